/* SPDX-License-Identifier: BSD-3-Clause */
/* Spring and damper in parallel between two points in space. Let e be the vector from body_a's
 * point to body_b's point (spatial_rows.h), l = |e|, and h = l_q. T(l, l') is the tension of
 * general/spring_law.h.
 *
 *   g   = -T h                              (12 entries, 6 for each body)
 *   g_q = -h T_q - T h_q,   T_q = T_l h + T_l' (l')_q
 *   g_v = -T_l' h h^T
 *
 * where h = (e . e)_q / (2 l) and h_q = ((e . e)_qq / 2 - h h^T) / l. At l = 0 the direction is
 * undefined; force and derivatives are set to zero there.
 */
#include "mechanism/definition.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/spatial/spatial_rows.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters of the spring: both points, then the numbers of the spring law. */
enum { LAW = 6, PARAMETER_COUNT = LAW + BAUM_I_SPRING_NUMBERS };

static const baum_i_spatial_row SQUARE = {BAUM_I_APART, BAUM_I_APART};

BAUM_I_CHECK_SPRING_DEF(baum_spatial_spring_def);

static const baum_i_def_field fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_spring_def),
  BAUM_I_SPRING_FIELDS(baum_spatial_spring_def, "N/m", "N s/m", free_length, OPTIONAL_NOT_NEGATIVE,
                       "m"),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  return baum_i_spatial_check_head(mechanism, def, label, true);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_spatial_points(mechanism, &force->element, parameters));
  baum_i_spring_lower(force, baum_i_spatial_design_length(mechanism, &force->span, parameters),
                      parameters + LAW);
  return BAUM_OK;
}

/* ---- one spring ---- */

static baum_i_spatial_pair pair_at(const baum_i_force *force, const baum_i_point *point)
{
  const double *numbers = point->parameters + force->element.parameter;
  return baum_i_spatial_pair_at(&force->span, numbers, false, point);
}

static baum_i_stretch stretch(const baum_i_force *force, const baum_i_point *point)
{
  const baum_i_spatial_pair pair = pair_at(force, point);
  const baum_i_spatial_length l = baum_i_spatial_length_of(&pair);
  return (baum_i_stretch){l.length, l.rate, point->mechanism->length, l.length == 0.0};
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_force *spring = group->forces[i];
    const baum_i_spatial_pair pair = pair_at(spring, point);
    const baum_i_spatial_length l = baum_i_spatial_length_of(&pair);
    if (l.length == 0.0) {
      continue;
    }
    const baum_i_spring_law law = baum_i_spring_law_of(spring, point);
    baum_i_tension t;
    BAUM_I_TRY(baum_i_tension_at(&law, point, l.length, l.rate, &t));
    double wide[COLUMNS];
    for (int k = 0; k < COLUMNS; k++) {
      wide[k] = -t.value * l.h[k];
    }
    baum_i_columns_scatter_any(point->mechanism, &spring->span, BAUM_I_SPACE, wide, out);
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  const baum_i_spatial_pair pair = pair_at(element, point);
  const baum_i_spatial_length l = baum_i_spatial_length_of(&pair);
  if (l.length == 0.0) {
    return BAUM_OK;
  }
  const baum_i_spring_law law = baum_i_spring_law_of(element, point);
  baum_i_tension t;
  BAUM_I_TRY(baum_i_tension_at(&law, point, l.length, l.rate, &t));
  baum_i_spatial_second second;
  baum_i_spatial_second_of(&pair, SQUARE, &second);
  double force_q[COLUMNS * COLUMNS];
  double force_v[COLUMNS * COLUMNS];
  for (int k = 0; k < COLUMNS; k++) {
    double rate_q = (0.5 * second.rate_q[k] - l.rate * l.h[k]) / l.length;
    double tension_q = t.by_length * l.h[k] + t.by_rate * rate_q;
    for (int i = 0; i < COLUMNS; i++) {
      double h_q = (0.5 * second.columns_q[COLUMNS * i + k] - l.h[i] * l.h[k]) / l.length;
      force_q[COLUMNS * i + k] = -l.h[i] * tension_q - t.value * h_q;
      force_v[COLUMNS * i + k] = -t.by_rate * l.h[i] * l.h[k];
    }
  }
  const baum_mechanism *m = point->mechanism;
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_q, blocks->force_q);
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_v, blocks->force_v);
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_spring, "spatial spring", fields), .check = check,
                 .parameter_count = PARAMETER_COUNT, .check_derivatives = baum_i_spring_check},
  .spatial = true,
  .lower = lower,
  .force = force,
  .linearize = linearize,
  BAUM_I_SPRING_MEMBERS(baum_spatial_spring_def),
  .stretch = stretch,
};

BAUM_I_DEFINE(force, spatial_spring, type)
