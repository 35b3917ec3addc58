/* SPDX-License-Identifier: BSD-3-Clause */
/* A small mechanism for the tests of drawings, pictures and pages. */
#ifndef BAUM_TEST_SUPPORT_DRAWN_CRANK_H
#define BAUM_TEST_SUPPORT_DRAWN_CRANK_H

#include <baum/baum.h>

/* The name of the wheel. It contains tags, quotes, a backslash, and letters that are written from
 * right to left. */
extern const char DRAWN_HOSTILE[];

baum_body_id drawn_body(baum_mechanism *m, const char *name, double x, double y);

/* Makes a crank with two pins, a rod with three pins, a block on a guide, and a wheel. The
 * mechanism is not frozen. */
baum_mechanism *drawn_crank(void);

#endif
