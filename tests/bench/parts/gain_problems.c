/* SPDX-License-Identifier: BSD-3-Clause */
#include "gain_problems.h"

#include <math.h>
#include <stdlib.h>

#include "a01_pendulum_reference.h"
#include "catalog/data/andrews.h"
#include "catalog/data/car_axis.h"
#include "catalog/data/four_bar.h"
#include "catalog/data/slider_crank_eccentric.h"
#include "catalog/data/slider_crank_sundials.h"
#include "simulate/run.h"
#include "slider_crank_driven_reference.h"

/* ---- the list ---- */

static baum_status pendulum(model *out)
{
  return model_pendulum_rod(&MODEL_PENDULUM_A01, out);
}

static baum_status driven(model *out)
{
  return model_slider_crank_build((model_slider_crank){.driven = true}, out);
}

static baum_status undriven(model *out)
{
  return model_slider_crank_build((model_slider_crank){.driven = false}, out);
}

static baum_status car_axis(model *out)
{
  return model_car_axis(true, out);
}

/* The sample times are taken from tests/data, without the time of the start. */
static const struct {
  const char *name;
  baum_status (*build)(model *out);
  int samples;
  const double *t;
  int steps; /* number of steps of a reference from one sample to the next */
} PROBLEMS[] = {
  {"A01 pendulum", pendulum, A01_PENDULUM_SAMPLES - 1, A01_PENDULUM_T + 1, 4000},
  {"slider-crank, driven", driven, SLIDER_CRANK_DRIVEN_SAMPLES - 1, SLIDER_CRANK_DRIVEN_T + 1,
   4000},
  {"slider-crank, free", undriven, SLIDER_CRANK_ECCENTRIC_SAMPLES - 1, SLIDER_CRANK_ECCENTRIC_T + 1,
   4000},
  {"Andrews", model_andrews_bodies, ANDREWS_SAMPLES - 1, ANDREWS_T + 1, 4000},
  {"four-bar", model_four_bar, FOUR_BAR_SAMPLES - 1, FOUR_BAR_T + 1, 4000},
  {"car axis", car_axis, CAR_AXIS_SAMPLES - 1, CAR_AXIS_T + 1, 8000},
  {"SUNDIALS slider-crank", model_sundials_slider_crank, SUNDIALS_SLIDER_CRANK_SAMPLES - 1,
   SUNDIALS_SLIDER_CRANK_T + 1, 2000},
};

int gain_problem_count(void)
{
  return (int)(sizeof PROBLEMS / sizeof PROBLEMS[0]);
}

/* ---- references ---- */

double gain_problem_error(const gain_problem *problem, const double *rows, const double *expected)
{
  double error = 0.0;
  for (int k = 0; k < problem->samples * problem->nq; k++) {
    error = fmax(error, fabs(rows[k] - expected[k]) / problem->scale[k % problem->nq]);
  }
  return error;
}

static baum_status integrate(const gain_problem *problem, const gain_start *start, int steps,
                             double *rows)
{
  const baum_channel positions = baum_channel_of(BAUM_Q);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.step = (problem->t[1] - problem->t[0]) / steps;
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(problem->m.mechanism, &options, &run);
  if (status >= 0) {
    status = baum_simulation_set_state(run, start->t, start->q, start->v);
  }
  if (status >= 0) {
    status = baum_simulation_sample(run, problem->t, problem->samples, &positions, 1, rows, NULL);
  }
  baum_simulation_destroy(run);
  return status;
}

static baum_status refer(gain_problem *problem, const gain_start *start, int steps)
{
  size_t size = (size_t)problem->samples * (size_t)problem->nq;
  double *coarse = calloc(size, sizeof *coarse);
  baum_status status = coarse ? integrate(problem, start, steps, start->rows) : BAUM_ERR_MEMORY;
  if (status >= 0) {
    status = integrate(problem, start, steps / 2, coarse);
  }
  if (status >= 0) {
    problem->apart = fmax(problem->apart, gain_problem_error(problem, coarse, start->rows));
  }
  free(coarse);
  return status;
}

/* ---- starts ---- */

/* Returns a pseudo-random number in (-1, 1), by Knuth's generator. It is the same on all
 * machines. */
static double draw(uint64_t *seed)
{
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

static bool allocate(gain_problem *problem, gain_start *start)
{
  size_t nq = (size_t)problem->nq;
  start->q = calloc((size_t)problem->samples * nq + 2 * nq, sizeof(double));
  start->v = start->q ? start->q + nq : NULL;
  start->rows = start->q ? start->v + nq : NULL;
  return start->q != NULL;
}

/* Changes each coordinate by up to a hundredth of its scale, and the velocities accordingly. Delays
 * the start by up to a hundredth of the first sample time. Then projects the start onto the
 * constraints. */
static baum_status perturb(gain_problem *problem, int lot, int number, gain_start *start)
{
  static const double SIZE = 0.01;
  static const double GOLDEN = 0.6180339887498949;
  baum_simulation *run = problem->kept;
  double rate = run->problem.rate;
  uint64_t seed = 1 + (uint64_t)(lot * GAIN_STARTS + number);
  (void)draw(&seed);
  start->t = (number + 1 - fmod(lot * GOLDEN, 1.0)) * SIZE / GAIN_STARTS * problem->t[0];
  for (int i = 0; i < problem->nq; i++) {
    double scale = problem->scale[i];
    start->q[i] = run->workspace->mechanism->design_q[i] + SIZE * scale * draw(&seed);
    double v = baum_simulation_v(run)[i];
    start->v[i] = v + SIZE * scale * rate * draw(&seed);
  }
  return baum_i_project(run->workspace, start->t, start->q, start->v);
}

static baum_status keep_run(gain_problem *problem)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 1.0; /* this step is never taken */
  options.formulation = BAUM_FORMULATION_PROJECTION;
  baum_status status = baum_simulation_create(problem->m.mechanism, &options, &problem->kept);
  if (status >= 0) {
    problem->nq = problem->kept->workspace->mechanism->nq;
    problem->scale = problem->kept->workspace->mechanism->scale;
  }
  return status;
}

bool gain_problem_make(int k, int lot, gain_problem *out)
{
  *out =
    (gain_problem){.name = PROBLEMS[k].name, .samples = PROBLEMS[k].samples, .t = PROBLEMS[k].t};
  baum_status status = PROBLEMS[k].build(&out->m);
  if (status >= 0) {
    status = keep_run(out);
  }
  for (int s = 0; s < GAIN_STARTS && status >= 0; s++) {
    gain_start *start = &out->starts[s];
    status = allocate(out, start) ? perturb(out, lot, s, start) : BAUM_ERR_MEMORY;
    if (status >= 0) {
      status = refer(out, start, PROBLEMS[k].steps);
    }
  }
  if (status < 0) {
    gain_problem_clear(out);
  }
  return status >= 0;
}

void gain_problem_clear(gain_problem *problem)
{
  for (int s = 0; s < GAIN_STARTS; s++) {
    free(problem->starts[s].q);
  }
  baum_simulation_destroy(problem->kept);
  model_destroy(&problem->m);
  *problem = (gain_problem){0};
}
