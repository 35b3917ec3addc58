/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions of drawn elements; `user` is a design_user or NULL. */
#ifndef BAUM_FUZZ_DRAWN_FUNCTIONS_H
#define BAUM_FUZZ_DRAWN_FUNCTIONS_H

#include <stddef.h>

/* The one that the field of a definition of a kind takes, as bytes (the size of a pointer to a
 * function); false when it takes none. */
int design_function(const char *kind, const char *field, void *out);

#endif
