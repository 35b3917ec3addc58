/* SPDX-License-Identifier: BSD-3-Clause */
/* Files that are written as a whole or not at all. */
#ifndef BAUM_I_BASE_FILE_H
#define BAUM_I_BASE_FILE_H

#include <stddef.h>

#include <baum/status.h>

#include "base/buffer.h"

/* Writes the whole file or nothing, as baum_study_write() describes. */
baum_status baum_i_write_file(const char *path, const char *bytes, size_t size);

/* Appends the whole file to a zeroed buffer, which stays empty on failure. Messages about wrong
 * arguments begin with `call`, the name of the public function. Returns BAUM_OK, BAUM_ERR_ARGUMENT,
 * BAUM_ERR_FILE or BAUM_ERR_MEMORY. */
baum_status baum_i_read_file(const char *path, const char *call, baum_i_buffer *out);

/* The first function copies a whole text to the caller's memory, and the second writes it to a
 * file. Messages about wrong arguments begin with `call`, the name of the public function. The copy
 * is cut after capacity - 1 bytes and ends with a zero byte. *size is set to the length of the
 * whole text, unless `size` is NULL. */
baum_status baum_i_give_text(const baum_i_buffer *whole, const char *call, char *text,
                             size_t capacity, size_t *size);
baum_status baum_i_give_file(const baum_i_buffer *whole, const char *call, const char *path);

#endif
