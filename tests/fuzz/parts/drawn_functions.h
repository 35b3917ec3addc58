/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions of elements of a fuzzer. Their `user` is a design_user or NULL. */
#ifndef BAUM_FUZZ_DRAWN_FUNCTIONS_H
#define BAUM_FUZZ_DRAWN_FUNCTIONS_H

#include <stddef.h>

/* Stores the function for a field of a definition of a kind, as bytes with the size of a pointer to
 * a function. Returns false if the field takes no function. */
int design_function(const char *kind, const char *field, void *out);

#endif
