/* SPDX-License-Identifier: BSD-3-Clause */
/* The user functions of elements that a fuzzer makes. Their `user` is a design_user or NULL. */
#ifndef BAUM_FUZZ_DRAWN_FUNCTIONS_H
#define BAUM_FUZZ_DRAWN_FUNCTIONS_H

#include <stddef.h>

/* Copies the address of the function for a field of a definition to `out`, which has the size of a
 * pointer to a function. Returns false if the field is not a function. */
int design_function(const char *kind, const char *field, void *out);

#endif
