/* SPDX-License-Identifier: BSD-3-Clause */
/* Files that are written as a whole or not at all. */
#ifndef BAUM_I_BASE_FILE_H
#define BAUM_I_BASE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <baum/status.h>

#include "base/buffer.h"

/* Tells whether the path is something other than a regular file, such as a pipe. False if it does
 * not exist. Links are followed. */
bool baum_i_is_no_file(const char *path);

/* Writes the whole file or nothing, see baum_study_write(). */
baum_status baum_i_write_file(const char *path, const char *bytes, size_t size);

/* Writes flushed data to the disk. Returns 0, or errno on failure. */
int baum_i_sync_file(FILE *file);

/* Give a whole text to a caller, in memory or as a file; `call` begins the messages. In memory, the
 * text is zero-terminated and cut after capacity - 1 bytes. *size, unless NULL, is set to the whole
 * length. */
baum_status baum_i_give_text(const baum_i_buffer *whole, const char *call, char *text,
                             size_t capacity, size_t *size);
baum_status baum_i_give_file(const baum_i_buffer *whole, const char *call, const char *path);

#endif
