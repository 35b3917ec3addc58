/* SPDX-License-Identifier: BSD-3-Clause */
/* Driver: one row that prescribes the coordinate of another joint (driven.h) by
 *
 *   s(t) = value + rate t + acceleration t^2 / 2, or the user's law
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
  BAUM_I_FIELD(baum_driver_def, law, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_driver_def, user, USER),
  {0},
};

/* ---- definition ---- */

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

/* The user's, at any time. */
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

/* ---- checking what is given ---- */

/* Value and rate in the places of their derivatives, so that the message names their entry. */
static baum_status derived_field(const void *joint, const baum_i_local *at, double *out)
{
  double s[LAW_SIZE];
  BAUM_I_TRY(law_at(joint, at->point, at->t, s));
  out[0] = 0.0;
  out[1] = s[0];
  out[2] = s[1];
  return BAUM_OK;
}

/* A law may begin and end where it likes: where it refuses, nothing is to be told. */
static baum_status check_derivatives(const baum_i_joint *joint, baum_i_point *point)
{
  double given[LAW_SIZE];
  const baum_driver_def *def = joint->element.def;
  if (!def->law || law(joint, point, given) != BAUM_OK) {
    return BAUM_OK;
  }
  given[0] = 0.0;
  const baum_i_local at = {.point = point, .t = point->t, .free = point->scratch};
  const baum_i_user_function function = {
    .element = &joint->element, .name = "law", .rows = LAW_SIZE};
  const baum_i_field field = {.evaluate = derived_field, .context = joint, .size = LAW_SIZE};
  const baum_i_ray ray = {.dt = 1.0, .rate = 1.0};
  const baum_i_claim claim = {&function, "law in t", given};
  return baum_i_compare_ray(&claim, &baum_i_stencil_first, &field, &ray, &at);
}

/* ---- type ---- */

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  return baum_i_driver_evaluate(group, point, law, out);
}

static const baum_i_joint_type type = {
  .definition = {.kind = "driver",
                 .size = sizeof(baum_driver_def),
                 .fields = fields,
                 .check = baum_i_driver_check,
                 .parameter_count = BAUM_I_DRIVER_NUMBERS},
  .planar = true,
  .scleronomic = false,
  .drives = true,
  .replace_law = baum_i_driver_replace_law,
  .row_count = 1,
  .lower = lower,
  .evaluate = evaluate,
  .linearize = baum_i_driver_linearize,
  .check = check_derivatives,
  .place = baum_i_driver_place,
};

BAUM_I_DEFINE(joint, driver, type)
