/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the speed of a study with two threads and with one thread. The study runs the standard
 * grid for a slider-crank without a driver.
 *
 * Two threads compute the errors of the entries. Afterwards only one thread measures their CPU
 * times. The wall time is therefore more than half of the wall time with one thread. In this study,
 * each time is measured once. With two threads, the total CPU time should be the same as with one.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <baum/baum.h>
#include <baum/catalog.h>

typedef struct spent {
  double wall; /* [s] */
  double cpu;  /* [s] of all threads together */
} spent;

static double clock_now(clockid_t clock)
{
  struct timespec now;
  (void)clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static baum_status set_up(baum_study *study, int threads)
{
  baum_study_options options = baum_study_options_default();
  options.threads = threads;
  options.repeats = 1;
  options.entry_limit = 0.1;
  baum_status status = baum_study_set_options(study, &options);
  return status == BAUM_OK ? baum_study_add_standard(study, NULL) : status;
}

static baum_status measure(const baum_mechanism *mechanism, int threads, spent *out)
{
  baum_study *study = NULL;
  baum_status status = baum_study_create(mechanism, 0.0, 0.2, &study);
  if (status == BAUM_OK) {
    status = set_up(study, threads);
  }
  double wall = clock_now(CLOCK_MONOTONIC);
  double cpu = clock_now(CLOCK_PROCESS_CPUTIME_ID);
  if (status == BAUM_OK) {
    status = baum_study_run(study);
  }
  out->wall = clock_now(CLOCK_MONOTONIC) - wall;
  out->cpu = clock_now(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  printf("%d thread%s: %d entries, wall %.2f s, cpu %.2f s\n", threads, threads == 1 ? "" : "s",
         (int)baum_study_entry_count(study), out->wall, out->cpu);
  baum_study_destroy(study);
  return status;
}

int main(void)
{
  const baum_catalog_choice choice = {.name = "slider_crank"};
  baum_mechanism *mechanism = NULL;
  spent one;
  spent two;
  baum_status status = baum_catalog_build(&choice, &mechanism);
  if (status == BAUM_OK) {
    status = measure(mechanism, 1, &one);
  }
  if (status >= BAUM_OK) {
    status = measure(mechanism, 2, &two);
  }
  baum_mechanism_destroy(mechanism);
  if (status < BAUM_OK) {
    (void)fprintf(stderr, "%s\n", baum_message());
    return EXIT_FAILURE;
  }
  printf("two threads divided by one: wall %.2f, cpu %.2f\n", two.wall / one.wall,
         two.cpu / one.cpu);
  return EXIT_SUCCESS;
}
