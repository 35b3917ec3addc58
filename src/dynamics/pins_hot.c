/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the geometry of all planar revolute joints (called pins) together. The equations are
 * those of mechanism/planar/lower_pairs.c:
 *
 *   Phi   = r_a + p_a - r_b - p_b,   Phi' likewise,   gamma = p_a w_a^2 - p_b w_b^2
 *   r     = bending gamma - damping Phi' - stiffness Phi
 *   c_a   = k x p_a,   c_b = -k x p_b
 *   D     = (w_a0 + w_b0) I + w_a2 c_a c_a^T + w_b2 c_b c_b^T
 *   J a0 - r
 *
 * In Phi, r_a is the origin of body a, and p_a is the vector from it to the point of the joint. In
 * gamma, w_a is the angular velocity of body a. The vector k is the normal of the plane. In the
 * pivot D, w_a0 and w_a2 are the first and the third diagonal entry of the inverse mass matrix of
 * body a. The index b marks the same quantities of body b. a0 are the accelerations without
 * constraint forces.
 *
 * J is not formed. c_a, c_b and gamma are rounded exactly like the J and gamma that users receive.
 * The compiler therefore may not use fused multiply-add instructions for them. Close to a singular
 * configuration, a difference in the last digit would matter.
 */
#include "base/four.h"
#include "dynamics/pins.h"

/* The kernel processes two pins at a time, one in each half of a vector. If the number of pins is
 * odd, the last pin is processed in both halves, and only one half of the result is stored. This
 * struct points to the data of two pins. */
typedef struct two_pins {
  /* Index of the second pin: 1, or 0 if there is only one pin; the compiler knows its value after
   * inlining. */
  ptrdiff_t second;
  const baum_i_pin_node *pin;
  const double *points;
  const double *weight;
  double *arm;
} two_pins;

/* Quantities of the point p of a body: k x p, the position, the velocity, and p w^2. */
typedef struct markers {
  baum_i_four turned;
  baum_i_four place;
  baum_i_four rate;
  baum_i_four bend;
} markers;

/* Compute the markers of one point on each of two bodies. The points `s` are given in body axes. */
BAUM_I_INLINE markers markers_on(const baum_i_frame *f, const baum_i_frame *g, baum_i_four s)
{
  baum_i_four along = baum_i_four_times(baum_i_four_spread(&f->c, &g->c), s);
  baum_i_four across =
    baum_i_four_times(baum_i_four_spread(&f->s, &g->s), baum_i_four_exchanged(s));
  baum_i_four p = baum_i_four_minus_plus(baum_i_four_rounded(along), baum_i_four_rounded(across));
  baum_i_four exchanged = baum_i_four_exchanged(p);
  baum_i_four w = baum_i_four_spread(&f->w, &g->w);
  markers m;
  m.turned = baum_i_four_times(exchanged, baum_i_four_in_turns(-1.0, 1.0));
  m.place = baum_i_four_plus(baum_i_four_gathered(&f->x, &g->x), p);
  m.rate = baum_i_four_plus(baum_i_four_gathered(&f->vx, &g->vx), baum_i_four_times(w, m.turned));
  m.bend = baum_i_four_rounded(baum_i_four_times(p, baum_i_four_times(w, w)));
  return m;
}

/* Compute the markers on one body of both pins; `body` is 0 for body a and 1 for body b. */
BAUM_I_INLINE markers markers_of(const two_pins *two, const baum_i_frame *frames, int body)
{
  /* Pins connect planar bodies, whose body blocks have the same numbers as the bodies. */
  return markers_on(
    &frames[(ptrdiff_t)two->pin[0].body_block[body]],
    &frames[(ptrdiff_t)two->pin[two->second].body_block[body]],
    baum_i_four_gathered(two->points + 2 * body, two->points + 4 * two->second + 2 * body));
}

BAUM_I_INLINE void put(const two_pins *two, double *low, double *high, baum_i_four x)
{
  baum_i_store(low, baum_i_four_low(x));
  if (two->second) {
    baum_i_store(high, baum_i_four_high(x));
  }
}

/* Compute J a0 of both pins. */
BAUM_I_INLINE baum_i_four push_of(const two_pins *two, const double *free, const markers *a,
                                  const markers *b)
{
  const double *x = free + two->pin[0].place[0];
  const double *y = free + two->pin[0].place[1];
  const double *z = free + two->pin[two->second].place[0];
  const double *u = free + two->pin[two->second].place[1];
  baum_i_four of_a = baum_i_four_times(baum_i_four_spread(x + 2, z + 2), a->turned);
  baum_i_four of_b = baum_i_four_times(baum_i_four_spread(y + 2, u + 2), b->turned);
  baum_i_four moving = baum_i_four_minus(baum_i_four_gathered(x, z), baum_i_four_gathered(y, u));
  return baum_i_four_minus(baum_i_four_plus(moving, of_a), of_b);
}

BAUM_I_INLINE void put_pivot(baum_i_node *node, baum_i_pair on, baum_i_pair off, baum_i_pair miss)
{
  baum_i_store(node->pivot, (baum_i_pair){on[0], off[0]});
  baum_i_store(node->pivot + 2, (baum_i_pair){off[0], on[1]});
  baum_i_store(node->lambda, miss);
  node->size = on[0] * on[1];
}

BAUM_I_INLINE void set_nodes(const two_pins *two, baum_i_four c_a, baum_i_four c_b,
                             baum_i_four miss, baum_i_node *nodes)
{
  baum_i_node *node[2] = {&nodes[(ptrdiff_t)two->pin[0].node],
                          &nodes[(ptrdiff_t)two->pin[two->second].node]};
  const double *w = two->weight;
  const double *u = two->weight + 4 * two->second;
  baum_i_four moving = baum_i_four_plus(baum_i_four_spread(w, u), baum_i_four_spread(w + 2, u + 2));
  baum_i_four weighted_a = baum_i_four_times(baum_i_four_spread(w + 1, u + 1), c_a);
  baum_i_four weighted_b = baum_i_four_times(baum_i_four_spread(w + 3, u + 3), c_b);
  baum_i_four on = baum_i_four_plus(moving, baum_i_four_plus(baum_i_four_times(weighted_a, c_a),
                                                             baum_i_four_times(weighted_b, c_b)));
  baum_i_four off = baum_i_four_plus(baum_i_four_times(weighted_a, baum_i_four_exchanged(c_a)),
                                     baum_i_four_times(weighted_b, baum_i_four_exchanged(c_b)));
  put_pivot(node[0], baum_i_four_low(on), baum_i_four_low(off), baum_i_four_low(miss));
  if (two->second) {
    put_pivot(node[1], baum_i_four_high(on), baum_i_four_high(off), baum_i_four_high(miss));
  }
}

BAUM_I_INLINE void set_two(const two_pins *two, const baum_i_pins *at, const baum_i_block *block)
{
  ptrdiff_t row[2] = {two->pin[0].row, two->pin[two->second].row};
  ptrdiff_t node[2] = {two->pin[0].node, two->pin[two->second].node};
  markers a = markers_of(two, at->frames, 0);
  markers b = markers_of(two, at->frames, 1);
  baum_i_four phi = baum_i_four_minus(a.place, b.place);
  baum_i_four rate = baum_i_four_minus(a.rate, b.rate);
  baum_i_four gamma = baum_i_four_minus(a.bend, b.bend);
  baum_i_four right = baum_i_four_times(baum_i_four_all(at->bending), gamma);
  right = baum_i_four_minus(right, baum_i_four_times(baum_i_four_all(at->damping), rate));
  right = baum_i_four_minus(right, baum_i_four_times(baum_i_four_all(at->stiffness), phi));
  baum_i_four miss = baum_i_four_minus(push_of(two, block->from, &a, &b), right);
  set_nodes(two, a.turned, b.turned, miss, block->nodes);
  put(two, at->phi + row[0], at->phi + row[1], phi);
  put(two, at->phi_rate + row[0], at->phi_rate + row[1], rate);
  put(two, at->gamma + row[0], at->gamma + row[1], gamma);
  put(two, block->right + 2 * node[0], block->right + 2 * node[1], right);
  put(two, two->arm, two->arm + 4 * two->second, a.turned);
  put(two, two->arm + 2, two->arm + 4 * two->second + 2,
      baum_i_four_minus(baum_i_four_all(0.0), b.turned));
}

static void set_pins(baum_i_block *block, const baum_i_pins *pins)
{
  const baum_i_block to = *block; /* a local copy, which can stay in registers */
  const baum_i_pins at = *pins;
  two_pins two = {1, to.pins, at.points, to.pin_weight, to.arm};
  for (int left = to.pin_count; left > 1; left -= 2) {
    set_two(&two, &at, &to);
    two.pin += 2;
    two.points += 8;
    two.weight += 8;
    two.arm += 8;
  }
  if (to.pin_count % 2 != 0) {
    const two_pins one = {0, two.pin, two.points, two.weight, two.arm};
    set_two(&one, &at, &to);
  }
}

const baum_i_pins_kernel BAUM_I_HOT(baum_i_pins_kernel) = {.set = set_pins};
