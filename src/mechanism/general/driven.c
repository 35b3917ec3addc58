/* SPDX-License-Identifier: BSD-3-Clause */
/* The row of a driver. It is the same for every prescribed motion s(t). */
#include "mechanism/general/driven.h"

#include <math.h>

#include "base/message.h"
#include "base/rotation.h"
#include "mechanism/general/columns.h"

const baum_i_coordinate_fields baum_i_driver_fields = {"joint", "coordinate", "to drive"};

static baum_i_joint_coordinate driven_by(const baum_i_joint *driver, const baum_i_point *point)
{
  return driver->type->driven(point->mechanism, driver->element.def);
}

/* ---- motion ---- */

void baum_i_driver_replace_law(double *parameters, double t0, const double s[3])
{
  parameters[BAUM_I_DRIVER_S] = s[0];
  parameters[BAUM_I_DRIVER_DS] = s[1];
  parameters[BAUM_I_DRIVER_DDS] = s[2];
  parameters[BAUM_I_DRIVER_T0] = t0;
  parameters[BAUM_I_DRIVER_POLYNOMIAL] = 1.0;
}

static void polynomial(const double *numbers, double t, double s[3])
{
  double tau = t - numbers[BAUM_I_DRIVER_T0];
  double ds = numbers[BAUM_I_DRIVER_DS];
  double dds = numbers[BAUM_I_DRIVER_DDS];
  s[0] = numbers[BAUM_I_DRIVER_S] + tau * (ds + 0.5 * tau * dds);
  s[1] = ds + tau * dds;
  s[2] = dds;
}

static baum_status motion_of(const baum_i_joint *joint, baum_i_point *point, double s[3])
{
  const double *numbers = point->parameters + joint->element.parameter;
  if (numbers[BAUM_I_DRIVER_POLYNOMIAL] == 0.0) {
    return joint->type->motion(joint, point, s);
  }
  polynomial(numbers, point->t, s);
  return BAUM_OK;
}

baum_status baum_i_check_motion(const baum_i_joint *driver, baum_i_point *point, const char *source,
                                const double s[3])
{
  static const char *const names[3] = {"value", "rate", "acceleration"};
  static const char *const per[3] = {"", "/s", "/s^2"};
  for (int i = 0; i < 3; i++) {
    if (!isfinite(s[i])) {
      point->retry = true;
      const baum_i_joint_coordinate driven = driven_by(driver, point);
      return baum_i_fail(BAUM_ERR_NOT_FINITE, "%s: %s gave %g for the %s [%s%s]",
                         baum_i_label(&driver->element).text, source, s[i], names[i],
                         baum_i_is_angle(&driven) ? "rad" : "m", per[i]);
    }
  }
  return BAUM_OK;
}

baum_status baum_i_expect_driven_angles(baum_i_point *point, double t)
{
  point->t = t;
  for (int i = 0; point->angles && i < point->mechanism->joint_count; i++) {
    const baum_i_joint *joint = point->mechanism->joints[i];
    if (!joint->type->driven) {
      continue;
    }
    const baum_i_joint_coordinate driven = driven_by(joint, point);
    if (baum_i_is_spatial_angle(&driven)) {
      double s[3];
      BAUM_I_TRY(motion_of(joint, point, s));
      baum_i_expect_angle(&driven, point, s[0]);
    }
  }
  return BAUM_OK;
}

/* ---- evaluation ---- */

/* Evaluates the coordinate and returns its difference from s. For an angle in space, the difference
 * does not count whole revolutions. Whole revolutions are removed from the angle and from s before
 * the subtraction, because the difference of two large angles would have a large rounding error. */
static double find_offset(const baum_i_joint_coordinate *driven, const baum_i_point *point,
                          double s, baum_i_coordinate *c)
{
  baum_i_coordinate_near_zero(driven, point, c);
  return baum_i_is_spatial_angle(driven)
           ? remainder(c->value - remainder(s, BAUM_I_REVOLUTION), BAUM_I_REVOLUTION)
           : c->value - s;
}

baum_status baum_i_driver_evaluate(const baum_i_joint *joint, baum_i_point *point,
                                   const baum_i_rows *out)
{
  double s[3] = {0.0};
  if (out->phi || out->nu || out->gamma) {
    BAUM_I_TRY(motion_of(joint, point, s));
  }
  const baum_i_joint_coordinate driven = driven_by(joint, point);
  baum_i_coordinate c;
  double offset = find_offset(&driven, point, s[0], &c);
  if (out->phi) {
    out->phi[joint->row] = offset;
  }
  if (out->jacobian) {
    baum_i_columns_pack_any(point->mechanism, &joint->span, driven.joint->type->width, 1,
                            c.gradient, out->jacobian + joint->jacobian);
  }
  if (out->nu) {
    out->nu[joint->row] = s[1];
  }
  if (out->gamma) {
    out->gamma[joint->row] = c.gamma + s[2];
  }
  return BAUM_OK;
}

baum_status baum_i_driver_linearize(const baum_i_joint *joint, baum_i_point *point, const double *w,
                                    const double *lambda, const baum_i_joint_blocks *blocks)
{
  const baum_i_joint_coordinate driven = driven_by(joint, point);
  const int width = driven.joint->type->width;
  double w_wide[BAUM_I_PAIR_COLUMNS];
  baum_i_columns_gather(point, &joint->span, width, w, w_wide);
  baum_i_coordinate_blocks c;
  baum_i_coordinate_linearize(&driven, point, w_wide, lambda ? lambda[joint->row] : 0.0, &c);
  const baum_i_joint_blocks wide = {c.jw_q, c.jtl_q, c.gamma_q, c.gamma_v, NULL};
  baum_i_columns_pack_blocks(point->mechanism, joint, width, &wide, blocks);
  return BAUM_OK;
}

void baum_i_driver_place(const baum_i_joint *joint, const baum_i_point *point, double at[3])
{
  const baum_i_joint *driven = driven_by(joint, point).joint;
  driven->type->place(driven, point, at);
}

/* This function is called only if the driven joint is spatial. */
void baum_i_driver_force_on_b(const baum_i_joint *joint, const baum_i_point *point,
                              const double *lambda, double six[BAUM_I_SPACE])
{
  const baum_i_joint_coordinate driven = driven_by(joint, point);
  baum_i_coordinate coordinate;
  baum_i_coordinate_at(&driven, point, &coordinate);
  for (int k = 0; k < BAUM_I_SPACE; k++) {
    six[k] -= lambda[0] * coordinate.gradient[BAUM_I_SPACE + k];
  }
}
