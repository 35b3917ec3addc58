/* SPDX-License-Identifier: BSD-3-Clause */
/* Backend "klu": sparse LU of the scaled saddle-point matrix (sparse_lu.h).
 *
 * Factors with kept pivots may be useless, because pivots that were good at an earlier
 * configuration may have become small. rcond() returns the ratio of the smallest to the largest
 * pivot. The front end (kkt.c) checks this ratio and the residual.
 *
 * There are two ways to choose pivots. Usually diagonal entries are preferred. Masses, which are
 * about 1 after scaling, are then the pivots, and they stay good while the mechanism moves. Their
 * elimination leaves J M^-1 J^T, whose smallest eigenvalue is sigma^2 if sigma is the smallest
 * singular value of the scaled J. If accuracy matters most, M is given a small weight w,
 *
 *   [ w M   J^T ]
 *   [ J    -S/w ]
 *
 * and the largest entry is the pivot. Pivots are then entries of J. The condition number is only
 * about 1/sigma, and masses of very different size do not cause cancellation. These pivots depend
 * on the configuration and must be chosen more often. */
#include "base/alloc.h"
#include "linear/backend.h"
#include "linear/pattern.h"
#include "linear/sparse_lu.h"

/* Square roots of the weight w. They are powers of two. */
static const double usual_root = 1.0;
static const double careful_root = 0x1p-13;

typedef struct klu_backend {
  baum_i_pattern pattern;
  baum_i_sparse_lu *lu;
  double root;
} klu_backend;

static void destroy(void *self)
{
  klu_backend *klu = self;
  if (klu) {
    baum_i_sparse_lu_destroy(klu->lu);
    baum_i_pattern_clear(&klu->pattern);
    baum_i_free(klu);
  }
}

static baum_status create(const baum_i_kkt_structure *structure, void **out)
{
  klu_backend *klu = *out = baum_i_alloc(1, sizeof *klu);
  if (!klu || baum_i_pattern_create(structure, &klu->pattern) != BAUM_OK ||
      baum_i_sparse_lu_create(klu->pattern.n, klu->pattern.columns.start, klu->pattern.columns.row,
                              &klu->lu) != BAUM_OK) {
    destroy(klu);
    *out = NULL;
    return BAUM_ERR_MEMORY;
  }
  baum_i_sparse_lu_take_scaled(klu->lu);
  return BAUM_OK;
}

static baum_status factor(void *self, const baum_i_kkt_values *values, const double *scale,
                          baum_i_kkt_effort effort)
{
  klu_backend *klu = self;
  bool careful = effort == BAUM_I_EFFORT_CAREFUL;
  if (effort != BAUM_I_EFFORT_KEEP) {
    klu->root = careful ? careful_root : usual_root;
  }
  baum_i_pattern_fill(&klu->pattern, values, scale, klu->root);
  double *matrix = klu->pattern.matrix;
  return effort == BAUM_I_EFFORT_KEEP
           ? baum_i_sparse_lu_keep(klu->lu, matrix)
           : baum_i_sparse_lu_choose(klu->lu, matrix, careful ? 1.0 : BAUM_I_USUAL_THRESHOLD);
}

static baum_status solve(void *self, double *x)
{
  klu_backend *klu = self;
  baum_i_pattern_scale(&klu->pattern, x);
  baum_i_sparse_lu_solve(klu->lu, x);
  baum_i_pattern_scale(&klu->pattern, x);
  return BAUM_OK;
}

static double rcond(const void *self)
{
  const klu_backend *klu = self;
  return baum_i_sparse_lu_rcond(klu->lu);
}

const baum_i_kkt_ops baum_i_klu_ops = {
  .name = "klu",
  .keeps_pivots = true,
  .create = create,
  .factor = factor,
  .solve = solve,
  .rcond = rcond,
  .destroy = destroy,
};
