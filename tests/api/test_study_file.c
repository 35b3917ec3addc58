/* SPDX-License-Identifier: BSD-3-Clause */
/* An interrupted study must continue from its file. No entry may be lost, and none may be run
 * twice. */
#define _GNU_SOURCE /* for fork and mkstemp */
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "message.h"
#include "models.h"
#include "study/study_line.h"
#include "study_entries.h"

enum { PATH = 32, FILE_SIZE = 1 << 20, KILLED_AT = 23 };

static int sync_error;

/* Replaces the system's fsync() in this program, so that tests can let it fail. */
int fsync(int descriptor)
{
  (void)descriptor;
  errno = sync_error;
  return sync_error ? -1 : 0;
}

typedef struct scene {
  model m;
  char path[PATH];
  baum_study_options options;
} scene;

static scene make_scene(void)
{
  scene s = {.path = "/tmp/baum-study-XXXXXX", .options = small_study_options()};
  int file = mkstemp(s.path);
  assert_true(file >= 0);
  (void)close(file);
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &s.m), BAUM_OK);
  return s;
}

static void end_scene(scene *s)
{
  (void)remove(s->path);
  model_destroy(&s->m);
}

static baum_study *study_of(scene *s)
{
  s->options.file = s->path;
  return small_study(s->m.mechanism, &s->options);
}

static char *read_file(const char *path)
{
  FILE *stream = fopen(path, "r");
  assert_non_null(stream);
  char *text = test_calloc(FILE_SIZE, 1);
  assert_true(fread(text, 1, FILE_SIZE - 1, stream) < FILE_SIZE - 1);
  (void)fclose(stream);
  return text;
}

static void write_file(const char *path, const char *text, size_t size)
{
  FILE *stream = fopen(path, "w");
  assert_non_null(stream);
  assert_int_equal(fwrite(text, 1, size, stream), size);
  (void)fclose(stream);
}

/* Counts the lines of the form `entry KEY STAGE ...` that have this stage. */
static int lines_at(const char *text, int stage)
{
  int count = 0;
  for (const char *at = text; (at = strstr(at, "\nentry ")) != NULL; at++) {
    count += at[7 + 16 + 1] == '0' + stage;
  }
  return count;
}

static int die(const baum_study *study, int32_t done, int32_t total, void *user)
{
  (void)study;
  (void)total;
  return done == *(const int *)user ? raise(SIGKILL) : 0;
}

/* Runs the study in a child process. This process is killed after `at` stages. */
static void run_and_be_killed(scene *s, int at)
{
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    s->options.progress = die;
    s->options.user = &at;
    (void)baum_study_run(study_of(s));
    _exit(0);
  }
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

static int count_entries(const baum_study *study, int32_t done, int32_t total, void *user)
{
  (void)study;
  (void)total;
  *(int *)user = *(int *)user == 0 ? done : *(int *)user;
  return 0;
}

/* Runs the study of a scene to its end. *first is set to the number of stages that are done when
 * progress is first called. */
static baum_study *run_to_the_end(scene *s, int *first)
{
  *first = 0;
  s->options.progress = count_entries;
  s->options.user = first;
  baum_study *study = study_of(s);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  return study;
}

static int entries_done(const baum_study *study)
{
  int count = 0;
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    count += study_entry(study, k).state == BAUM_STUDY_DONE;
  }
  return count;
}

static void a_killed_study_goes_on_without_losing_or_doubling_entries(void **state)
{
  (void)state;
  scene whole = make_scene();
  scene broken = make_scene();
  int first = 0;
  baum_study *want = run_to_the_end(&whole, &first);
  int entries = baum_study_entry_count(want);
  /* The first two times, the process is killed while errors are measured, and the last time while
   * CPU times are measured. */
  const int kills[] = {KILLED_AT, entries - 1, entries + 3};
  for (size_t k = 0; k < sizeof kills / sizeof kills[0]; k++) {
    run_and_be_killed(&broken, kills[k]);
  }
  baum_study *got = run_to_the_end(&broken, &first);
  assert_int_equal(first, entries + 1); /* so that no error is measured a second time */
  assert_same_entries(got, want);
  char *text = read_file(broken.path);
  for (int stage = 1; stage <= 2; stage++) { /* the stages are: measured, timed */
    assert_int_equal(lines_at(text, stage), stage == 1 ? entries : entries_done(want));
  }
  test_free(text);
  baum_study_destroy(got);
  baum_study_destroy(want);
  end_scene(&whole);
  end_scene(&broken);
}

static void a_complete_file_needs_no_run(void **state)
{
  (void)state;
  scene s = make_scene();
  int first = 0;
  baum_study *want = run_to_the_end(&s, &first);
  char *before = read_file(s.path);
  baum_study *got = run_to_the_end(&s, &first);
  char *after = read_file(s.path);
  assert_string_equal(before, after);
  assert_same_entries(got, want);
  assert_true(study_entry(got, 0).cpu == study_entry(want, 0).cpu);
  baum_study_reference r;
  assert_int_equal(baum_study_reference_read(got, &r, sizeof r), BAUM_OK);
  assert_true(r.trusted && r.digits > 10.0);
  double t = 0.0;
  assert_int_equal(baum_study_reference_sample(got, 0, &t, NULL, NULL, NULL), BAUM_ERR_STATE);
  test_free(before);
  test_free(after);
  baum_study_destroy(got);
  baum_study_destroy(want);
  end_scene(&s);
}

static void a_line_that_is_cut_off_or_damaged_is_run_again(void **state)
{
  (void)state;
  scene s = make_scene();
  int first = 0;
  baum_study *want = run_to_the_end(&s, &first);
  char *text = read_file(s.path);
  char *entry = strstr(text, "\nentry ");
  assert_non_null(entry);
  const size_t lengths[] = {strlen(text) - 9, (size_t)(entry - text) + 40, 30};
  for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
    write_file(s.path, text, lengths[k]);
    baum_study *got = run_to_the_end(&s, &first);
    assert_same_entries(got, want);
    baum_study_destroy(got);
  }
  entry[27] = entry[27] == '1' ? '2' : '1';
  write_file(s.path, text, strlen(text));
  baum_study *got = run_to_the_end(&s, &first);
  assert_same_entries(got, want);
  test_free(text);
  baum_study_destroy(got);
  baum_study_destroy(want);
  end_scene(&s);
}

/* The last two texts begin like a study file. The last one contains a zero byte in its first
 * line. */
static void a_file_of_something_else_is_refused_and_left_alone(void **state)
{
  (void)state;
  scene s = make_scene();
  const struct {
    const char *text;
    size_t size;
  } others[] = {{"Hello,\nthis is no study.\n", 26},
                {"\0\0\0\0", 4},
                {"baum-study notes of mine", 24},
                {"baum-study 3\0 library", 21}};
  for (size_t k = 0; k < sizeof others / sizeof others[0]; k++) {
    write_file(s.path, others[k].text, others[k].size);
    baum_study *study = study_of(&s);
    ASSERT_SAYS(baum_study_run(study), BAUM_ERR_BUFFER, "is not a study file");
    char *text = read_file(s.path);
    assert_memory_equal(text, others[k].text, others[k].size);
    assert_int_equal(text[others[k].size], 0);
    test_free(text);
    baum_study_destroy(study);
  }
  end_scene(&s);
}

/* The first line has a correct digest, but version 0 of the format. */
static void a_file_of_another_version_is_refused(void **state)
{
  (void)state;
  scene s = make_scene();
  char line[BAUM_I_STUDY_LINE] = "baum-study 0 library 0.0.0";
  baum_i_study_seal(line, 0);
  write_file(s.path, line, strlen(line));
  baum_study *study = study_of(&s);
  ASSERT_SAYS(baum_study_run(study), BAUM_ERR_BUFFER, "version");
  baum_study_destroy(study);
  end_scene(&s);
}

/* The file has the first line of this study, but as another version of the library writes it. */
static void a_file_of_another_library_is_refused(void **state)
{
  (void)state;
  scene s = make_scene();
  int first = 0;
  baum_study_destroy(run_to_the_end(&s, &first));
  char *text = read_file(s.path);
  char line[BAUM_I_STUDY_LINE] = "";
  memcpy(line, text, strcspn(text, "\n") + 1);
  assert_true(baum_i_study_unseal(line, 0));
  char *last = line + strlen(line) - 1; /* last digit of the mark "library" */
  *last = *last == '0' ? '1' : '0';
  baum_i_study_seal(line, 0);
  write_file(s.path, line, strlen(line));
  baum_study *study = study_of(&s);
  ASSERT_SAYS(baum_study_run(study), BAUM_ERR_BUFFER, "another study|the version of the library");
  baum_study_destroy(study);
  test_free(text);
  end_scene(&s);
}

/* The file has the first line of this study, but the other lines come from the study of a pendulum
 * under twice the gravity. Their checksums do not match the first line, so the entries run
 * again. */
static void lines_of_another_study_are_run_again(void **state)
{
  (void)state;
  scene s = make_scene();
  scene heavy = make_scene();
  model_pendulum heavier = MODEL_PENDULUM_A01;
  heavier.gravity *= 2.0;
  model_destroy(&heavy.m);
  assert_int_equal(model_pendulum_rod(&heavier, &heavy.m), BAUM_OK);
  int first = 0;
  baum_study *want = run_to_the_end(&s, &first);
  baum_study_destroy(run_to_the_end(&heavy, &first));
  char *own = read_file(s.path);
  char *other = read_file(heavy.path);
  size_t head = strcspn(own, "\n");
  assert_int_equal(head, strcspn(other, "\n"));
  memcpy(other, own, head);
  write_file(s.path, other, strlen(other));
  baum_study *got = run_to_the_end(&s, &first);
  assert_int_equal(first, 1);
  assert_same_entries(got, want);
  test_free(own);
  test_free(other);
  baum_study_destroy(got);
  baum_study_destroy(want);
  end_scene(&s);
  end_scene(&heavy);
}

static void a_file_of_another_study_is_refused_with_what_differs(void **state)
{
  (void)state;
  scene s = make_scene();
  int first = 0;
  baum_study_destroy(run_to_the_end(&s, &first));
  s.options.samples++;
  baum_study *other = study_of(&s);
  ASSERT_SAYS(baum_study_run(other), BAUM_ERR_BUFFER, "another study|the samples");
  baum_study_destroy(other);
  s.options.samples--;

  model_pendulum heavier = MODEL_PENDULUM_A01;
  heavier.gravity *= 2.0;
  model_destroy(&s.m);
  assert_int_equal(model_pendulum_rod(&heavier, &s.m), BAUM_OK);
  other = study_of(&s);
  ASSERT_SAYS(baum_study_run(other), BAUM_ERR_BUFFER, "another study|mechanism");
  baum_study_destroy(other);

  model_pendulum faster = MODEL_PENDULUM_A01;
  faster.v += 1.0;
  model_destroy(&s.m);
  assert_int_equal(model_pendulum_rod(&faster, &s.m), BAUM_OK);
  other = study_of(&s);
  ASSERT_SAYS(baum_study_run(other), BAUM_ERR_BUFFER, "another study|the initial positions, vel");
  baum_study_destroy(other);
  end_scene(&s);
}

/* The ends of lines are those that other systems or editors write. */
static void lines_may_end_as_on_other_systems(void **state)
{
  (void)state;
  scene s = make_scene();
  int first = 0;
  baum_study *want = run_to_the_end(&s, &first);
  char *text = read_file(s.path);
  FILE *stream = fopen(s.path, "w");
  assert_non_null(stream);
  for (const char *at = text; *at; at++) {
    (void)fprintf(stream, *at == '\n' ? "\r\n" : "%c", *at);
  }
  (void)fclose(stream);
  baum_study *got = run_to_the_end(&s, &first);
  assert_same_entries(got, want);
  assert_true(study_entry(got, 0).cpu == study_entry(want, 0).cpu); /* it comes from the file */
  test_free(text);
  baum_study_destroy(got);
  baum_study_destroy(want);
  end_scene(&s);
}

static void a_path_that_is_no_regular_file_is_refused(void **state)
{
  (void)state;
  scene s = make_scene();
  assert_int_equal(remove(s.path), 0);
  assert_int_equal(mkfifo(s.path, 0600), 0);
  baum_study *study = study_of(&s);
  ASSERT_SAYS(baum_study_run(study), BAUM_ERR_FILE, "is not a regular file");
  baum_study_destroy(study);
  end_scene(&s);
}

static void a_missing_folder_is_a_status(void **state)
{
  (void)state;
  scene s = make_scene();
  baum_study_options o = s.options;
  o.file = "/nowhere/at/all";
  baum_study *study = small_study(s.m.mechanism, &o);
  ASSERT_SAYS(baum_study_run(study), BAUM_ERR_FILE, "/nowhere/at/all|cannot be opened");
  baum_study_destroy(study);
  end_scene(&s);
}

/* Runs the study with a limit on the size of files, which simulates a full disk. */
static baum_status run_on_small_disk(baum_study *study, rlim_t size)
{
  struct rlimit before;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  const struct rlimit small = {.rlim_cur = size, .rlim_max = before.rlim_max};
  (void)signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  baum_status status = baum_study_run(study);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
  return status;
}

/* The disk becomes full while the first line, the reference or the errors are written. When there
 * is space again, the missing lines must be written. */
static void a_full_disk_is_a_status_and_loses_nothing(void **state)
{
  (void)state;
  const rlim_t sizes[] = {40, 300, 3000, 6000};
  for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
    scene s = make_scene();
    baum_study *study = study_of(&s);
    ASSERT_SAYS(run_on_small_disk(study, sizes[k]), BAUM_ERR_FILE, "cannot be written");
    assert_non_null(strstr(baum_message(), s.path));
    assert_int_equal(baum_study_run(study), BAUM_OK);
    int first = 0;
    baum_study *again = run_to_the_end(&s, &first);
    assert_int_equal(first, baum_study_entry_count(study) + 1);
    assert_same_entries(again, study);
    assert_true(study_entry(again, 0).cpu == study_entry(study, 0).cpu);
    baum_study_destroy(again);
    baum_study_destroy(study);
    end_scene(&s);
  }
}

static void a_file_that_does_not_reach_the_disk_is_a_status(void **state)
{
  (void)state;
  scene s = make_scene();
  baum_study *study = study_of(&s);
  sync_error = EIO;
  ASSERT_SAYS(baum_study_run(study), BAUM_ERR_FILE, "cannot be written: Input/output error");
  sync_error = 0;
  assert_int_equal(baum_study_run(study), BAUM_OK);
  baum_study_destroy(study);
  end_scene(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_killed_study_goes_on_without_losing_or_doubling_entries),
    cmocka_unit_test(a_complete_file_needs_no_run),
    cmocka_unit_test(a_line_that_is_cut_off_or_damaged_is_run_again),
    cmocka_unit_test(a_file_of_something_else_is_refused_and_left_alone),
    cmocka_unit_test(a_file_of_another_version_is_refused),
    cmocka_unit_test(a_file_of_another_library_is_refused),
    cmocka_unit_test(lines_of_another_study_are_run_again),
    cmocka_unit_test(a_file_of_another_study_is_refused_with_what_differs),
    cmocka_unit_test(lines_may_end_as_on_other_systems),
    cmocka_unit_test(a_path_that_is_no_regular_file_is_refused),
    cmocka_unit_test(a_missing_folder_is_a_status),
    cmocka_unit_test(a_file_that_does_not_reach_the_disk_is_a_status),
    cmocka_unit_test(a_full_disk_is_a_status_and_loses_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
