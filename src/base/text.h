/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts that grow piece by piece. */
#ifndef BAUM_I_BASE_TEXT_H
#define BAUM_I_BASE_TEXT_H

#include <stddef.h>

#include "base/message.h"

/* Append to a zero-terminated text in a buffer of `size` characters; what does not fit is cut. */
void baum_i_append(char *text, size_t size, const char *format, ...) BAUM_I_PRINTF(3, 4);

#endif
