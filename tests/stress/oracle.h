/* SPDX-License-Identifier: BSD-3-Clause */
/* Integrates x'' = f(x, x') for one degree of freedom, in long double. It is much more accurate
 * than any run that is tested, even for stiff forces. */
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

/* Advances the state by the time `span` [s]. Returns false if this would take too many steps. */
bool oracle_advance(const oracle *o, long double span, oracle_state *state);

#endif
