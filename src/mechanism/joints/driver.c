/* SPDX-License-Identifier: BSD-3-Clause */
/* Driver: one row that prescribes the coordinate c(q) of another joint.
 *
 *   Phi = c(q) - s(t),   J = c_q,   nu = s',   gamma = s'' - (c_q v)_q v,   nu_q = 0
 *   s(t) = value + rate t + acceleration t^2 / 2, or the user's law
 *
 * c, c_q and their derivatives are those of the driven joint's type;
 * the driver acts on the same bodies.
 */
#include <math.h>

#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/joints/coordinate.h"
#include "mechanism/planar.h"

/* Parameters. */
enum { VALUE, RATE, ACCELERATION, PARAMETER_COUNT };

static const baum_driver_def defaults = {.struct_size = sizeof(baum_driver_def)};

/* ---- definition ---- */

static const baum_i_joint *driven_by(const baum_mechanism *mechanism, const void *given)
{
  const baum_driver_def *def = given;
  return mechanism->joints[baum_i_joint_index(mechanism, def->joint)];
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_driver_def *def = given;
  baum_status status = baum_i_check_coordinate(mechanism, def->joint, label, "joint", "to drive");
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "value", "rad or m", def->value);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "rate", "rad/s or m/s", def->rate);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "acceleration", "rad/s^2 or m/s^2", def->acceleration);
  }
  return status;
}

/* A driver always comes after its joint; in a copy, too, that is what it finds. */
static const char *tied(const void *present, const void *next)
{
  const baum_driver_def *a = present;
  const baum_driver_def *b = next;
  return a->joint.index1 == b->joint.index1 ? NULL : "joint";
}

static int rows(const void *def)
{
  (void)def;
  return 1;
}

static void bodies(const baum_mechanism *mechanism, const void *def, baum_i_span *span)
{
  const baum_i_joint *driven = driven_by(mechanism, def);
  driven->type->bodies(mechanism, driven->element.def, span);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_joint *joint,
                         double *parameters)
{
  (void)mechanism;
  const baum_driver_def *def = joint->element.def;
  parameters[VALUE] = def->value;
  parameters[RATE] = def->rate;
  parameters[ACCELERATION] = def->acceleration;
  return BAUM_OK;
}

/* ---- the law ---- */

static baum_status refuse_return(const baum_i_joint *joint, baum_i_point *point, int code)
{
  char label[BAUM_I_LABEL_SIZE];
  point->retry = code > 0;
  return baum_i_fail(BAUM_ERR_CALLBACK, "%s: law() returned %d (%s)",
                     baum_i_label(&joint->element, "joint", label), code,
                     code > 0 ? "retry" : "stop");
}

static baum_status check_law(const baum_i_joint *joint, baum_i_point *point, const double s[3])
{
  static const char *const names[3] = {"value", "rate", "acceleration"};
  static const char *const per[3] = {"", "/s", "/s^2"};
  for (int i = 0; i < 3; i++) {
    if (!isfinite(s[i])) {
      char label[BAUM_I_LABEL_SIZE];
      point->retry = true;
      return baum_i_fail(BAUM_ERR_NOT_FINITE, "%s: law() gave %g for the %s [%s%s]",
                         baum_i_label(&joint->element, "joint", label), s[i], names[i],
                         driven_by(point->mechanism, joint->element.def)->type->coordinate_unit,
                         per[i]);
    }
  }
  return BAUM_OK;
}

static baum_status law(const baum_i_joint *joint, baum_i_point *point, double s[3])
{
  const baum_driver_def *def = joint->element.def;
  double t = point->t;
  if (!def->law) {
    const double *numbers = point->parameters + joint->element.parameter;
    s[0] = numbers[VALUE] + t * (numbers[RATE] + 0.5 * t * numbers[ACCELERATION]);
    s[1] = numbers[RATE] + t * numbers[ACCELERATION];
    s[2] = numbers[ACCELERATION];
    return BAUM_OK;
  }
  s[0] = 0.0;
  s[1] = 0.0;
  s[2] = 0.0;
  int code = def->law(t, s, def->user);
  return code == 0 ? check_law(joint, point, s) : refuse_return(joint, point, code);
}

/* ---- type ---- */

static void coordinate_of(const baum_i_joint *joint, const baum_i_point *point,
                          baum_i_coordinate *out)
{
  const baum_i_joint *driven = driven_by(point->mechanism, joint->element.def);
  driven->type->coordinate(driven, point, out);
}

static baum_status evaluate_one(const baum_i_joint *joint, baum_i_point *point,
                                const baum_i_rows *out)
{
  double s[3] = {0.0};
  if (out->phi || out->nu || out->gamma) {
    baum_status status = law(joint, point, s);
    if (status != BAUM_OK) {
      return status;
    }
  }
  baum_i_coordinate c;
  coordinate_of(joint, point, &c);
  if (out->phi) {
    out->phi[joint->row] = c.value - s[0];
  }
  if (out->jacobian) {
    baum_i_planar_pack(point->mechanism, &joint->span, 1, c.gradient,
                       out->jacobian + joint->jacobian);
  }
  if (out->nu) {
    out->nu[joint->row] = s[1];
  }
  if (out->gamma) {
    out->gamma[joint->row] = c.gamma + s[2];
  }
  return BAUM_OK;
}

static baum_status evaluate(const baum_i_joint_group *group, baum_i_point *point,
                            const baum_i_rows *out)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    status = evaluate_one(group->joints[i], point, out);
  }
  return status;
}

static void put_row(const baum_i_joint *joint, const baum_mechanism *mechanism, const double *six,
                    double *rows_of_all)
{
  if (rows_of_all) {
    baum_i_planar_pack(mechanism, &joint->span, 1, six, rows_of_all + joint->jacobian);
  }
}

static baum_status linearize(const baum_i_joint_group *group, baum_i_point *point, const double *w,
                             const double *lambda, const baum_i_joint_blocks *blocks)
{
  const baum_mechanism *mechanism = point->mechanism;
  for (int i = 0; i < group->count; i++) {
    const baum_i_joint *joint = group->joints[i];
    const baum_i_joint *driven = driven_by(mechanism, joint->element.def);
    double w_six[6] = {0.0};
    if (w) {
      baum_i_planar_gather(point, &joint->span, w, w_six);
    }
    baum_i_coordinate_blocks six;
    driven->type->coordinate_linearize(driven, point, w_six, lambda ? lambda[joint->row] : 0.0,
                                       &six);
    put_row(joint, mechanism, six.jw_q, blocks->jw_q);
    put_row(joint, mechanism, six.gamma_q, blocks->gamma_q);
    put_row(joint, mechanism, six.gamma_v, blocks->gamma_v);
    if (blocks->jtl_q) {
      baum_i_planar_pack_square(mechanism, &joint->span, six.jtl_q, blocks->jtl_q + joint->square);
    }
  }
  return BAUM_OK;
}

static void place(const baum_i_joint *joint, const baum_i_point *point, double at[2])
{
  const baum_i_joint *driven = driven_by(point->mechanism, joint->element.def);
  driven->type->place(driven, point, at);
}

static const baum_i_joint_type type = {
  .definition = {.kind = "driver",
                 .size = sizeof(baum_driver_def),
                 .defaults = &defaults,
                 .check = check,
                 .tied = tied},
  .parameter_count = PARAMETER_COUNT,
  .planar = true,
  .scleronomic = false,
  .drives = true,
  .rows = rows,
  .bodies = bodies,
  .lower = lower,
  .evaluate = evaluate,
  .linearize = linearize,
  .place = place,
};

BAUM_I_DEFINE(joint, driver, type)
