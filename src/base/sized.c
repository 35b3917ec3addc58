/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/sized.h"

#include <string.h>

#include "base/message.h"

bool baum_i_takes_sized(const void *out, size_t caller_size)
{
  return out && caller_size >= sizeof(size_t);
}

baum_status baum_i_check_sized(const void *out, size_t caller_size, const char *call)
{
  if (!baum_i_takes_sized(out, caller_size)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: out is NULL or caller_size is too small", call);
  }
  return BAUM_OK;
}

baum_status baum_i_check_entry(int64_t k, int64_t first, int64_t count, const char *call)
{
  if (first >= count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: k is %lld, but there are no entries", call,
                       (long long)k);
  }
  if (k < first || k >= count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: k is %lld, must be from %lld to %lld%s", call,
                       (long long)k, (long long)first, (long long)count - 1,
                       first > 0 ? "; earlier entries are no longer kept" : "");
  }
  return BAUM_OK;
}

baum_status baum_i_check_struct_size(size_t size, size_t present, const char *call, const char *of,
                                     const char *start)
{
  bool fits = size >= 2 * sizeof size && size <= present && size % sizeof size == 0;
  return fits
           ? BAUM_OK
           : baum_i_fail(
               BAUM_ERR_STRUCT,
               "%s: struct_size%s is %zu, must be %zu, or the size in an older version; start from "
               "%s",
               call, of, size, present, start);
}

baum_status baum_i_take_sized(void *to, size_t size, const void *from, const char *call,
                              const char *of, const char *start)
{
  size_t given = 0;
  memcpy(&given, from, sizeof given);
  BAUM_I_TRY(baum_i_check_struct_size(given, size, call, of, start));
  memcpy(to, from, given);
  memcpy(to, &size, sizeof size);
  return BAUM_OK;
}

void baum_i_give_sized(void *out, size_t caller_size, const void *whole, size_t size)
{
  size_t bytes = caller_size < size ? caller_size : size;
  if (baum_i_takes_sized(out, caller_size)) {
    memcpy(out, whole, bytes);
    memcpy(out, &bytes, sizeof bytes);
  }
}
