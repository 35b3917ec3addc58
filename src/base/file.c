/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads whole files, and writes a file completely or not at all. A new file is written in the same
 * folder and then replaces the old file. Only paths that must not be replaced, such as devices and
 * links, are written in place.
 */
#include "base/file.h"

#include <errno.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/platform.h"
#include "base/text.h"

enum { TRIES = 100, NAME = 64, USUAL = 0666 };

static baum_status fail(const char *path, const char *what, int reason)
{
  return baum_i_fail(BAUM_ERR_FILE, "%s: cannot be %s: %s", path, what, strerror(reason));
}

/* Writes bytes and closes the file, even if writing fails. Returns errno of the first failure, or 0
 * if there was none. */
static int write_bytes(FILE *file, const char *bytes, size_t size)
{
  int reason = fwrite(bytes, 1, size, file) == size && fflush(file) == 0 ? 0 : errno;
  if (reason == 0) {
    reason = baum_i_file_sync(file);
  }
  if (fclose(file) != 0 && reason == 0) {
    reason = errno;
  }
  return reason;
}

static baum_status write_in_place(const char *path, const char *bytes, size_t size)
{
  FILE *file = baum_i_file_open(path, "wb");
  int reason = file ? write_bytes(file, bytes, size) : errno;
  return reason ? fail(path, "written", reason) : BAUM_OK;
}

/* Returns the length of the folder part of a path, including its last slash. */
static size_t folder_of(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Creates a file with an unused name in the folder of `path`. */
static FILE *create_part(const char *path, unsigned permissions, char *part, size_t capacity)
{
  FILE *file = NULL;
  errno = EEXIST;
  for (int k = 0; !file && errno == EEXIST && k < TRIES; k++) {
    baum_i_print(part, capacity, "%.*s.baum-%ld-%d.part", (int)folder_of(path), path,
                 baum_i_process_number(), k);
    file = baum_i_file_create(part, permissions);
  }
  return file;
}

/* Writes the new file and replaces the old one. `old` points to the permissions of the old file, or
 * is NULL if there is no old file. `part` is memory for the name of the new file. */
static baum_status replace_file(const char *path, const unsigned *old, const char *bytes,
                                size_t size, char *part, size_t capacity)
{
  FILE *file = create_part(path, old ? *old : USUAL, part, capacity);
  if (!file) {
    return fail(path, "written", errno);
  }
  int reason = old ? baum_i_file_permit(file, *old) : 0;
  int written = write_bytes(file, bytes, size);
  reason = reason ? reason : written;
  baum_status status = reason ? fail(path, "written", reason) : BAUM_OK;
  if (status == BAUM_OK && baum_i_file_replace(part, path) != 0) {
    status = fail(path, "replaced", errno);
  }
  if (status != BAUM_OK) {
    baum_i_file_remove(part);
    return status;
  }
  size_t folder = folder_of(path);
  part[folder] = '\0';
  baum_i_folder_sync(folder ? part : ".");
  return BAUM_OK;
}

baum_status baum_i_write_file(const char *path, const char *bytes, size_t size)
{
  unsigned permissions = 0;
  baum_i_path_kind kind = baum_i_path_read(path, &permissions);
  if (kind == BAUM_I_PATH_OTHER) {
    return write_in_place(path, bytes, size);
  }
  size_t capacity = strlen(path) + NAME;
  char *part = baum_i_alloc(capacity, 1);
  BAUM_I_TRY(baum_i_check_memory(part));
  baum_status status =
    replace_file(path, kind == BAUM_I_PATH_FREE ? NULL : &permissions, bytes, size, part, capacity);
  baum_i_free(part);
  return status;
}

/* ---- reading ---- */

baum_status baum_i_read_file(const char *path, const char *call, baum_i_buffer *out)
{
  if (!path || !path[0]) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: path is NULL or empty", call);
  }
  FILE *file = baum_i_file_open(path, "rb");
  if (!file) {
    return fail(path, "read", errno);
  }
  char bytes[4096];
  size_t count = 0;
  errno = 0;
  do {
    count = fread(bytes, 1, sizeof bytes, file);
    baum_i_put_bytes(out, bytes, count);
  } while (count > 0 && !out->failed);
  baum_status status = ferror(file)  ? fail(path, "read", errno)
                       : out->failed ? baum_i_fail_memory()
                                     : BAUM_OK;
  (void)fclose(file);
  if (status != BAUM_OK) {
    baum_i_buffer_clear(out);
  }
  return status;
}

/* ---- output to callers ---- */

baum_status baum_i_give_text(const baum_i_buffer *whole, const char *call, char *text,
                             size_t capacity, size_t *size)
{
  if (!text && capacity > 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: text is NULL and capacity is not 0", call);
  }
  if (whole->text && capacity > 0) {
    size_t kept = whole->used < capacity ? whole->used : capacity - 1;
    memcpy(text, whole->text, kept);
    text[kept] = '\0';
  }
  if (size) {
    *size = whole->used;
  }
  return BAUM_OK;
}

baum_status baum_i_give_file(const baum_i_buffer *whole, const char *call, const char *path)
{
  if (!path || !path[0]) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: path is NULL or empty", call);
  }
  return baum_i_write_file(path, whole->text, whole->used);
}
