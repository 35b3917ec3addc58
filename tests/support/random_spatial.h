/* SPDX-License-Identifier: BSD-3-Clause */
/* Random spatial mechanisms. Each is made both for the library and for an oracle. Joints of all
 * kinds form a tree with some loops. There are springs, loads and drivers. Some bodies are
 * particles or planar bodies. The design configuration satisfies all constraints. Rows may be
 * redundant. The same seed gives the same mechanism on every machine. */
#ifndef BAUM_TEST_RANDOM_SPATIAL_H
#define BAUM_TEST_RANDOM_SPATIAL_H

#include "random_mechanism.h"
#include "spatial_oracle.h"

typedef struct random_spatial {
  baum_mechanism *mechanism;
  chance chance;
  spatial_oracle oracle;
  double start;          /* [s] time at which drivers prescribe the design configuration */
  double span;           /* masses are from 1/span to span */
  int particles, planar; /* [%] of the bodies */
  enum { RANDOM_ANY, RANDOM_PARALLEL, RANDOM_CONCURRENT } axes;
  double direction[3]; /* direction of parallel axes, or the point where concurrent axes meet */
} random_spatial;

/* Makes a frozen mechanism. If `further` is true, it has the elements of random_further.h, too. Its
 * functions keep pointers into *out, so *out must not be moved. */
void random_spatial_make(random_spatial *out, uint64_t seed, bool further);
void random_spatial_destroy(random_spatial *out);

/* These functions are called before the mechanism is frozen. The first one adds a body or a
 * particle. The second one appends an empty joint to the oracle. The third one adds a joint with a
 * random point and axis. */
void random_spatial_add_body(random_spatial *r, bool particle, bool planar);
oracle_joint *random_spatial_next_joint(random_spatial *r, oracle_kind kind, int a, int b);
void random_spatial_add_joint(random_spatial *r, oracle_kind kind, int a, int b);

#endif
