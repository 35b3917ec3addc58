/* SPDX-License-Identifier: BSD-3-Clause */
/* Spring and damper in parallel between two points in the plane. Let d be the vector from the point
 * on body_a to the point on body_b, and l = |d|. The spring has the stiffness k, the damping c and
 * the free length l_0. F = l^2 / 2 and G are defined in separation.h.
 *
 *   T   = k (l - l_0) + c l'                       tension
 *   h   = l_q = G^T d / l                          (6 columns)
 *   g   = -T h                                     (6 entries)
 *   V   = k (l - l_0)^2 / 2
 *   g_q = -h (k h + c l_qq v)^T - T l_qq,   l_qq = (F_qq - h h^T) / l          (6 x 6)
 *   g_v = -c h h^T                                                            (6 x 6)
 *
 * A spring with a user's law T(l, l') has no V, and in g_q and g_v the derivatives T_l and T_l'
 * replace k and c. If l = 0, the direction is undefined, and the force and its derivatives are set
 * to zero.
 */
#include <float.h>
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/planar/separation.h"

/* Parameters of the spring: the points s_a and s_b, then the numbers of the spring law. */
enum { LAW = 4, PARAMETER_COUNT = LAW + BAUM_I_SPRING_NUMBERS };

BAUM_I_CHECK_SPRING_DEF(baum_planar_spring_def);

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_FIELDS(baum_planar_spring_def),
  BAUM_I_SPRING_FIELDS(baum_planar_spring_def, "N/m", "N s/m", free_length, OPTIONAL_NOT_NEGATIVE,
                       "m"),
  {0},
};

/* ---- definition ---- */

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  BAUM_I_TRY(baum_i_planar_points(mechanism, &force->element, parameters));
  baum_i_spring_lower(force, baum_i_separation_in_design(mechanism, &force->span, parameters),
                      parameters + LAW);
  return BAUM_OK;
}

/* ---- one spring ---- */

typedef struct spring {
  baum_i_separation line;
  double length; /* l, or 0 if the direction is undefined */
  double rate;
  double h[6];
} spring;

static spring spring_at(const baum_i_force *force, const baum_i_point *point)
{
  const double *numbers = point->parameters + force->element.parameter;
  baum_i_marker a = baum_i_marker_at(point, force->span.bodies[0], numbers);
  baum_i_marker b = baum_i_marker_at(point, force->span.bodies[1], numbers + 2);
  spring s;
  s.line = baum_i_separation_of(&a, &b);
  s.length = baum_i_separation_length(&s.line);
  if (s.length < DBL_MIN) {
    /* The length may be so small that 1 / length overflows. The spring then has no direction. */
    return (spring){.line = s.line};
  }
  const double e[2] = {s.line.d[0] / s.length, s.line.d[1] / s.length};
  baum_i_separation_spread(&s.line, e, s.h);
  s.rate = e[0] * s.line.rate[0] + e[1] * s.line.rate[1];
  return s;
}

static baum_i_stretch stretch(const baum_i_force *force, const baum_i_point *point)
{
  const spring s = spring_at(force, point);
  return (baum_i_stretch){s.length, s.rate, point->mechanism->length, s.length == 0.0};
}

/* Compute the second derivative l_qq of the length. */
static void bend_of(const spring *s, double bend[36])
{
  baum_i_separation_hessian(&s->line, bend);
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) {
      bend[6 * i + j] = (bend[6 * i + j] - s->h[i] * s->h[j]) / s->length;
    }
  }
}

static void set_force_q(const spring *s, const baum_i_tension *t, const double v[6], double out[36])
{
  double bend[36];
  bend_of(s, bend);
  double tension_q[6];
  for (int j = 0; j < 6; j++) {
    double rate_q = 0.0;
    for (int k = 0; k < 6; k++) {
      rate_q += bend[6 * j + k] * v[k];
    }
    tension_q[j] = t->by_length * s->h[j] + t->by_rate * rate_q;
  }
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) {
      out[6 * i + j] = -s->h[i] * tension_q[j] - t->value * bend[6 * i + j];
    }
  }
}

static void set_force_v(const spring *s, const baum_i_tension *t, double out[36])
{
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < 6; j++) {
      out[6 * i + j] = -t->by_rate * s->h[i] * s->h[j];
    }
  }
}

/* ---- type ---- */

/* Add g = -T h. With e = d / l, g consists of the force T e and its moment on body_a, and of the
 * force -T e and its moment on body_b. Every evaluation calls this function. It therefore uses
 * vector instructions (pair.h). */
static baum_status add_one(const baum_i_force *element, baum_i_point *point, double *out)
{
  const double *numbers = point->parameters + element->element.parameter;
  const baum_i_frame *f = &point->frames[element->span.bodies[0]];
  const baum_i_frame *g = &point->frames[element->span.bodies[1]];
  baum_i_pair p = baum_i_arm_on(f, numbers);
  baum_i_pair s = baum_i_arm_on(g, numbers + 2);
  baum_i_pair d = baum_i_load(&g->x) + s - (baum_i_load(&f->x) + p);
  baum_i_pair rate =
    baum_i_load(&g->vx) + g->w * baum_i_turned(s) - (baum_i_load(&f->vx) + f->w * baum_i_turned(p));
  double length = baum_i_length_of(d[0], d[1]);
  if (length < DBL_MIN) {
    return BAUM_OK;
  }
  baum_i_pair e = d / length;
  baum_i_spring_law law = baum_i_spring_law_of(element, point);
  baum_i_tension t;
  BAUM_I_TRY(baum_i_tension_at(&law, point, length, baum_i_dot(e, rate), &t));
  baum_i_pair pull = t.value * e;
  const double six[6] = {pull[0],  pull[1],  baum_i_dot(baum_i_turned(p), pull),
                         -pull[0], -pull[1], -baum_i_dot(baum_i_turned(s), pull)};
  baum_i_columns_scatter(point->mechanism, &element->span, six, out);
  return BAUM_OK;
}

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    BAUM_I_TRY(add_one(group->forces[i], point, out));
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  spring s = spring_at(element, point);
  if (s.length == 0.0) {
    return BAUM_OK;
  }
  baum_i_spring_law law = baum_i_spring_law_of(element, point);
  baum_i_tension t;
  BAUM_I_TRY(baum_i_tension_at(&law, point, s.length, s.rate, &t));
  const baum_i_span *span = &element->span;
  double six[36];
  if (blocks->force_q) {
    double v[6];
    baum_i_planar_velocities(&point->frames[span->bodies[0]], &point->frames[span->bodies[1]], v);
    set_force_q(&s, &t, v, six);
    baum_i_columns_pack_force(point->mechanism, element, BAUM_I_PLANE, six, blocks->force_q);
  }
  if (blocks->force_v) {
    set_force_v(&s, &t, six);
    baum_i_columns_pack_force(point->mechanism, element, BAUM_I_PLANE, six, blocks->force_v);
  }
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(planar_spring, "planar spring", fields),
                 .check = baum_i_planar_check_apart, .parameter_count = PARAMETER_COUNT,
                 .check_derivatives = baum_i_spring_check},
  .lower = lower,
  .force = force,
  .linearize = linearize,
  BAUM_I_SPRING_MEMBERS(baum_planar_spring_def),
  .stretch = stretch,
};

BAUM_I_DEFINE(force, planar_spring, type)
