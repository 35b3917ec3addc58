/* SPDX-License-Identifier: BSD-3-Clause */
/* A model in a given state, with its accelerations as computed by the library and by an oracle (an
 * accurate solution). The oracle solves the equations with the same M, J, g and gamma in quadruple
 * precision. Include after cmocka.h. */
#ifndef BAUM_TEST_POSED_H
#define BAUM_TEST_POSED_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "check.h"
#include "models.h"
#include "quad_saddle.h"

typedef struct posed {
  model m;
  baum_workspace *workspace;
  int32_t nq;
  int32_t nv;
  int32_t nc;
  double *memory; /* one block of memory for the arrays below */
  double *q;      /* (nq) */
  double *v;      /* (nv) */
  double *a;      /* (nv) as computed by the library */
  double *want_a; /* (nv) as computed by the oracle */
  double *lambda; /* (nc) */
  double *want_lambda;
} posed;

/* Takes ownership of a new model, and sets the state to the design configuration. */
static inline posed pose_model(baum_status built, model m)
{
  check(built);
  posed p = {.m = m};
  check(baum_workspace_create(m.mechanism, &p.workspace));
  check(baum_mechanism_sizes(m.mechanism, &p.nq, &p.nv, &p.nc));
  size_t nq = (size_t)p.nq;
  size_t nv = (size_t)p.nv;
  size_t nc = (size_t)p.nc;
  p.memory = calloc(nq + 3 * nv + 2 * nc, sizeof *p.memory);
  assert_non_null(p.memory);
  p.q = p.memory;
  p.v = p.q + nq;
  p.a = p.v + nv;
  p.want_a = p.a + nv;
  p.lambda = p.want_a + nv;
  p.want_lambda = p.lambda + nc;
  check(baum_workspace_design(p.workspace, p.q, p.v));
  return p;
}

static inline void unpose(posed *p)
{
  baum_workspace_destroy(p->workspace);
  free(p->memory);
  model_destroy(&p->m);
}

/* Returns a pseudo-random number, uniform in [low, high). */
static inline double draw(uint64_t *seed, double low, double high)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(*seed >> 11) * 0x1p-53;
}

static inline void accelerate(posed *p)
{
  check(baum_workspace_acceleration(p->workspace, 0.0, p->q, p->v, 0.0, 0.0, p->a, p->lambda));
}

#endif
