/* SPDX-License-Identifier: BSD-3-Clause */
/* Appends SVG pictures to larger texts. */
#ifndef BAUM_I_DRAW_PICTURE_H
#define BAUM_I_DRAW_PICTURE_H

#include <baum/mechanism.h>

#include "base/buffer.h"

/* Append the picture that baum_mechanism_svg() writes. Messages begin with `call`, the name of the
 * public function. */
baum_status baum_i_put_svg(const baum_mechanism *mechanism, const double *q, const char *call,
                           baum_i_buffer *out);

#endif
