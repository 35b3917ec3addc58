/* SPDX-License-Identifier: BSD-3-Clause */
/* Structs that begin with `size_t struct_size`. A caller built with older headers has a shorter
 * struct. The library fills only the fields that fit, and struct_size is their size in bytes. */
#ifndef BAUM_I_BASE_SIZED_H
#define BAUM_I_BASE_SIZED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Tell whether the caller's struct is large enough to hold struct_size. */
bool baum_i_takes_sized(const void *out, size_t caller_size);

/* Fail with BAUM_ERR_ARGUMENT if the caller's struct is smaller; the message names the call. */
baum_status baum_i_check_sized(const void *out, size_t caller_size, const char *call);

/* Fail with BAUM_ERR_ARGUMENT unless first <= k < count. `first` is the oldest entry that is still
 * stored. */
baum_status baum_i_check_entry(int64_t k, int64_t first, int64_t count, const char *call);

/* Copy as many bytes of a whole struct as fit into the caller's struct, and set its struct_size. */
void baum_i_give_sized(void *out, size_t caller_size, const void *whole, size_t size);

#endif
