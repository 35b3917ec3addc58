/* SPDX-License-Identifier: BSD-3-Clause */
/* The standard grid of settings that a study can add.
 *
 * Tolerances decrease by equal ratios from 1e-2 to the finest one, and are rounded to one digit.
 * Steps begin with h0, decrease by a constant factor, and are rounded down to (t1 - t0) / N with a
 * whole number N. The factor, and the product of h0 and the rate of the motion
 * (baum_i_study_rate()), depend on the order of the method:
 *
 *   order        1      2      3 to 5   8
 *   h0 x rate    0.1    0.3    0.5      0.8
 *   factor       3      3      2        1.5
 *
 * The quick grid has the first five of these steps, and five tolerances over the same range. */
#include <math.h>

#include "base/sized.h"
#include "base/text.h"
#include "dynamics/dynamics.h"
#include "integrate/integrator.h"
#include "mechanism/definition.h"
#include "simulate/run.h"
#include "study/study.h"

enum { MOST_SETTINGS = 64, MOST_CONSTANTS = 4, LOOKS = 20, QUICK_SETTINGS = 5 };
static const double LARGEST_RTOL = 1e-2;
static const double LEAST_RTOL = 1e-13;

void baum_study_grid_init(baum_study_grid *grid, size_t caller_size)
{
  const baum_study_grid defaults = {
    .settings = 8, .constants = 2, .coarsest = BAUM_I_NOT_GIVEN, .finest = BAUM_I_NOT_GIVEN};
  baum_i_give_sized(grid, caller_size, &defaults, sizeof defaults);
}

static baum_status check_grid(const baum_study_grid *g)
{
  if (g->settings < 1 || g->settings > MOST_SETTINGS) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "study grid: settings is %d, must be 1 to %d",
                       (int)g->settings, MOST_SETTINGS);
  }
  if (g->constants < 0 || g->constants > MOST_CONSTANTS) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "study grid: constants is %d, must be 0 to %d",
                       (int)g->constants, MOST_CONSTANTS);
  }
  if (!isnan(g->coarsest) && !(isfinite(g->coarsest) && g->coarsest > 0.0)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "study grid: coarsest is %g s, must be finite and > 0",
                       g->coarsest);
  }
  if (!isnan(g->finest) && !(g->finest > 0.0 && g->finest < LARGEST_RTOL)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "study grid: finest is %g, must be > 0 and < %g",
                       g->finest, LARGEST_RTOL);
  }
  return BAUM_OK;
}

/* ---- the rate of the motion ---- */

static int is_cancelled(const baum_simulation *run, double t, void *user)
{
  const baum_study *study = user;
  (void)run;
  (void)t;
  return atomic_load(&study->cancelled);
}

baum_status baum_i_study_rate(baum_study *study, double *rate)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_dp5();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  o.rtol = 1e-3;
  o.start_time = study->t0;
  o.max_steps = 100000;
  o.progress = is_cancelled;
  o.progress_interval = 0.0;
  o.user = study;
  baum_simulation *run = NULL;
  BAUM_I_TRY(baum_simulation_create(study->mechanism, &o, &run));
  baum_status status = BAUM_OK;
  double sum = 0.0;
  int seen = 0;
  while (seen < LOOKS && status >= BAUM_OK && status != BAUM_STOP_CANCELLED) {
    seen++;
    double t = study->t0 + (study->t1 - study->t0) * seen / LOOKS;
    status = baum_simulation_advance_to(run, t);
    sum += baum_i_scaled_size(study->mechanism, baum_simulation_v(run));
  }
  *rate = fmax(run->problem.rate, sum / seen);
  baum_simulation_destroy(run);
  atomic_store(&study->cancelled, 0);
  return status == BAUM_STOP_CANCELLED ? status : BAUM_OK;
}

/* ---- settings ---- */

typedef struct grid {
  baum_study *study;
  const baum_study_grid *wanted;
  double rate;
} grid;

static double first_step(const grid *g, int order)
{
  double h = order == 1 ? 0.1 : order == 2 ? 0.3 : order < 6 ? 0.5 : 0.8;
  double unit = isnan(g->wanted->coarsest) ? 1.0 / g->rate : 2.0 * g->wanted->coarsest;
  return h * unit;
}

static double step_at(const grid *g, int order, int k)
{
  double factor = order <= 2 ? 3.0 : order < 6 ? 2.0 : 1.5;
  double span = fabs(g->study->t1 - g->study->t0);
  return span / ceil(span / first_step(g, order) * pow(factor, k));
}

/* Returns the finest tolerance of the grid. Its default is not below the error of the difference
 * quotients that replace missing derivatives of constraints. */
static double finest_of(const grid *g)
{
  double finest = g->wanted->finest;
  double noise = baum_i_difference_noise(g->study->mechanism);
  return isnan(finest) ? fmax(LEAST_RTOL, noise) : finest;
}

static int settings_of(const grid *g)
{
  int settings = g->wanted->settings;
  return g->wanted->quick && settings > QUICK_SETTINGS ? QUICK_SETTINGS : settings;
}

static double rtol_at(const grid *g, int k)
{
  int last = settings_of(g) > 1 ? settings_of(g) - 1 : 1;
  double rtol = LARGEST_RTOL * pow(finest_of(g) / LARGEST_RTOL, (double)k / last);
  double decade = pow(10.0, floor(log10(rtol) + 1e-9));
  return decade * round(rtol / decade);
}

static baum_status add_ladder(const grid *g, baum_simulation_options o, bool fixed)
{
  for (int k = 0; k < settings_of(g); k++) {
    o.step = fixed ? step_at(g, o.integrator->order, k) : (double)NAN;
    o.rtol = fixed ? (double)NAN : rtol_at(g, k);
    BAUM_I_TRY(baum_study_add(g->study, &o));
  }
  return BAUM_OK;
}

/* Adds settings with rtol and settings with a fixed step, as far as the integrator offers them. */
static baum_status add_settings(const grid *g, const baum_simulation_options *o)
{
  if (o->integrator->without_freedom) {
    return baum_study_add(g->study, o);
  }
  if (baum_integrator_has_variable_step(o->integrator)) {
    BAUM_I_TRY(add_ladder(g, *o, false));
  }
  return baum_integrator_has_fixed_step(o->integrator) ? add_ladder(g, *o, true) : BAUM_OK;
}

/* Adds settings with the integrator's default gains. The full grid of Baumgarte's method also has
 * settings with the rule "auto" and with constant gains. */
static baum_status add_gains(const grid *g, baum_simulation_options o)
{
  BAUM_I_TRY(add_settings(g, &o));
  if (g->wanted->quick || o.formulation != BAUM_FORMULATION_BAUMGARTE) {
    return BAUM_OK;
  }
  if (o.integrator->gains != BAUM_GAINS_AUTO) {
    o.gains = baum_gains_auto();
    BAUM_I_TRY(add_settings(g, &o));
  }
  double gain = g->rate;
  for (int k = 0; k < g->wanted->constants; k++) {
    o.gains = baum_gains_fixed(gain, gain);
    BAUM_I_TRY(add_settings(g, &o));
    gain *= 10.0;
  }
  return BAUM_OK;
}

static baum_status add_integrator(void *user, const baum_integrator *integrator)
{
  const grid *g = user;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  bool all = g->wanted->formulation == BAUM_FORMULATION_DEFAULT;
  if (integrator->without_freedom || (g->wanted->quick && all)) {
    return all ? add_gains(g, o) : BAUM_OK;
  }
  for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
    bool wanted = all || g->wanted->formulation == (baum_formulation)f;
    o.formulation = (baum_formulation)f;
    if (wanted && baum_i_integrator_offers(integrator, o.formulation)) {
      BAUM_I_TRY(add_gains(g, o));
    }
  }
  return BAUM_OK;
}

baum_status baum_study_add_standard(baum_study *study, const baum_study_grid *grid_wanted)
{
  const char *call = "baum_study_add_standard";
  BAUM_I_TRY(baum_i_study_check(study, call));
  baum_study_grid wanted = baum_study_grid_default();
  if (grid_wanted) {
    BAUM_I_TRY(baum_i_take_sized(&wanted, sizeof wanted, grid_wanted, call, "", "the default"));
  }
  BAUM_I_TRY(check_grid(&wanted));
  grid g = {.study = study, .wanted = &wanted};
  BAUM_I_TRY(baum_i_study_rate(study, &g.rate));
  const char *formulation = baum_formulation_name(wanted.formulation);
  const baum_i_text missing = baum_i_text_of(
    "study grid: no integrator of this build that you allow offers the formulation %s",
    formulation ? formulation : "that is asked for");
  return baum_i_study_add_each(study, wanted.integrator, add_integrator, &g, missing.text);
}
