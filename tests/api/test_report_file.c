/* SPDX-License-Identifier: BSD-3-Clause */
/* A file with a report must be written completely or not at all. It must have the mode of the file
 * that it replaces. Other files in the folder must not change. */
#define _GNU_SOURCE /* for mkdtemp and chown */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
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
#include <unistd.h>

#include <cmocka.h>

#include "message.h"
#include "report_scene.h"

enum { PATH = 300, TRIES = 100, OTHER_USER = 65534 };

/* A study for a report, and a temporary folder. */
typedef struct scene {
  report_scene report;
  char folder[PATH / 4];
  char path[PATH / 2];
} scene;

static scene make_scene(void)
{
  scene s = {.report = report_scene_make(), .folder = "/tmp/baum-report-XXXXXX"};
  assert_non_null(s.report.study);
  assert_non_null(mkdtemp(s.folder));
  (void)snprintf(s.path, sizeof s.path, "%s/report.csv", s.folder);
  return s;
}

/* Counts the files in the folder. If `empty` is set, also removes them. */
static int count_files(const scene *s, bool empty)
{
  DIR *folder = opendir(s->folder);
  assert_non_null(folder);
  int count = 0;
  for (const struct dirent *e; (e = readdir(folder)) != NULL;) {
    char path[2 * PATH];
    if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) {
      continue;
    }
    count++;
    (void)snprintf(path, sizeof path, "%s/%s", s->folder, e->d_name);
    assert_true(!empty || remove(path) == 0);
  }
  (void)closedir(folder);
  return count;
}

static void end_scene(scene *s)
{
  (void)count_files(s, true);
  (void)rmdir(s->folder);
  report_scene_end(&s->report);
}

static int syncs;
static int sync_error;

/* Replaces the system's fsync() in this program. It counts the calls, and tests can let it fail. */
int fsync(int descriptor)
{
  (void)descriptor;
  syncs++;
  errno = sync_error;
  return sync_error ? -1 : 0;
}

static baum_status write_report(const scene *s)
{
  return baum_study_write(s->report.study, BAUM_REPORT_CSV, NULL, s->path);
}

static void make_file(const char *path, const char *text)
{
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  assert_true(fputs(text, file) >= 0);
  assert_int_equal(fclose(file), 0);
}

static struct stat look_at(const char *path)
{
  struct stat found;
  assert_int_equal(lstat(path, &found), 0);
  return found;
}

static bool file_is(const char *path, const char *want)
{
  static char text[1 << 20];
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  (void)fclose(file);
  return strcmp(text, want) == 0;
}

static bool has_report(const scene *s, const char *path)
{
  static char text[1 << 20];
  assert_int_equal(
    baum_study_print(s->report.study, BAUM_REPORT_CSV, NULL, text, sizeof text, NULL), BAUM_OK);
  return file_is(path, text);
}

static void a_file_has_what_is_printed_and_obeys_the_umask(void **state)
{
  (void)state;
  scene s = make_scene();
  mode_t before = umask(027);
  assert_int_equal(write_report(&s), BAUM_OK);
  (void)umask(before);
  assert_true(has_report(&s, s.path));
  assert_int_equal(look_at(s.path).st_mode & 07777, 0640);
  assert_int_equal(count_files(&s, false), 1);
  end_scene(&s);
}

static void a_report_has_the_mode_of_the_file_it_replaces(void **state)
{
  (void)state;
  const mode_t modes[] = {0600, 0444, 0666, 0750};
  scene s = make_scene();
  make_file(s.path, "old");
  for (size_t k = 0; k < sizeof modes / sizeof modes[0]; k++) {
    ino_t old = look_at(s.path).st_ino;
    assert_int_equal(chmod(s.path, modes[k]), 0);
    assert_int_equal(write_report(&s), BAUM_OK);
    assert_true(has_report(&s, s.path));
    assert_int_equal(look_at(s.path).st_mode & 07777, modes[k]);
    assert_int_not_equal(look_at(s.path).st_ino, old);
  }
  assert_int_equal(count_files(&s, false), 1);
  end_scene(&s);
}

static void hard_links_and_symbolic_links_stay_links(void **state)
{
  (void)state;
  scene s = make_scene();
  char other[PATH];
  (void)snprintf(other, sizeof other, "%s/other", s.folder);
  make_file(other, "old");
  assert_int_equal(link(other, s.path), 0);
  assert_int_equal(write_report(&s), BAUM_OK);
  assert_int_equal(look_at(other).st_ino, look_at(s.path).st_ino);
  assert_true(has_report(&s, other));
  assert_int_equal(remove(s.path), 0);
  make_file(other, "old");
  assert_int_equal(symlink(other, s.path), 0);
  assert_int_equal(write_report(&s), BAUM_OK);
  assert_true(S_ISLNK(look_at(s.path).st_mode));
  assert_true(has_report(&s, other));
  end_scene(&s);
}

static void a_file_of_another_owner_keeps_that_owner(void **state)
{
  (void)state;
  if (geteuid() != 0) {
    skip();
  }
  scene s = make_scene();
  make_file(s.path, "old");
  assert_int_equal(chown(s.path, OTHER_USER, OTHER_USER), 0);
  assert_int_equal(write_report(&s), BAUM_OK);
  assert_int_equal(look_at(s.path).st_uid, OTHER_USER);
  assert_true(has_report(&s, s.path));
  end_scene(&s);
}

/* The folder already contains files of other programs. One of them has the name of the report with
 * ".part" at its end. The others have names that the library gives to temporary files. */
static void files_of_others_are_not_touched(void **state)
{
  (void)state;
  scene s = make_scene();
  char others[TRIES][PATH];
  for (int k = 0; k < TRIES; k++) {
    (void)snprintf(others[k], PATH, "%s/.baum-%ld-%d.part", s.folder, (long)getpid(), k);
  }
  (void)snprintf(others[TRIES - 1], PATH, "%s.part", s.path);
  for (int k = 0; k < TRIES; k++) {
    make_file(others[k], "foreign");
  }
  make_file(s.path, "old");
  assert_int_equal(write_report(&s), BAUM_OK);
  assert_int_equal(count_files(&s, false), TRIES + 1);
  char last[PATH];
  (void)snprintf(last, sizeof last, "%s/.baum-%ld-%d.part", s.folder, (long)getpid(), TRIES - 1);
  make_file(last, "foreign");
  ASSERT_SAYS(write_report(&s), BAUM_ERR_FILE, "report.csv: cannot be written: File exists");
  assert_true(has_report(&s, s.path));
  for (int k = 0; k < TRIES; k++) {
    assert_true(file_is(others[k], "foreign"));
  }
  end_scene(&s);
}

static void a_path_without_a_folder_is_in_the_current_folder(void **state)
{
  (void)state;
  scene s = make_scene();
  char before[PATH];
  assert_non_null(getcwd(before, sizeof before));
  assert_int_equal(chdir(s.folder), 0);
  assert_int_equal(baum_study_write(s.report.study, BAUM_REPORT_CSV, NULL, "report.csv"), BAUM_OK);
  assert_int_equal(chdir(before), 0);
  assert_true(has_report(&s, s.path));
  assert_int_equal(count_files(&s, false), 1);
  end_scene(&s);
}

static void a_full_disk_is_reported_and_a_device_is_not_replaced(void **state)
{
  (void)state;
  struct stat found;
  if (stat("/dev/full", &found) != 0) {
    skip();
  }
  scene s = make_scene();
  for (int form = BAUM_REPORT_TEXT; form <= BAUM_REPORT_PAGE; form++) {
    ASSERT_SAYS(baum_study_write(s.report.study, (baum_report_form)form, NULL, "/dev/full"),
                BAUM_ERR_FILE, "/dev/full|written|No space left");
  }
  assert_int_equal(baum_study_write(s.report.study, BAUM_REPORT_CSV, NULL, "/dev/null"), BAUM_OK);
  assert_true(S_ISCHR(look_at("/dev/full").st_mode));
  end_scene(&s);
}

/* A limit on the size of files simulates a disk that becomes full while the report is written. */
static void a_failed_write_leaves_the_older_file_and_no_other(void **state)
{
  (void)state;
  scene s = make_scene();
  make_file(s.path, "old");
  struct rlimit before;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  const struct rlimit little = {.rlim_cur = 4096, .rlim_max = before.rlim_max};
  void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);
  baum_status status = baum_study_write(s.report.study, BAUM_REPORT_PAGE, NULL, s.path);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
  (void)signal(SIGXFSZ, handler);
  ASSERT_SAYS(status, BAUM_ERR_FILE, "report.csv|written|too large");
  assert_true(file_is(s.path, "old"));
  assert_int_equal(count_files(&s, false), 1);
  end_scene(&s);
}

static void file_and_folder_are_on_the_disk_before_the_call_returns(void **state)
{
  (void)state;
  scene s = make_scene();
  make_file(s.path, "old");
  sync_error = EIO;
  ASSERT_SAYS(write_report(&s), BAUM_ERR_FILE, "report.csv: cannot be written: Input/output error");
  assert_true(file_is(s.path, "old"));
  assert_int_equal(count_files(&s, false), 1);
  sync_error = 0;
  syncs = 0;
  assert_int_equal(write_report(&s), BAUM_OK);
  assert_int_equal(syncs, 2);
  sync_error = EINVAL; /* the error of fsync() for pipes */
  assert_int_equal(baum_study_write(s.report.study, BAUM_REPORT_CSV, NULL, "/dev/null"), BAUM_OK);
  sync_error = 0;
  end_scene(&s);
}

static void a_missing_folder_is_reported(void **state)
{
  (void)state;
  scene s = make_scene();
  ASSERT_SAYS(baum_study_write(s.report.study, BAUM_REPORT_PAGE, NULL, "no/such/folder.html"),
              BAUM_ERR_FILE, "no/such/folder.html: cannot be written: No such file");
  end_scene(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_file_has_what_is_printed_and_obeys_the_umask),
    cmocka_unit_test(a_report_has_the_mode_of_the_file_it_replaces),
    cmocka_unit_test(hard_links_and_symbolic_links_stay_links),
    cmocka_unit_test(a_file_of_another_owner_keeps_that_owner),
    cmocka_unit_test(files_of_others_are_not_touched),
    cmocka_unit_test(a_path_without_a_folder_is_in_the_current_folder),
    cmocka_unit_test(a_full_disk_is_reported_and_a_device_is_not_replaced),
    cmocka_unit_test(a_failed_write_leaves_the_older_file_and_no_other),
    cmocka_unit_test(file_and_folder_are_on_the_disk_before_the_call_returns),
    cmocka_unit_test(a_missing_folder_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
