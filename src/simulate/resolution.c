/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether steps of fixed length resolve the motion.
 *
 * Such a method is given no tolerance and estimates no error. But a method of order p that goes
 * through a motion of rate w by steps of h leaves about
 *
 *   C (w h)^p  x  the way that the motion has gone,   (w h)^2 = sum |a_k+1 - a_k|^2 / sum |a_k|^2
 *
 * where sizes are the largest of the coordinates in their scales, and C is the method's own. That is
 * right within a factor of some five, so the warning comes where a result would be worth little. */
#include <math.h>

#include "simulate/run.h"

/* Of the scales: with less, even an estimate that is five times too large means a usable result. */
static const double COARSE = 0.1;
/* Steps that are all looked at; later ones by samples, for a look costs a tenth of a step of the fastest methods. */
enum { FIRST = 64, STRIDE = 8 };
/* An error that is worth aiming at, for the step that is advised. */
static const double FINE = 0.01;

/* Largest change of acceleration since the last step, in the scales. */
static double change(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const double *a = run->workspace->a;
  double most = 0.0;
  for (int i = 0; i < m->nv; i++) {
    most = fmax(most, fabs(a[i] - run->acceleration[i]) / m->scale[i]);
  }
  return most;
}

static void warn(baum_simulation *run, double turn, double error)
{
  double h = run->options.step;
  double advised = h * pow(FINE / error, 1.0 / run->integrator->order);
  baum_i_run_warn(
    run, BAUM_WARNING_STEP, run->state.t, BAUM_I_NO_JOINT,
    "t = %.9g s: the step of %.3g s is too long for %s: the motion turns by about %.2g "
    "rad in each, and by now is off by about %.1g of the scales; take a step below %.1g s",
    run->state.t, h, run->integrator->name, turn, error, advised);
  run->resolution.coarse = true;
}

void baum_i_run_resolve(baum_simulation *run)
{
  baum_i_resolution *r = &run->resolution;
  const baum_mechanism *m = run->workspace->mechanism;
  int64_t k = run->counters.steps;
  if (r->coarse || (k >= FIRST && k % STRIDE != 0)) {
    return;
  }
  double steps = k >= FIRST ? STRIDE : 1.0;
  if (r->follows) {
    double da = change(run);
    r->changes += steps * da * da;
  }
  double a = baum_i_scaled_size(m, run->workspace->a);
  r->sizes += steps * a * a;
  r->way += steps * baum_i_scaled_size(m, run->state.v) * run->options.step;
  r->follows = true;
  double turn = r->sizes > 0.0 ? sqrt(r->changes / r->sizes) : 0.0;
  double error = run->integrator->error_constant * pow(turn, run->integrator->order) * r->way;
  if (error > COARSE) {
    warn(run, turn, error);
  }
}
