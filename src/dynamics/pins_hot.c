/* SPDX-License-Identifier: BSD-3-Clause */
/* The geometry of all revolute joints, with the equations of mechanism/joints/pin_rows.c:
 *
 *   Phi   = r_a + p_a - r_b - p_b,   Phi' likewise,   gamma = p_a w_a^2 - p_b w_b^2
 *   r     = bending gamma - damping Phi' - stiffness Phi
 *   c_a   = k x p_a,   c_b = -k x p_b
 *   D     = (w_a0 + w_b0) I + w_a2 c_a c_a^T + w_b2 c_b c_b^T
 *   J a0 - r
 *
 * No J is formed. Arms and gamma are rounded as where J and gamma are reported: fused products would
 * give another J, by a last digit, which close to a singular pose counts.
 */
#include "base/hot.h"
#include "base/pair.h"
#include "dynamics/pins.h"

/* A point of a body: arm p, its turn k x p, place, velocity, and p w^2. */
typedef struct marker {
  baum_i_pair turned;
  baum_i_pair place;
  baum_i_pair rate;
  baum_i_pair bend;
} marker;

static inline marker marker_on(const baum_i_frame *f, const double *point)
{
  baum_i_pair s = baum_i_load(point);
  baum_i_pair p = baum_i_rounded(f->c * s) + baum_i_rounded(f->s * baum_i_turned(s));
  marker m;
  m.turned = baum_i_turned(p);
  m.place = baum_i_load(&f->x) + p;
  m.rate = baum_i_load(&f->vx) + f->w * m.turned;
  m.bend = baum_i_rounded(p * (f->w * f->w));
  return m;
}

/* w: weights of both triples. */
static inline baum_i_square pivot_of(const marker *a, const marker *b, const double w[4])
{
  baum_i_pair weighted_a = w[1] * a->turned;
  baum_i_pair weighted_b = w[3] * b->turned;
  baum_i_pair on = weighted_a * a->turned + weighted_b * b->turned + (w[0] + w[2]);
  double off = weighted_a[0] * a->turned[1] + weighted_b[0] * b->turned[1];
  return (baum_i_square){{{on[0], off}, {off, on[1]}}};
}

static void set_pins(baum_i_block *block, const baum_i_pins *pins)
{
  const baum_i_pins at = *pins;
  const double *weight = block->pin_weight;
  const double *free = block->from;
  const double *point = at.points;
  double *arm = block->arm;
  double *rights = block->right;
  baum_i_node *nodes = block->nodes;
  const baum_i_pin_node *end = block->pins + block->pin_count;
  for (const baum_i_pin_node *pin = block->pins; pin < end; pin++) {
    ptrdiff_t row = pin->row;
    ptrdiff_t k = pin->node;
    size_t ta = (size_t)pin->triple[0];
    size_t tb = (size_t)pin->triple[1];
    /* Triples of planar bodies have the numbers of the bodies. */
    marker a = marker_on(&at.frames[ta], point);
    marker b = marker_on(&at.frames[tb], point + 2);
    baum_i_pair phi = a.place - b.place;
    baum_i_pair rate = a.rate - b.rate;
    baum_i_pair gamma = a.bend - b.bend;
    baum_i_pair right = at.bending * gamma - at.damping * rate - at.stiffness * phi;
    const double *x = free + pin->place[0];
    const double *y = free + pin->place[1];
    baum_i_pair miss = baum_i_load(x) - baum_i_load(y) + x[2] * a.turned - y[2] * b.turned - right;
    baum_i_square pivot = pivot_of(&a, &b, weight);
    baum_i_store(at.phi + row, phi);
    baum_i_store(at.phi_rate + row, rate);
    baum_i_store(at.gamma + row, gamma);
    baum_i_node *node = &nodes[k];
    baum_i_store(rights + 2 * k, right);
    baum_i_store(arm, a.turned);
    baum_i_store(arm + 2, -b.turned);
    baum_i_store_square(node->pivot, pivot);
    baum_i_store(node->lambda, miss);
    node->size = pivot.column[0][0] * pivot.column[1][1];
    point += 4;
    arm += 4;
    weight += 4;
  }
}

const baum_i_pins_kernel BAUM_I_HOT(baum_i_pins_kernel) = {.set = set_pins};
