/* SPDX-License-Identifier: BSD-3-Clause */
/* Multipliers of least norm, where redundant rows leave them a choice.
 *
 * In rows of unit length, J_s = S^-1 J with s_i = |row i of J M^-1/2|, the multipliers S lambda
 * that hold the same forces differ by null vectors of J_s^T; of least norm is the one without any
 * part in them. With A = J_s M^-1 J_s^T,
 *
 *   y <- e (A + e)^-1 y,     [ M   J^T     ] [ x  ]   [  0  ]
 *                            [ J   -e S^2  ] [ mu ] = [ S y ],   new y = -e S mu
 *
 * leaves the part of y in the null space as it is, and takes of all others away, the more the
 * larger their eigenvalue is against e. Repeated, it ends at the null part; the matrix is factored
 * once.
 * Parts whose eigenvalue is below e are slow: they are those of poses close to singular, and of the
 * longest loops.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/golden.h"
#include "dynamics/dynamics.h"

enum { MOST_REPETITIONS = 200 };

/* e: the matrix is solved without more effort than usual. */
static const double SHIFT = 1e-8;
/* What a repetition changes at most, of the first y, when nothing is left but rounding. */
static const double ROUNDING = 1e-14;

/* ---- the null part ---- */

static baum_status factor(baum_workspace *w)
{
  const baum_i_redundancy *r = &w->redundancy;
  const baum_i_kkt_values values = {.mass = w->mass, .jacobian = w->jacobian, .shift = w->shift};
  baum_i_row_mobilities(w, w->shift);
  for (int i = 0; i < w->mechanism->nc; i++) {
    r->row_scale[i] = sqrt(w->shift[i]);
    w->shift[i] = w->shift[i] > 0.0 ? SHIFT * w->shift[i] : 1.0;
  }
  return baum_i_kkt_factor(r->kkt, &values);
}

/* One repetition on redundancy.part, and the most that it changes. */
static baum_status filter(baum_workspace *w, double *change)
{
  const baum_i_redundancy *r = &w->redundancy;
  int nv = w->mechanism->nv;
  int nc = w->mechanism->nc;
  double *zero = w->work_v;
  double *mu = w->work_c + nc;
  memset(zero, 0, (size_t)nv * sizeof *zero);
  for (int i = 0; i < nc; i++) {
    w->work_c[i] = r->row_scale[i] * r->part[i];
  }
  baum_status status = baum_i_kkt_solve(r->kkt, zero, w->work_c, zero + nv, mu);
  *change = 0.0;
  for (int i = 0; i < nc && status == BAUM_OK; i++) {
    double next = -SHIFT * r->row_scale[i] * mu[i];
    *change = fmax(*change, fabs(next - r->part[i]));
    r->part[i] = next;
  }
  return status;
}

/* Of redundancy.part, after factor(). */
static baum_status find_null_part(baum_workspace *w)
{
  double size = 0.0;
  double change = (double)INFINITY;
  baum_status status = BAUM_OK;
  (void)baum_i_largest(w->redundancy.part, w->mechanism->nc, &size);
  for (int k = 0; k < MOST_REPETITIONS && status == BAUM_OK && change > ROUNDING * size; k++) {
    status = filter(w, &change);
  }
  return status;
}

baum_status baum_i_make_multipliers_least(baum_workspace *w)
{
  const baum_i_redundancy *r = &w->redundancy;
  baum_status status = factor(w);
  for (int i = 0; i < w->mechanism->nc; i++) {
    r->part[i] = r->row_scale[i] * w->lambda[i];
  }
  if (status == BAUM_OK) {
    status = find_null_part(w);
  }
  for (int i = 0; i < w->mechanism->nc && status == BAUM_OK; i++) {
    w->lambda[i] -= r->row_scale[i] > 0.0 ? r->part[i] / r->row_scale[i] : 0.0;
  }
  return status;
}

/* ---- whose they are ---- */

/* Part of a unit pattern in the null space above which multipliers are not unique; rounding is far below. */
static const double SHARED = 1e-6;

/* Where multipliers without a pattern have a null part, the null space reaches. */
static baum_status find_reach(baum_workspace *w)
{
  baum_status status = factor(w);
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->redundancy.part[i] = baum_i_golden(i + 1);
  }
  return status == BAUM_OK ? find_null_part(w) : status;
}

/* Largest part of a joint's rows. */
static double part_of(const baum_workspace *w, const baum_i_joint *joint)
{
  double part = 0.0;
  (void)baum_i_largest(w->redundancy.part + joint->row, joint->rows, &part);
  return part;
}

static void list_joints(const baum_workspace *w, char *text, size_t size)
{
  const baum_mechanism *m = w->mechanism;
  size_t used = 0;
  for (int j = 0; j < m->joint_count && used + 1 < size; j++) {
    if (part_of(w, m->joints[j]) > SHARED) {
      int wrote = snprintf(text + used, size - used, "%s\"%s\"", used ? ", " : "",
                           m->joints[j]->element.name);
      used += wrote > 0 ? (size_t)wrote : 0;
    }
  }
}

baum_status baum_i_redundancy_text(baum_workspace *w, char *text, size_t size)
{
  text[0] = '\0';
  baum_status status = find_reach(w);
  if (status == BAUM_OK) {
    list_joints(w, text, size);
  }
  return status;
}

baum_status baum_i_find_unique_multipliers(baum_workspace *w, bool *unique)
{
  bool any_shared = w->redundancy.count > 0;
  baum_status status = any_shared ? find_reach(w) : BAUM_OK;
  for (int i = 0; i < w->mechanism->nc && status == BAUM_OK; i++) {
    unique[i] = !any_shared || fabs(w->redundancy.part[i]) <= SHARED;
  }
  return status;
}
