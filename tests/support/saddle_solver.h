/* SPDX-License-Identifier: BSD-3-Clause */
/* Solves the systems of saddle.h with a chosen solver and compares the results. Include after
 * cmocka.h. */
#ifndef BAUM_TEST_SADDLE_SOLVER_H
#define BAUM_TEST_SADDLE_SOLVER_H

#include <math.h>
#include <stdlib.h>

#include "assert_near.h"
#include "saddle.h"

enum { MOST_UNKNOWNS = 400 };

static const baum_i_kkt_choice choices[] = {BAUM_I_KKT_AUTO, BAUM_I_KKT_KLU, BAUM_I_KKT_QR};
static const char *const names[] = {"klu", "klu", "qr"};
enum { CHOICES = 3 };

static inline baum_i_kkt *make_solver(const saddle *system, baum_i_kkt_choice choice)
{
  baum_i_kkt *kkt = NULL;
  assert_int_equal(baum_i_kkt_create(&system->structure, choice, &kkt), BAUM_OK);
  assert_non_null(kkt);
  return kkt;
}

static inline baum_status factor(baum_i_kkt *kkt, const saddle *system)
{
  return baum_i_kkt_factor(kkt, &system->values);
}

static inline baum_status solve(baum_i_kkt *kkt, saddle *system)
{
  return baum_i_kkt_solve(kkt, system->f, system->r, system->a, system->lambda);
}

static inline double largest_of(const double *x, int count)
{
  double largest = 0.0;
  for (int i = 0; i < count; i++) {
    largest = fmax(largest, fabs(x[i]));
  }
  return largest;
}

/* Checks that (a, lambda) equals `want`. The tolerance for a is relative to the largest a, and the
 * tolerance for lambda is relative to the largest lambda. */
static inline void assert_solution(const saddle *system, const double *want, double tolerance)
{
  int nv = system->structure.nv;
  int nc = system->structure.nc;
  for (int j = 0; j < nv; j++) {
    ASSERT_NEAR(system->a[j], want[j], 0.0, tolerance * largest_of(want, nv));
  }
  for (int i = 0; i < nc; i++) {
    ASSERT_NEAR(system->lambda[i], want[nv + i], 0.0, tolerance * largest_of(want + nv, nc));
  }
}

static inline void solve_and_compare(baum_i_kkt *kkt, saddle *system, double tolerance)
{
  double want[MOST_UNKNOWNS];
  assert_true(system->structure.nv + system->structure.nc <= MOST_UNKNOWNS);
  assert_int_equal(factor(kkt, system), BAUM_OK);
  assert_int_equal(solve(kkt, system), BAUM_OK);
  saddle_solve(system, want);
  assert_solution(system, want, tolerance);
}

#endif
