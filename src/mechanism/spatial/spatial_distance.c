/* SPDX-License-Identifier: BSD-3-Clause */
/* Distance joint in space: a rod without mass keeps two points at the distance L. If e is the
 * vector from body_a's point to body_b's point (spatial_rows.h), the row is
 *
 *   Phi = (e . e - L^2) / (2 L),  which is nearly |e| - L if Phi is small, and smooth at e = 0
 */
#include <math.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/spatial/spatial_joint.h"

/* The parameters that follow the two points of the joint. */
enum { LENGTH = 6, PARAMETER_COUNT };

static const baum_i_spatial_row SQUARE = {BAUM_I_APART, BAUM_I_APART};

static const baum_i_def_field fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_distance_def),
  BAUM_I_OPTIONAL(baum_spatial_distance_def, length, OPTIONAL_POSITIVE, "m"),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  return baum_i_spatial_check_head(mechanism, def, label, true);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  const baum_spatial_distance_def *def = joint->element.def;
  BAUM_I_TRY(baum_i_spatial_points(mechanism, &joint->element, parameters));
  parameters[LENGTH] = isnan(def->length)
                         ? baum_i_spatial_design_length(mechanism, &joint->span, parameters)
                         : def->length;
  if (!(parameters[LENGTH] > 0.0)) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "%s: length is not given and is 0 m in the design configuration, must be > 0",
      baum_i_label(&joint->element).text);
  }
  return BAUM_OK;
}

/* ---- evaluation ---- */

static baum_status evaluate(const baum_i_joint *joint, baum_i_point *point, const baum_i_rows *out)
{
  const double *numbers = point->parameters + joint->element.parameter;
  const baum_i_spatial_pair pair = baum_i_spatial_pair_at(&joint->span, numbers, false, point);
  double length = numbers[LENGTH];
  baum_i_coordinate square;
  baum_i_spatial_row_at(&pair, SQUARE, &square);
  if (out->phi) {
    out->phi[joint->row] = 0.5 * (square.value / length - length);
  }
  if (out->gamma) {
    out->gamma[joint->row] = 0.5 * square.gamma / length;
  }
  if (out->jacobian) {
    for (int i = 0; i < BAUM_I_PAIR_COLUMNS; i++) {
      square.gradient[i] *= 0.5 / length;
    }
    baum_i_columns_pack_any(point->mechanism, &joint->span, BAUM_I_SPACE, 1, square.gradient,
                            out->jacobian + joint->jacobian);
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  const double *numbers = point->parameters + joint->element.parameter;
  const baum_i_spatial_pair pair = baum_i_spatial_pair_at(&joint->span, numbers, false, point);
  baum_i_spatial_linearize_rows(joint, point, &pair, &SQUARE, 0.5 / numbers[LENGTH], w, lambda,
                                blocks);
  return BAUM_OK;
}

static void place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const baum_i_spatial_pair pair = baum_i_spatial_pair_at(
    &joint->span, point->parameters + joint->element.parameter, false, point);
  baum_i_spatial_place_of(&pair, at);
}

static void force_on_b(const baum_i_joint *joint, const baum_i_point *point, const double *lambda,
                       double six[BAUM_I_SPACE])
{
  const double *numbers = point->parameters + joint->element.parameter;
  const baum_i_spatial_pair pair = baum_i_spatial_pair_at(&joint->span, numbers, false, point);
  baum_i_coordinate square;
  baum_i_spatial_row_at(&pair, SQUARE, &square);
  baum_i_spatial_add_force_on_b(&square, 0.5 * lambda[0] / numbers[LENGTH], six);
}

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_distance, "spatial distance joint", fields),
                 .check = check, .parameter_count = PARAMETER_COUNT},
  .width = BAUM_I_SPACE,
  .scleronomic = true,
  .row_count = 1,
  .lower = lower,
  .extent = baum_i_spatial_extent,
  .evaluate = baum_i_evaluate_each,
  .evaluate_one = evaluate,
  .linearize = linearize,
  .place = place,
  .force_on_b = force_on_b,
};

BAUM_I_DEFINE(joint, spatial_distance, type)
