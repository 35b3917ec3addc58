/* SPDX-License-Identifier: BSD-3-Clause */
/* A file that is there as a whole or not at all: it is written beside the old one, which it then replaces. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/alloc.h"
#include "study/report.h"

bool baum_i_is_no_file(const char *path)
{
  struct stat found;
  return stat(path, &found) == 0 && !S_ISREG(found.st_mode);
}

static baum_status fail(const char *path, const char *what, int reason)
{
  return baum_i_fail(BAUM_ERR_FILE, "%s: cannot be %s: %s", path, what, strerror(reason));
}

/* Devices, pipes and links are not to be replaced. */
static bool is_special(const char *path)
{
  struct stat found;
  return lstat(path, &found) == 0 && !S_ISREG(found.st_mode);
}

/* Into the file itself or, exclusively, the one beside it; sentences name the one that was asked for. */
static baum_status write_bytes(const char *into, const char *mode, const char *path,
                               const char *bytes, size_t size)
{
  FILE *file = fopen(into, mode);
  if (!file) {
    return fail(path, "written", errno);
  }
  int reason = fwrite(bytes, 1, size, file) == size && fflush(file) == 0 ? 0 : errno;
  if (fclose(file) != 0 && reason == 0) {
    reason = errno;
  }
  return reason ? fail(path, "written", reason) : BAUM_OK;
}

/* Exclusively, so that nothing else is followed or overwritten there; what a program that was killed has left is removed. */
static baum_status write_part(const char *part, const char *path, const char *bytes, size_t size)
{
  (void)remove(part);
  baum_status status = write_bytes(part, "wx", path, bytes, size);
  if (status == BAUM_OK && rename(part, path) != 0) {
    status = fail(path, "replaced", errno);
  }
  if (status != BAUM_OK) {
    (void)remove(part);
  }
  return status;
}

baum_status baum_i_write_file(const char *path, const char *bytes, size_t size)
{
  if (is_special(path)) {
    return write_bytes(path, "w", path, bytes, size);
  }
  size_t length = strlen(path) + sizeof ".part";
  char *part = baum_i_alloc(length, 1);
  if (!part) {
    return baum_i_fail_memory();
  }
  (void)snprintf(part, length, "%s.part", path);
  baum_status status = write_part(part, path, bytes, size);
  baum_i_free(part);
  return status;
}
