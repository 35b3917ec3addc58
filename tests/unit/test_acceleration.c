/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests accelerations and multipliers against a dense LU solution, and energy and reactions against
 * the laws of mechanics. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <gsl/gsl_linalg.h>
#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "models.h"
#include "runs.h"

enum { SIZE = 64 };

static double scatter(int k)
{
  double x = 0.6180339887498949 * (k + 1);
  return 2.0 * (x - floor(x)) - 1.0;
}

/* Builds the equations of motion as one dense linear system. The rows of the constraints are the
 * stabilized rows (7) of docs/theory/formulations.md. */
static void dense_system(baum_workspace *w, const double *q, const double *v, int nv, int nc,
                         double gain, double *matrix, double *right)
{
  double mass[SIZE * SIZE];
  double jacobian[SIZE * SIZE];
  double phi[SIZE];
  double nu[SIZE];
  int n = nv + nc;
  assert_int_equal(baum_workspace_mass(w, 0.2, q, mass), BAUM_OK);
  assert_int_equal(baum_workspace_jacobian(w, 0.2, q, jacobian), BAUM_OK);
  assert_int_equal(baum_workspace_phi(w, 0.2, q, phi), BAUM_OK);
  assert_int_equal(baum_workspace_nu(w, 0.2, q, nu), BAUM_OK);
  assert_int_equal(baum_workspace_force(w, 0.2, q, v, right), BAUM_OK);
  assert_int_equal(baum_workspace_gamma(w, 0.2, q, v, right + nv), BAUM_OK);
  memset(matrix, 0, (size_t)(n * n) * sizeof *matrix);
  for (int i = 0; i < nv; i++) {
    for (int j = 0; j < nv; j++) {
      matrix[i * n + j] = mass[i * nv + j];
    }
  }
  for (int i = 0; i < nc; i++) {
    double rate = -nu[i];
    for (int j = 0; j < nv; j++) {
      matrix[(nv + i) * n + j] = matrix[j * n + nv + i] = jacobian[i * nv + j];
      rate += jacobian[i * nv + j] * v[j];
    }
    right[nv + i] -= 2.0 * gain * rate + gain * gain * phi[i];
  }
}

static void check_against_lu(model *m, double gain)
{
  baum_workspace *w = NULL;
  int32_t nv = 0;
  int32_t nc = 0;
  double q[SIZE];
  double v[SIZE];
  double got[SIZE];
  static double matrix[SIZE * SIZE];
  double right[SIZE];
  double want[SIZE];
  int sign = 0;
  size_t order[SIZE];
  assert_int_equal(baum_workspace_create(m->mechanism, &w), BAUM_OK);
  assert_int_equal(baum_mechanism_sizes(m->mechanism, NULL, &nv, &nc), BAUM_OK);
  assert_true(nv + nc <= SIZE);
  assert_int_equal(baum_workspace_design(w, q, NULL), BAUM_OK);
  for (int i = 0; i < nv; i++) {
    q[i] += 0.02 * scatter(i);
    v[i] = scatter(i + 50);
  }
  assert_int_equal(baum_workspace_acceleration(w, 0.2, q, v, gain, gain, got, got + nv), BAUM_OK);
  dense_system(w, q, v, nv, nc, gain, matrix, right);
  size_t n = (size_t)(nv + nc);
  gsl_matrix_view a = gsl_matrix_view_array(matrix, n, n);
  gsl_vector_view b = gsl_vector_view_array(right, n);
  gsl_vector_view x = gsl_vector_view_array(want, n);
  gsl_permutation p = {n, order};
  assert_int_equal(gsl_linalg_LU_decomp(&a.matrix, &p, &sign), 0);
  assert_int_equal(gsl_linalg_LU_solve(&a.matrix, &p, &b.vector, &x.vector), 0);
  double largest = 0.0;
  for (size_t i = 0; i < n; i++) {
    largest = fmax(largest, fabs(want[i]));
  }
  for (size_t i = 0; i < n; i++) {
    ASSERT_NEAR(got[i], want[i], 1e-9, 1e-10 * largest); /* the condition number is at most 1e5 */
  }
  baum_workspace_destroy(w);
  model_destroy(m);
}

static void accelerations_and_multipliers_agree_with_a_dense_lu_solution(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &m), BAUM_OK);
  check_against_lu(&m, 0.0);
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = false}, &m), BAUM_OK);
  check_against_lu(&m, 20.0);
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  check_against_lu(&m, 5.0);
  assert_int_equal(model_andrews_bodies(&m), BAUM_OK);
  check_against_lu(&m, 5.0);
  assert_int_equal(model_andrews_angles(true, &m), BAUM_OK);
  check_against_lu(&m, 5.0);
}

/* ---- reactions and energy, by the laws of mechanics ---- */

static void a_pin_carries_the_weight_and_the_centripetal_force_of_a_rod(void **state)
{
  (void)state;
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id rod;
  baum_workspace *w = NULL;
  baum_mechanism *m = create_mechanism();
  def.mass = 2.0;
  def.inertia = 0.5;
  def.position[1] = -0.7;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &rod), BAUM_OK);
  baum_joint_id joint = add_planar_pin(m, NULL, BAUM_GROUND, rod, 0.0, 0.0);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  const double q[3] = {0.0, -0.7, 0.0};
  const double v[3] = {0.7 * 3.0, 0.0, 3.0}; /* swings through the lowest point at 3 rad/s */
  double lambda[2];
  double reaction[3];
  assert_int_equal(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, NULL, lambda), BAUM_OK);
  assert_int_equal(baum_workspace_reaction(w, 0.0, q, lambda, joint, reaction), BAUM_OK);
  ASSERT_NEAR(reaction[0], 0.0, 0.0, 1e-13);
  ASSERT_NEAR(reaction[1], 2.0 * 9.81 + 2.0 * 9.0 * 0.7, 1e-14, 0.0); /* m g + m w^2 r */
  ASSERT_NEAR(reaction[2], 0.0, 0.0, 1e-13);
  double kinetic = 0.0;
  double potential = 0.0;
  assert_int_equal(baum_workspace_energy(w, 0.0, q, v, &kinetic, &potential), BAUM_OK);
  ASSERT_NEAR(kinetic, 0.5 * 2.0 * 2.1 * 2.1 + 0.5 * 0.5 * 9.0, 1e-14, 0.0);
  ASSERT_NEAR(potential, -2.0 * 9.81 * 0.7, 1e-14, 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* Checks Newton's and Euler's equations for the rod of the slider-crank. Its weight and the
 * reactions of both its pins must produce its acceleration. */
static void reactions_on_the_rod_balance_inertia_and_weight(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = false}, &m), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-4;
  baum_simulation *s = create_run(m.mechanism, &o);
  assert_int_equal(baum_simulation_advance_to(s, 0.0123), BAUM_OK);
  const baum_channel channels[] = {
    baum_channel_of(BAUM_A),
    baum_channel_of(BAUM_Q),
    baum_channel_of_joint(BAUM_JOINT_REACTION, m.joints[MODEL_PIN_CRANK]),
    baum_channel_of_joint(BAUM_JOINT_REACTION, m.joints[MODEL_PIN_SLIDER]),
    baum_channel_of_point(BAUM_BODY_POSE, m.bodies[MODEL_ROD], -0.153, 0.0, 0.0),
    baum_channel_of_point(BAUM_BODY_POSE, m.bodies[MODEL_ROD], 0.153, 0.0, 0.0),
  };
  double row[9 + 9 + 3 + 3 + 3 + 3];
  assert_int_equal(baum_channels_width(m.mechanism, channels, 6), 30);
  assert_int_equal(baum_simulation_get(s, channels, 6, row), BAUM_OK);
  const double *a = row + 3; /* acceleration of the rod */
  const double *q = row + 9 + 3;
  const double *on_rod = row + 18;    /* pin with the crank: body_b is the rod */
  const double *on_slider = row + 21; /* pin with the slider: body_b is the slider */
  const double *near = row + 24;
  const double *far = row + 27;
  double size = fabs(on_rod[0]) + fabs(on_rod[1]);
  ASSERT_NEAR(on_rod[0] - on_slider[0], 0.038 * a[0], 0.0, 1e-12 * size);
  ASSERT_NEAR(on_rod[1] - on_slider[1] - 0.038 * 9.81, 0.038 * a[1], 0.0, 1e-12 * size);
  double moment = (near[0] - q[0]) * on_rod[1] - (near[1] - q[1]) * on_rod[0] + on_rod[2];
  moment -= (far[0] - q[0]) * on_slider[1] - (far[1] - q[1]) * on_slider[0] + on_slider[2];
  ASSERT_NEAR(moment, 5.9e-4 * a[2], 0.0, 1e-12 * size);
  ASSERT_NEAR(on_rod[2], 0.0, 0.0, 1e-12 * size); /* no moment about the pin */
  baum_simulation_destroy(s);
  model_destroy(&m);
}

static void joints_that_end_on_ground_give_the_reaction_on_ground(void **state)
{
  (void)state;
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_planar_fixed_def weld = baum_planar_fixed_def_default();
  baum_body_id beam;
  baum_joint_id joint;
  baum_workspace *w = NULL;
  baum_mechanism *m = create_mechanism();
  def.mass = 3.0;
  def.position[0] = 2.0;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &beam), BAUM_OK);
  weld.body_a = beam;
  weld.body_b = BAUM_GROUND;
  weld.point[0] = weld.point[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_fixed(m, &weld, &joint), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  const double q[3] = {2.0, 0.0, 0.0};
  const double v[3] = {0.0, 0.0, 0.0};
  double lambda[3];
  double reaction[3];
  assert_int_equal(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, NULL, lambda), BAUM_OK);
  assert_int_equal(baum_workspace_reaction(w, 0.0, q, lambda, joint, reaction), BAUM_OK);
  /* The ground carries the weight of the beam, and the moment of this weight about the weld. */
  ASSERT_NEAR(reaction[0], 0.0, 0.0, 1e-12);
  ASSERT_NEAR(reaction[1], -3.0 * 9.81, 1e-13, 0.0);
  ASSERT_NEAR(reaction[2], -3.0 * 9.81 * 2.0, 1e-13, 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static void stabilization_pulls_a_violated_pendulum_back(void **state)
{
  (void)state;
  model m;
  baum_workspace *w = NULL;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m.mechanism, &w), BAUM_OK);
  const double q[2] = {0.0, -1.1};
  const double v[2] = {0.0, -0.2};
  double a[2];
  assert_int_equal(baum_workspace_acceleration(w, 0.0, q, v, 10.0, 10.0, a, NULL), BAUM_OK);
  /* The particle is below the pin, at y = -r. Therefore Phi = (r^2 - 1) / 2 and Phi' = r r'. The
   * stabilized equation is Phi'' = r'^2 + r r'' = -2 alpha Phi' - beta^2 Phi. */
  double phi = 0.5 * (1.21 - 1.0);
  double rate = 1.1 * 0.2;
  ASSERT_NEAR(a[1], -(-20.0 * rate - 100.0 * phi - 0.04) / 1.1, 1e-13, 0.0);
  baum_workspace_destroy(w);
  model_destroy(&m);
}

static int mass_equal_to_q(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0];
  return 0;
}

static int force_of_six(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = 6.0;
  return 0;
}

/* The block solver needs the square root of the mass. If a mass is negative, the solver of the
 * whole system therefore replaces the block solver. No solver accepts a zero mass. */
static void a_negative_mass_is_left_to_the_solver_of_the_whole_system(void **state)
{
  (void)state;
  static const double design = 2.0;
  baum_workspace *w = NULL;
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 1;
  def.q = &design;
  def.mass = mass_equal_to_q;
  def.force = force_of_six;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_coordinates(m, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  static const double masses[] = {3.0, -3.0, 0.0, 1.5};
  for (int k = 0; k < 4; k++) {
    double q = masses[k];
    double v = 0.0;
    double a = 7.0;
    baum_status status = baum_workspace_acceleration(w, 0.0, &q, &v, 0.0, 0.0, &a, NULL);
    assert_int_equal(status, masses[k] == 0.0 ? BAUM_ERR_SINGULAR : BAUM_OK);
    ASSERT_NEAR(a, masses[k] == 0.0 ? 7.0 : 6.0 / masses[k], 1e-15, 0.0);
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(accelerations_and_multipliers_agree_with_a_dense_lu_solution),
    cmocka_unit_test(a_pin_carries_the_weight_and_the_centripetal_force_of_a_rod),
    cmocka_unit_test(reactions_on_the_rod_balance_inertia_and_weight),
    cmocka_unit_test(joints_that_end_on_ground_give_the_reaction_on_ground),
    cmocka_unit_test(stabilization_pulls_a_violated_pendulum_back),
    cmocka_unit_test(a_negative_mass_is_left_to_the_solver_of_the_whole_system),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
