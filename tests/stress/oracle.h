/* SPDX-License-Identifier: BSD-3-Clause */
/* The motion of one degree of freedom, x'' = f(x, x'), far more accurately than any run: in long
 * double, also for stiff forces. */
#ifndef BAUM_TEST_ORACLE_H
#define BAUM_TEST_ORACLE_H

#include <stdbool.h>

typedef struct oracle {
  long double (*acceleration)(const void *scene, long double x, long double v);
  const void *scene;
} oracle;

typedef struct oracle_state {
  long double x; /* [rad] */
  long double v; /* [rad/s] */
} oracle_state;

/* Advance by `span` [s]; false where steps would have to be too many. */
bool oracle_advance(const oracle *o, long double span, oracle_state *state);

#endif
