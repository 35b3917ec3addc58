/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions that operating systems provide and the C library lacks: clocks, locales, files and
 * threads. Only platform.c contains code for particular systems. */
#ifndef BAUM_I_BASE_PLATFORM_H
#define BAUM_I_BASE_PLATFORM_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/message.h"

/* ---- clocks ---- */

/* The first function returns the time of a monotonic clock in ns, and the second returns it in
 * s. */
int64_t baum_i_wall_nanoseconds(void);
double baum_i_wall_seconds(void);

/* Return the CPU time of this thread [s]. Where the system does not measure it, return the time of
 * the monotonic clock. */
double baum_i_thread_seconds(void);

/* Write date and time in UTC, in the form 2026-01-31T12:00:00Z. */
void baum_i_date_read(char *text, size_t size);

/* ---- texts ---- */

/* Like vsnprintf(), but in the "C" locale. */
int baum_i_format(char *text, size_t size, const char *format, va_list arguments)
  BAUM_I_PRINTF(3, 0);

/* ---- files; paths are in UTF-8, and functions that fail set errno ---- */

/* What exists at a path. */
typedef enum baum_i_path_kind {
  BAUM_I_PATH_FREE, /* nothing */
  /* A regular file that belongs to this user and has only one name. Files of other users are not
   * replaced, because the new file would belong to this user. Files with several names are not
   * replaced, because the old file would remain under its other names. */
  BAUM_I_PATH_REPLACEABLE,
  BAUM_I_PATH_OTHER /* for example a device, a pipe or a link */
} baum_i_path_kind;

/* Find out what exists at a path. If a replaceable file exists there, `permissions` is set to its
 * permissions. */
baum_i_path_kind baum_i_path_read(const char *path, unsigned *permissions);

/* Tells whether the path is something other than a regular file, such as a pipe. Returns false if
 * the path does not exist. Links are followed. */
bool baum_i_is_no_file(const char *path);

/* Like fopen(). If "b" is added to the mode "w", "a" or "r", lines end with '\n' on all systems. */
FILE *baum_i_file_open(const char *path, const char *mode);

/* Creates a file for writing. The system may grant fewer permissions than requested. Fails with
 * EEXIST if the path exists. */
FILE *baum_i_file_create(const char *path, unsigned permissions);

/* Sets the permissions of a file. Returns 0, or errno on failure. */
int baum_i_file_permit(FILE *file, unsigned permissions);

/* Writes to the disk what fflush() has passed to the system. Returns 0, or errno on failure. */
int baum_i_file_sync(FILE *file);

/* Renames the file `part` to `path`. If there is already a file at `path`, it is replaced in one
 * step. Returns 0 on success.
 */
int baum_i_file_replace(const char *part, const char *path);
void baum_i_file_remove(const char *path);

/* Writes a folder to the disk, so that the names of new files are stored. A failure is ignored,
 * because the data of the files are not lost. */
void baum_i_folder_sync(const char *folder);

/* Returns a number that no other process has at the same time. On systems without processes,
 * returns a constant. */
long baum_i_process_number(void);

/* ---- threads ---- */

typedef struct baum_i_lock baum_i_lock;

/* Creates a lock. Returns NULL if there is no memory or no lock left. */
baum_i_lock *baum_i_lock_create(void);
void baum_i_lock_destroy(baum_i_lock *lock);
void baum_i_lock_take(baum_i_lock *lock);
void baum_i_lock_give(baum_i_lock *lock);

/* Calls work(user, k) for k = 0 to count - 1. The first call is in this thread, and the other calls
 * are in separate threads. Calls for which no thread can be created are omitted. Returns after all
 * calls have ended. */
void baum_i_threads_run(int count, void (*work)(void *user, int k), void *user);

#endif
