/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy of long runs: RATTLE, whose change stays in a band, and beside it methods whose change grows with time,
 * semi-implicit Euler with dead-beat gains first. Pendulum A01 and the slider-crank that is not driven; neither dissipates.
 *
 *   bench_long [STEPS]      10000000 by default
 *
 * A line for every decade of steps: least and largest change of energy since the start, of the largest kinetic energy,
 * over the looks of that decade; the largest violations since the start; seconds. A run that blows up ends with its
 * sentence.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "models.h"

/* Between two looks at the energy; prime, so that they meet all phases. */
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

static double energy_of(baum_simulation *run, double *kinetic)
{
  const baum_channel channel = {.quantity = BAUM_ENERGY};
  double energy[2];
  check(baum_simulation_get(run, &channel, 1, energy));
  *kinetic = energy[0];
  return energy[0] + energy[1];
}

/* Largest kinetic energy of a second of motion. */
static double largest_kinetic(const model *m, const baum_simulation_options *options)
{
  baum_simulation *run = NULL;
  double largest = 0.0;
  check(baum_simulation_create(m->mechanism, options, &run));
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

static void print_decade(baum_simulation *run, int64_t first, int64_t last, const band *b)
{
  baum_counters c;
  check(baum_simulation_counters(run, &c, sizeof c));
  printf("  %10lld - %-10lld %13.5e %13.5e   %8.1e %8.1e %8.1f\n", (long long)first,
         (long long)last, b->least, b->most, c.max_phi, c.max_phi_rate, c.wall);
  (void)fflush(stdout);
}

static void run_decades(const model *m, const baum_simulation_options *options, int64_t steps)
{
  baum_simulation *run = NULL;
  double kinetic = 0.0;
  double unit = largest_kinetic(m, options);
  check(baum_simulation_create(m->mechanism, options, &run));
  double start = energy_of(run, &kinetic);
  int64_t done = 0;
  baum_status status = BAUM_OK;
  for (int64_t end = 1000; done < steps && status >= BAUM_OK; end *= 10) {
    int64_t first = done;
    int64_t last = end < steps ? end : steps;
    band b = {INFINITY, -INFINITY};
    while (done < last && status >= BAUM_OK) {
      int64_t count = last - done < STRIDE ? last - done : STRIDE;
      status = baum_simulation_step(run, count);
      done += count;
      see(&b, (energy_of(run, &kinetic) - start) / unit);
    }
    print_decade(run, first, done, &b);
  }
  if (status < BAUM_OK) {
    printf("  %s\n", baum_simulation_message(run));
  }
  baum_simulation_destroy(run);
}

static void compare(const char *name, const model *m, double step, int64_t steps)
{
  const baum_integrator *const methods[] = {baum_rattle(), baum_semi_implicit_euler(), baum_rk4(),
                                            baum_ab4(), baum_generalized_alpha()};
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = methods[k];
    options.step = step;
    printf("\n%s, %s, h = %g s\n", name, baum_integrator_name(methods[k]), step);
    printf("  %-23s %13s %13s   %8s %8s %8s\n", "steps", "least dE/T", "most dE/T", "max Phi",
           "Phi'", "wall s");
    run_decades(m, &options, steps);
  }
}

int main(int argc, char **argv)
{
  int64_t steps = argc > 1 ? strtoll(argv[1], NULL, 10) : 10000000;
  model pendulum;
  model crank;
  check(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum));
  check(model_slider_crank_build((model_slider_crank){.driven = false}, &crank));
  compare("pendulum A01", &pendulum, 0.01, steps);
  compare("slider-crank, free", &crank, 1e-4, steps);
  model_destroy(&pendulum);
  model_destroy(&crank);
  return EXIT_SUCCESS;
}
