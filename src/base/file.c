/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes a file completely or not at all: writes a new file in the same folder and then replaces
 * the old file by it.
 */
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/alloc.h"
#include "base/message.h"

enum { TRIES = 100, NAME = 64 };

bool baum_i_is_no_file(const char *path)
{
  struct stat found;
  return stat(path, &found) == 0 && !S_ISREG(found.st_mode);
}

static baum_status fail(const char *path, const char *what, int reason)
{
  return baum_i_fail(BAUM_ERR_FILE, "%s: cannot be %s: %s", path, what, strerror(reason));
}

/* Tells whether a file may be replaced. Replacing would destroy devices, pipes and links, and would
 * change the owner of a file or separate it from its other hard links. */
static bool is_replaceable(const struct stat *found)
{
  return S_ISREG(found->st_mode) && found->st_nlink == 1 && found->st_uid == geteuid();
}

int baum_i_sync_file(FILE *file)
{
  /* Devices and pipes do not support fsync(). */
  bool done = fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS;
  return done ? 0 : errno;
}

/* Writes bytes and closes the file in every case. Returns errno of the first failure, or 0. */
static int write_bytes(FILE *file, const char *bytes, size_t size)
{
  int reason = fwrite(bytes, 1, size, file) == size && fflush(file) == 0 ? 0 : errno;
  if (reason == 0) {
    reason = baum_i_sync_file(file);
  }
  if (fclose(file) != 0 && reason == 0) {
    reason = errno;
  }
  return reason;
}

static baum_status write_in_place(const char *path, const char *bytes, size_t size)
{
  FILE *file = fopen(path, "w");
  int reason = file ? write_bytes(file, bytes, size) : errno;
  return reason ? fail(path, "written", reason) : BAUM_OK;
}

/* Creates a file with an unused name in the folder of `path`, which is its first `folder`
 * characters. */
static FILE *create_part(const char *path, size_t folder, mode_t mode, char *part, size_t capacity)
{
  for (int k = 0; k < TRIES; k++) {
    (void)snprintf(part, capacity, "%.*s.baum-%ld-%d.part", (int)folder, path, (long)getpid(), k);
    int descriptor = open(part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor >= 0) {
      return fdopen(descriptor, "w");
    }
    if (errno != EEXIST) {
      break;
    }
  }
  return NULL;
}

/* Writes the folder, which contains the new name, to the disk. A failure is ignored, because no
 * data are lost. */
static void sync_folder(const char *folder)
{
  int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    (void)fsync(descriptor);
    (void)close(descriptor);
  }
}

/* Writes the new file and replaces the old one. `old` describes the old file, or is NULL if there
 * is none. `part` is memory for the name of the new file. */
static baum_status replace_file(const char *path, const struct stat *old, const char *bytes,
                                size_t size, char *part, size_t capacity)
{
  const char *slash = strrchr(path, '/');
  size_t folder = slash ? (size_t)(slash - path) + 1 : 0;
  mode_t mode = old ? old->st_mode & 07777 : 0666;
  FILE *file = create_part(path, folder, mode, part, capacity);
  if (!file) {
    return fail(path, "written", errno);
  }
  int reason = old && fchmod(fileno(file), mode) != 0 ? errno : 0; /* open() has applied the
                                                                    * umask */
  int written = write_bytes(file, bytes, size);
  reason = reason ? reason : written;
  baum_status status = reason ? fail(path, "written", reason) : BAUM_OK;
  if (status == BAUM_OK && rename(part, path) != 0) {
    status = fail(path, "replaced", errno);
  }
  if (status != BAUM_OK) {
    (void)remove(part);
    return status;
  }
  part[folder] = '\0';
  sync_folder(folder ? part : ".");
  return BAUM_OK;
}

baum_status baum_i_write_file(const char *path, const char *bytes, size_t size)
{
  struct stat found;
  bool exists = lstat(path, &found) == 0;
  if (exists && !is_replaceable(&found)) {
    return write_in_place(path, bytes, size);
  }
  size_t capacity = strlen(path) + NAME;
  char *part = baum_i_alloc(capacity, 1);
  BAUM_I_TRY(baum_i_check_memory(part));
  baum_status status = replace_file(path, exists ? &found : NULL, bytes, size, part, capacity);
  baum_i_free(part);
  return status;
}

/* ---- what callers receive ---- */

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
