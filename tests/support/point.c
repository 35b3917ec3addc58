/* SPDX-License-Identifier: BSD-3-Clause */
#include "point.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "mechanism/manifold.h"

void test_point_open(test_point *p, baum_mechanism *mechanism)
{
  *p = (test_point){.mechanism = mechanism};
  check(baum_mechanism_freeze(mechanism));
  p->nv = mechanism->nv;
  p->nc = mechanism->nc;
  assert_true(mechanism->nq <= TEST_SIZE_MAX && p->nc <= TEST_SIZE_MAX);
  assert_int_equal(baum_i_point_create(mechanism, &p->point), BAUM_OK);
  memcpy(p->q, mechanism->design_q, (size_t)mechanism->nq * sizeof(double));
  test_point_update(p);
}

void test_point_close(test_point *p)
{
  baum_i_point_release(&p->point);
  baum_mechanism_destroy(p->mechanism);
}

void test_point_update(test_point *p)
{
  baum_i_point_set(&p->point, p->t, p->q, p->v);
}

/* The random number is made of the upper bits of Knuth's linear congruential generator. */
double test_uniform(uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

void test_point_random(test_point *p, uint64_t *seed)
{
  p->t = test_uniform(seed, 0.0, 2.0);
  for (int i = 0; i < p->mechanism->nq; i++) {
    p->q[i] = test_uniform(seed, -2.0, 2.0);
  }
  for (int i = 0; i < p->nv; i++) {
    p->v[i] = test_uniform(seed, -3.0, 3.0);
  }
  baum_i_normalize(p->mechanism, p->q);
  test_point_update(p);
}
