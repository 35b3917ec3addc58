/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the time of a run in baum_sweep() with that of the same run alone. In baum_sweep(), each
 * run also copies, changes and freezes the mechanism. The mechanism is a slider-crank without a
 * driver. A run simulates 0.2 s by rk8 with rtol 1e-8. The program measures both CPU times
 * alternately, and prints the ratio of their sums. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <baum/baum.h>
#include <baum/catalog.h>

enum { RUNS = 200, PAIRS = 10, TIMES = 21 };

static double times[TIMES];
static double rows[RUNS * TIMES * 2];

static void check(baum_status status)
{
  if (status < BAUM_OK) {
    printf("%s\n", baum_message());
    exit(1);
  }
}

static double cpu_now(void)
{
  struct timespec now;
  (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static baum_status change(baum_mechanism *copy, int64_t run, void *user)
{
  const baum_body_id *rod = user;
  baum_planar_body_def def;
  check(baum_mechanism_get_planar_body(copy, *rod, &def, sizeof def));
  def.mass *= 1.0 + 1e-12 * (double)run; /* a change so small that all runs take the same steps */
  return baum_mechanism_set_planar_body(copy, *rod, &def);
}

static void run_alone(const baum_mechanism *mechanism, const baum_simulation_options *options,
                      const baum_channel *energy)
{
  for (int k = 0; k < RUNS; k++) {
    baum_simulation *run = NULL;
    check(baum_simulation_create(mechanism, options, &run));
    check(baum_simulation_sample(run, times, TIMES, energy, 1, rows, NULL));
    baum_simulation_destroy(run);
  }
}

int main(void)
{
  const baum_catalog_choice choice = {.name = "slider_crank"};
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  baum_mechanism *mechanism = NULL;
  check(baum_catalog_build(&choice, &mechanism));
  baum_body_id rod = baum_mechanism_body_at(mechanism, 1);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-8;
  baum_sweep_def def = baum_sweep_def_default();
  def.count = RUNS;
  def.change = change;
  def.user = &rod;
  def.times = times;
  def.time_count = TIMES;
  def.channels = &energy;
  def.channel_count = 1;
  for (int k = 0; k < TIMES; k++) {
    times[k] = 0.2 * k / (TIMES - 1);
  }
  double alone = 0.0;
  double swept = 0.0;
  for (int pair = 0; pair < PAIRS; pair++) {
    const double begun = cpu_now();
    run_alone(mechanism, &options, &energy);
    const double middle = cpu_now();
    check(baum_sweep(mechanism, &options, &def, rows, NULL));
    swept += cpu_now() - middle;
    alone += middle - begun;
  }
  printf("alone %.1f us, in baum_sweep %.1f us: ratio %.3f\n", 1e6 * alone / (RUNS * PAIRS),
         1e6 * swept / (RUNS * PAIRS), swept / alone);
  baum_mechanism_destroy(mechanism);
  return 0;
}
