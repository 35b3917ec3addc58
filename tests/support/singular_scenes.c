/* SPDX-License-Identifier: BSD-3-Clause */
#include "singular_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "methods.h"

static const double GRAVITY = 9.81;

static void must(baum_status status)
{
  if (status < BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", baum_status_name(status), baum_message());
    exit(EXIT_FAILURE);
  }
}

/* ---- the angle ---- */

typedef struct swing {
  double i0;
  double i1;
  double k;
} swing;

static double angular_acceleration(const swing *s, double angle, double rate)
{
  double sine = sin(angle);
  double cosine = cos(angle);
  return -(s->i1 * sine * cosine * rate * rate + s->k * cosine) / (s->i0 + s->i1 * sine * sine);
}

/* Takes one step of the classical Runge-Kutta method. */
static void swing_on(const swing *s, double h, double y[2])
{
  static const double c[4] = {0.0, 0.5, 0.5, 1.0};
  static const double b[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  double k[2] = {0.0, 0.0};
  double sum[2] = {0.0, 0.0};
  for (int i = 0; i < 4; i++) {
    double angle = y[0] + c[i] * h * k[0];
    double rate = y[1] + c[i] * h * k[1];
    k[0] = rate;
    k[1] = angular_acceleration(s, angle, rate);
    sum[0] += b[i] * k[0];
    sum[1] += b[i] * k[1];
  }
  y[0] += h * sum[0];
  y[1] += h * sum[1];
}

/* Computes the angle th at all samples. 4000 steps between two samples give errors of about 1e-13
 * rad. */
static void know(singular_scene *scene, const swing *s, double angle, double rate)
{
  enum { STEPS = 4000 };
  double y[2] = {angle, rate};
  double h = scene->end / SINGULAR_SAMPLES / STEPS;
  scene->want[0] = angle;
  for (int k = 1; k <= SINGULAR_SAMPLES; k++) {
    for (int i = 0; i < STEPS; i++) {
      swing_on(s, h, y);
    }
    scene->want[k] = y[0];
  }
}

static void follow(singular_scene *scene, int index, double sign)
{
  scene->angle[scene->count] = index;
  scene->sign[scene->count] = sign;
  scene->count++;
}

/* ---- scenes ---- */

static void n_four_bar(singular_scene *scene, int loops, double off, double faster)
{
  model_n_four_bar data = model_n_four_bar_a02(loops);
  double n = loops;
  data.angle += off;
  data.rate += faster;
  must(model_n_four_bar_build(&data, &scene->m));
  for (int k = 0; k <= loops; k++) {
    follow(scene, 6 * k + 2, 1.0);
  }
  swing s = {(n + 1.0) / 3.0 + n, 0.0, ((n + 1.0) / 2.0 + n) * GRAVITY};
  know(scene, &s, data.angle, data.rate);
}

static void parallelogram(singular_scene *scene, model_parallelogram which, double off)
{
  double cranks = which == MODEL_TWO_CRANKS ? 2.0 : 3.0;
  must(model_parallelogram_build(which, 1.0 + off, &scene->m));
  follow(scene, 2, 1.0);
  follow(scene, 5, 1.0);
  if (which != MODEL_TWO_CRANKS) {
    follow(scene, 11, 1.0);
  }
  swing s = {cranks / 3.0 + 2.0, 0.0, (cranks / 2.0 + 2.0) * GRAVITY};
  know(scene, &s, 1.0 + off, 2.0);
}

/* The angle of the crank is th, and the angle of the rod is -th. The data are taken from
 * tests/models/slider_crank.c. */
static void slider_crank(singular_scene *scene, double off)
{
  static const double L = 0.153;
  static const double MASS = 0.038;   /* [kg] of the crank, and also of the rod */
  static const double SLIDER = 0.076; /* kg */
  model_slider_crank data = {.centric = true, .rod = L, .angle = off, .moving = true};
  must(model_slider_crank_build(data, &scene->m));
  double crank = 7.4e-5 + MASS * L * L / 4.0;
  double rod = 5.9e-4 * 0.25 + MASS * L * L / 4.0;
  swing s = {crank + rod, (2.0 * MASS + 4.0 * SLIDER) * L * L, MASS * L * GRAVITY};
  scene->unit = 1.0 / 30.0;
  scene->end /= 30.0;
  follow(scene, 2, 1.0);
  follow(scene, 5, -1.0);
  know(scene, &s, off, 150.0);
}

/* Makes two cranks of 1 m, whose feet are at (0, 0) and (2, 0). The length of the coupler, 2.0001
 * m, determines the angle of the second crank. */
static void near_parallelogram(singular_scene *scene, double off)
{
  static const double COUPLER = 2.0001;
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_parts_gravity(&parts, GRAVITY);
  double first = 1.0 + off;
  double second = first;
  for (int k = 0; k < 50; k++) { /* Newton's method until the distance of the tips is COUPLER */
    double x = 2.0 + cos(second) - cos(first);
    double y = sin(second) - sin(first);
    second -= (x * x + y * y - COUPLER * COUPLER) / (2.0 * (y * cos(second) - x * sin(second)));
  }
  double angles[2] = {first, second};
  baum_body_id crank[2];
  for (int k = 0; k < 2; k++) {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.mass = 1.0;
    def.inertia = 1.0 / 12.0;
    def.position[0] = 2.0 * k + cos(angles[k]) / 2.0;
    def.position[1] = sin(angles[k]) / 2.0;
    def.angle = angles[k];
    if (k == 0) {
      def.angular_velocity = 2.0;
      def.velocity[0] = -sin(first);
      def.velocity[1] = cos(first);
    }
    crank[k] = baum_i_parts_body(&parts, &def);
    baum_i_parts_pin(&parts, NULL, (baum_i_spot){BAUM_GROUND, {2.0 * k, 0.0}},
                     (baum_i_spot){crank[k], {-0.5, 0.0}});
  }
  double x = 2.0 + cos(second) - cos(first);
  double y = sin(second) - sin(first);
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = 2.0;
  def.inertia = 2.0 / 3.0;
  def.position[0] = 1.0 + (cos(first) + cos(second)) / 2.0;
  def.position[1] = (sin(first) + sin(second)) / 2.0;
  def.angle = atan2(y, x);
  baum_body_id coupler = baum_i_parts_body(&parts, &def);
  baum_i_parts_pin(&parts, NULL, (baum_i_spot){crank[0], {0.5, 0.0}},
                   (baum_i_spot){coupler, {-COUPLER / 2.0, 0.0}});
  baum_i_parts_pin(&parts, NULL, (baum_i_spot){crank[1], {0.5, 0.0}},
                   (baum_i_spot){coupler, {COUPLER / 2.0, 0.0}});
  must(model_finish(&parts, NULL, &scene->m));
}

/* Computes the reference by rk4 with projection and steps of 2e-5 s. Near the singularity, the
 * second crank reverses while the first one rotates by a hundredth of a radian. This takes hundreds
 * of steps. If the step is halved, the final angles change by less than 1e-7 rad. */
static void compute_reference(singular_scene *scene)
{
  int nq = 3 * scene->m.body_count;
  baum_simulation_options options = baum_simulation_options_default();
  baum_simulation *run = NULL;
  options.integrator = baum_rk4();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.step = 2e-5;
  scene->reference = calloc((size_t)(SINGULAR_SAMPLES + 1) * (size_t)nq, sizeof(double));
  must(scene->reference ? BAUM_OK : BAUM_ERR_MEMORY);
  must(baum_simulation_create(scene->m.mechanism, &options, &run));
  for (int k = 0; k <= SINGULAR_SAMPLES; k++) {
    must(baum_simulation_advance_to(run, scene->end * k / SINGULAR_SAMPLES));
    for (int i = 0; i < nq; i++) {
      scene->reference[k * nq + i] = baum_simulation_q(run)[i];
    }
  }
  baum_simulation_destroy(run);
}

singular_scene singular_open(singular_kind kind, int loops, uint64_t *seed)
{
  singular_scene scene = {.end = 10.0, .unit = 1.0};
  double off = uniform(seed, -0.1, 0.1);
  double faster = uniform(seed, -0.1, 0.1);
  switch (kind) {
  case SINGULAR_N_FOUR_BAR: n_four_bar(&scene, loops, off, faster); break;
  case SINGULAR_PARALLELOGRAM: parallelogram(&scene, MODEL_TWO_CRANKS, off); break;
  case SINGULAR_THREE_CRANKS: parallelogram(&scene, MODEL_THREE_CRANKS, off); break;
  case SINGULAR_SLIDER_CRANK: slider_crank(&scene, off); break;
  case SINGULAR_NEAR_PARALLELOGRAM:
    scene.end = 4.0;
    near_parallelogram(&scene, off);
    compute_reference(&scene);
    break;
  case SINGULAR_KINDS:
  default: break;
  }
  return scene;
}

void singular_close(singular_scene *scene)
{
  model_destroy(&scene->m);
  free(scene->reference);
  scene->reference = NULL;
}

/* ---- runs ---- */

static double larger(double a, double b)
{
  return isnan(b) || b > a ? b : a;
}

static double error_at(const singular_scene *scene, int k, const double *q)
{
  double error = 0.0;
  for (int i = 0; i < scene->count; i++) {
    error = larger(error, fabs(q[scene->angle[i]] - scene->sign[i] * scene->want[k]));
  }
  int nq = scene->reference ? 3 * scene->m.body_count : 0;
  for (int i = 0; i < nq; i++) {
    error = larger(error, fabs(q[i] - scene->reference[k * nq + i]));
  }
  return error;
}

singular_result singular_run(const singular_scene *scene, const singular_setting *setting)
{
  singular_result out = {0};
  baum_simulation *run = NULL;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = setting->integrator();
  options.formulation = setting->formulation;
  if (setting->step > 0.0) {
    options.step = setting->step * scene->unit;
  } else {
    options.rtol = setting->rtol;
  }
  if (setting->formulation == BAUM_FORMULATION_BAUMGARTE) {
    options.gains = baum_gains_fixed(setting->alpha / scene->unit, setting->alpha / scene->unit);
  }
  options.max_steps = 2000;
  out.status = baum_simulation_create(scene->m.mechanism, &options, &run);
  must(out.status);
  for (int k = 1; k <= SINGULAR_SAMPLES && out.status >= BAUM_OK; k++) {
    out.status = baum_simulation_advance_to(run, scene->end * k / SINGULAR_SAMPLES);
    if (out.status >= BAUM_OK) {
      out.error = larger(out.error, error_at(scene, k, baum_simulation_q(run)));
    }
  }
  baum_counters c;
  must(baum_simulation_counters(run, &c, sizeof c));
  out.intervals = c.near_singular_intervals;
  out.branch_warnings = c.branch_warnings;
  out.warnings = c.warnings;
  out.doubts = c.doubts;
  out.forced = c.forced_steps;
  baum_simulation_destroy(run);
  return out;
}

#define RK4(text, h)                                                                    \
  {                                                                                     \
    .name = (text), .integrator = baum_rk4, .formulation = BAUM_FORMULATION_PROJECTION, \
    .step = (h)                                                                         \
  }
#define RK8(text, tolerance)                                                            \
  {                                                                                     \
    .name = (text), .integrator = baum_rk8, .formulation = BAUM_FORMULATION_PROJECTION, \
    .rtol = (tolerance)                                                                 \
  }
#define BDF(text, tolerance)                                                                  \
  {                                                                                           \
    .name = (text), .integrator = baum_cvode_bdf, .formulation = BAUM_FORMULATION_PROJECTION, \
    .rtol = (tolerance)                                                                       \
  }
#define GAINS(text, method, gain)                                                      \
  {                                                                                    \
    .name = (text), .integrator = (method), .formulation = BAUM_FORMULATION_BAUMGARTE, \
    .rtol = 1e-7, .alpha = (gain)                                                      \
  }

const singular_setting SINGULAR_SETTINGS[] = {
  RK4("rk4 h = 2e-3, projection", 2e-3),
  RK4("rk4 h = 5e-3, projection", 5e-3),
  RK4("rk4 h = 1e-2, projection", 1e-2),
  RK8("rk8 rtol = 1e-5, projection", 1e-5),
  RK8("rk8 rtol = 1e-6, projection", 1e-6),
  RK8("rk8 rtol = 1e-7, projection", 1e-7),
  RK8("rk8 rtol = 1e-8, projection", 1e-8),
  RK8("rk8 rtol = 1e-9, projection", 1e-9),
  RK8("rk8 rtol = 1e-11, projection", 1e-11),
  GAINS("rk8, alpha = 0", baum_rk8, 0.0),
  GAINS("rk8, alpha = 1", baum_rk8, 1.0),
  GAINS("rk8, alpha = 10", baum_rk8, 10.0),
  GAINS("rk8, alpha = 100", baum_rk8, 100.0),
  GAINS("cvode-adams, alpha = 0", baum_cvode_adams, 0.0),
  GAINS("cvode-adams, alpha = 1", baum_cvode_adams, 1.0),
  GAINS("cvode-adams, alpha = 10", baum_cvode_adams, 10.0),
  GAINS("cvode-adams, alpha = 100", baum_cvode_adams, 100.0),
  BDF("cvode-bdf rtol = 1e-7, proj.", 1e-7),
  BDF("cvode-bdf rtol = 1e-9, proj.", 1e-9),
  {.name = NULL},
};
