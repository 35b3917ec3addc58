/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions of the operating system. Most code is for POSIX. Two systems differ. On Windows, mingw
 * provides the clocks and threads of POSIX, but file names are in UTF-16. WASI has one thread in
 * one process of one user. */
#include "base/platform.h"

#include <errno.h>
#include <locale.h>
#include <pthread.h>
#include <string.h>
#include <time.h>

#ifdef _WIN32
#include <io.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include "base/alloc.h"

/* ---- clocks ---- */

/* WASI has no clock for the CPU time of a thread, and the thread clock of Windows advances in steps
 * of 1/64 s. */
#if defined(__wasi__) || defined(_WIN32)
#undef CLOCK_THREAD_CPUTIME_ID
#define CLOCK_THREAD_CPUTIME_ID CLOCK_MONOTONIC
#endif

static int64_t nanoseconds(clockid_t clock)
{
  struct timespec now = {0};
  (void)clock_gettime(clock, &now);
  return (int64_t)now.tv_sec * 1000000000 + (int64_t)now.tv_nsec;
}

int64_t baum_i_wall_nanoseconds(void)
{
  return nanoseconds(CLOCK_MONOTONIC);
}

double baum_i_wall_seconds(void)
{
  return 1e-9 * (double)nanoseconds(CLOCK_MONOTONIC);
}

double baum_i_thread_seconds(void)
{
  return 1e-9 * (double)nanoseconds(CLOCK_THREAD_CPUTIME_ID);
}

void baum_i_date_read(char *text, size_t size)
{
  time_t now = time(NULL);
  struct tm parts;
  if (!gmtime_r(&now, &parts) || strftime(text, size, "%Y-%m-%dT%H:%M:%SZ", &parts) == 0) {
    (void)snprintf(text, size, "not known");
  }
}

/* ---- texts: only the calling thread has the "C" locale, and only while it formats ---- */

#ifdef _WIN32

int baum_i_format(char *text, size_t size, const char *format, va_list arguments)
{
  _locale_t plain = _create_locale(LC_ALL, "C"); /* if NULL, the program's locale is used */
  int length = __stdio_common_vsprintf(_CRT_INTERNAL_PRINTF_STANDARD_SNPRINTF_BEHAVIOR, text, size,
                                       format, plain, arguments);
  _free_locale(plain);
  return length;
}

#else

int baum_i_format(char *text, size_t size, const char *format, va_list arguments)
{
  /* NULL when out of memory; then the program's locale is used */
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  locale_t before = plain ? uselocale(plain) : (locale_t)0;
  int length = vsnprintf(text, size, format, arguments);
  if (plain) {
    (void)uselocale(before);
    freelocale(plain);
  }
  return length;
}

#endif

/* ---- files ---- */

#ifdef _WIN32

/* Returns the path in UTF-16. On failure returns NULL and sets errno. */
static wchar_t *widen(const char *path)
{
  int size = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, NULL, 0);
  wchar_t *wide = size > 0 ? baum_i_alloc((size_t)size, sizeof *wide) : NULL;
  errno = size > 0 ? ENOMEM : EILSEQ;
  if (wide) {
    (void)MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, size);
  }
  return wide;
}

static DWORD attributes_of(const char *path)
{
  wchar_t *wide = widen(path);
  DWORD attributes = wide ? GetFileAttributesW(wide) : INVALID_FILE_ATTRIBUTES;
  baum_i_free(wide);
  return attributes;
}

baum_i_path_kind baum_i_path_read(const char *path, unsigned *permissions)
{
  const DWORD other =
    FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_DEVICE | FILE_ATTRIBUTE_REPARSE_POINT;
  DWORD attributes = attributes_of(path);
  *permissions = 0;
  if (attributes == INVALID_FILE_ATTRIBUTES) {
    return BAUM_I_PATH_FREE;
  }
  return attributes & other ? BAUM_I_PATH_OTHER : BAUM_I_PATH_REPLACEABLE;
}

bool baum_i_is_no_file(const char *path)
{
  DWORD attributes = attributes_of(path);
  return attributes != INVALID_FILE_ATTRIBUTES &&
         (attributes & (FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_DEVICE)) != 0;
}

FILE *baum_i_file_open(const char *path, const char *mode)
{
  wchar_t *wide = widen(path);
  wchar_t *wide_mode = wide ? widen(mode) : NULL;
  FILE *file = wide_mode ? _wfopen(wide, wide_mode) : NULL;
  baum_i_free(wide_mode);
  baum_i_free(wide);
  return file;
}

FILE *baum_i_file_create(const char *path, unsigned permissions)
{
  (void)permissions;
  return baum_i_file_open(path, "wbx");
}

int baum_i_file_permit(FILE *file, unsigned permissions)
{
  (void)file;
  (void)permissions;
  return 0;
}

int baum_i_file_sync(FILE *file)
{
  /* EINVAL or EBADF: a device or a pipe */
  bool done = _commit(_fileno(file)) == 0 || errno == EINVAL || errno == EBADF;
  return done ? 0 : errno;
}

int baum_i_file_replace(const char *part, const char *path)
{
  wchar_t *from = widen(part);
  wchar_t *to = from ? widen(path) : NULL;
  int failure = to ? 0 : -1;
  if (to && !MoveFileExW(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH)) {
    errno = EACCES;
    failure = -1;
  }
  baum_i_free(to);
  baum_i_free(from);
  return failure;
}

void baum_i_file_remove(const char *path)
{
  wchar_t *wide = widen(path);
  if (wide) {
    (void)_wremove(wide);
  }
  baum_i_free(wide);
}

void baum_i_folder_sync(const char *folder)
{
  (void)folder; /* MOVEFILE_WRITE_THROUGH has already written the folder to the disk */
}

long baum_i_process_number(void)
{
  return (long)GetCurrentProcessId();
}

#else

#ifdef __wasi__
#define getpid()                 0
#define geteuid()                0
#define fchmod(descriptor, mode) ((void)(descriptor), (void)(mode), 0)
#endif

baum_i_path_kind baum_i_path_read(const char *path, unsigned *permissions)
{
  struct stat found;
  *permissions = 0;
  if (lstat(path, &found) != 0) {
    return BAUM_I_PATH_FREE;
  }
  *permissions = (unsigned)found.st_mode & 07777u;
  bool is_replaceable = S_ISREG(found.st_mode) && found.st_nlink == 1 && found.st_uid == geteuid();
  return is_replaceable ? BAUM_I_PATH_REPLACEABLE : BAUM_I_PATH_OTHER;
}

bool baum_i_is_no_file(const char *path)
{
  struct stat found;
  return stat(path, &found) == 0 && !S_ISREG(found.st_mode);
}

FILE *baum_i_file_open(const char *path, const char *mode)
{
  return fopen(path, mode);
}

FILE *baum_i_file_create(const char *path, unsigned permissions)
{
  int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, (mode_t)permissions);
  FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
  if (descriptor >= 0 && !file) { /* out of memory */
    (void)close(descriptor);
    (void)remove(path);
    errno = ENOMEM;
  }
  return file;
}

int baum_i_file_permit(FILE *file, unsigned permissions)
{
  return fchmod(fileno(file), (mode_t)permissions) == 0 ? 0 : errno;
}

int baum_i_file_sync(FILE *file)
{
  /* EINVAL or EROFS: a device or a pipe */
  bool done = fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS;
  return done ? 0 : errno;
}

int baum_i_file_replace(const char *part, const char *path)
{
  return rename(part, path);
}

void baum_i_file_remove(const char *path)
{
  (void)unlink(path);
}

void baum_i_folder_sync(const char *folder)
{
  int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    (void)fsync(descriptor);
    (void)close(descriptor);
  }
}

long baum_i_process_number(void)
{
  return (long)getpid();
}

#endif

/* ---- threads ---- */

struct baum_i_lock {
  pthread_mutex_t mutex;
};

baum_i_lock *baum_i_lock_create(void)
{
  baum_i_lock *lock = baum_i_alloc(1, sizeof *lock);
  bool is_ready = lock && pthread_mutex_init(&lock->mutex, NULL) == 0;
  if (!is_ready) {
    baum_i_free(lock);
    return NULL;
  }
  return lock;
}

void baum_i_lock_destroy(baum_i_lock *lock)
{
  (void)pthread_mutex_destroy(&lock->mutex);
  baum_i_free(lock);
}

void baum_i_lock_take(baum_i_lock *lock)
{
  (void)pthread_mutex_lock(&lock->mutex);
}

void baum_i_lock_give(baum_i_lock *lock)
{
  (void)pthread_mutex_unlock(&lock->mutex);
}

typedef struct worker {
  pthread_t thread;
  void (*work)(void *user, int k);
  void *user;
  int k;
  bool is_running;
} worker;

static void *start(void *self)
{
  worker *w = self;
  w->work(w->user, w->k);
  return NULL;
}

void baum_i_threads_run(int count, void (*work)(void *user, int k), void *user)
{
  worker *workers = baum_i_alloc((size_t)count, sizeof *workers);
  for (int k = 1; workers && k < count; k++) {
    workers[k] = (worker){.work = work, .user = user, .k = k};
    workers[k].is_running = pthread_create(&workers[k].thread, NULL, start, &workers[k]) == 0;
  }
  work(user, 0);
  for (int k = 1; workers && k < count; k++) {
    if (workers[k].is_running) {
      (void)pthread_join(workers[k].thread, NULL);
    }
  }
  baum_i_free(workers);
}
