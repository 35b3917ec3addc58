/* SPDX-License-Identifier: BSD-3-Clause */
/* A saved run must continue in another process exactly as in its own process, bit for bit.
 *
 * This process advances a run by random intervals, and saves the run before each interval. A second
 * process of the same program then builds the same mechanism. It restores each buffer, advances by
 * the same interval, and returns the state for comparison.
 */
#define _GNU_SOURCE /* for fork */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "runs.h"
#include "saved_scenes.h"
#include "step_mode.h"

enum { NEW_RUN_EVERY = 10 /* after this many buffers, the other process creates a new run */ };

static const char *program; /* argv[0] */

/* Everything that can be read from a run after an interval. */
typedef struct outcome {
  double t;
  double q[SAVED_NQ_MAX];
  double v[SAVED_NQ_MAX];
  baum_counters counters;
  baum_energy_account account;
  double input;
  int64_t events;
  double last_event;
  double last_singular;
  baum_warning warning;
} outcome;

/* Reads the run's events and singular configurations. */
static void look_back(baum_simulation *run, outcome *out)
{
  baum_event_record record;
  baum_near_singular interval;
  int64_t intervals = out->counters.near_singular_intervals;
  out->events = baum_simulation_event_count(run);
  if (out->events > 0) {
    assert_int_equal(baum_simulation_event(run, out->events - 1, &record, sizeof record), BAUM_OK);
    out->last_event = record.t;
  }
  if (intervals > 0) {
    assert_int_equal(baum_simulation_near_singular(run, intervals - 1, &interval, sizeof interval),
                     BAUM_OK);
    out->last_singular = interval.t;
  }
}

static void look(baum_simulation *run, const saved_scene *scene, outcome *out)
{
  memset(out, 0, sizeof *out);
  out->t = baum_simulation_time(run);
  memcpy(out->q, baum_simulation_q(run), (size_t)scene->nq * sizeof *out->q);
  memcpy(out->v, baum_simulation_v(run), (size_t)scene->nv * sizeof *out->v);
  out->counters = counters_of(run);
  if (scene->options.energy_account) {
    assert_int_equal(baum_simulation_energy_account(run, &out->account, sizeof out->account),
                     BAUM_OK);
  }
  if (out->counters.warnings > 0) {
    int64_t last = out->counters.warnings - 1;
    (void)baum_simulation_warning(run, last, &out->warning, sizeof out->warning);
    out->warning.joint.tag = 0;
  }
  out->input = scene->has_input ? baum_simulation_input(run, scene->input) : 0.0;
  look_back(run, out);
  out->counters.wall = 0.0;
  out->counters.max_phi_joint.tag = 0; /* ids differ between mechanisms */
  out->counters.max_phi_rate_joint.tag = 0;
}

/* Advances by random interval number k. For some k, inputs or laws are changed before. */
static void go_on(baum_simulation *run, const saved_scene *scene, int k)
{
  double t = baum_simulation_time(run) + saved_random(k) * scene->span;
  if (k % 3 == 0 && scene->has_input) {
    assert_int_equal(baum_simulation_set_input(run, scene->input, 0.5 + saved_random(k + 1000)),
                     BAUM_OK);
  }
  if (k % 7 == 3 && scene->law) {
    assert_int_equal(scene->law(run, scene), BAUM_OK);
  }
  if (k % 5 == 4 && scene->has_input) { /* an earlier schedule may still be in effect */
    const double times[3] = {t - 0.3 * scene->span * saved_random(k), t, t + 0.5 * scene->span};
    const double values[3] = {0.7, 1.1, 0.9};
    assert_int_equal(baum_simulation_schedule_input(run, scene->input, times, values, 3), BAUM_OK);
  }
  assert_true(saved_reached(baum_simulation_advance_to(run, t)));
  if (k % 4 == 1) {
    assert_true(saved_reached(baum_simulation_step(run, 2)));
  }
}

/* ---- the other process ---- */

static void *read_buffer(FILE *file, size_t *size)
{
  assert_int_equal(fread(size, sizeof *size, 1, file), 1);
  void *buffer = malloc(*size);
  assert_non_null(buffer);
  assert_int_equal(fread(buffer, 1, *size, file), *size);
  return buffer;
}

/* The main function of the second process. Its arguments are the number of the scene, the number of
 * buffers, and the descriptors of the two files. */
static int be_the_other(char **arguments)
{
  saved_scene scene;
  int count = atoi(arguments[1]);
  FILE *in = fdopen(atoi(arguments[2]), "r");
  FILE *out = fdopen(atoi(arguments[3]), "w");
  bool fine = in && out && saved_scene_open(&scene, atoi(arguments[0]));
  baum_simulation *run = NULL;
  for (int k = 0; k < count && fine; k++) {
    size_t size = 0;
    outcome came_to;
    if (k % NEW_RUN_EVERY == 0) {
      baum_simulation_destroy(run);
      run = saved_scene_start(&scene);
    }
    void *buffer = read_buffer(in, &size);
    fine = baum_simulation_restore(run, buffer, size) == BAUM_OK;
    free(buffer);
    if (!fine) {
      (void)fprintf(stderr, "%s\n", baum_message());
      break;
    }
    go_on(run, &scene, k);
    look(run, &scene, &came_to);
    fine = fwrite(&came_to, sizeof came_to, 1, out) == 1;
  }
  baum_simulation_destroy(run);
  saved_scene_close(&scene);
  return out && fclose(out) == 0 && fine ? EXIT_SUCCESS : EXIT_FAILURE;
}

static void start_the_other(int scene, int count, FILE *buffers, FILE *outcomes)
{
  char numbers[4][16];
  (void)snprintf(numbers[0], sizeof numbers[0], "%d", scene);
  (void)snprintf(numbers[1], sizeof numbers[1], "%d", count);
  (void)snprintf(numbers[2], sizeof numbers[2], "%d", fileno(buffers));
  (void)snprintf(numbers[3], sizeof numbers[3], "%d", fileno(outcomes));
  rewind(buffers);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    (void)execl(program, program, "restore", numbers[0], numbers[1], numbers[2], numbers[3],
                (char *)NULL);
    _exit(EXIT_FAILURE);
  }
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS) {
    fail_msg("scene %d: the other process failed", scene);
  }
}

/* ---- this process ---- */

/* Saves the run before every interval, and stores the outcome after every interval. */
static void run_and_save(const saved_scene *scene, FILE *buffers, outcome *came_to, int count)
{
  baum_simulation *run = saved_scene_start(scene);
  for (int k = 0; k < count; k++) {
    size_t size = 0;
    unsigned char *buffer = save_run(run, &size);
    assert_int_equal(fwrite(&size, sizeof size, 1, buffers), 1);
    assert_int_equal(fwrite(buffer, 1, size, buffers), size);
    free(buffer);
    go_on(run, scene, k);
    look(run, scene, &came_to[k]);
  }
  baum_simulation_destroy(run);
}

static void check_scene(int number, const saved_scene *scene)
{
  int count = scene->times;
  outcome *want = calloc((size_t)count, sizeof *want);
  FILE *buffers = tmpfile();
  FILE *outcomes = tmpfile();
  assert_true(want && buffers && outcomes);
  run_and_save(scene, buffers, want, count);
  start_the_other(number, count, buffers, outcomes);
  rewind(outcomes);
  for (int k = 0; k < count; k++) {
    outcome got;
    assert_int_equal(fread(&got, sizeof got, 1, outcomes), 1);
    if (memcmp(&got, &want[k], sizeof got) != 0) {
      fail_msg("%s: buffer %d: t = %.17g and %.17g, q0 = %.17g and %.17g, evaluations %lld and "
               "%lld",
               scene->name, k, got.t, want[k].t, got.q[0], want[k].q[0],
               (long long)got.counters.evaluations, (long long)want[k].counters.evaluations);
    }
  }
  if (scene->watched.index1 != 0) {
    assert_true(want[count - 1].events > 0);
    assert_true(want[count - 1].counters.near_singular_intervals > 1);
  }
  (void)fclose(buffers);
  (void)fclose(outcomes);
  free(want);
}

static void every_method_goes_on_bit_for_bit_in_another_process(void **state)
{
  (void)state;
  saved_scene scene;
  int number = 0;
  for (; saved_scene_open(&scene, number); number++) {
    check_scene(number, &scene);
    saved_scene_close(&scene);
  }
  /* Even without SUNDIALS there are more than 20 pairs of integrator and formulation. */
  assert_true(number > 20);
}

/* The equations of a particle without joints are not factored, so the run never has a smallest
 * pivot. */
static void runs_without_joints_are_saved_before_their_first_step(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_planar_particle_def def = baum_planar_particle_def_default();
  assert_int_equal(baum_mechanism_add_planar_particle(m, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    const baum_simulation_options o = step_mode_options(step_mode_at(i), 1e-2, 1e-6);
    baum_simulation *saved = create_run(m, &o);
    baum_simulation *restored = create_run(m, &o);
    size_t size = 0;
    unsigned char *buffer = save_run(saved, &size);
    check(baum_simulation_restore(restored, buffer, size));
    free(buffer);
    check(baum_simulation_advance_to(saved, 0.1));
    check(baum_simulation_advance_to(restored, 0.1));
    assert_true(baum_simulation_q(restored)[1] == baum_simulation_q(saved)[1]);
    baum_simulation_destroy(saved);
    baum_simulation_destroy(restored);
  }
  baum_mechanism_destroy(m);
}

int main(int argc, char **argv)
{
  program = argv[0];
  if (argc == 6 && strcmp(argv[1], "restore") == 0) {
    return be_the_other(argv + 2);
  }
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_method_goes_on_bit_for_bit_in_another_process),
    cmocka_unit_test(runs_without_joints_are_saved_before_their_first_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
