/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the geometry of joints between bodies in space from their frames. A point s of a body
 * has the arm d = A s and the position r + d. Let e be the position of a joint's point on b
 * minus the position of its point on a. The rows are
 *
 *   rows p   Phi = e, in ground axes
 *   row d    Phi = x . y   (axis x on a, axis y on b)
 *   row e    a row d with the same y as the row before it
 *   row s    Phi = x . e   (axis x on a)
 *
 * For each row and each body k there is a vector s_k, which is constant in the axes of the body,
 * and a vector z_k, also in these axes. The row of J for the angular acceleration of the body in
 * its own axes is n_a = cross(s_a, z_a) or n_b = cross(z_b, s_b). The side (space_block.h) of the
 * row is R = n_k L_k^-T and E:
 *
 *   rows   s_a              z_a                      s_b              z_b          E
 *   p      minus the point  row of A_a               minus the point  row of A_b   -+ I
 *   d, e   x                A_a^T y                  -y               A_b^T x      0
 *   s      x                A_a^T (r_b + d_b - r_a)  minus the point  A_b^T x      -+ x
 *
 * Each of these vectors is stored as three columns with one number for each row, so that one
 * instruction computes numbers of several rows. Let W_k be the angular velocity of body k in its
 * own axes, and w_k the same vector in ground axes. Then Phi', and gamma, which is -Phi'' without
 * the terms of accelerations, are
 *
 *   Phi'  = n_a . W_a + n_b . W_b + E_b (r_b' - r_a')
 *   gamma = W_a^2 (s_a . z_a) - (W_a . s_a) (W_a . z_a)
 *           - W_b^2 (s_b . z_b) + (W_b . s_b) (W_b . z_b)
 *           + 2 (W_a . z_a) (W_b . z_b) + 2 (w_a . w_b) (s_b . z_b)      (not in rows p)
 *           - 2 x . ((w_a . (r_b - r_a)) w_b + cross(r_b' - r_a', w_a))  (only in rows s)
 */
#include "dynamics/space_joints.h"
#include "linear/space_columns.h"

enum { MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_four four;
typedef baum_i_space_column column;

/* The pose and the velocities of a body, see baum_i_space_frame and baum_i_spatial_frame. */
typedef struct pose {
  const double *columns;
  const double *spin;
  const double *r;
  const double *v;
  const double *w;
  const double *rows; /* rows of A, each of three numbers */
} pose;

BAUM_I_INLINE pose pose_of(const baum_i_space_pass *at, int body)
{
  const baum_i_space_frame *own = &at->joints.frames[body];
  const baum_i_spatial_frame *frame = &at->spatial[body];
  return (pose){own->columns, own->spin, frame->r, frame->v, frame->w, frame->axes};
}

/* Returns A^T x. The fourth number of the result is arbitrary. */
BAUM_I_INLINE four turned_back(const pose *f, const double *x)
{
  return baum_i_four_combined(f->rows, 3, x);
}

/* All rows of a joint. */
typedef struct rows {
  pose of[2];
  column other[2][3]; /* z_k, one column for each number of the vector */
  column move[3];     /* columns of E_b = -E_a, set only in rows s */
  column phi;
  column rate;
  column gamma;
} rows;

/* Sets number i of a column. */
BAUM_I_INLINE void put(column *x, int i, double s)
{
  if (i < 4) {
    x->low = baum_i_four_put(x->low, i, s);
  } else {
    x->high = i == 4 ? (baum_i_pair){s, x->high[1]} : (baum_i_pair){x->high[0], s};
  }
}

/* Loads s_k of row i. */
BAUM_I_INLINE void get_own(const double *own, int i, double s[3])
{
  for (int c = 0; c < 3; c++) {
    s[c] = own[baum_i_column_entry(3, i, c)];
  }
}

/* Sets z_a of a row for its vector s_b, and returns `other`. */
BAUM_I_INLINE const double *find_other(const pose *f, const pose *g, const double s_b[3],
                                       bool slides, double other[4])
{
  four apart =
    slides ? baum_i_four_minus(baum_i_four_load(g->r), baum_i_four_load(f->r)) : baum_i_four_zero();
  four y = baum_i_four_minus(apart, baum_i_four_turned(g->columns, s_b));
  double stored[4];
  return baum_i_four_spilled(other, turned_back(f, baum_i_four_spilled(stored, y)));
}

/* Sets the vectors z_k of row i, which is not of kind p, and E_b of rows s. */
BAUM_I_INLINE void set_row(const pose *f, const pose *g, const double z_a[4], const double s_a[3],
                           bool slides, int i, rows *out)
{
  double stored[4];
  double other[4];
  const double *x = baum_i_four_spilled(stored, baum_i_four_turned(f->columns, s_a));
  const double *z_b = baum_i_four_spilled(other, turned_back(g, x));
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    put(&out->other[0][c], i, z_a[c]);
    put(&out->other[1][c], i, z_b[c]);
    if (slides) {
      put(&out->move[c], i, x[c]);
    }
  }
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

/* The symmetric matrix D by diagonals, which needs fewer copies of numbers than D by columns. */
typedef struct square {
  column diagonal;
  four next;          /* n > 3: D_01, D_12, D_23, D_30; otherwise D_01, D_12, D_20 */
  four far;           /* n > 3: D_02, D_13, D_20, D_31 */
  four last[2];       /* rows 0 to 3 of columns 4 and 5 */
  baum_i_pair corner; /* D_45 twice */
} square;

/* Adds x y^T to D, where y is a multiple of x. */
BAUM_I_INLINE void add_square(square *to, column x, column y, int n)
{
  to->diagonal = baum_i_column_plus(to->diagonal, baum_i_column_product(x, y, n > 4), n > 4);
  four next = n > 3 ? baum_i_four_next(y.low) : baum_i_four_rotated(y.low);
  if (n > 1) {
    to->next = baum_i_four_plus(to->next, baum_i_four_times(x.low, next));
  }
  if (n > 3) {
    to->far = baum_i_four_plus(to->far, baum_i_four_times(x.low, baum_i_four_swapped(y.low)));
  }
  for (int j = 4; j < n; j++) {
    to->last[j - 4] = baum_i_four_add(to->last[j - 4], x.low, y.high[j - 4]);
  }
  if (n > 5) {
    to->corner += x.high * baum_i_exchanged(y.high);
  }
}

/* Stores D, and the products of the diagonal entries of its own rows. That of a spin row is only
 * what remains of u . u - 1. */
BAUM_I_INLINE void store_pivot(const baum_i_space_joint *joint, int n, int own, const square *from)
{
  double *d = joint->equations + baum_i_space_pivot(n);
  four columns[4];
  if (n > 3) {
    baum_i_four_symmetric(from->diagonal.low, from->next, from->far, columns);
  } else {
    four before = baum_i_four_rotated(baum_i_four_rotated(from->next));
    baum_i_four_mix(from->diagonal.low, before, from->next, columns);
  }
  double size[2] = {1.0, 1.0};
  BAUM_I_UNROLL(6)
  for (int j = 0; j < n; j++) {
    baum_i_four_store(d + 4 * j, j < 4 ? columns[j] : from->last[j - 4]);
    if (j < own) {
      size[j < 3 ? 0 : 1] *=
        j < 4 ? baum_i_four_get(from->diagonal.low, j) : from->diagonal.high[j - 4];
    }
  }
  if (n == 5) {
    baum_i_store(d + 20, from->diagonal.high);
  } else if (n == 6) {
    baum_i_store(d + 24, (baum_i_pair){from->diagonal.high[0], from->corner[0]});
    baum_i_store(d + 26, (baum_i_pair){from->corner[0], from->diagonal.high[1]});
  }
  baum_i_store(joint->measure->size, (baum_i_pair){size[0], size[1]});
}

/* Adds the terms of the origins' motion to Phi' and gamma of rows s. Sets E of both sides, and adds
 * their parts to D and to J a0 - r. `apart` is the difference of a0 of the two bodies. */
BAUM_I_INLINE void set_moves(const baum_i_space_joint *joint, int n, four apart, rows *row,
                             square *to, column *sum)
{
  bool tall = n > 4;
  const pose *f = &row->of[0];
  const pose *g = &row->of[1];
  four w_a = baum_i_four_load(f->w);
  four r = baum_i_four_minus(baum_i_four_load(g->r), baum_i_four_load(f->r));
  four v = baum_i_four_minus(baum_i_four_load(g->v), baum_i_four_load(f->v));
  four bend = baum_i_four_add(baum_i_four_cross(v, w_a), baum_i_four_load(g->w),
                              baum_i_four_sum(baum_i_four_times(w_a, r)));
  four weight =
    baum_i_four_plus(baum_i_four_load(joint->weight[0]), baum_i_four_load(joint->weight[1]));
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    column move = row->move[c];
    row->rate = baum_i_column_add(row->rate, move, baum_i_four_get(v, c), tall);
    row->gamma = baum_i_column_subtract(row->gamma, move, 2.0 * baum_i_four_get(bend, c), tall);
    if (joint->turn[0]) {
      baum_i_column_store(joint->move[0], 3, c, tall, baum_i_column_times(move, -1.0, tall));
    }
    if (joint->turn[1]) {
      baum_i_column_store(joint->move[1], 3, c, tall, move);
    }
    *sum = baum_i_column_add(*sum, move, baum_i_four_get(apart, c), tall);
    add_square(to, move, baum_i_column_times(move, baum_i_four_get(weight, c), tall), n);
  }
}

/* Products of the vectors of all rows for one body k. */
typedef struct products {
  column own;   /* s_k . W_k */
  column other; /* z_k . W_k */
  column both;  /* s_k . z_k */
} products;

BAUM_I_INLINE products find_products(const double *own, const column z[3], const double *w, int n)
{
  bool tall = n > 4;
  column s = baum_i_column_load(own, 3, 0, tall);
  products to = {.own = baum_i_column_times(s, w[0], tall),
                 .other = baum_i_column_times(z[0], w[0], tall),
                 .both = baum_i_column_product(s, z[0], tall)};
  BAUM_I_UNROLL(2)
  for (int c = 1; c < 3; c++) {
    s = baum_i_column_load(own, 3, c, tall);
    to.own = baum_i_column_add(to.own, s, w[c], tall);
    to.other = baum_i_column_add(to.other, z[c], w[c], tall);
    to.both = baum_i_column_plus(to.both, baum_i_column_product(s, z[c], tall), tall);
  }
  return to;
}

/* Sets Phi and gamma of all rows. Rows p are the numbers 0 to 2 if `points` is true. */
BAUM_I_INLINE void set_positions(const pose *f, const pose *g, int n, bool points,
                                 const double *own, rows *row)
{
  bool tall = n > 4;
  products a = find_products(own, row->other[0], f->spin, n);
  products b = find_products(own + baum_i_space_part(n), row->other[1], g->spin, n);
  four square_a = baum_i_four_all(f->spin[3]);
  four square_b = baum_i_four_all(g->spin[3]);
  if (points) { /* in row 3, of kind d, square_a is the factor for both bodies */
    b.both.low = baum_i_four_put(b.both.low, 3, 0.0);
  }
  if (n > 3 || !points) { /* rows other than p */
    four w = baum_i_four_times(baum_i_four_load(f->w), baum_i_four_load(g->w));
    double mixed = g->spin[3] - 2.0 * baum_i_four_sum(w);
    double whole = f->spin[3] + mixed;
    square_a = points ? baum_i_four_put(square_a, 3, whole) : square_a;
    square_b = points ? square_b : baum_i_four_all(mixed);
    const four twice = points ? baum_i_four_set(0.0, 0.0, 0.0, 2.0) : baum_i_four_all(2.0);
    four both = baum_i_four_times(a.other.low, twice);
    row->gamma.low = baum_i_four_plus(row->gamma.low, baum_i_four_times(both, b.other.low));
    if (tall) { /* rows d and e, where s_b . z_b = -s_a . z_a */
      row->gamma.high = a.both.high * baum_i_both(whole);
      row->gamma.high += (a.other.high + a.other.high) * b.other.high;
    }
  }
  four gamma = baum_i_four_plus(row->gamma.low, baum_i_four_times(a.both.low, square_a));
  row->gamma.low = baum_i_four_minus(gamma, baum_i_four_times(b.both.low, square_b));
  row->gamma = baum_i_column_minus(row->gamma, baum_i_column_product(a.own, a.other, tall), tall);
  row->gamma = baum_i_column_plus(row->gamma, baum_i_column_product(b.own, b.other, tall), tall);
  if (points) { /* the difference of the points' places */
    four x_b = baum_i_four_minus(baum_i_four_load(g->r), b.both.low);
    a.both.low = baum_i_four_minus(x_b, baum_i_four_minus(baum_i_four_load(f->r), a.both.low));
  }
  row->phi = baum_i_column_plus(row->phi, a.both, tall);
}

/* Sets R of side k, and adds its parts to Phi', to D and to J a0 - r. Rounding errors of
 * cross(x, y) for x on body a and of cross(x, y) for y on body b are the same, because thin bodies
 * need exactly opposite moments. */
BAUM_I_INLINE void set_turns(const baum_i_space *b, const baum_i_space_joint *joint, int n,
                             int count, int k, rows *row, column *sum, square *d)
{
  bool tall = n > 4;
  const double *own = joint->numbers + BAUM_I_JOINT_OWN + (ptrdiff_t)k * baum_i_space_part(n);
  const double *w = row->of[k].spin;
  const double *spin = joint->spin + 4 * k;
  const column *z = row->other[k];
  column turn[3];
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    int i = (c + 1) % 3;
    int j = (c + 2) % 3;
    column s_i = baum_i_column_load(own, 3, i, tall);
    column s_j = baum_i_column_load(own, 3, j, tall);
    turn[c] = k == 0 ? baum_i_column_cross(s_i, z[j], s_j, z[i], tall)
                     : baum_i_column_cross(z[i], s_j, z[j], s_i, tall);
    row->rate = baum_i_column_add(row->rate, turn[c], w[c], tall);
  }
  if (!joint->turn[k]) {
    return;
  }
  const double *white = joint->white[k];
  const double *free = b->from + (ptrdiff_t)MOTION * joint->body[k] + 4;
  double *stored = joint->turn[k];
  BAUM_I_UNROLL(3)
  for (int c = 2; c >= 0; c--) { /* L^-T is upper triangular */
    turn[c] = baum_i_column_times(turn[c], white[5 * c], tall);
    BAUM_I_UNROLL(3)
    for (int j = 0; j < c; j++) {
      turn[c] = baum_i_column_add(turn[c], turn[j], white[4 * j + c], tall);
    }
    if (n > count) {
      put(&turn[c], count, spin[c]);
    }
    baum_i_column_store(stored, 3, c, tall, turn[c]);
    *sum = baum_i_column_add(*sum, turn[c], free[c], tall);
    add_square(d, turn[c], turn[c], n);
  }
}

/* Sets the sides of a joint, r, J a0 - r and D. If n > count, the last row is a spin row. */
BAUM_I_INLINE void set_node(const baum_i_space *b, const baum_i_space_joint *joint, int n,
                            int count, bool points, bool slides, rows *row,
                            const baum_i_space_pass *at)
{
  bool tall = n > 4;
  const column zero = {baum_i_four_zero(), {0.0, 0.0}};
  const double *diagonal = joint->numbers + BAUM_I_JOINT_DIAGONAL;
  four apart = baum_i_four_minus(baum_i_four_load(b->from + (ptrdiff_t)MOTION * joint->body[1]),
                                 baum_i_four_load(b->from + (ptrdiff_t)MOTION * joint->body[0]));
  column sum = {points ? apart : zero.low, {0.0, 0.0}};
  square d = {.diagonal = baum_i_column_load(diagonal, 1, 0, tall),
              .next = zero.low,
              .far = zero.low,
              .last = {zero.low, zero.low}};
  if (slides) {
    set_moves(joint, n, apart, row, &d, &sum);
  }
  column right = baum_i_column_times(row->gamma, at->bending, tall);
  right = baum_i_column_subtract(right, row->phi, at->stiffness, tall);
  store_rows(at->phi + joint->row, row->phi, count);
  store_rows(at->gamma + joint->row, row->gamma, count);
  set_turns(b, joint, n, count, 0, row, &sum, &d);
  set_turns(b, joint, n, count, 1, row, &sum, &d);
  right = baum_i_column_subtract(right, row->rate, at->damping, tall);
  store_rows(at->phi_rate + joint->row, row->rate, count);
  if (n > count) { /* u . u is not added to the diagonal entry, because it would cancel */
    put(&right, count, 0.0);
    put(&d.diagonal, count, diagonal[count]);
  }
  double *stored = joint->equations;
  baum_i_column_store(stored, 1, 0, tall, baum_i_column_minus(sum, right, tall));
  baum_i_column_store(stored + baum_i_space_vector(n), 1, 0, tall, right);
  store_pivot(joint, n, count, &d);
  if ((n > 3 || !points) && joint->omits) {
    baum_i_space_joint_omit(b, joint);
  }
}

/* Computes the n rows of a joint and writes them to the solver. If `points` is true, the first
 * three rows are of kind p. `slides` has bit i set if row i is of kind s. `again` is the row of
 * kind e, or 0 if there is none. If n > count, the last row is a spin row. */
BAUM_I_INLINE void set_joint(const baum_i_space *b, const baum_i_space_joint *joint, int n,
                             int count, bool points, unsigned slides, int again,
                             const baum_i_space_pass *at)
{
  const double *own = joint->numbers + BAUM_I_JOINT_OWN;
  const double *own_b = own + baum_i_space_part(n);
  const column zero = {baum_i_four_zero(), {0.0, 0.0}};
  rows row = {.of = {pose_of(at, joint->body[0]), pose_of(at, joint->body[1])},
              .other = {{zero, zero, zero}, {zero, zero, zero}},
              .move = {zero, zero, zero},
              .phi = zero,
              .rate = zero,
              .gamma = zero};
  const pose *f = &row.of[0];
  const pose *g = &row.of[1];
  double other[4];
  const double *z_a = other;
  if (slides) {
    row.phi = baum_i_column_load(own_b + baum_i_space_part(n), 1, 0, n > 4);
  }
  BAUM_I_UNROLL(3)
  for (int c = 0; points && c < 3; c++) {
    row.other[0][c].low = baum_i_four_load(f->columns + 4 * c);
    row.other[1][c].low = baum_i_four_load(g->columns + 4 * c);
  }
  if (points) {
    row.rate.low = baum_i_four_minus(baum_i_four_load(g->v), baum_i_four_load(f->v));
  }
  BAUM_I_UNROLL(6)
  for (int i = points ? 3 : 0; i < count; i++) {
    bool slide = (slides >> i & 1u) != 0;
    bool same = i > 0 && (i == again || (slide && (slides >> (i - 1) & 1u) != 0));
    double s[3];
    if (!same) {
      get_own(own_b, i, s);
      z_a = find_other(f, g, s, slide, other);
    }
    get_own(own, i, s);
    set_row(f, g, z_a, s, slide, i, &row);
  }
  set_positions(f, g, n, points, own, &row);
  set_node(b, joint, n, count, points, slides != 0, &row, at);
}

BAUM_I_INLINE void set_joint_with_spin(const baum_i_space *b, const baum_i_space_joint *joint,
                                       const baum_i_space_pass *at)
{
  switch (joint->shape) {
  case BAUM_I_SHAPE_PU: set_joint(b, joint, 4, 3, true, 0, 0, at); break;
  case BAUM_I_SHAPE_PDU: set_joint(b, joint, 5, 4, true, 0, 0, at); break;
  case BAUM_I_SHAPE_PDEU: set_joint(b, joint, 6, 5, true, 0, 4, at); break;
  case BAUM_I_SHAPE_DESSDU: set_joint(b, joint, 6, 5, false, 0xc, 1, at); break;
  default: break;
  }
}

BAUM_I_INLINE void set_joint_of_shape(const baum_i_space *b, const baum_i_space_joint *joint,
                                      const baum_i_space_pass *at)
{
  switch (joint->shape) {
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
  default: set_joint_with_spin(b, joint, at); break;
  }
}

static void set_joints(baum_i_space *b, const baum_i_space_pass *pass, int first, int end)
{
  const baum_i_space_pass at = *pass;
  for (int i = at.joints.joint_start[first]; i < at.joints.joint_start[end]; i++) {
    set_joint_of_shape(b, &at.joints.list[i], &at);
  }
}

const baum_i_space_joints_kernel BAUM_I_HOT(baum_i_space_joints_kernel) = {.set = set_joints};
