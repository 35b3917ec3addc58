/* SPDX-License-Identifier: BSD-3-Clause */
/* A frozen mechanism with a state at which tests evaluate it. */
#ifndef BAUM_TEST_POINT_H
#define BAUM_TEST_POINT_H

#include <stdint.h>

#include "mechanism/mechanism.h"

enum { TEST_SIZE_MAX = 40 }; /* of nq and nc; blocks have at most its square */

typedef struct test_point {
  baum_mechanism *mechanism; /* owned by the test_point */
  baum_i_point point;
  int nv;
  int nc;
  double t;
  double q[TEST_SIZE_MAX];
  double v[TEST_SIZE_MAX];
} test_point;

/* Freezes the mechanism and takes ownership. The state is the design configuration at rest. */
void test_point_open(test_point *p, baum_mechanism *mechanism);
void test_point_close(test_point *p);

/* Must be called after a change of t, q or v. */
void test_point_update(test_point *p);

/* Draws a random state: t in [0, 2], q on the configuration manifold with elements up to 2, v up to
 * 3. */
void test_point_random(test_point *p, uint64_t *seed);

double test_uniform(uint64_t *seed, double low, double high);

#endif
