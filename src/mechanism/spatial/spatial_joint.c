/* SPDX-License-Identifier: BSD-3-Clause */
/* What all spatial joints compute, from their tables of rows. */
#include "mechanism/spatial/spatial_joint.h"

#include <string.h>

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

baum_status baum_i_spatial_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                    const baum_i_rows *out)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  for (int i = 0; i < joint->rows; i++) {
    baum_i_coordinate row;
    baum_i_spatial_row_at(&pair, type_of(joint)->rows[i], &row);
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
 * A displacement is a product. An angle is atan2(s, c) = Im log z of z = c + i s, whose k-th
 * derivatives are those of log z, times i for each s:
 *
 *   first 1 / z, second -1 / z^2, third 2 / z^3
 */

/* Derivatives of the angle by (c, s): entry j has j derivatives by s. */
typedef struct angle {
  double first[2];
  double second[3];
  double third[4];
} angle;

static angle angle_of(double c, double s)
{
  double square = c * c + s * s;
  /* 1 / z, 1 / z^2, 1 / z^3, real and imaginary parts */
  const double a[2] = {c / square, -s / square};
  const double b[2] = {a[0] * a[0] - a[1] * a[1], 2.0 * a[0] * a[1]};
  const double d[2] = {a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]};
  return (angle){.first = {a[1], a[0]},
                 .second = {-b[1], -b[0], b[1]},
                 .third = {2.0 * d[1], 2.0 * d[0], -2.0 * d[1], -2.0 * d[0]}};
}

/* Within a step, which may be longer than a revolution. */
static double expected_angle(const baum_i_joint *joint, const baum_i_point *point)
{
  if (!point->angles) {
    return 0.0;
  }
  const double *followed = point->angles + 2 * (ptrdiff_t)(joint->element.index - 1);
  return followed[0] + followed[1] * (point->t - point->angles[2 * point->mechanism->joint_count]);
}

void baum_i_spatial_coordinate(const baum_i_joint *joint, const baum_i_point *point,
                               baum_i_coordinate *out)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  const baum_i_spatial_joint_type *type = type_of(joint);
  if (!type->type.is_angle) {
    baum_i_spatial_row_at(&pair, type->coordinate[0], out);
    return;
  }
  baum_i_coordinate x[2]; /* cosine and sine */
  baum_i_spatial_row_at(&pair, type->coordinate[1], &x[0]);
  baum_i_spatial_row_at(&pair, type->coordinate[0], &x[1]);
  const angle g = angle_of(x[0].value, x[1].value);
  double near = expected_angle(joint, point);
  double raw = atan2(x[1].value, x[0].value);
  *out = (baum_i_coordinate){.value = near + remainder(raw - near, BAUM_I_REVOLUTION)};
  for (int i = 0; i < 2; i++) {
    out->rate += g.first[i] * x[i].rate;
    out->gamma += g.first[i] * x[i].gamma;
    for (int j = 0; j < 2; j++) {
      out->gamma -= g.second[i + j] * x[i].rate * x[j].rate;
    }
    for (int k = 0; k < COLUMNS; k++) {
      out->gradient[k] += g.first[i] * x[i].gradient[k];
    }
  }
}

/* gradient w */
static double along(const double *gradient, const double *w)
{
  double sum = 0.0;
  for (int i = 0; i < COLUMNS; i++) {
    sum += gradient[i] * w[i];
  }
  return sum;
}

/* The parts of out that come of x_i, as in general/composed_row.c, which has symmetric second
 * derivatives. */
static void add_composed(const baum_i_coordinate x[2], const baum_i_spatial_second *second, int i,
                         const angle *g, const double *w, double lambda,
                         baum_i_coordinate_blocks *out)
{
  double bend_w = 0.0;
  double bend = 0.0;
  double bend_rate = 0.0;
  for (int j = 0; j < 2; j++) {
    bend_w += g->second[i + j] * along(x[j].gradient, w);
    bend += g->second[i + j] * x[j].rate;
    bend_rate += g->second[i + j] * x[j].gamma;
    for (int k = 0; k < 2; k++) {
      bend_rate -= g->third[i + j + k] * x[j].rate * x[k].rate;
    }
  }
  baum_i_spatial_add_jw_q(second, w, g->first[i], out->jw_q);
  for (int k = 0; k < COLUMNS; k++) {
    double slope = x[i].gradient[k];
    out->jw_q[k] += bend_w * slope;
    out->gamma_v[k] += g->first[i] * second->gamma_v[k] - 2.0 * bend * slope;
    out->gamma_q[k] += g->first[i] * second->gamma_q[k] + bend_rate * slope;
    out->gamma_q[k] -= 2.0 * bend * second->rate_q[k];
    for (int n = 0; n < COLUMNS; n++) {
      double bent = g->second[2 * i] * x[i].gradient[n] + g->second[1] * x[1 - i].gradient[n];
      out->jtl_q[COLUMNS * k + n] +=
        lambda * (g->first[i] * second->columns_q[COLUMNS * k + n] + slope * bent);
    }
  }
}

void baum_i_spatial_coordinate_linearize(const baum_i_joint *joint, const baum_i_point *point,
                                         const double *w, double lambda,
                                         baum_i_coordinate_blocks *out)
{
  const baum_i_spatial_pair pair = pair_at(joint, point);
  const baum_i_spatial_joint_type *type = type_of(joint);
  *out = (baum_i_coordinate_blocks){.jw_q = {0.0}};
  angle g = {.first = {1.0}};
  baum_i_coordinate x[2] = {{.value = 0.0}};
  int count = type->type.is_angle ? 2 : 1;
  for (int i = 0; i < count; i++) {
    baum_i_spatial_row_at(&pair, type->coordinate[count - 1 - i], &x[i]);
  }
  if (count == 2) {
    g = angle_of(x[0].value, x[1].value);
  }
  for (int i = 0; i < count; i++) {
    baum_i_spatial_second second;
    baum_i_spatial_second_of(&pair, type->coordinate[count - 1 - i], &second);
    add_composed(x, &second, i, &g, w, lambda, out);
  }
}
