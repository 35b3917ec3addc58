/* SPDX-License-Identifier: BSD-3-Clause */
/* Saddle-point systems for the tests of src/linear, and their solution in wider arithmetic. */
#ifndef BAUM_TEST_SADDLE_H
#define BAUM_TEST_SADDLE_H

#include <stdint.h>

#include "linear/kkt.h"

typedef struct saddle {
  baum_i_kkt_structure structure;
  baum_i_kkt_values values; /* points to the arrays below, NULL included */
  double *mass;
  double *jacobian;
  double *shift;
  unsigned char *omitted;
  double *f;
  double *r;
  double *a;          /* room for a solution */
  double *lambda;     /* likewise */
  int mass_count;     /* numbers in mass */
  int jacobian_count; /* numbers in jacobian */
  baum_i_mass_block *mass_blocks;
  baum_i_row_block *row_blocks;
  int *columns;
} saddle;

/* Deterministic, uniform in [-1, 1). */
double saddle_random(uint64_t *seed);

/* Bodies of 3 or 6 velocities with dense positive definite masses, in a chain of joints of 1 to 3
 * rows with some loops of one row; rows of J are independent. Blocks are listed out of order,
 * columns too, with gaps between values. f, r are random; no shift, no dropped rows. */
saddle saddle_make_random(uint64_t seed, int bodies);

/* N coupled planar four-bars: N + 1 unit rods on the ground, their tips joined by N unit rods. 2 N
 * + 1 bodies of mass
 * 1, nc = 6 N + 2. saddle_pose_four_bar() fills mass and jacobian at a crank angle; flat at 0. */
saddle saddle_make_four_bar(int loops);
void saddle_pose_four_bar(saddle *system, double angle);

/* The dense system of order n: one mass block, one row block. All values are zero. */
saddle saddle_make_dense(int nv, int nc);

void saddle_free(saddle *system);

/* r = J a for a random a, so that the rows agree with each other. */
void saddle_make_consistent(saddle *system, uint64_t seed);

/* Turn the dropped or the shift array on, all zero. */
void saddle_use_omitted(saddle *system);
void saddle_use_shift(saddle *system);

/* want (nv + nc) = (a, lambda) by elimination in quadruple precision (long double where there is
 * none). */
void saddle_solve(const saddle *system, double *want);

/* matrix ((nv + nc)^2), row-major: K as one would write it down, without dropping. */
void saddle_write_dense(const saddle *system, double *matrix);

/* Largest componentwise backward error of system->a, system->lambda: max |b - K x| / (|K| |x| +
 * |b|). */
double saddle_backward_error(const saddle *system);

#endif
