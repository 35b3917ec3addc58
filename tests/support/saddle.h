/* SPDX-License-Identifier: BSD-3-Clause */
/* Saddle-point systems for the tests of src/linear, and their solutions in higher precision. */
#ifndef BAUM_TEST_SADDLE_H
#define BAUM_TEST_SADDLE_H

#include <stdint.h>

#include "linear/kkt.h"

typedef struct saddle {
  baum_i_kkt_structure structure;
  baum_i_kkt_values values; /* pointers to the arrays below, or NULL */
  double *mass;
  double *jacobian;
  double *shift;
  unsigned char *omitted;
  double *f;
  double *r;
  double *a;          /* for the solution */
  double *lambda;     /* for the multipliers of the solution */
  int mass_count;     /* length of mass */
  int jacobian_count; /* length of jacobian */
  baum_i_mass_block *mass_blocks;
  baum_i_row_block *row_blocks;
  int *columns;
} saddle;

/* Returns a pseudo-random number, uniform in [-1, 1). */
double saddle_random(uint64_t *seed);

/* Makes a chain of bodies, each with 3 or 6 velocities and a dense positive definite mass matrix.
 * Its joints have 1 to 3 rows. Some additional rows close loops. The rows of J are independent.
 * Blocks and columns are listed out of order, and `mass` and `jacobian` have unused entries between
 * the entries of the blocks. f and r contain random numbers. There is no shift, and no row is
 * omitted. */
saddle saddle_make_random(uint64_t seed, int bodies);

/* Makes N coupled planar four-bars. They consist of N + 1 parallel rods of 1 m, which are pinned to
 * the ground, and of N rods of 1 m between the tips of neighbouring parallel rods. The system has 2
 * N + 1 bodies of 1 kg, and nc = 6 N + 2. saddle_pose_four_bar() computes mass and jacobian at a
 * crank angle. At the angle 0, the mechanism is flat and therefore singular. */
saddle saddle_make_four_bar(int loops);
void saddle_pose_four_bar(saddle *system, double angle);

/* Makes a dense system with nv + nc unknowns, which has one mass block and one row block. All
 * values are zero. */
saddle saddle_make_dense(int nv, int nc);

void saddle_free(saddle *system);

/* Sets r = J a for a random a. The right sides of dependent rows are then consistent. */
void saddle_make_consistent(saddle *system, uint64_t seed);

/* Makes the system use its array `omitted` or `shift`. The array is filled with zeros. */
void saddle_use_omitted(saddle *system);
void saddle_use_shift(saddle *system);

/* Computes the solution want (nv + nc) = (a, lambda), by elimination in quadruple precision (or in
 * long double). */
void saddle_solve(const saddle *system, double *want);

/* Writes the whole matrix K ((nv + nc)^2, row-major). Omitted rows are included. */
void saddle_write_dense(const saddle *system, double *matrix);

/* Returns the largest componentwise backward error of x = (system->a, system->lambda): max |b - K
 * x| / (|K| |x| + |b|), where K is the matrix and b = (f, r) is the right side. */
double saddle_backward_error(const saddle *system);

#endif
