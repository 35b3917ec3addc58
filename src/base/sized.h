/* SPDX-License-Identifier: BSD-3-Clause */
/* Structs that begin with `size_t struct_size`. A caller built with older headers knows fewer
 * fields. It receives only these, and struct_size tells it their size in bytes. */
#ifndef BAUM_I_BASE_SIZED_H
#define BAUM_I_BASE_SIZED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Whether the caller's struct is large enough for at least struct_size. */
bool baum_i_takes_sized(const void *out, size_t caller_size);

/* Fail with BAUM_ERR_ARGUMENT if it is not; the message names the call. */
baum_status baum_i_check_sized(const void *out, size_t caller_size, const char *call);

/* Fail with BAUM_ERR_ARGUMENT unless k is an entry from `first`, the oldest that is kept, to
 * count - 1. */
baum_status baum_i_check_entry(int64_t k, int64_t first, int64_t count, const char *call);

/* Copy as much of a whole struct as the caller knows, and set its struct_size. */
void baum_i_give_sized(void *out, size_t caller_size, const void *whole, size_t size);

#endif
