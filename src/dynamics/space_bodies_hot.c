/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the frames of bodies in space, and the weights and gyroscopic moments. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dynamics/space_joints.h"
#include "linear/space_columns.h"

enum { MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_four four;

/* Normalizes a quaternion unless its length is 1 up to rounding. */
BAUM_I_INLINE four unit(four p)
{
  double square = baum_i_four_sum(baum_i_four_times(p, p));
  bool is_unit = fabs(square - 1.0) <= 8.0 * DBL_EPSILON;
  return is_unit ? p : baum_i_four_over(p, baum_i_four_all(sqrt(square)));
}

/* Computes the columns and the rows of A of a unit quaternion. */
BAUM_I_INLINE void set_axes(four p, four columns[3], four rows[3])
{
  const four one = baum_i_four_set(1.0, 1.0, 1.0, 0.0);
  four x = baum_i_four_set(baum_i_four_get(p, 1), baum_i_four_get(p, 2), baum_i_four_get(p, 3), 0);
  four twice = baum_i_four_plus(x, x);
  four squares = baum_i_four_times(x, twice);
  four next = baum_i_four_rotated(x);
  four last = baum_i_four_times(baum_i_four_rotated(next), baum_i_four_all(baum_i_four_get(p, 0)));
  squares = baum_i_four_rotated(baum_i_four_plus(squares, baum_i_four_rotated(squares)));
  four diagonal = baum_i_four_minus(one, squares);
  four products = baum_i_four_times(twice, next);
  last = baum_i_four_plus(last, last);
  four below = baum_i_four_plus(products, last);  /* A_10, A_21, A_02 */
  four above = baum_i_four_minus(products, last); /* A_01, A_12, A_20 */
  baum_i_four_mix(diagonal, baum_i_four_rotated(baum_i_four_rotated(below)), above, columns);
  baum_i_four_mix(diagonal, baum_i_four_rotated(baum_i_four_rotated(above)), below, rows);
}

BAUM_I_INLINE four three(const double *from)
{
  return from ? baum_i_four_set(from[0], from[1], from[2], 0.0) : baum_i_four_zero();
}

/* Returns (I w) x w. Both products of an entry are rounded, so that they cancel exactly if two
 * moments of inertia are equal. A rounding error could be large compared with the third moment. */
BAUM_I_INLINE four gyroscopic_moment(const double *inertia, const double *w)
{
  four momentum = baum_i_four_turned(inertia, w);
  four first = baum_i_four_times(momentum, baum_i_four_rotated(three(w)));
  four second = baum_i_four_times(baum_i_four_rotated(momentum), three(w));
  return baum_i_four_rotated(
    baum_i_four_minus(baum_i_four_rounded(first), baum_i_four_rounded(second)));
}

/* Sets the force on a body in space, and a0. */
BAUM_I_INLINE void set_force(const baum_i_space *b, int body, bool rigid, const double *w,
                             const baum_i_space_pass *pass)
{
  const baum_i_space_body *own = &b->bodies[body];
  ptrdiff_t first = pass->places[body].v;
  double *f = b->force + (ptrdiff_t)MOTION * body;
  double *a0 = b->free + (ptrdiff_t)MOTION * body;
  four push = baum_i_four_times(three(pass->gravity), baum_i_four_all(own->heft));
  four turn = baum_i_four_zero();
  baum_i_store(pass->force + first, baum_i_four_low(push));
  pass->force[first + 2] = baum_i_four_high(push)[0];
  if (rigid && w) {
    turn = gyroscopic_moment(own->inertia, w);
  }
  if (rigid && pass->moments) {
    turn = three(pass->moments + first + 3);
  }
  if (rigid) {
    baum_i_store(pass->force + first + 3, baum_i_four_low(turn));
    pass->force[first + 5] = baum_i_four_high(turn)[0];
  }
  if (own->fixed) {
    return;
  }
  double moment[4];
  baum_i_four_store(moment, turn);
  four white = baum_i_four_turned(own->whiten, moment);
  baum_i_four_store(f, push);
  baum_i_four_store(a0, baum_i_four_times(push, baum_i_four_load(own->weight)));
  baum_i_four_store(f + 4, white);
  baum_i_four_store(a0 + 4, white);
}

/* Sets the frame of a body with the angular velocity w in body axes. Returns the angular velocity
 * in ground axes. */
BAUM_I_INLINE four set_frame(baum_i_space_frame *to, const four a[3], const double *w)
{
  four turning = baum_i_four_zero();
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    baum_i_four_store(to->columns + (ptrdiff_t)4 * c, a[c]);
    turning = w ? baum_i_four_add(turning, a[c], w[c]) : turning;
  }
  four spin = three(w);
  double square = baum_i_four_sum(baum_i_four_times(spin, spin));
  baum_i_four_store(to->spin, baum_i_four_put(spin, 3, square));
  return turning;
}

BAUM_I_INLINE void set_body(const baum_i_space *b, int body, const baum_i_space_pass *pass)
{
  const baum_i_body_place *place = &pass->places[body];
  const double *q = pass->q + place->q;
  const double *v = pass->v ? pass->v + place->v : NULL;
  bool rigid = place->kind == BAUM_I_FRAME_SPATIAL_BODY;
  baum_i_spatial_frame *frame = &pass->spatial[body];
  four p = rigid ? unit(baum_i_four_load(q + 3)) : baum_i_four_set(1.0, 0.0, 0.0, 0.0);
  four r = three(q);
  if (pass->normalized) {
    double *copy = pass->normalized + place->q;
    baum_i_store(copy, baum_i_four_low(r));
    copy[2] = baum_i_four_high(r)[0];
    if (rigid) {
      baum_i_four_store(copy + 3, p);
    }
  }
  four a[3];
  four rows[3];
  set_axes(p, a, rows);
  baum_i_four_store(frame->w, set_frame(&pass->joints.frames[body], a, rigid && v ? v + 3 : NULL));
  baum_i_four_store(frame->r, r);
  baum_i_four_store(frame->v, three(v));
  /* each store of a row writes one number too many, which the next store overwrites */
  BAUM_I_UNROLL(3)
  for (int i = 0; i < 3; i++) {
    baum_i_four_store(frame->axes + (ptrdiff_t)3 * i, rows[i]);
  }
  if (pass->gravity) {
    set_force(b, body, rigid, v ? v + 3 : NULL, pass);
  }
}

/* Computes the frame in space of a planar body. */
BAUM_I_INLINE void set_planar_body(int body, const baum_i_space_pass *pass)
{
  const baum_i_frame *f = &pass->frames[body];
  const baum_i_body_place *place = &pass->places[body];
  const double c = f->c, s = f->s;
  const four columns[3] = {baum_i_four_set(c, s, 0.0, 0.0), baum_i_four_set(-s, c, 0.0, 0.0),
                           baum_i_four_set(0.0, 0.0, 1.0, 0.0)};
  (void)set_frame(&pass->joints.frames[body], columns, (const double[]){0.0, 0.0, f->w});
  pass->spatial[body] = baum_i_lifted(f);
  if (pass->normalized) {
    size_t size = place->kind == BAUM_I_FRAME_BODY ? 3 : 2;
    memcpy(pass->normalized + place->q, pass->q + place->q, size * sizeof *pass->q);
  }
}

static void set_bodies(baum_i_space *b, const baum_i_space_pass *pass, int first, int end)
{
  const baum_i_space_pass at = *pass;
  for (int k = at.joints.body_start[first]; k < at.joints.body_start[end]; k++) {
    int i = at.joints.bodies[k];
    if (baum_i_is_spatial((baum_i_frame_kind)at.places[i].kind)) {
      set_body(b, i, &at);
    } else {
      set_planar_body(i, &at);
    }
  }
}

const baum_i_space_bodies_kernel BAUM_I_HOT(baum_i_space_bodies_kernel) = {.set = set_bodies};
