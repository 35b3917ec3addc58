/* SPDX-License-Identifier: BSD-3-Clause */
/* Structs that begin with `size_t struct_size`. A caller built with older headers knows fewer
 * fields: it gets these and reads in struct_size how many bytes they are. */
#ifndef BAUM_I_BASE_SIZED_H
#define BAUM_I_BASE_SIZED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Can something be given there? */
bool baum_i_takes_sized(const void *out, size_t caller_size);

/* BAUM_ERR_ARGUMENT where not, said of this call. */
baum_status baum_i_check_sized(const void *out, size_t caller_size, const char *call);

/* BAUM_ERR_ARGUMENT where k is none of the entries from `first`, the oldest that is kept, up to
 * count - 1. */
baum_status baum_i_check_entry(int64_t k, int64_t first, int64_t count, const char *call);

/* As much of a whole struct as the caller knows; its struct_size is set. */
void baum_i_give_sized(void *out, size_t caller_size, const void *whole, size_t size);

#endif
