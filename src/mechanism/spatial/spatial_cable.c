/* SPDX-License-Identifier: BSD-3-Clause */
/* Cable over points that are fixed in bodies. Let e_i be the vector from point i to point i + 1,
 * l_i = |e_i|, l = sum of l_i, and h = l_q. The stiffness k, the damping c and the free length l_0
 * are those of general/spring_law.h. d is the field `transition` of the definition. T(l, l') is the
 * tension. It is the result of a user's law, or, with s = l - l_0,
 *
 *   T = max(0, k s + c w(s / d) l') for s > 0, otherwise 0;   w(x) = x^2 (3 - 2 x), 1 for x > 1
 *
 *   g   = -T h
 *   g_q = -h T_q - T h_q,   T_q = T_l h + T_l' (l')_q
 *   g_v = -T_l' h h^T
 *
 * h, h_q and (l')_q are sums over the parts i, each from point i to point i + 1. The squared length
 * of a part is a product e_i . e_i (spatial_spring.c). A part with l_i = 0 has no direction and is
 * omitted. If consecutive points are on the same body, the part between them has a constant length,
 * and its derivatives cancel.
 */
#include <math.h>
#include <string.h>

#include "mechanism/definition.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/spatial/spatial_rows.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

/* Parameters. */
enum { TRANSITION, LAW, PARAMETER_COUNT = LAW + BAUM_I_SPRING_NUMBERS };

/* The default of d, relative to l_0. */
static const double TRANSITION_SHARE = 1e-4;

static const baum_i_spatial_row SQUARE = {BAUM_I_APART, BAUM_I_APART};

BAUM_I_CHECK_SPRING_DEF(baum_spatial_cable_def);

static const baum_i_def_field fields[] = {
  BAUM_I_ARRAY(baum_spatial_cable_def, bodies, PATH, FINITE, point_count, point_count),
  BAUM_I_ARRAY(baum_spatial_cable_def, points, POINTS, FINITE, point_count, point_count),
  BAUM_I_FIELD(baum_spatial_cable_def, point_count, OWN_COUNT),
  BAUM_I_SPRING_FIELDS(baum_spatial_cable_def, "N/m", "N s/m", free_length, OPTIONAL_NOT_NEGATIVE,
                       "m"),
  BAUM_I_OPTIONAL(baum_spatial_cable_def, transition, OPTIONAL_NOT_NEGATIVE, "m"),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_spatial_cable_def *def = given;
  for (int k = 0; k < def->point_count; k++) {
    const baum_i_text body = baum_i_text_of("bodies[%d]", k);
    const baum_i_text point = baum_i_text_of("points[%d]", k);
    BAUM_I_TRY(baum_i_spatial_check_body(mechanism, def->bodies[k], label, body.text));
    BAUM_I_TRY(baum_i_spatial_check_zero_on_particle(mechanism, def->bodies[k], label, point.text,
                                                     "m", def->points + 3 * (ptrdiff_t)k));
  }
  return BAUM_OK;
}

/* The bodies of point k and of the next point. */
typedef struct ends {
  int bodies[2];
} ends;

static ends ends_of(const baum_mechanism *mechanism, const baum_spatial_cable_def *def, int k)
{
  return (ends){{baum_i_body_index(mechanism, def->bodies[k]),
                 baum_i_body_index(mechanism, def->bodies[k + 1])}};
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  const baum_spatial_cable_def *def = force->element.def;
  double length = 0.0;
  for (int k = 0; k + 1 < def->point_count; k++) {
    ends at = ends_of(mechanism, def, k);
    const baum_i_span span = {.body_count = 2, .bodies = at.bodies};
    length += baum_i_spatial_design_length(mechanism, &span, def->points + 3 * (ptrdiff_t)k);
  }
  baum_i_spring_lower(force, length, parameters + LAW);
  parameters[TRANSITION] = isnan(def->transition)
                             ? TRANSITION_SHARE * parameters[LAW + BAUM_I_FREE_LENGTH]
                             : def->transition;
  return BAUM_OK;
}

/* ---- one part ---- */

typedef struct part {
  ends at;
  baum_i_spatial_pair pair;
  baum_i_spatial_length l;
} part;

static part part_at(const baum_i_force *force, const baum_i_point *point, int k)
{
  const baum_spatial_cable_def *def = force->element.def;
  part p = {.at = ends_of(point->mechanism, def, k)};
  const baum_i_span span = {.body_count = 2, .bodies = p.at.bodies};
  p.pair = baum_i_spatial_pair_at(&span, def->points + 3 * (ptrdiff_t)k, false, point);
  p.l = baum_i_spatial_length_of(&p.pair);
  return p;
}

static baum_i_stretch stretch(const baum_i_force *force, const baum_i_point *point)
{
  const baum_spatial_cable_def *def = force->element.def;
  baum_i_stretch sum = {.scale = point->mechanism->length};
  for (int k = 0; k + 1 < def->point_count; k++) {
    const part p = part_at(force, point, k);
    sum.length += p.l.length;
    sum.rate += p.l.rate;
  }
  sum.no_direction = sum.length == 0.0;
  return sum;
}

/* ---- tension ---- */

static baum_status tension_at(const baum_i_force *force, baum_i_point *point,
                              const baum_i_stretch *now, baum_i_tension *out)
{
  const baum_i_spring_law given = baum_i_spring_law_of(force, point);
  const double *law = given.numbers;
  *out = (baum_i_tension){.value = 0.0};
  if (given.law) {
    return baum_i_call_spring_law(&given, point, now->length, now->rate, out);
  }
  const double s = now->length - law[BAUM_I_FREE_LENGTH];
  if (s <= 0.0) {
    return BAUM_OK;
  }
  const double d = point->parameters[force->element.parameter + TRANSITION];
  const double x = s < d ? s / d : 1.0;
  const double damping = law[BAUM_I_DAMPING] * x * x * (3.0 - 2.0 * x);
  const double slope = s < d ? law[BAUM_I_DAMPING] * 6.0 * x * (1.0 - x) / d : 0.0;
  const double value = law[BAUM_I_STIFFNESS] * s + damping * now->rate;
  if (value > 0.0) {
    *out = (baum_i_tension){value, law[BAUM_I_STIFFNESS] + slope * now->rate, damping};
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_force *force, baum_i_point *point, double *sum)
{
  const baum_i_spring_law given = baum_i_spring_law_of(force, point);
  const double *law = given.numbers;
  double s = fmax(stretch(force, point).length - law[BAUM_I_FREE_LENGTH], 0.0);
  *sum += given.law ? 0.0 : 0.5 * law[BAUM_I_STIFFNESS] * s * s;
  return BAUM_OK;
}

/* While the force of the damper of a slackening cable cancels the force of the spring, the cable
 * exerts no force, but its potential decreases. The step control of a run does not notice this
 * decrease, which ends suddenly at s = 0. The integral of the power of the spring would therefore
 * be inaccurate. For a damped cable, power() uses the whole force, and the decrease is a difference
 * of two potentials. */
static bool power_is_whole(const baum_i_force *force)
{
  const baum_spatial_cable_def *def = force->element.def;
  return !def->law && def->damping != 0.0;
}

static baum_status power(const baum_i_force *force, baum_i_point *point, double sum[BAUM_I_POWERS])
{
  const baum_spatial_cable_def *def = force->element.def;
  const baum_i_stretch now = stretch(force, point);
  baum_i_tension t;
  BAUM_I_TRY(tension_at(force, point, &now, &t));
  if (def->law) {
    sum[BAUM_I_POWER_SPRINGS] -= t.value * now.rate;
  } else if (def->damping != 0.0) {
    sum[BAUM_I_POWER_DAMPERS] -= t.value * now.rate;
  }
  return BAUM_OK;
}

/* ---- force ---- */

static void add_part(const baum_i_force *force, const baum_i_point *point, int k, double tension,
                     double *out)
{
  const part p = part_at(force, point, k);
  for (int side = 0; side < 2; side++) {
    double six[BAUM_I_SPACE];
    for (int i = 0; i < BAUM_I_SPACE; i++) {
      six[i] = -tension * p.l.h[BAUM_I_SPACE * side + i];
    }
    const baum_i_body *body = point->mechanism->bodies[p.at.bodies[side]];
    baum_i_columns_scatter_any(point->mechanism, &body->span, BAUM_I_SPACE, six, out);
  }
}

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_force *one = group->forces[i];
    const baum_spatial_cable_def *def = one->element.def;
    const baum_i_stretch now = stretch(one, point);
    baum_i_tension t;
    BAUM_I_TRY(tension_at(one, point, &now, &t));
    for (int k = 0; t.value != 0.0 && k + 1 < def->point_count; k++) {
      add_part(one, point, k, t.value, out);
    }
  }
  return BAUM_OK;
}

/* ---- derivatives ---- */

/* Finds the index of each of the twelve columns of a part among the packed columns. The index is -1
 * if a body does not have the column. */
static void find_columns(const baum_mechanism *m, const baum_i_span *span, const part *p,
                         int at[COLUMNS])
{
  for (int side = 0; side < 2; side++) {
    int k = 0;
    while (span->bodies[k] != p->at.bodies[side]) {
      k++;
    }
    baum_i_columns_find(m, span, k, BAUM_I_SPACE, at + (ptrdiff_t)BAUM_I_SPACE * side);
  }
}

/* Adds the contribution of a part to h and (l')_q (nl), and subtracts T times the part's h_q from
 * force_q (nl x nl). */
static void add_second(const baum_i_span *span, const part *p, const int at[COLUMNS],
                       double tension, double *h, double *rate_q, double *force_q)
{
  baum_i_spatial_second second;
  baum_i_spatial_second_of(&p->pair, SQUARE, &second);
  for (int i = 0; i < COLUMNS; i++) {
    if (at[i] < 0) {
      continue;
    }
    h[at[i]] += p->l.h[i];
    rate_q[at[i]] += (0.5 * second.rate_q[i] - p->l.rate * p->l.h[i]) / p->l.length;
    for (int k = 0; force_q && k < COLUMNS; k++) {
      if (at[k] >= 0) {
        double h_q =
          (0.5 * second.columns_q[COLUMNS * i + k] - p->l.h[i] * p->l.h[k]) / p->l.length;
        force_q[(ptrdiff_t)span->nl * at[i] + at[k]] -= tension * h_q;
      }
    }
  }
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  const baum_spatial_cable_def *def = element->element.def;
  const baum_i_span *span = &element->span;
  const baum_i_stretch now = stretch(element, point);
  baum_i_tension t;
  BAUM_I_TRY(tension_at(element, point, &now, &t));
  double *force_q = blocks->force_q ? blocks->force_q + element->square : NULL;
  double *force_v = blocks->force_v ? blocks->force_v + element->square : NULL;
  double *h = point->scratch;
  double *rate_q = point->scratch + span->nl;
  memset(h, 0, 2 * (size_t)span->nl * sizeof *h);
  for (int k = 0; k + 1 < def->point_count; k++) {
    const part p = part_at(element, point, k);
    int at[COLUMNS];
    if (p.l.length > 0.0) {
      find_columns(point->mechanism, span, &p, at);
      add_second(span, &p, at, t.value, h, rate_q, force_q);
    }
  }
  for (int k = 0; k < span->nl * span->nl; k++) {
    const int i = k / span->nl;
    const int j = k % span->nl;
    if (force_q) {
      force_q[k] -= h[i] * (t.by_length * h[j] + t.by_rate * rate_q[j]);
    }
    if (force_v) {
      force_v[k] -= t.by_rate * h[i] * h[j];
    }
  }
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(spatial_cable, "spatial cable", fields), .check = check,
                 .parameter_count = PARAMETER_COUNT, .check_derivatives = baum_i_spring_check},
  .spatial = true,
  .lower = lower,
  .force = force,
  .linearize = linearize,
  .depends_on_velocity = baum_i_spring_depends,
  .spring_fields = offsetof(baum_spatial_cable_def, stiffness),
  .stretch = stretch,
  .potential = potential,
  .power = power,
  .power_is_whole = power_is_whole,
  .whole_class = BAUM_I_POWER_DAMPERS,
};

BAUM_I_DEFINE(force, spatial_cable, type)
