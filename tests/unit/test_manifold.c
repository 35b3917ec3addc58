/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests positions on a manifold (nq > nv): the functions move(), rate() and difference(),
 * derivatives along the manifold, and the checks of definitions. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/golden.h"
#include "check.h"
#include "construct.h"
#include "dynamics/dynamics.h"
#include "every_element.h"
#include "manifold_bodies.h"
#include "manifold_scenes.h"
#include "runs.h"

/* Sizes of the largest tested mechanism, which has every kind of element. WIDE includes the
 * multipliers lambda and mu of GGL. */
enum { SIZE = EVERY_NQ, WIDE = EVERY_NQ + EVERY_NV + 2 * EVERY_NC };

/* ---- scenes and their states ---- */

typedef struct stage {
  baum_mechanism *mechanism;
  baum_workspace *w;
  double q[SIZE];
  double v[SIZE];
  double a[SIZE];
} stage;

static void open_stage(stage *s, baum_mechanism *mechanism)
{
  s->mechanism = mechanism;
  check(baum_workspace_create(s->mechanism, &s->w));
  check(baum_workspace_design(s->w, s->q, NULL));
  for (int i = 0; i < s->mechanism->nv; i++) {
    s->v[i] = 0.3 * baum_i_golden(i + 1);
    s->a[i] = baum_i_golden(i + 7);
  }
  /* After this displacement, the state violates the constraints. */
  check(baum_workspace_move(s->w, s->v, s->q));
  for (int i = 0; i < s->mechanism->nv; i++) {
    s->v[i] = 2.0 * baum_i_golden(i + 20);
  }
}

static void close_stage(stage *s)
{
  baum_workspace_destroy(s->w);
  baum_mechanism_destroy(s->mechanism);
}

static void for_each_scene(void (*test)(stage *s, const manifold_scene *scene))
{
  for (int k = 0; k < MANIFOLD_SCENES; k++) {
    stage s;
    open_stage(&s, manifold_scene_make(&manifold_scenes[k]));
    test(&s, &manifold_scenes[k]);
    close_stage(&s);
  }
}

/* Sets q to the configuration of the stage, displaced by h x. */
static void move_to(const stage *s, double h, const double *x, double *q)
{
  memcpy(q, s->q, (size_t)s->mechanism->nq * sizeof *q);
  baum_i_move(s->mechanism, h, x, q);
}

static void set_axis(const stage *s, int j, double *x)
{
  memset(x, 0, (size_t)s->mechanism->nv * sizeof *x);
  x[j] = 1.0;
}

/* ---- the functions ---- */

/* Checks N v by a central difference of the function move(). The central difference has an error of
 * 1e-8. Also checks that N^+ N v = v, and that the function difference() is the inverse of
 * move(). */
static void check_functions(stage *s, const manifold_scene *scene)
{
  static const double H = 1e-4;
  (void)scene;
  const baum_mechanism *m = s->mechanism;
  double rate[SIZE];
  double ahead[SIZE];
  double behind[SIZE];
  double back[SIZE];
  double room[4 * SIZE];
  check(baum_workspace_rate(s->w, s->q, s->v, rate));
  move_to(s, H, s->v, ahead);
  move_to(s, -H, s->v, behind);
  for (int i = 0; i < m->nq; i++) {
    ASSERT_NEAR((ahead[i] - behind[i]) / (2.0 * H), rate[i], 0.0, 1e-6);
  }
  const double *tangent = baum_i_tangent(m, s->q, rate, room);
  for (int i = 0; i < m->nv; i++) {
    ASSERT_NEAR(tangent[i], s->v[i], 0.0, 1e-8);
  }
  move_to(s, 0.3, s->v, ahead);
  check(baum_workspace_difference(s->w, s->q, ahead, back));
  for (int i = 0; i < m->nv; i++) {
    ASSERT_NEAR(back[i], 0.3 * s->v[i], 0.0, 1e-14);
  }
}

/* Checks q'' by a central difference of q' along a motion with the velocity v + h a. */
static void check_second_rates(stage *s, const manifold_scene *scene)
{
  static const double H = 1e-4;
  (void)scene;
  const baum_mechanism *m = s->mechanism;
  double side[2][SIZE];
  double room[4 * SIZE];
  for (int k = 0; k < 2; k++) {
    double h = k == 0 ? -H : H;
    double mean[SIZE];
    double q[SIZE];
    for (int i = 0; i < m->nv; i++) {
      mean[i] = s->v[i] + 0.5 * h * s->a[i];
    }
    move_to(s, h, mean, q);
    for (int i = 0; i < m->nv; i++) {
      mean[i] = s->v[i] + h * s->a[i];
    }
    baum_i_rate(m, q, mean, side[k]);
  }
  const double *got = baum_i_second_rates(m, s->q, s->v, s->a, room);
  for (int i = 0; i < m->nq; i++) {
    ASSERT_NEAR(got[i], (side[1][i] - side[0][i]) / (2.0 * H), 0.0, 1e-6);
  }
}

static void functions_agree_with_each_other(void **state)
{
  (void)state;
  for_each_scene(check_functions);
  for_each_scene(check_second_rates);
}

static void columns_of_positions_and_velocities_may_differ(void **state)
{
  (void)state;
  int32_t q = 0;
  int32_t v = 0;
  baum_mechanism *m = manifold_scene_make(manifold_scene_find("mixed double pendulum"));
  check(baum_mechanism_columns(m, baum_mechanism_body_at(m, 1), &q, &v));
  assert_int_equal(q, 4);
  assert_int_equal(v, 3);
  int32_t nq = 0;
  int32_t nv = 0;
  check(baum_mechanism_sizes(m, &nq, &nv, NULL));
  assert_int_equal(nq, 7);
  assert_int_equal(nv, 6);
  assert_false(m->flat);
  baum_mechanism_destroy(m);
}

/* ---- assembly ---- */

/* Assembly must minimize the displacements (nv), not the changes of q (nq). The twin is the same
 * mechanism with nq = nv. Its assembly must give the same configuration. */
static void assembly_moves_along_the_manifold(void **state)
{
  (void)state;
  const manifold_scene *scene = manifold_scene_find("slider-crank");
  baum_mechanism *m = manifold_scene_make(scene);
  baum_mechanism *twin = manifold_scene_make_twin(scene);
  baum_workspace *w[2] = {NULL, NULL};
  double q[2][SIZE];
  double v[2][SIZE];
  double dx[SIZE];
  check(baum_workspace_create(m, &w[0]));
  check(baum_workspace_create(twin, &w[1]));
  for (int k = 0; k < 2; k++) {
    check(baum_workspace_design(w[k], q[k], v[k]));
    for (int i = 0; i < 9; i++) {
      dx[i] = 0.1 * baum_i_golden(i + 1);
    }
    check(baum_workspace_move(w[k], dx, q[k]));
    check(baum_workspace_assemble(w[k], 0.0, q[k], v[k], NULL, 0));
  }
  double want[SIZE];
  scene->translate(q[1], want);
  for (int i = 0; i < 12; i++) {
    ASSERT_NEAR(q[0][i], want[i], 0.0, 1e-9); /* tolerance of Newton's iteration */
  }
  for (int k = 0; k < 2; k++) {
    baum_workspace_destroy(w[k]);
  }
  baum_mechanism_destroy(m);
  baum_mechanism_destroy(twin);
}

/* ---- derivatives of constraints ---- */

/* Computes the dense J (nc x nv). */
static void jacobian_at(const stage *s, const double *q, double *out)
{
  check(baum_workspace_jacobian(s->w, 0.0, q, out));
}

/* Checks (J x)_q and (J^T lambda)_q by central differences of J along the manifold. These
 * differences have errors of 1e-8. On a manifold, (J^T lambda)_q need not be symmetric. */
static void check_second_derivatives(stage *s, const manifold_scene *scene)
{
  static const double H = 1e-4;
  const baum_mechanism *m = s->mechanism;
  double lambda[SIZE];
  double ahead[SIZE * SIZE];
  double behind[SIZE * SIZE];
  double asymmetry = 0.0;
  for (int i = 0; i < m->nc; i++) {
    lambda[i] = baum_i_golden(i + 3);
  }
  baum_i_point_set(&s->w->point, 0.0, s->q, s->v);
  const baum_i_joint_blocks blocks = {.jw_q = s->w->jw_q, .jtl_q = s->w->jtl_q};
  check(baum_i_mechanism_linearize_joints(&s->w->point, s->v, lambda, &blocks));
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    const baum_i_span *span = &joint->span;
    for (int j = 0; j < span->nl; j++) {
      double axis[SIZE];
      double q[SIZE];
      set_axis(s, span->columns[j], axis);
      move_to(s, H, axis, q);
      jacobian_at(s, q, ahead);
      move_to(s, -H, axis, q);
      jacobian_at(s, q, behind);
      for (int r = 0; r < joint->rows; r++) {
        double want = 0.0;
        for (int i = 0; i < m->nv; i++) {
          int at = (joint->row + r) * m->nv + i;
          want += (ahead[at] - behind[at]) / (2.0 * H) * s->v[i];
        }
        ASSERT_NEAR(s->w->jw_q[joint->jacobian + r * span->nl + j], want, 0.0, 1e-6);
      }
      for (int i = 0; i < span->nl; i++) {
        double want = 0.0;
        for (int r = joint->row; r < joint->row + joint->rows; r++) {
          int at = r * m->nv + span->columns[i];
          want += (ahead[at] - behind[at]) / (2.0 * H) * lambda[r];
        }
        double got = s->w->jtl_q[joint->square + i * span->nl + j];
        ASSERT_NEAR(got, want, 0.0, 1e-6);
        asymmetry = fmax(asymmetry, fabs(got - s->w->jtl_q[joint->square + j * span->nl + i]));
      }
    }
  }
  bool turns = scene->units.length == 4 && m->nc > 0;
  assert_true(turns ? asymmetry > 0.01 : asymmetry < 1e-6);
}

static void second_derivatives_agree_with_differences_along_the_manifold(void **state)
{
  (void)state;
  for_each_scene(check_second_derivatives);
}

/* ---- the Jacobian of residuals ---- */

static double scatter(int k)
{
  return 0.5 * baum_i_golden(k);
}

static void check_residual_form(const stage *s, baum_residual index)
{
  static double got[WIDE * WIDE];
  static const double C = 7.0;
  static const double H = 1e-5;
  const baum_dae dae = {.index = index, .alpha = 3.0, .beta = 5.0};
  int n = baum_i_residual_size(s->mechanism, index);
  double y[WIDE];
  double dy[WIDE];
  assert_true(n <= WIDE);
  for (int i = 0; i < n; i++) {
    y[i] = i < s->mechanism->nq ? s->q[i] : scatter(i + 1);
    dy[i] = scatter(i + 50);
  }
  baum_sparse sparse = {.columns = NULL};
  check(baum_workspace_residual_jacobian(s->w, &dae, C, 0.0, y, dy, &sparse));
  sparse.columns = malloc(((size_t)n + 1) * sizeof *sparse.columns);
  sparse.rows = malloc((size_t)sparse.nonzeros * sizeof *sparse.rows);
  sparse.values = malloc((size_t)sparse.nonzeros * sizeof *sparse.values);
  check(baum_workspace_residual_jacobian(s->w, &dae, C, 0.0, y, dy, &sparse));
  memset(got, 0, sizeof got);
  for (int j = 0; j < n; j++) {
    for (int32_t k = sparse.columns[j]; k < sparse.columns[j + 1]; k++) {
      got[sparse.rows[k] * n + j] = sparse.values[k];
    }
  }
  for (int j = 0; j < n; j++) {
    double side[2][WIDE];
    double y_j = y[j];
    double dy_j = dy[j];
    for (int k = 0; k < 2; k++) {
      double h = k == 0 ? -H : H;
      y[j] = y_j + h;
      dy[j] = dy_j + C * h;
      check(baum_workspace_residual(s->w, &dae, 0.0, y, dy, side[k]));
    }
    y[j] = y_j;
    dy[j] = dy_j;
    for (int i = 0; i < n; i++) {
      ASSERT_NEAR(got[i * n + j], (side[1][i] - side[0][i]) / (2.0 * H), 1e-6, 1e-5);
    }
  }
  free(sparse.columns);
  free(sparse.rows);
  free(sparse.values);
}

static void check_residual_forms(const stage *s)
{
  for (int index = BAUM_RESIDUAL_INDEX1; index <= BAUM_RESIDUAL_GGL; index++) {
    check_residual_form(s, (baum_residual)index);
  }
}

static void check_residuals(stage *s, const manifold_scene *scene)
{
  (void)scene;
  check_residual_forms(s);
}

static void jacobians_of_residuals_agree_with_differences(void **state)
{
  (void)state;
  stage s;
  for_each_scene(check_residuals);
  open_stage(&s, every_element_make(NULL).mechanism);
  check_residual_forms(&s);
  close_stage(&s);
}

/* ---- definitions ---- */

/* Makes a valid definition of a body whose position is one angle, stored as (cos, sin). Tests
 * replace single fields of the definition. */
static void set_angle_definition(baum_coordinates_def *def)
{
  static manifold_body body = {.mass = 1.0, .inertia = {1.0}};
  baum_body_id id;
  baum_mechanism *m = create_mechanism();
  id = manifold_add_angle(m, &body, 0.2, NULL);
  check(baum_mechanism_get_coordinates(m, id, def, sizeof *def));
  static const double q[2] = {0.6, 0.8};
  def->name = NULL;
  def->q = q;
  def->v = NULL;
  baum_mechanism_destroy(m);
}

static void expect_refused(const baum_coordinates_def *def, const char *message)
{
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_coordinates(m, def, NULL), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), message));
  baum_mechanism_destroy(m);
}

static void definitions_must_be_complete(void **state)
{
  (void)state;
  baum_coordinates_def def;
  const double off[2] = {0.6, 0.80001};
  const double bad_scale[2] = {1.0, 0.0};
  set_angle_definition(&def);
  def.move = NULL;
  expect_refused(&def, "move() is NULL, must be given");
  set_angle_definition(&def);
  def.difference = NULL;
  expect_refused(&def, "difference() is NULL, must be given");
  set_angle_definition(&def);
  def.q = NULL;
  expect_refused(&def, "q is NULL, must be given");
  set_angle_definition(&def);
  def.rate = NULL;
  expect_refused(&def, "move() is given, but rate() is NULL");
  def.move = NULL;
  expect_refused(&def, "difference() is given, but rate() is NULL");
  def.difference = NULL;
  expect_refused(&def, "normalize() is given, but rate() is NULL");
  def.normalize = NULL;
  expect_refused(&def, "position_count is given, but rate() is NULL");
  set_angle_definition(&def);
  def.q = off;
  expect_refused(&def, "normalize() changes q by more than 1e-6");
  set_angle_definition(&def);
  def.position_count = -2;
  expect_refused(&def, "position_count is -2");
  set_angle_definition(&def);
  def.size = 3;
  expect_refused(&def, "position_count is 2, must be at least size (3)");
  set_angle_definition(&def);
  def.position_scale = bad_scale;
  expect_refused(&def, "position_scale[1] is 0");
}

static void a_new_definition_cannot_change_the_manifold(void **state)
{
  (void)state;
  baum_coordinates_def def;
  baum_body_id id;
  set_angle_definition(&def);
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_coordinates(m, &def, &id));
  check(baum_mechanism_set_coordinates(m, id, &def));
  const double long_q[3] = {0.6, 0.8, 0.0};
  def.position_count = 3;
  def.q = long_q;
  def.normalize = NULL;
  assert_int_equal(baum_mechanism_set_coordinates(m, id, &def), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "its position_count cannot change"));
  baum_mechanism_destroy(m);
}

/* ---- functions that do not agree with each other ---- */

static void wrong_rate(const double *q, const double *v, double *dq, void *user)
{
  (void)user;
  dq[0] = q[1] * v[0];
  dq[1] = q[0] * v[0];
}

/* A wrong move(). It changes the angle by h v + (h v)^2 / 2, which is correct only to first
 * order. */
static void wrong_move(double h, const double *v, double *q, void *user)
{
  (void)user;
  double angle = atan2(q[1], q[0]) + h * v[0] + 0.5 * h * v[0] * h * v[0];
  q[0] = cos(angle);
  q[1] = sin(angle);
}

static void wrong_difference(const double *from, const double *to, double *dx, void *user)
{
  (void)user;
  dx[0] = hypot(to[0] - from[0], to[1] - from[1]); /* the chord, not the signed angle */
}

/* A wrong normalize(). It makes the cosine positive. If the cosine was negative, the angle changes
 * by pi. */
static void wrong_normalize(double *q, void *user)
{
  (void)user;
  double length = copysign(hypot(q[0], q[1]), q[0]);
  q[0] /= length;
  q[1] /= length;
}

static void expect_found(const baum_coordinates_def *def, const char *message)
{
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_coordinates(m, def, NULL));
  check(baum_mechanism_freeze(m));
  assert_int_equal(baum_mechanism_check_derivatives(m), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), message));
  baum_mechanism_destroy(m);
}

static void functions_that_do_not_agree_are_found(void **state)
{
  (void)state;
  baum_coordinates_def def;
  set_angle_definition(&def);
  def.rate = wrong_rate;
  expect_found(&def, "rate()[0] is");
  set_angle_definition(&def);
  def.move = wrong_move;
  expect_found(&def, "rate along move()[");
  set_angle_definition(&def);
  def.difference = wrong_difference;
  expect_found(&def, "difference()[0] is");
  set_angle_definition(&def);
  def.normalize = wrong_normalize;
  expect_found(&def, "normalize()[1] is");
}

/* ---- states that the user sets ---- */

static void states_off_the_manifold_are_refused(void **state)
{
  (void)state;
  static manifold_body body = {.mass = 1.0, .inertia = {1.0}};
  baum_mechanism *m = create_mechanism();
  (void)manifold_add_angle(m, &body, 0.2, NULL);
  check(baum_mechanism_freeze(m));
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 1e-3;
  baum_simulation *run = create_run(m, &options);
  const double far[2] = {0.0, 1.1};
  const double near[2] = {0.0, 1.0 + 1e-9};
  const double v[1] = {0.5};
  assert_int_equal(baum_simulation_set_state(run, 0.0, far, v), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "q[1] is 1.1, but 1 after normalizing q"));
  check(baum_simulation_set_state(run, 0.0, near, v));
  assert_true(baum_simulation_q(run)[1] == 1.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(functions_agree_with_each_other),
    cmocka_unit_test(columns_of_positions_and_velocities_may_differ),
    cmocka_unit_test(assembly_moves_along_the_manifold),
    cmocka_unit_test(second_derivatives_agree_with_differences_along_the_manifold),
    cmocka_unit_test(jacobians_of_residuals_agree_with_differences),
    cmocka_unit_test(definitions_must_be_complete),
    cmocka_unit_test(a_new_definition_cannot_change_the_manifold),
    cmocka_unit_test(functions_that_do_not_agree_are_found),
    cmocka_unit_test(states_off_the_manifold_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
