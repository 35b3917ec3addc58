/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial mechanisms by chance, for the library and for an oracle: a tree of joints of all kinds
 * with some loops, springs, loads and drivers; particles and planar bodies take part.
 * The design configuration fulfils all constraints; rows may be redundant. The same seed gives the
 * same mechanism on every machine.
 */
#ifndef BAUM_TEST_RANDOM_SPATIAL_H
#define BAUM_TEST_RANDOM_SPATIAL_H

#include "random_mechanism.h"
#include "spatial_oracle.h"

typedef struct random_spatial {
  baum_mechanism *mechanism;
  chance chance;
  spatial_oracle oracle;
  double start;          /* [s] drivers have their design coordinates then */
  double span;           /* masses are from 1/span to span */
  int particles, planar; /* in a hundred bodies */
  enum { RANDOM_ANY, RANDOM_PARALLEL, RANDOM_CONCURRENT } axes;
  double direction[3]; /* of parallel axes; concurrent ones meet here */
} random_spatial;

/* Frozen. The struct must stay where it is. */
void random_spatial_make(random_spatial *out, uint64_t seed);
void random_spatial_destroy(random_spatial *out);

#endif
