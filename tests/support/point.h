/* SPDX-License-Identifier: BSD-3-Clause */
/* A frozen mechanism, and a state at which tests evaluate it. */
#ifndef BAUM_TEST_POINT_H
#define BAUM_TEST_POINT_H

#include <stdint.h>

#include "mechanism/mechanism.h"

enum { TEST_SIZE_MAX = 40 }; /* largest nq and nc; blocks have at most 40^2 values */

typedef struct test_point {
  baum_mechanism *mechanism; /* the test_point owns it */
  baum_i_point point;
  int nv;
  int nc;
  double t;
  double q[TEST_SIZE_MAX];
  double v[TEST_SIZE_MAX];
} test_point;

/* Freezes the mechanism and becomes its owner. The state is the design configuration with zero
 * velocities. */
void test_point_open(test_point *p, baum_mechanism *mechanism);
void test_point_close(test_point *p);

/* Tests must call this function after they have changed t, q or v. */
void test_point_update(test_point *p);

/* Chooses a random state: t from 0 to 2, q on the configuration manifold with numbers up to 2, and
 * v up to 3. */
void test_point_random(test_point *p, uint64_t *seed);

double test_uniform(uint64_t *seed, double low, double high);

#endif
