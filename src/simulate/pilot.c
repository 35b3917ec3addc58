/* SPDX-License-Identifier: BSD-3-Clause */
/* A pilot is a short run that finds the mean rate of a motion over its first radians. If |v| / L
 * and |a| / L denote the sizes of the velocities and accelerations relative to the scales, and h
 * the length of a step,
 *
 *   rate w = max(|v| / L, sqrt(|a| / L)),   h = 0.75 / w,   mean rate = sum w h / sum h
 *
 * The pilot takes 5 steps. It uses a Runge-Kutta method of order 3 with 3 evaluations for each
 * step, which does not store its stages (J. H. Williamson, J. Comput. Phys. 35 (1980) 48-56, case
 * 7):
 *
 *   d := A_i d + h f(y),   y := y + B_i d
 *
 * The constraints need no stabilization, because there are only few steps. An error of a tenth in
 * the rate does no harm. All steps cover about the same angle. A short fast phase or a singular
 * configuration therefore has little influence on the mean rate. No step is longer than the time in
 * which gravity turns the mechanism by the angle of a step. If a mechanism starts slowly, the pilot
 * therefore also includes its later motion.
 */
#include <math.h>
#include <string.h>

#include "simulate/run.h"

enum { STEPS = 5, STAGES = 3 };
static const double A[STAGES] = {0.0, -5.0 / 9.0, -153.0 / 128.0};
static const double B[STAGES] = {1.0 / 3.0, 15.0 / 16.0, 8.0 / 15.0};
static const double C[STAGES] = {0.0, 1.0 / 3.0, 3.0 / 4.0};

static const double ANGLE = 0.75; /* [rad] angle that the mechanism covers in a step */
static const double GROWTH = 2.0; /* a step is at most this many times as long as the step before */

typedef struct pilot {
  baum_workspace *workspace;
  baum_i_state *y;
  baum_i_state *d;
  double swing;  /* [1/s] rate at which gravity makes the mechanism swing */
  double h;      /* [s] length of the last step; infinite before the first step */
  double turned; /* [rad] angle covered so far */
  double time;   /* [s] time covered so far */
  bool ready;    /* whether the workspace contains the accelerations in the state y */
} pilot;

/* Evaluate the accelerations. Returns false if the evaluation fails. */
static bool evaluate(pilot *p)
{
  const baum_i_state *y = p->y;
  if (!p->ready && baum_i_acceleration(p->workspace, y->t, y->q, y->v, 0.0, 0.0) != BAUM_OK) {
    return false;
  }
  p->ready = true;
  return isfinite(baum_i_state_rate(p->workspace->mechanism, y->v, p->workspace->a));
}

static void add(int count, int stage, double h, const double *rate, double *d, double *y)
{
  for (int i = 0; i < count; i++) {
    d[i] = A[stage] * d[i] + h * rate[i];
    y[i] += B[stage] * d[i];
  }
}

static void advance(pilot *p, int stage, double t, double h)
{
  const baum_mechanism *m = p->workspace->mechanism;
  const double *rate = baum_i_rates(m, p->y->q, p->y->v, p->workspace->work_q);
  add(m->nq, stage, h, rate, p->d->q, p->y->q);
  add(m->nv, stage, h, p->workspace->a, p->d->v, p->y->v);
  p->y->t = stage + 1 < STAGES ? t + C[stage + 1] * h : t + h;
  p->ready = false;
}

static bool step(pilot *p)
{
  if (!evaluate(p)) {
    return false;
  }
  double rate = baum_i_state_rate(p->workspace->mechanism, p->y->v, p->workspace->a);
  double t = p->y->t;
  p->h = fmin(ANGLE / fmax(rate, p->swing), GROWTH * p->h);
  p->turned += rate * p->h;
  p->time += p->h;
  for (int k = 0; k < STAGES; k++) {
    if (!evaluate(p)) {
      return false;
    }
    advance(p, k, t, p->h);
  }
  return true;
}

double baum_i_run_pilot(baum_simulation *run, double swing)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_probe probe;
  baum_i_probe_begin(&probe, run->workspace);
  baum_i_run_copy(run, &run->trial, &run->ahead);
  memset(run->state.q, 0, (size_t)m->nq * sizeof *run->state.q);
  memset(run->state.v, 0, (size_t)m->nv * sizeof *run->state.v);
  pilot p = {.workspace = run->workspace,
             .y = &run->ahead,
             .d = &run->state,
             .swing = swing,
             .h = (double)INFINITY,
             .ready = true};
  for (int k = 0; k < STEPS && step(&p); k++) {
  }
  (void)baum_i_probe_end(&probe, BAUM_OK);
  return p.turned / p.time;
}
