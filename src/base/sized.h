/* SPDX-License-Identifier: BSD-3-Clause */
/* Public structs begin with the member `size_t struct_size`. A caller built with older headers has
 * a shorter struct. The library fills only the fields that fit into the caller's struct, and sets
 * its struct_size to the number of bytes that it has filled. */
#ifndef BAUM_I_BASE_SIZED_H
#define BAUM_I_BASE_SIZED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Tell whether the caller's struct is not NULL and is large enough to hold struct_size. */
bool baum_i_takes_sized(const void *out, size_t caller_size);

/* Fail with BAUM_ERR_ARGUMENT if the caller's struct is NULL or too small to hold struct_size. The
 * message names the call. */
baum_status baum_i_check_sized(const void *out, size_t caller_size, const char *call);

/* Fail with BAUM_ERR_ARGUMENT unless first <= k < count. `first` is the oldest entry that is still
 * stored. */
baum_status baum_i_check_entry(int64_t k, int64_t first, int64_t count, const char *call);

/* Check `size`, the struct_size of a caller's struct. It must be `present`, which is the size in
 * this version, or a possible size in an older version. Sizes in older versions are multiples of
 * sizeof(size_t) and have room for at least two fields. Messages contain the texts `of` and
 * `start`. `of` names the struct, for example " of the options", or is "". `start` names the call
 * that sets the defaults. */
baum_status baum_i_check_struct_size(size_t size, size_t present, const char *call, const char *of,
                                     const char *start);

/* Check a caller's struct and copy it to `to`. The caller of this function has filled `to` with the
 * defaults. Fields that the struct of an older version does not have keep their defaults. */
baum_status baum_i_take_sized(void *to, size_t size, const void *from, const char *call,
                              const char *of, const char *start);

/* Copy as many bytes of the struct `whole` as fit into the caller's struct, and set the caller's
 * struct_size to the number of copied bytes. Does nothing if the caller's struct is NULL or too
 * small to hold struct_size. */
void baum_i_give_sized(void *out, size_t caller_size, const void *whole, size_t size);

#endif
