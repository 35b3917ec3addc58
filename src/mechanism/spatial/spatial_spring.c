/* SPDX-License-Identifier: BSD-3-Clause */
/* Spring and damper in parallel between two points in space. With e from body_a's point to body_b's
 * (spatial_rows.h), l = |e|, h = l_q and the tension T(l, l') of general/spring_law.h:
 *
 *   g   = -T h                              (12 entries, 6 for each body)
 *   g_q = -h T_q - T h_q,   T_q = T_l h + T_l' (l')_q
 *   g_v = -T_l' h h^T
 *
 * where h = (e . e)_q / (2 l) and h_q = ((e . e)_qq / 2 - h h^T) / l. At l = 0 the direction is
 * undefined; force and derivatives are set to zero there.
 */
#include <float.h>
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/spatial/spatial_rows.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters; both points come first. */
enum { LAW = 6, PARAMETER_COUNT = LAW + BAUM_I_SPRING_NUMBERS };

static const baum_i_spatial_row SQUARE = {BAUM_I_APART, BAUM_I_APART};

static const baum_i_def_field fields[] = {
  BAUM_I_SPATIAL_FIELDS(baum_spatial_spring_def),
  BAUM_I_NUMBERS(baum_spatial_spring_def, stiffness, NOT_NEGATIVE, "N/m", 0.0),
  BAUM_I_NUMBERS(baum_spatial_spring_def, damping, NOT_NEGATIVE, "N s/m", 0.0),
  BAUM_I_OPTIONAL(baum_spatial_spring_def, free_length, OPTIONAL_NOT_NEGATIVE, "m"),
  BAUM_I_FIELD(baum_spatial_spring_def, law, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_spatial_spring_def, user, USER),
  BAUM_I_FIELD(baum_spatial_spring_def, depends_on_velocity, CLAIM),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  return baum_i_spatial_check_head(mechanism, def, label, true);
}

static bool depends_on_velocity(const void *given)
{
  const baum_spatial_spring_def *def = given;
  return def->law ? def->depends_on_velocity : def->damping != 0.0;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  const baum_spatial_spring_def *def = force->element.def;
  BAUM_I_TRY(baum_i_spatial_points(mechanism, &force->element, parameters));
  double *numbers = parameters + LAW;
  numbers[BAUM_I_STIFFNESS] = def->stiffness;
  numbers[BAUM_I_DAMPING] = def->damping;
  numbers[BAUM_I_FREE_LENGTH] =
    isnan(def->free_length) ? baum_i_spatial_design_length(mechanism, &force->span, parameters)
                            : def->free_length;
  return BAUM_OK;
}

/* ---- one spring ---- */

typedef struct spring {
  baum_i_spatial_pair pair;
  baum_i_spring_law law;
  double length; /* l; 0 if too short to have a direction */
  double rate;
  double h[COLUMNS];
} spring;

static spring spring_at(const baum_i_force *force, const baum_i_point *point)
{
  const baum_spatial_spring_def *def = force->element.def;
  const double *numbers = point->parameters + force->element.parameter;
  spring s = {.pair = baum_i_spatial_pair_at(&force->span, numbers, false, point),
              .law = {.element = &force->element,
                      .numbers = numbers + LAW,
                      .law = def->law,
                      .user = def->user,
                      .depends_on_rate = def->depends_on_velocity}};
  baum_i_coordinate square;
  baum_i_spatial_row_at(&s.pair, SQUARE, &square);
  double length = sqrt(square.value);
  if (length >= DBL_MIN) {
    s.length = length;
    s.rate = 0.5 * square.rate / length;
    for (int i = 0; i < COLUMNS; i++) {
      s.h[i] = 0.5 * square.gradient[i] / length;
    }
  }
  return s;
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const spring s = spring_at(group->forces[i], point);
    if (s.length == 0.0) {
      continue;
    }
    baum_i_tension t;
    BAUM_I_TRY(baum_i_tension_at(&s.law, point, s.length, s.rate, &t));
    double wide[COLUMNS];
    for (int k = 0; k < COLUMNS; k++) {
      wide[k] = -t.value * s.h[k];
    }
    baum_i_columns_scatter_any(point->mechanism, &group->forces[i]->span, BAUM_I_SPACE, wide, out);
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_force *element, baum_i_point *point, double *sum)
{
  const spring s = spring_at(element, point);
  *sum += baum_i_spring_potential(&s.law, s.length);
  return BAUM_OK;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  const spring s = spring_at(element, point);
  return s.length > 0.0 ? baum_i_spring_power(&s.law, point, s.length, s.rate, sum) : BAUM_OK;
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  const spring s = spring_at(element, point);
  if (s.length == 0.0) {
    return BAUM_OK;
  }
  baum_i_tension t;
  BAUM_I_TRY(baum_i_tension_at(&s.law, point, s.length, s.rate, &t));
  baum_i_spatial_second second;
  baum_i_spatial_second_of(&s.pair, SQUARE, &second);
  double force_q[COLUMNS * COLUMNS];
  double force_v[COLUMNS * COLUMNS];
  for (int k = 0; k < COLUMNS; k++) {
    double rate_q = (0.5 * second.rate_q[k] - s.rate * s.h[k]) / s.length;
    double tension_q = t.by_length * s.h[k] + t.by_rate * rate_q;
    for (int i = 0; i < COLUMNS; i++) {
      double h_q = (0.5 * second.columns_q[COLUMNS * i + k] - s.h[i] * s.h[k]) / s.length;
      force_q[COLUMNS * i + k] = -s.h[i] * tension_q - t.value * h_q;
      force_v[COLUMNS * i + k] = -t.by_rate * s.h[i] * s.h[k];
    }
  }
  const baum_mechanism *m = point->mechanism;
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_q, blocks->force_q);
  baum_i_columns_pack_force(m, element, BAUM_I_SPACE, force_v, blocks->force_v);
  return BAUM_OK;
}

static baum_status check_derivatives(const void *element, baum_i_point *point)
{
  const spring s = spring_at(element, point);
  return s.length == 0.0
           ? BAUM_OK
           : baum_i_check_spring_law(&s.law, point, s.length, s.rate, point->mechanism->length);
}

static const baum_i_force_type type = {
  .definition = {.kind = "spatial spring",
                 .size = sizeof(baum_spatial_spring_def),
                 .fields = fields,
                 .check = check,
                 .parameter_count = PARAMETER_COUNT,
                 .check_derivatives = check_derivatives},
  .spatial = true,
  .lower = lower,
  .force = force,
  .depends_on_velocity = depends_on_velocity,
  .potential = potential,
  .linearize = linearize,
  .power = power,

};

BAUM_I_DEFINE(force, spatial_spring, type)
