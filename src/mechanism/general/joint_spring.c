/* SPDX-License-Identifier: BSD-3-Clause */
/* Spring and damper in parallel, which act on a coordinate c of a joint. The gradient of the
 * coordinate is h = c_q, and T(c, c') is the force or torque of general/spring_law.h:
 *
 *   g   = -T h^T
 *   g_q = -h^T (T_c h + T_c' (c')_q) - T (h^T)_q
 *   g_v = -T_c' h^T h
 *
 * The type of the joint computes c and its derivatives.
 */
#include "mechanism/definition.h"
#include "mechanism/general/columns.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/general/spring_law.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

BAUM_I_CHECK_SPRING_DEF(baum_joint_spring_def);

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_joint_spring_def, joint, JOINT),
  BAUM_I_FIELD(baum_joint_spring_def, coordinate, COORDINATE),
  BAUM_I_SPRING_FIELDS(baum_joint_spring_def, "N m/rad or N/m", "N m s/rad or N s/m", free_value,
                       OPTIONAL, "rad or m"),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  static const baum_i_coordinate_fields names = {"joint", "coordinate", "for a spring"};
  const baum_joint_spring_def *def = given;
  return baum_i_check_coordinate(mechanism, def->joint, def->coordinate, label, &names);
}

static baum_i_joint_coordinate sprung(const baum_mechanism *mechanism, const baum_i_force *force)
{
  const baum_joint_spring_def *def = force->element.def;
  return baum_i_joint_coordinate_of(mechanism, def->joint, def->coordinate);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  const baum_i_joint_coordinate of = sprung(mechanism, force);
  baum_i_spring_lower(force, baum_i_design_coordinate(mechanism, &of), parameters);
  return BAUM_OK;
}

/* ---- one spring ---- */

typedef struct spring {
  baum_i_joint_coordinate of;
  baum_i_spring_law law;
  baum_i_coordinate c;
} spring;

static spring spring_at(const baum_i_force *force, const baum_i_point *point)
{
  spring s = {.of = sprung(point->mechanism, force), .law = baum_i_spring_law_of(force, point)};
  baum_i_coordinate_at(&s.of, point, &s.c);
  return s;
}

static baum_i_stretch stretch(const baum_i_force *force, const baum_i_point *point)
{
  const spring s = spring_at(force, point);
  double scale = baum_i_is_angle(&s.of) ? 1.0 : point->mechanism->length;
  return (baum_i_stretch){s.c.value, s.c.rate, scale, false};
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const spring s = spring_at(group->forces[i], point);
    const int width = s.of.joint->type->width;
    baum_i_tension t;
    BAUM_I_TRY(baum_i_tension_at(&s.law, point, s.c.value, s.c.rate, &t));
    double wide[COLUMNS];
    for (int k = 0; k < 2 * width; k++) {
      wide[k] = -t.value * s.c.gradient[k];
    }
    baum_i_columns_scatter_any(point->mechanism, &group->forces[i]->span, width, wide, out);
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  const spring s = spring_at(element, point);
  const int width = s.of.joint->type->width;
  const int columns = 2 * width;
  const double *h = s.c.gradient;
  baum_i_tension t;
  BAUM_I_TRY(baum_i_tension_at(&s.law, point, s.c.value, s.c.rate, &t));
  const double unused[COLUMNS] = {0.0};
  baum_i_coordinate_blocks c;
  baum_i_coordinate_linearize(&s.of, point, unused, t.value, &c);
  double force_q[COLUMNS * COLUMNS];
  double force_v[COLUMNS * COLUMNS];
  for (int i = 0; i < columns; i++) {
    for (int k = 0; k < columns; k++) {
      int at = columns * i + k;
      force_q[at] = -h[i] * (t.by_length * h[k] + t.by_rate * c.rate_q[k]) - c.jtl_q[at];
      force_v[at] = -t.by_rate * h[i] * h[k];
    }
  }
  baum_i_columns_pack_force(point->mechanism, element, width, force_q, blocks->force_q);
  baum_i_columns_pack_force(point->mechanism, element, width, force_v, blocks->force_v);
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(joint_spring, "joint spring", fields), .check = check,
                 .parameter_count = BAUM_I_SPRING_NUMBERS,
                 .check_derivatives = baum_i_spring_check},
  .lower = lower,
  .force = force,
  .linearize = linearize,
  BAUM_I_SPRING_MEMBERS(baum_joint_spring_def),
  .stretch = stretch,
};

BAUM_I_DEFINE(force, joint_spring, type)
