/* SPDX-License-Identifier: BSD-3-Clause */
#include "user_check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"

/* Freezes the mechanism, checks its derivatives and destroys it. */
baum_status user_check(baum_mechanism *mechanism)
{
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_status status = baum_mechanism_check_derivatives(mechanism);
  baum_mechanism_destroy(mechanism);
  return status;
}

void user_check_right(baum_mechanism *mechanism)
{
  check(user_check(mechanism));
}

void user_check_wrong(baum_mechanism *mechanism, const char *message)
{
  assert_int_equal(user_check(mechanism), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), message);
}

void user_check_wrong_entry(baum_mechanism *mechanism, const char *what, int entry)
{
  char start[64];
  char end[64];
  (void)snprintf(start, sizeof start, "%s()[%d] is ", what, entry);
  (void)snprintf(end, sizeof end, " but finite differences of %s give ", strrchr(what, ' ') + 1);
  assert_int_equal(user_check(mechanism), BAUM_ERR_ARGUMENT);
  if (!strstr(baum_message(), start) || !strstr(baum_message(), end)) {
    fail_msg("%s", baum_message());
  }
}

void user_check_fails(test_point *p, baum_status status, bool retry, const char *message)
{
  double rows[TEST_SIZE_MAX * TEST_SIZE_MAX];
  const double lambda[TEST_SIZE_MAX] = {1.0};
  baum_i_joint_blocks blocks = {.jw_q = rows};
  baum_status (*const functions[])(baum_i_point *, double *) = {
    baum_i_mechanism_phi, baum_i_mechanism_jacobian, baum_i_mechanism_gamma};
  for (int i = 0; i <= 3; i++) {
    test_point_update(p);
    assert_int_equal(i < 3 ? functions[i](&p->point, rows)
                           : baum_i_mechanism_linearize_joints(&p->point, p->v, lambda, &blocks),
                     status);
    assert_string_equal(baum_message(), message);
    assert_int_equal(p->point.retry, retry);
  }
}

baum_mechanism *user_make_constraint(baum_q_fn *phi, baum_q_fn *jacobian, baum_q_fn *nu,
                                     baum_qv_fn *gamma, double scale)
{
  const double q[2] = {0.6, -0.8};
  baum_mechanism *mechanism = create_mechanism();
  const baum_body_id body = user_add_coordinates(mechanism, 2, q, scale);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "circle";
  def.bodies = &body;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = phi;
  def.jacobian = jacobian;
  def.nu = nu;
  def.gamma = gamma;
  assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &def, NULL), BAUM_OK);
  return mechanism;
}

baum_mechanism *user_make_force(baum_force_fn *force, baum_force_fn *force_q,
                                baum_force_fn *force_v, void *user)
{
  const double q[2] = {0.0, 0.0};
  baum_mechanism *mechanism = create_mechanism();
  const baum_body_id body = user_add_coordinates(mechanism, 2, q, 1.0);
  baum_user_force_def def = baum_user_force_def_default();
  def.name = "spring";
  def.bodies = &body;
  def.body_count = 1;
  def.force = force;
  def.force_q = force_q;
  def.force_v = force_v;
  def.user = user;
  assert_int_equal(baum_mechanism_add_user_force(mechanism, &def, NULL), BAUM_OK);
  return mechanism;
}
