/* SPDX-License-Identifier: BSD-3-Clause */
/* Everything that the C library lacks and operating systems provide: clocks, locales, files,
 * threads. Only platform.c knows the systems. */
#ifndef BAUM_I_BASE_PLATFORM_H
#define BAUM_I_BASE_PLATFORM_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/message.h"

/* ---- clocks ---- */

/* Monotonic clock [ns] and [s]. */
int64_t baum_i_wall_nanoseconds(void);
double baum_i_wall_seconds(void);

/* CPU time of this thread [s]; monotonic clock where the system does not measure it. */
double baum_i_thread_seconds(void);

/* Date and time in UTC, as in 2026-01-31T12:00:00Z. */
void baum_i_date_read(char *text, size_t size);

/* ---- texts ---- */

/* Like vsnprintf(), but in the "C" locale. */
int baum_i_format(char *text, size_t size, const char *format, va_list arguments)
  BAUM_I_PRINTF(3, 0);

/* ---- files; paths are UTF-8, failures set errno ---- */

/* What a path names. */
typedef enum baum_i_path_kind {
  BAUM_I_PATH_FREE,        /* nothing */
  BAUM_I_PATH_REPLACEABLE, /* a regular file that replacing neither detaches from other names nor
                              gives to another owner */
  BAUM_I_PATH_OTHER        /* for example a device, a pipe or a link */
} baum_i_path_kind;

/* If the path is replaceable, `permissions` are those of the file. */
baum_i_path_kind baum_i_path_read(const char *path, unsigned *permissions);

/* Tells whether the path is something other than a regular file, such as a pipe. False if it does
 * not exist. Links are followed. */
bool baum_i_is_no_file(const char *path);

/* Like fopen(). Mode "w", "a" or "r" with "b": lines end with '\n' on all systems. */
FILE *baum_i_file_open(const char *path, const char *mode);

/* Creates a file for writing, whose permissions the process may restrict. Fails with EEXIST if the
 * path exists. */
FILE *baum_i_file_create(const char *path, unsigned permissions);

/* Sets the permissions. Returns 0, or errno on failure. */
int baum_i_file_permit(FILE *file, unsigned permissions);

/* Writes flushed data to the disk. Returns 0, or errno on failure. */
int baum_i_file_sync(FILE *file);

/* Gives the file `part` the name `path`, whose file it replaces in one step. Returns 0 on success.
 */
int baum_i_file_replace(const char *part, const char *path);
void baum_i_file_remove(const char *path);

/* Writes a folder, which contains new names, to the disk. A failure is ignored, because no data are
 * lost. */
void baum_i_folder_sync(const char *folder);

/* A number that no other process has at the same time, if the system has processes. */
long baum_i_process_number(void);

/* ---- threads ---- */

typedef struct baum_i_lock baum_i_lock;

/* Returns NULL if memory or locks are exhausted. */
baum_i_lock *baum_i_lock_create(void);
void baum_i_lock_destroy(baum_i_lock *lock);
void baum_i_lock_take(baum_i_lock *lock);
void baum_i_lock_give(baum_i_lock *lock);

/* Calls work(user, k) for k = 0 to count - 1. The first call is in this thread, the others are in
 * separate threads. Calls for which no thread can be created are omitted. Returns after all calls
 * have ended. */
void baum_i_threads_run(int count, void (*work)(void *user, int k), void *user);

#endif
