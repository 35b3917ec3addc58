/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the frames of bodies in space and the geometry of joints between them. A point s of a
 * body has the arm d = A s and the position r + d. Let e be the position of a joint's point on b
 * minus the position of its point on a. With the upper sign for k = a and the lower sign for k = b,
 * the rows and sides [E | R] (space_block.h) are
 *
 *   rows p   Phi = e,      R_k = +- A_k [s_k]x L_k^-T,                        E = -+ I
 *   row d    Phi = x . y   (axis x on a, axis y on b)
 *            R_a = cross(x, y)^T B_a,   R_b = -cross(x, y)^T B_b
 *   row e    a row d with the same y as the row before it
 *   row s    Phi = x . e   (axis x on a)
 *            R_a = cross(x, e + d_a)^T B_a,   R_b = cross(d_b, x)^T B_b,   E = -+ x
 *
 * gamma is -Phi'' without the terms of accelerations. For a row d, let W_a and W_b be the angular
 * velocities, y' = cross(W_b, y) and z = y' - cross(W_a, y). Then Phi' = z . x and gamma =
 * -(cross(W_b, y') + cross(y' + z, W_a)) . x.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "dynamics/space_joints.h"
#include "linear/space_columns.h"

enum { MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_four four;
typedef baum_i_space_column column;

/* ---- bodies ---- */

/* Normalizes a quaternion unless its length is 1 up to rounding. */
BAUM_I_INLINE four unit(four p)
{
  double square = baum_i_four_sum(baum_i_four_times(p, p));
  bool is_unit = fabs(square - 1.0) <= 8.0 * DBL_EPSILON;
  return is_unit ? p : baum_i_four_over(p, baum_i_four_all(sqrt(square)));
}

/* Sets m to the vectors (x_0, y_1, z_2), (z_0, x_1, y_2) and (y_0, z_1, x_2), each followed by
 * x_3. */
BAUM_I_INLINE void mix(four x, four y, four z, four m[3])
{
  m[0] = baum_i_four_move(baum_i_four_move(x, 1, y, 1), 2, z, 2);
  m[1] = baum_i_four_move(baum_i_four_move(x, 2, y, 2), 0, z, 0);
  m[2] = baum_i_four_move(baum_i_four_move(x, 0, y, 0), 1, z, 1);
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
  mix(diagonal, baum_i_four_rotated(baum_i_four_rotated(below)), above, columns);
  mix(diagonal, baum_i_four_rotated(baum_i_four_rotated(above)), below, rows);
}

BAUM_I_INLINE four three(const double *from)
{
  return from ? baum_i_four_set(from[0], from[1], from[2], 0.0) : baum_i_four_zero();
}

/* Computes A x. */
BAUM_I_INLINE four turned(const double *axes, const double *x)
{
  four sum = baum_i_four_times(baum_i_four_load(axes), baum_i_four_all(x[0]));
  sum = baum_i_four_add(sum, baum_i_four_load(axes + 4), x[1]);
  return baum_i_four_add(sum, baum_i_four_load(axes + 8), x[2]);
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
    four momentum = turned(own->inertia, w);
    turn = baum_i_four_cross(momentum, three(w));
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
  four white = turned(own->whiten, moment);
  baum_i_four_store(f, push);
  baum_i_four_store(a0, baum_i_four_times(push, baum_i_four_load(own->weight)));
  baum_i_four_store(f + 4, white);
  baum_i_four_store(a0 + 4, white);
}

BAUM_I_INLINE void set_body(const baum_i_space *b, int body, const baum_i_space_pass *pass)
{
  const baum_i_body_place *place = &pass->places[body];
  const double *white = b->bodies[body].whiten;
  const double *q = pass->q + place->q;
  const double *v = pass->v ? pass->v + place->v : NULL;
  bool rigid = place->kind == BAUM_I_FRAME_SPATIAL_BODY;
  baum_i_space_frame *to = &pass->joints.frames[body];
  baum_i_spatial_frame *other = &pass->spatial[body];
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
  four w = baum_i_four_zero();
  four velocity = three(v);
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) { /* L^-T is upper triangular */
    four sum = baum_i_four_times(a[0], baum_i_four_all(white[c]));
    for (int k = 1; k <= c; k++) {
      sum = baum_i_four_add(sum, a[k], white[4 * k + c]);
    }
    baum_i_four_store(to->axes + (ptrdiff_t)4 * c, a[c]);
    baum_i_four_store(to->turned + (ptrdiff_t)4 * c, sum);
    w = rigid && v ? baum_i_four_add(w, a[c], v[3 + c]) : w;
  }
  baum_i_four_store(to->r, r);
  baum_i_four_store(to->v, velocity);
  baum_i_four_store(to->w, w);
  /* each store writes one number too many, which the next store overwrites */
  baum_i_four_store(other->r, r);
  baum_i_four_store(other->v, velocity);
  baum_i_four_store(other->w, w);
  baum_i_four_store(other->axes, rows[0]);
  baum_i_four_store(other->axes + 3, rows[1]);
  baum_i_store(other->axes + 6, baum_i_four_low(rows[2]));
  other->axes[8] = baum_i_four_high(rows[2])[0];
  if (pass->gravity) {
    set_force(b, body, rigid, v ? v + 3 : NULL, pass);
  }
}

/* Computes the spatial frame of a planar body. Only the last column of L^-T is not zero, where L
 * L^T is the inertia tensor of the body. */
BAUM_I_INLINE void set_planar_body(const baum_i_space *b, int body, const baum_i_space_pass *pass)
{
  const baum_i_frame *f = &pass->frames[body];
  const baum_i_body_place *place = &pass->places[body];
  baum_i_space_frame *to = &pass->joints.frames[body];
  const double c = f->c, s = f->s;
  baum_i_four_store(to->axes, baum_i_four_set(c, s, 0.0, 0.0));
  baum_i_four_store(to->axes + 4, baum_i_four_set(-s, c, 0.0, 0.0));
  baum_i_four_store(to->axes + 8, baum_i_four_set(0.0, 0.0, 1.0, 0.0));
  baum_i_four_store(to->turned + 8, baum_i_four_set(0.0, 0.0, b->bodies[body].whiten[10], 0.0));
  baum_i_four_store(to->r, baum_i_four_of(baum_i_load(&f->x)));
  baum_i_four_store(to->v, baum_i_four_of(baum_i_load(&f->vx)));
  baum_i_four_store(to->w, baum_i_four_set(0.0, 0.0, f->w, 0.0));
  if (place->in_space) {
    pass->spatial[body] = baum_i_lifted(f);
  }
  if (pass->normalized) {
    size_t size = place->kind == BAUM_I_FRAME_BODY ? 3 : 2;
    memcpy(pass->normalized + place->q, pass->q + place->q, size * sizeof *pass->q);
  }
}

static void set_bodies(baum_i_space *b, const baum_i_space_pass *pass)
{
  const baum_i_space_pass at = *pass;
  for (int i = 1; i < b->body_count; i++) {
    if (baum_i_is_spatial((baum_i_frame_kind)at.places[i].kind)) {
      set_body(b, i, &at);
    } else {
      set_planar_body(b, i, &at);
    }
  }
}

/* ---- joints ---- */

/* Quantities of a joint's point on one body. */
typedef struct marker {
  four arm;   /* d */
  four place; /* r + d */
  four rate;
  four bend; /* cross(W, cross(W, d)), where W is the angular velocity */
} marker;

BAUM_I_INLINE marker marker_on(const baum_i_space_frame *f, const double *s)
{
  marker m;
  four w = baum_i_four_load(f->w);
  m.arm = turned(f->axes, s);
  four swing = baum_i_four_cross(w, m.arm);
  m.place = baum_i_four_plus(baum_i_four_load(f->r), m.arm);
  m.rate = baum_i_four_plus(baum_i_four_load(f->v), swing);
  m.bend = baum_i_four_cross(w, swing);
  return m;
}

/* All rows of a joint. */
typedef struct rows {
  four turn[2][BAUM_I_SPACE_ROWS]; /* rows of R of both sides, except for rows p */
  column move[3];                  /* columns of E_b = -E_a, set only in rows s */
  column phi;
  column rate;
  column gamma;
} rows;

/* Sets number i of a column to number c of y. */
BAUM_I_INLINE void put(column *x, int i, four y, int c)
{
  double s = i < 4 ? 0.0 : baum_i_four_get(y, c);
  if (i < 4) {
    x->low = baum_i_four_move(x->low, i, y, c);
  } else {
    x->high = i == 4 ? (baum_i_pair){s, x->high[1]} : (baum_i_pair){x->high[0], s};
  }
}

/* A direction y on body b. For the row x . y with an axis x on body a, Phi' is x . z and gamma is
 * -x . bend. */
typedef struct direction {
  four y;
  four z;    /* the time derivative of y, relative to body a */
  four bend; /* the second derivative without the terms of accelerations */
} direction;

BAUM_I_INLINE direction direction_on(const baum_i_space_frame *f, const baum_i_space_frame *g,
                                     const double *axis)
{
  four w = baum_i_four_load(f->w);
  four u = baum_i_four_load(g->w);
  direction d = {.y = turned(g->axes, axis)};
  four y1 = baum_i_four_cross(u, d.y);
  d.z = baum_i_four_minus(y1, baum_i_four_cross(w, d.y));
  d.bend =
    baum_i_four_plus(baum_i_four_cross(u, y1), baum_i_four_cross(baum_i_four_plus(y1, d.z), w));
  return d;
}

/* Sets row i of R_k to (t_k)^T B_k for both bodies k. Sets Phi to the sum of the numbers in
 * terms[0], Phi' to the sum of those in terms[1], and -gamma to the sum of those in terms[2]. */
BAUM_I_INLINE void put_row(const baum_i_space_frame *f, const baum_i_space_frame *g,
                           const four t[2], const four terms[3], int i, rows *out)
{
  four sums[2][4];
  BAUM_I_UNROLL(2)
  for (int k = 0; k < 2; k++) {
    const double *b = (k == 0 ? f : g)->turned;
    BAUM_I_UNROLL(3)
    for (int c = 0; c < 3; c++) {
      sums[k][c] = baum_i_four_times(t[k], baum_i_four_load(b + 4 * c));
    }
    sums[k][3] = terms[k];
    out->turn[k][i] = baum_i_four_sums(sums[k]);
    put(k == 0 ? &out->phi : &out->rate, i, out->turn[k][i], 3);
  }
  put(&out->gamma, i, baum_i_four_all(-baum_i_four_sum(terms[2])), 0);
}

/* Sets row i, of kind d: x . y */
BAUM_I_INLINE void set_direction_row(const baum_i_space_frame *f, const baum_i_space_frame *g,
                                     const direction *d, const double *axis, double keep, int i,
                                     rows *out)
{
  four x = turned(f->axes, axis);
  four t = baum_i_four_times(baum_i_four_cross(x, d->y), baum_i_four_all(keep));
  const four both[2] = {t, baum_i_four_minus(baum_i_four_zero(), t)};
  const four terms[3] = {baum_i_four_times(x, d->y), baum_i_four_times(x, d->z),
                         baum_i_four_times(x, d->bend)};
  put_row(f, g, both, terms, i, out);
}

/* Sets row i, of kind s: x . e */
BAUM_I_INLINE void set_slide_row(const baum_i_space_frame *f, const baum_i_space_frame *g,
                                 const marker m[2], const double *axis, double keep, int i,
                                 rows *out)
{
  four w = baum_i_four_load(f->w);
  four x = turned(f->axes, axis);
  four x1 = baum_i_four_cross(w, x);
  four x2 = baum_i_four_cross(w, x1);
  four e = baum_i_four_minus(m[1].place, m[0].place);
  four e1 = baum_i_four_minus(m[1].rate, m[0].rate);
  four e2 = baum_i_four_minus(m[1].bend, m[0].bend);
  four kept = baum_i_four_times(x, baum_i_four_all(keep));
  const four t[2] = {baum_i_four_cross(kept, baum_i_four_plus(e, m[0].arm)),
                     baum_i_four_cross(m[1].arm, kept)};
  four bend = baum_i_four_plus(baum_i_four_times(x2, e), baum_i_four_times(x, e2));
  const four terms[3] = {baum_i_four_times(x, e),
                         baum_i_four_plus(baum_i_four_times(x1, e), baum_i_four_times(x, e1)),
                         baum_i_four_plus(bend, baum_i_four_times(baum_i_four_plus(x1, x1), e1))};
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    put(&out->move[c], i, kept, c);
  }
  put_row(f, g, t, terms, i, out);
}

/* Stores the first n numbers of a column. */
BAUM_I_INLINE void store_rows(double *to, column x, int n)
{
  if (n >= 4) {
    baum_i_four_store(to, x.low);
  } else if (n >= 2) {
    baum_i_store(to, baum_i_four_low(x.low));
  }
  if (n == 3) {
    to[2] = baum_i_four_high(x.low)[0];
  } else if (n == 1) {
    to[0] = baum_i_four_low(x.low)[0];
  } else if (n == 5) {
    to[4] = x.high[0];
  } else if (n == 6) {
    baum_i_store(to + 4, x.high);
  }
}

/* Returns r of the node, and sets the joint's `own` rows of Phi, Phi' and gamma in the workspace. */
BAUM_I_INLINE column set_rates(const baum_i_space_joint *joint, int n, int own, const double *keep,
                               const rows *row, const baum_i_space_pass *at)
{
  bool tall = n > 4;
  column right = baum_i_column_times(row->gamma, at->bending, tall);
  right = baum_i_column_subtract(right, row->rate, at->damping, tall);
  right = baum_i_column_subtract(right, row->phi, at->stiffness, tall);
  column kept = baum_i_column_load(keep, 1, 0, tall);
  right.low = baum_i_four_times(right.low, kept.low);
  right.high = tall ? right.high * kept.high : right.high;
  store_rows(at->phi + joint->row, row->phi, own);
  store_rows(at->phi_rate + joint->row, row->rate, own);
  store_rows(at->gamma + joint->row, row->gamma, own);
  return right;
}

/* J a0 - r and D of a node. */
typedef struct equations {
  column sum;
  column d[BAUM_I_SPACE_ROWS];
} equations;

/* Sets E of both sides of a joint with rows s, and adds their parts to the equations. `apart` is
 * the difference of a0 of the two bodies. */
BAUM_I_INLINE void set_moves(const baum_i_space *b, const baum_i_space_joint *joint, int n,
                             const rows *row, four apart, equations *to)
{
  bool tall = n > 4;
  const double *weights[2] = {b->bodies[joint->body[0]].weight, b->bodies[joint->body[1]].weight};
  BAUM_I_UNROLL(2)
  for (int k = 0; k < 2; k++) {
    if (joint->turn[k] < 0) {
      continue;
    }
    BAUM_I_UNROLL(3)
    for (int c = 0; c < 3; c++) {
      column move = baum_i_column_times(row->move[c], k == 0 ? -1.0 : 1.0, tall);
      baum_i_column_store(b->sides + joint->move[k], 3, c, tall, move);
    }
  }
  int first = joint->turn[0] < 0 ? 1 : 0;
  double sign = first == 0 ? -1.0 : 1.0; /* E_a = -move */
  const double *move = b->sides + joint->move[first];
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    to->sum = baum_i_column_add(to->sum, row->move[c], baum_i_four_get(apart, c), tall);
    BAUM_I_UNROLL(6)
    for (int j = 0; j < n; j++) {
      double s = sign * (weights[0][c] + weights[1][c]) * move[baum_i_column_entry(3, j, c)];
      to->d[j] = baum_i_column_add(to->d[j], row->move[c], s, j >= 4);
    }
  }
}

/* Sets R of side k, and adds its part to the equations. */
BAUM_I_INLINE void set_turns(const baum_i_space *b, const baum_i_space_joint *joint, int n,
                             bool points, int k, const rows *row, const baum_i_space_pass *at,
                             equations *to)
{
  if (joint->turn[k] < 0) {
    return;
  }
  const double *axes = at->joints.frames[joint->body[k]].axes;
  const double *arms = at->joints.numbers + joint->numbers + BAUM_I_JOINT_ARMS + 12 * k;
  const double *free = b->from + (ptrdiff_t)MOTION * joint->body[k] + 4;
  double *stored = b->sides + joint->turn[k];
  column turn[3];
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    turn[c] = (column){points ? turned(axes, arms + 4 * c) : baum_i_four_zero(), {0.0, 0.0}};
    BAUM_I_UNROLL(6)
    for (int i = points ? 3 : 0; i < n; i++) {
      put(&turn[c], i, row->turn[k][i], c);
    }
    baum_i_column_store(stored, 3, c, n > 4, turn[c]);
    to->sum = baum_i_column_add(to->sum, turn[c], free[c], n > 4);
  }
  BAUM_I_UNROLL(6)
  for (int j = 0; j < n; j++) {
    BAUM_I_UNROLL(3)
    for (int c = 0; c < 3; c++) {
      to->d[j] = baum_i_column_add(to->d[j], turn[c], stored[baum_i_column_entry(3, j, c)], j >= 4);
    }
  }
}

/* Stores D. The diagonal entry of a spin row is only what remains of u . u - 1, so it does not count
 * in the size. */
BAUM_I_INLINE void store_pivot(const baum_i_space *b, int node, int n, int own,
                               const column from[BAUM_I_SPACE_ROWS])
{
  double *d = b->nodes + b->list[node].at + baum_i_space_pivot(n);
  baum_i_space_measure *measure = &b->measures[node];
  double size[2] = {1.0, 1.0};
  BAUM_I_UNROLL(6)
  for (int j = 0; j < n; j++) {
    baum_i_four_store(d + 4 * j, from[j].low);
    if (j >= 4) {
      baum_i_store(d + 4 * n + 2 * (j - 4), from[j].high);
    }
    if (j < own) {
      size[j < 3 ? 0 : 1] *= j < 4 ? baum_i_four_get(from[j].low, j) : from[j].high[j - 4];
    }
  }
  measure->size[0] = size[0];
  measure->size[1] = size[1];
}

/* Sets the sides of a joint, r, J a0 - r and D. If n > own, the last row is a spin row. */
BAUM_I_INLINE void set_node(const baum_i_space *b, const baum_i_space_joint *joint, int n, int own,
                            bool points, bool slides, const rows *row, const baum_i_space_pass *at)
{
  const double *numbers = at->joints.numbers + joint->numbers;
  const double *diagonal = numbers + BAUM_I_JOINT_DIAGONAL;
  four apart = baum_i_four_minus(baum_i_four_load(b->from + (ptrdiff_t)MOTION * joint->body[1]),
                                 baum_i_four_load(b->from + (ptrdiff_t)MOTION * joint->body[0]));
  equations to = {.sum = {points ? apart : baum_i_four_zero(), {0.0, 0.0}}};
  column right = set_rates(joint, n, own, numbers + BAUM_I_JOINT_KEEP, row, at);
  to.sum = baum_i_column_subtract(to.sum, right, 1.0, n > 4);
  BAUM_I_UNROLL(6)
  for (int j = 0; j < n; j++) {
    to.d[j] = (column){baum_i_four_zero(), {0.0, 0.0}};
    put(&to.d[j], j, baum_i_four_all(diagonal[j]), 0);
  }
  if (slides) {
    set_moves(b, joint, n, row, apart, &to);
  }
  set_turns(b, joint, n, points, 0, row, at, &to);
  set_turns(b, joint, n, points, 1, row, at, &to);
  double *stored = b->nodes + b->list[joint->node].at;
  baum_i_column_store(stored, 1, 0, n > 4, to.sum);
  baum_i_column_store(stored + baum_i_space_vector(n), 1, 0, n > 4, right);
  store_pivot(b, joint->node, n, own, to.d);
}

/* Computes the n rows of a joint and writes them to the solver. If `points` is true, the first
 * three rows are of kind p. `slides` has bit i set if row i is of kind s. `again` is the row of
 * kind e, or 0 if there is none. If n > own, the last row is a spin row. */
BAUM_I_INLINE void set_joint(const baum_i_space *b, const baum_i_space_joint *joint, int n, int own,
                             bool points, unsigned slides, int again, const baum_i_space_pass *at)
{
  const baum_i_space_frame *f = &at->joints.frames[joint->body[0]];
  const baum_i_space_frame *g = &at->joints.frames[joint->body[1]];
  const double *numbers = at->joints.numbers + joint->numbers;
  const double *axes = numbers + BAUM_I_JOINT_AXES;
  const double *keep = numbers + BAUM_I_JOINT_KEEP;
  const column zero = {baum_i_four_zero(), {0.0, 0.0}};
  rows row = {.move = {zero, zero, zero}, .phi = zero, .rate = zero, .gamma = zero};
  const marker m[2] = {marker_on(f, numbers), marker_on(g, numbers + 4)};
  direction d;
  if (points) {
    row.phi.low = baum_i_four_minus(m[1].place, m[0].place);
    row.rate.low = baum_i_four_minus(m[1].rate, m[0].rate);
    row.gamma.low = baum_i_four_minus(m[0].bend, m[1].bend);
  }
  BAUM_I_UNROLL(6)
  for (int i = points ? 3 : 0; i < own; i++) {
    if ((slides >> i & 1u) != 0) {
      set_slide_row(f, g, m, axes, keep[i], i, &row);
    } else {
      d = i == again && i > 0 ? d : direction_on(f, g, axes + 4);
      set_direction_row(f, g, &d, axes, keep[i], i, &row);
    }
    axes += 8;
  }
  if (n > own) {
    row.turn[0][own] = baum_i_four_load(axes);
    row.turn[1][own] = baum_i_four_load(axes + 4);
  }
  set_node(b, joint, n, own, points, slides != 0, &row, at);
}

BAUM_I_INLINE void set_joint_of_shape(const baum_i_space *b, const baum_i_space_joint *joint,
                                      const baum_i_space_pass *at)
{
  switch ((baum_i_space_shape)joint->shape) {
  case BAUM_I_SHAPE_PIN: set_joint(b, joint, 2, 2, true, 0, 0, at); break;
  case BAUM_I_SHAPE_P: set_joint(b, joint, 3, 3, true, 0, 0, at); break;
  case BAUM_I_SHAPE_PD: set_joint(b, joint, 4, 4, true, 0, 0, at); break;
  case BAUM_I_SHAPE_PDE: set_joint(b, joint, 5, 5, true, 0, 4, at); break;
  case BAUM_I_SHAPE_PDED: set_joint(b, joint, 6, 6, true, 0, 4, at); break;
  case BAUM_I_SHAPE_DESS: set_joint(b, joint, 4, 4, false, 0xc, 1, at); break;
  case BAUM_I_SHAPE_DESSD: set_joint(b, joint, 5, 5, false, 0xc, 1, at); break;
  case BAUM_I_SHAPE_DES: set_joint(b, joint, 3, 3, false, 0x4, 1, at); break;
  case BAUM_I_SHAPE_SS: set_joint(b, joint, 2, 2, false, 0x3, 0, at); break;
  case BAUM_I_SHAPE_S: set_joint(b, joint, 1, 1, false, 0x1, 0, at); break;
  case BAUM_I_SHAPE_PU: set_joint(b, joint, 4, 3, true, 0, 0, at); break;
  case BAUM_I_SHAPE_PDU: set_joint(b, joint, 5, 4, true, 0, 0, at); break;
  case BAUM_I_SHAPE_PDEU: set_joint(b, joint, 6, 5, true, 0, 4, at); break;
  case BAUM_I_SHAPE_DESSDU: set_joint(b, joint, 6, 5, false, 0xc, 1, at); break;
  case BAUM_I_SHAPES:
  default: break;
  }
}

static void set_joints(baum_i_space *b, const baum_i_space_pass *pass)
{
  const baum_i_space_pass at = *pass;
  for (int i = 0; i < at.joints.count; i++) {
    set_joint_of_shape(b, &at.joints.list[i], &at);
  }
}

const baum_i_space_joints_kernel BAUM_I_HOT(baum_i_space_joints_kernel) = {
  .set_bodies = set_bodies, .set_joints = set_joints};
