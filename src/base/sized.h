/* SPDX-License-Identifier: BSD-3-Clause */
/* Structs that begin with `size_t struct_size`. A caller built with older headers knows fewer
 * fields. It receives these, and struct_size tells it how many bytes they are. */
#ifndef BAUM_I_BASE_SIZED_H
#define BAUM_I_BASE_SIZED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Whether the caller's struct has room for struct_size at least. */
bool baum_i_takes_sized(const void *out, size_t caller_size);

/* Fail with BAUM_ERR_ARGUMENT where it has not; the message names the call. */
baum_status baum_i_check_sized(const void *out, size_t caller_size, const char *call);

/* Fail with BAUM_ERR_ARGUMENT unless k is an entry from `first`, the oldest that is kept, to
 * count - 1. */
baum_status baum_i_check_entry(int64_t k, int64_t first, int64_t count, const char *call);

/* Copy as much of a whole struct as the caller knows, and set its struct_size. */
void baum_i_give_sized(void *out, size_t caller_size, const void *whole, size_t size);

#endif
