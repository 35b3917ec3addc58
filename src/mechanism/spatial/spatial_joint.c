/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions of those spatial joints that are defined by a table of products. They evaluate this
 * table. */
#include "mechanism/spatial/spatial_joint.h"

#include "mechanism/general/coordinate.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

static const baum_i_spatial_joint_type *type_of(const baum_i_joint *joint)
{
  return (const baum_i_spatial_joint_type *)(const void *)joint->type;
}

static baum_i_spatial_pair pair_at(const baum_i_joint *joint, const baum_i_point *point)
{
  return baum_i_spatial_pair_at(&joint->span, point->parameters + joint->element.parameter, true,
                                point);
}

/* ---- rows ---- */

const baum_i_spatial_row *baum_i_spatial_rows_of(const baum_i_joint *joint)
{
  return joint->type->evaluate_one == baum_i_spatial_evaluate ? type_of(joint)->rows : NULL;
}

baum_status baum_i_spatial_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                    const baum_i_rows *out)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  for (int i = 0; i < joint->rows; i++) {
    const baum_i_spatial_row vectors = type_of(joint)->rows[i];
    baum_i_coordinate row = {.gamma = 0.0};
    if (out->gamma) {
      baum_i_spatial_row_at(&pair, vectors, &row);
    } else {
      row.value = baum_i_spatial_gradient_at(&pair, vectors, out->jacobian ? row.gradient : NULL);
    }
    if (out->phi) {
      out->phi[joint->row + i] = row.value;
    }
    if (out->gamma) {
      out->gamma[joint->row + i] = row.gamma;
    }
    if (out->jacobian) {
      baum_i_columns_pack_any(point->mechanism, &joint->span, BAUM_I_SPACE, 1, row.gradient,
                              out->jacobian + joint->jacobian + (ptrdiff_t)i * joint->span.nl);
    }
  }
  return BAUM_OK;
}

baum_status baum_i_spatial_linearize(const baum_i_joint *joint, baum_i_point *point,
                                     const double *w, const double *lambda,
                                     const baum_i_joint_blocks *blocks)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  baum_i_spatial_linearize_rows(joint, point, &pair, type_of(joint)->rows, 1.0, w, lambda, blocks);
  return BAUM_OK;
}

void baum_i_spatial_place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  baum_i_spatial_place_of(&pair, at);
}

void baum_i_spatial_force_on_b(const baum_i_joint *joint, const baum_i_point *point,
                               const double *lambda, double six[BAUM_I_SPACE])
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  for (int i = 0; i < joint->rows; i++) {
    baum_i_coordinate row;
    baum_i_spatial_row_at(&pair, type_of(joint)->rows[i], &row);
    baum_i_spatial_add_force_on_b(&row, lambda[i], six);
  }
}

bool baum_i_spatial_is_reversed(const baum_i_joint *joint, const baum_i_point *point)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  const baum_i_spatial_joint_type *type = type_of(joint);
  for (int i = 0; i < type->directed_count; i++) {
    if (baum_i_spatial_product(&pair, type->directed[i]) < 0.5) {
      return true;
    }
  }
  return false;
}

/* ---- coordinates ----
 *
 * A displacement is the value of one product. An angle is computed from two products, its cosine c
 * and its sine s, as atan2(s, c). This is the imaginary part of log z with z = c + i s. The
 * derivatives of the angle with respect to c and s therefore follow from the derivatives of log z.
 * Each derivative with respect to s contributes a factor i.
 *
 *   The derivatives of log z are 1 / z, then -1 / z^2, and then 2 / z^3
 *
 * The chain rule is in general/composed_row.h.
 */

baum_i_outer baum_i_spatial_angle_of(double c, double s)
{
  double square = c * c + s * s;
  /* The numbers a, b and d are real and imaginary parts of 1 / z, 1 / z^2 and 1 / z^3. */
  const double a[2] = {c / square, -s / square};
  const double b[2] = {a[0] * a[0] - a[1] * a[1], 2.0 * a[0] * a[1]};
  const double d[2] = {a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]};
  return (baum_i_outer){.value = atan2(s, c),
                        .first = {a[1], a[0]},
                        .second = {-b[1], -b[0], b[1]},
                        .third = {2.0 * d[1], 2.0 * d[0], -2.0 * d[1], -2.0 * d[0]}};
}

/* Evaluates the cosine and the sine of an angle, and returns the angle as a function of them. */
static baum_i_outer cosine_and_sine(const baum_i_spatial_pair *pair,
                                    const baum_i_spatial_row rows[2], baum_i_inner x[2])
{
  static const int bodies[2] = {0, 1};
  for (int i = 0; i < 2; i++) {
    baum_i_composed_place(&x[i], BAUM_I_SPACE, BAUM_I_SPACE, bodies);
    baum_i_spatial_row_at(pair, rows[1 - i], &x[i].c);
  }
  return baum_i_spatial_angle_of(x[0].c.value, x[1].c.value);
}

void baum_i_spatial_coordinate(const baum_i_joint *joint, int number, const baum_i_point *point,
                               baum_i_coordinate *out)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  const baum_i_spatial_row *rows = type_of(joint)->coordinate_rows[number];
  const baum_i_joint_coordinate own = {joint, number};
  if (!baum_i_is_angle(&own)) {
    baum_i_spatial_row_at(&pair, rows[0], out);
    return;
  }
  baum_i_inner x[2];
  const baum_i_outer g = cosine_and_sine(&pair, rows, x);
  double near = baum_i_expected_angle(&own, point);
  *out = (baum_i_coordinate){.value = near + remainder(g.value - near, BAUM_I_REVOLUTION),
                             .rate = g.first[0] * x[0].c.rate + g.first[1] * x[1].c.rate,
                             .gamma = baum_i_composed_gamma(x, &g)};
  baum_i_composed_add_gradient(x, &g, out->gradient);
}

void baum_i_spatial_coordinate_linearize(const baum_i_joint *joint, int number,
                                         const baum_i_point *point, const double *w, double lambda,
                                         baum_i_coordinate_blocks *out)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  const baum_i_spatial_row *rows = type_of(joint)->coordinate_rows[number];
  const baum_i_joint_coordinate own = {joint, number};
  if (!baum_i_is_angle(&own)) {
    baum_i_spatial_row_linearize(&pair, rows[0], w, lambda, out);
    return;
  }
  baum_i_inner x[2];
  const baum_i_outer g = cosine_and_sine(&pair, rows, x);
  for (int i = 0; i < 2; i++) {
    baum_i_spatial_row_linearize(&pair, rows[1 - i], w, 1.0, &x[i].blocks);
  }
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
  const baum_i_composed_blocks blocks = {COLUMNS,      out->jw_q,    out->jtl_q,
                                         out->gamma_q, out->gamma_v, out->rate_q};
  baum_i_composed_linearize(x, &g, w, lambda, &blocks);
}
