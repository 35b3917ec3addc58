/* SPDX-License-Identifier: BSD-3-Clause */
/* What an error costs: for every integrator and formulation the cheapest run, over a ladder of steps or tolerances,
 * whose largest error over all samples is at most 1e-4, 1e-6, 1e-8, 1e-10.
 *
 * usage: bench_trade [PROBLEM]
 *
 * Errors: lengths relative to the scale of the mechanism, angles in radians. Time: CPU time of this thread from the
 * start to the last sample, with the making of the run, the smallest of some repeats. Ladders end where a run takes
 * longer than LONGEST or gets no better.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "andrews_reference.h"
#include "four_bar_reference.h"
#include "reference.h"
#include "slider_crank_undriven_reference.h"
#include "timing.h"

static const double LONGEST = 1.0; /* [s] */
static const double REPEATED = 0.02;
enum {
  RUNGS = 40,
  TARGETS = 4,
  WORSE = 6,
  WINDOW_SAMPLES = 10,
  WINDOW_STEPS = 100000,
  REPEATS = 5
};
static const double TARGET[TARGETS] = {1e-4, 1e-6, 1e-8, 1e-10};

typedef struct problem {
  const char *what;
  reference with;
  double step; /* [s] the longest */
  model m;
} problem;

/* ---- problems ---- */

/* Angle of N-four-bar's cranks with N = 1, at 1, 2, ... 10 s: (5/3) th'' = -2 g cos th, by the classical Runge-Kutta
 * method with an error of 1e-14. */
static double window_angle[WINDOW_SAMPLES];
static double window_t[WINDOW_SAMPLES];

static double pull(double angle)
{
  return -2.0 * 9.81 * cos(angle) / (5.0 / 3.0);
}

static void step_window(double h, double *angle, double *rate)
{
  double a = *angle;
  double w = *rate;
  double k1 = pull(a);
  double k2 = pull(a + h / 2 * w);
  double k3 = pull(a + h / 2 * (w + h / 2 * k1));
  double k4 = pull(a + h * (w + h / 2 * k2));
  *angle += h * w + h * h / 6 * (k1 + k2 + k3);
  *rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

static void integrate_window(const model_n_four_bar *data)
{
  double angle = data->angle;
  double rate = data->rate;
  for (int k = 0; k < WINDOW_SAMPLES; k++) {
    for (int i = 0; i < WINDOW_STEPS; i++) {
      step_window(1.0 / WINDOW_STEPS, &angle, &rate);
    }
    window_t[k] = k + 1.0;
    window_angle[k] = angle;
  }
}

static void take_angle(const double *q, double *out)
{
  out[0] = q[2];
}

static baum_status make_slider_crank(problem *out)
{
  out->what = "free slider-crank, 0.2 s: 5 turns";
  out->with = (reference){.samples = SLIDER_CRANK_UNDRIVEN_SAMPLES,
                          .width = SLIDER_CRANK_UNDRIVEN_WIDTH,
                          .t = SLIDER_CRANK_UNDRIVEN_T,
                          .q = SLIDER_CRANK_UNDRIVEN_Q[0],
                          .lengths = "mmrmmrmmr"};
  out->step = 2e-3;
  return model_slider_crank_build((model_slider_crank){.driven = false}, &out->m);
}

static baum_status make_four_bar(problem *out)
{
  out->what = "Grashof four-bar, 5 s";
  out->with = (reference){.samples = FOUR_BAR_SAMPLES,
                          .width = FOUR_BAR_WIDTH,
                          .t = FOUR_BAR_T,
                          .q = FOUR_BAR_Q[0],
                          .lengths = "mmrmmrmmr"};
  out->step = 0.05;
  return model_four_bar(&out->m);
}

static baum_status make_window(problem *out)
{
  model_n_four_bar data = model_n_four_bar_a02(1);
  integrate_window(&data);
  out->what = "N-four-bar N = 1, 10 s, through flat positions";
  out->with = (reference){.samples = WINDOW_SAMPLES,
                          .width = 1,
                          .t = window_t,
                          .q = window_angle,
                          .lengths = "r",
                          .columns = take_angle};
  out->step = 0.1;
  return model_n_four_bar_build(&data, &out->m);
}

static baum_status make_andrews(problem *out)
{
  out->what = "Andrews' mechanism, 7 bodies, 0.03 s";
  out->with = (reference){.samples = ANDREWS_SAMPLES,
                          .width = ANDREWS_WIDTH,
                          .t = ANDREWS_T,
                          .q = ANDREWS_Q[0],
                          .lengths = "rrrrrrr",
                          .columns = model_andrews_from_bodies};
  out->step = 5e-4;
  return model_andrews_bodies(&out->m);
}

static const struct {
  const char *name;
  baum_status (*make)(problem *out);
} PROBLEMS[] = {
  {"slider_crank", make_slider_crank},
  {"four_bar", make_four_bar},
  {"window", make_window},
  {"andrews", make_andrews},
};
enum { PROBLEM_COUNT = sizeof PROBLEMS / sizeof PROBLEMS[0] };

/* ---- one setting ---- */

typedef struct priced {
  double seconds;
  long long evaluations;
  double setting; /* step or rtol */
} priced;

static double measure(const problem *at, const baum_simulation_options *o, reference_run *run)
{
  double best = (double)INFINITY;
  double all = 0.0;
  for (int k = 0; k < REPEATS && all < REPEATED; k++) {
    double begin = timing_now();
    *run = reference_compare(&at->with, at->m.mechanism, o);
    double taken = timing_now() - begin;
    best = fmin(best, taken);
    all += taken;
  }
  return best;
}

static void keep_cheapest(priced best[TARGETS], double error, priced found)
{
  for (int k = 0; k < TARGETS; k++) {
    if (error <= TARGET[k] && !(best[k].seconds <= found.seconds)) {
      best[k] = found;
    }
  }
}

/* Steps are halved, tolerances go down by half decades. */
static double setting_of(const problem *at, bool fixed, int rung)
{
  return fixed ? at->step / exp2(rung) : pow(10.0, -2.0 - 0.5 * rung);
}

/* The cheapest runs of one integrator with one formulation. */
static void climb(const problem *at, baum_simulation_options o, bool fixed, priced best[TARGETS])
{
  double least = (double)INFINITY;
  int worse = 0;
  for (int k = 0; k < TARGETS; k++) {
    best[k] = (priced){.seconds = (double)NAN};
  }
  for (int rung = 0; rung < RUNGS && worse < WORSE; rung++) {
    double setting = setting_of(at, fixed, rung);
    *(fixed ? &o.step : &o.rtol) = setting;
    if (!fixed && setting < 1e-14) {
      break;
    }
    reference_run run;
    double seconds = measure(at, &o, &run);
    worse = run.error < 0.9 * least ? 0 : worse + 1;
    least = fmin(least, isnan(run.error) ? least : run.error);
    keep_cheapest(best, run.error, (priced){seconds, run.counters.evaluations, setting});
    if (seconds > LONGEST) {
      break;
    }
  }
}

static void print_row(const char *name, const char *formulation, const char *kind,
                      const priced best[TARGETS])
{
  char both[64];
  (void)snprintf(both, sizeof both, "%s %s", name, formulation);
  printf("%-34s %-4s", both, kind);
  for (int k = 0; k < TARGETS; k++) {
    if (isnan(best[k].seconds)) {
      printf(" | %27s", "-");
    } else {
      printf(" | %9.3f %8lld %8.1e", 1e3 * best[k].seconds, best[k].evaluations, best[k].setting);
    }
  }
  printf("\n");
  (void)fflush(stdout);
}

static void price(const problem *at, const baum_integrator *integrator,
                  baum_formulation formulation)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = formulation;
  for (int fixed = 0; fixed <= 1; fixed++) {
    bool offered = fixed ? baum_integrator_has_fixed_step(integrator)
                         : baum_integrator_has_variable_step(integrator);
    if (offered) {
      priced best[TARGETS];
      climb(at, o, fixed == 1, best);
      print_row(baum_integrator_name(integrator), baum_formulation_name(formulation),
                fixed ? "step" : "rtol", best);
    }
  }
}

static bool price_all(int which)
{
  problem at = {0};
  if (PROBLEMS[which].make(&at) != BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", PROBLEMS[which].name, baum_message());
    return false;
  }
  printf("\n%s: %s\n%-39s", PROBLEMS[which].name, at.what, "error at most");
  for (int k = 0; k < TARGETS; k++) {
    printf(" | %27.0e", TARGET[k]);
  }
  printf("\n%-39s", "");
  for (int k = 0; k < TARGETS; k++) {
    printf(" | %9s %8s %8s", "ms", "evals", "setting");
  }
  printf("\n");
  for (int k = 0; baum_integrator_at(k); k++) {
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_offers(baum_integrator_at(k), (baum_formulation)f)) {
        price(&at, baum_integrator_at(k), (baum_formulation)f);
      }
    }
  }
  model_destroy(&at.m);
  return true;
}

int main(int count, char **words)
{
  bool fine = true;
  bool known = count == 1;
  for (int k = 0; k < PROBLEM_COUNT; k++) {
    bool wanted = count == 1 || (count == 2 && strcmp(words[1], PROBLEMS[k].name) == 0);
    known = known || wanted;
    fine = (!wanted || price_all(k)) && fine;
  }
  if (!known) {
    (void)fprintf(stderr, "usage: bench_trade [slider_crank | four_bar | window | andrews]\n");
    return 2;
  }
  return fine ? 0 : 1;
}
