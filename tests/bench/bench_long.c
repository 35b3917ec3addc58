/* SPDX-License-Identifier: BSD-3-Clause */
/* Shows how energy and violations grow in long runs, for every fixed-step integrator. Two
 * mechanisms are planar, the pendulum A01 and the slider-crank without a driver. Two are spatial, a
 * heavy top and a four-bar (RSSR). None of them dissipates energy, so their energy should stay
 * constant.
 *
 *   bench_long [STEPS [INTEGRATOR]]      default: 10000000 steps, all integrators
 *
 * The program prints a line for every decade of steps. At every sample in this decade, the energy
 * is compared with the initial energy. The line contains the smallest and the largest of these
 * differences, relative to the largest kinetic energy. The next number is the exponent p of a
 * difference that grows like t^p. It is computed from this decade and the one before. The last
 * numbers are the largest violations since the start, the heap in use, and the computing time in
 * seconds. If a run fails, its message is printed.
 */
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "manifold_tops.h"
#include "models.h"
#include "spatial_scenes.h"

/* Number of steps between two samples of the energy. It is a prime, so that the samples cover all
 * phases of the motion. */
enum { STRIDE = 37 };

static void check(baum_status status)
{
  if (status < BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", baum_status_name(status), baum_message());
    exit(EXIT_FAILURE);
  }
}

/* ---- the energy ---- */

typedef struct band {
  double least;
  double most;
} band;

static void see(band *b, double x)
{
  b->least = fmin(b->least, x);
  b->most = fmax(b->most, x);
}

static double size_of(const band *b)
{
  return fmax(fabs(b->least), fabs(b->most));
}

static double energy_of(baum_simulation *run, double *kinetic)
{
  const baum_channel channel = baum_channel_of(BAUM_ENERGY);
  double energy[2];
  check(baum_simulation_get(run, &channel, 1, energy));
  *kinetic = energy[0];
  return energy[0] + energy[1];
}

/* Returns the largest kinetic energy in the first two seconds. It is computed by an accurate
 * run. */
static double largest_kinetic(const model *m)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-8;
  baum_simulation *run = NULL;
  double largest = 0.0;
  check(baum_simulation_create(m->mechanism, &options, &run));
  for (int k = 0; k < 200; k++) {
    double kinetic = 0.0;
    check(baum_simulation_advance_to(run, 0.01 * k));
    (void)energy_of(run, &kinetic);
    largest = fmax(largest, kinetic);
  }
  baum_simulation_destroy(run);
  return largest;
}

/* ---- runs ---- */

static void print_decade(baum_simulation *run, int64_t first, int64_t last, const band b[2])
{
  baum_counters c;
  check(baum_simulation_counters(run, &c, sizeof c));
  (void)printf("  %10lld - %-10lld %13.5e %13.5e %6.2f   %8.1e %8.1e %8zu %8.1f\n",
               (long long)first, (long long)last, b[1].least, b[1].most,
               log10(size_of(&b[1]) / size_of(&b[0])), c.max_phi, c.max_phi_rate,
               mallinfo2().uordblks / 1024, c.wall);
  (void)fflush(stdout);
}

/* Takes the steps of one decade, and samples the energy. */
static baum_status run_decade(baum_simulation *run, double start, double unit, int64_t steps,
                              band *b)
{
  double kinetic = 0.0;
  baum_status status = BAUM_OK;
  *b = (band){INFINITY, -INFINITY};
  for (int64_t done = 0; done < steps && status >= BAUM_OK; done += STRIDE) {
    int64_t left = steps - done;
    status = baum_simulation_step(run, left < STRIDE ? left : STRIDE);
    see(b, (energy_of(run, &kinetic) - start) / unit);
  }
  return status;
}

static void run_decades(const model *m, const baum_simulation_options *options, int64_t steps)
{
  baum_simulation *run = NULL;
  double kinetic = 0.0;
  double unit = largest_kinetic(m);
  check(baum_simulation_create(m->mechanism, options, &run));
  double start = energy_of(run, &kinetic);
  band b[2] = {{(double)NAN, (double)NAN}, {0.0, 0.0}};
  int64_t done = 0;
  baum_status status = BAUM_OK;
  for (int64_t end = 1000; done < steps && status >= BAUM_OK; end *= 10) {
    int64_t last = end < steps ? end : steps;
    status = run_decade(run, start, unit, last - done, &b[1]);
    print_decade(run, done, last, b);
    done = last;
    b[0] = b[1];
  }
  if (status < BAUM_OK) {
    (void)printf("  %s\n", baum_simulation_message(run));
  }
  baum_simulation_destroy(run);
}

static void run_with(const char *name, const model *m, const baum_simulation_options *options,
                     int64_t steps)
{
  (void)printf("\n%s, %s, %s, h = %g s\n", name, baum_integrator_name(options->integrator),
               baum_formulation_name(options->formulation), options->step);
  (void)printf("  %-23s %13s %13s %6s   %8s %8s %8s %8s\n", "steps", "least dE/T", "most dE/T", "p",
               "max Phi", "Phi'", "heap kB", "wall s");
  run_decades(m, options, steps);
}

static void compare(const char *name, const model *m, double step, int64_t steps, const char *only)
{
  static const baum_formulation TRIED[] = {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_PROJECTION,
                                           BAUM_FORMULATION_INDEX3};
  const baum_integrator *integrator = NULL;
  for (int32_t k = 0; (integrator = baum_integrator_at(k)) != NULL; k++) {
    bool wanted = only == NULL || strcmp(only, baum_integrator_name(integrator)) == 0;
    for (size_t f = 0; f < sizeof TRIED / sizeof TRIED[0]; f++) {
      baum_simulation_options options = baum_simulation_options_default();
      options.integrator = integrator;
      options.step = step;
      options.formulation = TRIED[f];
      if (wanted && baum_integrator_has_fixed_step(integrator) &&
          baum_integrator_offers(integrator, TRIED[f])) {
        run_with(name, m, &options, steps);
      }
    }
  }
}

static void compare_built(const char *name, void (*build)(baum_mechanism *), double step,
                          int64_t steps, const char *only)
{
  model m = {0};
  check(baum_mechanism_create(&m.mechanism));
  build(m.mechanism);
  check(baum_mechanism_freeze(m.mechanism));
  compare(name, &m, step, steps, only);
  model_destroy(&m);
}

int main(int argc, char **argv)
{
  int64_t steps = argc > 1 ? strtoll(argv[1], NULL, 10) : 10000000;
  const char *only = argc > 2 ? argv[2] : NULL;
  model pendulum;
  model crank;
  check(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum));
  check(model_slider_crank_build((model_slider_crank){.driven = false}, &crank));
  compare("pendulum A01", &pendulum, 0.01, steps, only);
  compare("slider-crank, free", &crank, 1e-4, steps, only);
  compare_built("heavy top", manifold_build_spatial_top, 5e-3, steps, only);
  compare_built("RSSR", spatial_build_rssr, 1e-3, steps, only);
  model_destroy(&pendulum);
  model_destroy(&crank);
  return EXIT_SUCCESS;
}
