/* SPDX-License-Identifier: BSD-3-Clause */
/* A load on a coordinate c of a joint. The gradient of the coordinate is h = c_q, and e is the
 * effort. If the load has an input u, the effort is multiplied by u. Below, e includes this factor.
 *
 *   g   = e h^T
 *   g_q = e (h^T)_q
 *   P   = e c', the power
 *
 * The type of the joint computes c and its derivatives. The load has no potential, because the work
 * of a torque depends on the number of revolutions.
 */
#include "mechanism/definition.h"
#include "mechanism/general/columns.h"
#include "mechanism/general/coordinate.h"

enum { COLUMNS = BAUM_I_PAIR_COLUMNS };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_joint_load_def, joint, JOINT),
  BAUM_I_FIELD(baum_joint_load_def, coordinate, COORDINATE),
  BAUM_I_NUMBERS(baum_joint_load_def, effort, FINITE, "N m or N", 0.0),
  BAUM_I_FIELD(baum_joint_load_def, input, INPUT),
  {0},
};

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  static const baum_i_coordinate_fields names = {"joint", "coordinate", "for a load"};
  const baum_joint_load_def *def = given;
  return baum_i_check_coordinate(mechanism, def->joint, def->coordinate, label, &names);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  (void)mechanism;
  const baum_joint_load_def *def = force->element.def;
  parameters[0] = def->effort;
  return BAUM_OK;
}

/* Return the effort multiplied by the input, and set the coordinate on which it acts. */
static double effort_at(const baum_i_force *force, const baum_i_point *point,
                        baum_i_joint_coordinate *of)
{
  const baum_joint_load_def *def = force->element.def;
  *of = baum_i_joint_coordinate_of(point->mechanism, def->joint, def->coordinate);
  return point->parameters[force->element.parameter] * baum_i_input_factor(point, def->input);
}

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    baum_i_joint_coordinate of;
    const double effort = effort_at(group->forces[i], point, &of);
    baum_i_coordinate c;
    baum_i_coordinate_at(&of, point, &c);
    const int width = of.joint->type->width;
    double wide[COLUMNS];
    for (int k = 0; k < 2 * width; k++) {
      wide[k] = effort * c.gradient[k];
    }
    baum_i_columns_scatter_any(point->mechanism, &group->forces[i]->span, width, wide, out);
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  baum_i_joint_coordinate of;
  const double effort = effort_at(element, point, &of);
  const double unused[COLUMNS] = {0.0};
  baum_i_coordinate_blocks c;
  baum_i_coordinate_linearize(&of, point, unused, effort, &c);
  baum_i_columns_pack_force(point->mechanism, element, of.joint->type->width, c.jtl_q,
                            blocks->force_q);
  return BAUM_OK;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  baum_i_joint_coordinate of;
  const double effort = effort_at(element, point, &of);
  baum_i_coordinate c;
  baum_i_coordinate_at(&of, point, &c);
  sum[BAUM_I_POWER_LOADS] += effort * c.rate;
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(joint_load, "joint load", fields), .check = check,
                 .parameter_count = 1},
  .lower = lower,
  .force = force,
  .linearize = linearize,
  .power = power,
};

BAUM_I_DEFINE(force, joint_load, type)
