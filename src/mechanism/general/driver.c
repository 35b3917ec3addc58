/* SPDX-License-Identifier: BSD-3-Clause */
/* A driver has one row, which prescribes the coordinate of another joint (driven.h) to be
 *
 *   s(t) = value + rate t + acceleration t^2 / 2, or the result of a user function (the law)
 */
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/driven.h"

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_driver_def, joint, JOINT),
  BAUM_I_NUMBERS(baum_driver_def, value, FINITE, "rad or m", 0.0),
  BAUM_I_NUMBERS(baum_driver_def, rate, FINITE, "rad/s or m/s", 0.0),
  BAUM_I_NUMBERS(baum_driver_def, acceleration, FINITE, "rad/s^2 or m/s^2", 0.0),
  BAUM_I_LAW(baum_driver_def, value),
  BAUM_I_FIELD(baum_driver_def, user, USER),
  BAUM_I_FIELD(baum_driver_def, coordinate, COORDINATE),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_driver_def *def = given;
  return baum_i_check_coordinate(mechanism, def->joint, def->coordinate, label,
                                 &baum_i_driver_fields);
}

static baum_i_joint_coordinate driven(const baum_mechanism *mechanism, const void *given)
{
  const baum_driver_def *def = given;
  return baum_i_joint_coordinate_of(mechanism, def->joint, def->coordinate);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  (void)mechanism;
  const baum_driver_def *def = joint->element.def;
  if (!def->law) {
    const double s[3] = {def->value, def->rate, def->acceleration};
    baum_i_driver_replace_law(parameters, 0.0, s);
  }
  return BAUM_OK;
}

/* ---- the law ---- */

enum { LAW_SIZE = 3 };

/* Calls the user's law at time t. */
static baum_status law_at(const baum_i_joint *joint, baum_i_point *point, double t,
                          double s[LAW_SIZE])
{
  const baum_driver_def *def = joint->element.def;
  s[0] = 0.0;
  s[1] = 0.0;
  s[2] = 0.0;
  baum_i_listen();
  point->asking = true;
  int code = def->law(t, s, def->user);
  point->asking = false;
  return code == 0 ? baum_i_check_motion(joint, point, "law()", s)
                   : baum_i_fail_returned(&joint->element, "law", code, point);
}

static baum_status law(const baum_i_joint *joint, baum_i_point *point, double s[3])
{
  return law_at(joint, point, point->t, s);
}

/* ---- checks of the user's law ---- */

static baum_status law_field(const void *joint, const baum_i_local *at, double *out)
{
  return law_at(joint, at->point, at->t, out);
}

/* A law may be defined only for a limited time. Where the law fails, the check is therefore
 * skipped. */
static baum_status check_derivatives(const void *element, baum_i_point *point)
{
  static const baum_i_derived pairs[] = {{1, 0}, {2, 1}};
  const baum_i_joint *joint = element;
  const baum_driver_def *def = joint->element.def;
  /* A run may have replaced the law by a polynomial. */
  if (!def->law || point->parameters[joint->element.parameter + BAUM_I_DRIVER_POLYNOMIAL] != 0.0) {
    return BAUM_OK;
  }
  const baum_i_local at = {.point = point, .t = point->t, .free = point->scratch};
  const baum_i_user_function function = {&joint->element, "law", LAW_SIZE, 0, def->user};
  const baum_i_field field = {.evaluate = law_field, .context = joint, .size = LAW_SIZE};
  const baum_i_ray ray = {.dt = 1.0, .rate = 1.0};
  baum_status status = baum_i_compare_entries(&function, "law in t", &field, pairs, 2, &ray, &at);
  return status == BAUM_ERR_ARGUMENT ? status : BAUM_OK;
}

/* ---- type ---- */

static const baum_i_joint_type type = {
  .definition = {BAUM_I_DEFINITION(driver, "driver", fields), .check = check,
                 .parameter_count = BAUM_I_DRIVER_NUMBERS, .check_derivatives = check_derivatives},
  BAUM_I_DRIVER_MEMBERS(driven, law),
  .lower = lower,
};

BAUM_I_DEFINE(joint, driver, type)
