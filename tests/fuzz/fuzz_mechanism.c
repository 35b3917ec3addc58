/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds, freezes, describes and evaluates mechanisms with arbitrary definitions. If a call
 * succeeds, its results must be finite. A copy of the mechanism must give the same
 * accelerations. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drawn.h"

enum { SIZE = 200 /* mechanisms with more coordinates or rows are not evaluated */ };

static void check_finite(baum_status status, const double *x, int count)
{
  for (int k = 0; k < count && fuzz_status(status) == BAUM_OK; k++) {
    FUZZ_CHECK(isfinite(x[k]));
  }
}

static void look(const baum_mechanism *m)
{
  static baum_mobility mobility;
  static baum_report report;
  (void)fuzz_status(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  (void)fuzz_status(baum_mechanism_report(m, &report, sizeof report));
  (void)fuzz_status(baum_mechanism_check_derivatives(m));
}

typedef struct pose {
  double t;
  double q[SIZE];
  double v[SIZE];
} pose;

static pose draw_pose(baum_workspace *w, fuzz_bytes *b, int nv)
{
  pose p = {.t = fuzz_number(b)};
  FUZZ_CHECK(baum_workspace_design(w, p.q, p.v) == BAUM_OK);
  for (int i = 0; i < nv; i++) {
    p.v[i] = isnan(p.v[i]) ? 0.0 : p.v[i];
  }
  for (int k = fuzz_below(b, 4); k > 0; k--) {
    p.q[fuzz_below(b, nv)] += fuzz_number(b);
    p.v[fuzz_below(b, nv)] += fuzz_number(b);
  }
  return p;
}

/* Calls every kind of evaluation in one configuration. */
static void evaluate(baum_workspace *w, const pose *p, int nv, int nc)
{
  static double out[SIZE * SIZE];
  static double lambda[SIZE];
  double energy[2] = {0.0, 0.0};
  check_finite(baum_workspace_phi(w, p->t, p->q, out), out, nc);
  check_finite(baum_workspace_nu(w, p->t, p->q, out), out, nc);
  check_finite(baum_workspace_gamma(w, p->t, p->q, p->v, out), out, nc);
  check_finite(baum_workspace_force(w, p->t, p->q, p->v, out), out, nv);
  check_finite(baum_workspace_mass(w, p->t, p->q, out), out, nv * nv);
  check_finite(baum_workspace_jacobian(w, p->t, p->q, out), out, nc * nv);
  check_finite(baum_workspace_energy(w, p->t, p->q, p->v, &energy[0], &energy[1]), energy, 2);
  memset(lambda, 0, sizeof lambda);
  baum_status status = baum_workspace_acceleration(w, p->t, p->q, p->v, 1.0, 2.0, out, lambda);
  check_finite(status, out, nv);
  check_finite(status, lambda, nc);
}

/* Projects a configuration and assembles it. Calls that fail must leave q and v unchanged. */
static void move(baum_workspace *w, pose *p, int nv)
{
  pose before = *p;
  baum_status status = fuzz_status(baum_workspace_project(w, p->t, p->q, p->v));
  check_finite(status, p->q, nv);
  check_finite(status, p->v, nv);
  FUZZ_CHECK(status == BAUM_OK || memcmp(&before, p, sizeof before) == 0);
  before = *p;
  status = fuzz_status(baum_workspace_assemble(w, p->t, p->q, p->v, NULL, 0));
  check_finite(status, p->q, nv);
  check_finite(status, p->v, nv);
  FUZZ_CHECK(status == BAUM_OK || memcmp(&before, p, sizeof before) == 0);
}

/* Computes the accelerations in one configuration. If this fails, they are NaN. */
static void accelerations_of(const baum_mechanism *m, const pose *p, double *a, int nv)
{
  baum_workspace *w = NULL;
  baum_status status = fuzz_status(baum_workspace_create(m, &w));
  if (status == BAUM_OK) {
    status = baum_workspace_acceleration(w, p->t, p->q, p->v, 0.0, 0.0, a, NULL);
  }
  for (int i = 0; i < nv && status != BAUM_OK; i++) {
    a[i] = (double)NAN;
  }
  baum_workspace_destroy(w);
}

static void check_copy(const baum_mechanism *m, const pose *p, int nv)
{
  double a[2][SIZE];
  baum_mechanism *copy = NULL;
  FUZZ_CHECK(baum_mechanism_copy(m, &copy) == BAUM_OK);
  FUZZ_CHECK(baum_mechanism_freeze(copy) == BAUM_OK);
  accelerations_of(m, p, a[0], nv);
  accelerations_of(copy, p, a[1], nv);
  for (int i = 0; i < nv; i++) {
    FUZZ_CHECK(a[0][i] == a[1][i] || (isnan(a[0][i]) && isnan(a[1][i])));
  }
  baum_mechanism_destroy(copy);
}

static bool any_function_fails(const design_mechanism *m)
{
  for (int k = 0; k < m->user_count; k++) {
    if (m->users[k].calls > 0) {
      return true;
    }
  }
  return false;
}

static void evaluate_all(const design_mechanism *m, fuzz_bytes *b)
{
  int32_t nv = 0;
  int32_t nc = 0;
  baum_workspace *w = NULL;
  FUZZ_CHECK(baum_mechanism_sizes(m->mechanism, NULL, &nv, &nc) == BAUM_OK);
  if (nv > SIZE || nc > SIZE || fuzz_status(baum_workspace_create(m->mechanism, &w)) != BAUM_OK) {
    return;
  }
  pose p = draw_pose(w, b, nv);
  evaluate(w, &p, nv, nc);
  move(w, &p, nv);
  evaluate(w, &p, nv, nc);
  baum_workspace_destroy(w);
  if (!any_function_fails(m)) {
    check_copy(m->mechanism, &p, nv);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static design_mechanism m;
  fuzz_bytes b = {data, size};
  design_mechanism_make(&m, &b);
  bool frozen = fuzz_status(baum_mechanism_freeze(m.mechanism)) == BAUM_OK;
  FUZZ_CHECK(baum_mechanism_is_frozen(m.mechanism) == frozen);
  if (frozen) {
    look(m.mechanism);
    evaluate_all(&m, &b);
  }
  design_mechanism_destroy(&m);
  return 0;
}
