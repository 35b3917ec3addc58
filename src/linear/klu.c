/* SPDX-License-Identifier: BSD-3-Clause */
/* Backend "klu": sparse LU of the scaled saddle-point matrix by KLU of SuiteSparse, 32-bit indices.
 *
 * The pattern is analyzed once. klu_factor chooses pivots; klu_refactor keeps them and allocates
 * nothing. It may return KLU_OK and be worthless, when pivots that were fine at an earlier pose
 * have become small: klu_rcond, the ratio of the smallest to the largest pivot, tells here, the
 * residual in the front.
 *
 * There are two ways to choose. Usually the scaled M has a unit diagonal and the diagonal is
 * preferred: masses are the pivots, and they stay good while the mechanism moves. But then
 * constraints enter as J M^-1 J^T, whose smallest eigenvalue is sigma^2 where the smallest singular
 * value of the scaled J is sigma. With care, M is weighted down,
 *
 *   [ w M   J^T ]
 *   [ J    -S/w ]
 *
 * and the largest entry is the pivot: J itself is eliminated, which loses sigma only, and masses of
 * very different size do not disturb each other. Such pivots depend on the configuration and have
 * to be chosen more often.
 */
#include <klu.h>

#include "base/alloc.h"
#include "linear/backend.h"
#include "linear/pattern.h"
#include "linear/scale.h"

/* Roots of the weight w, powers of two. */
static const double usual_root = 1.0;
static const double careful_root = 0x1p-13;

/* How small a diagonal entry may be against the largest of its column to be the pivot. */
static const double usual_threshold = 0.001;
static const double careful_threshold = 1.0;

typedef struct klu_backend {
  baum_i_pattern pattern;
  double *matrix;
  double *scale; /* (n) */
  double root;
  klu_common common;
  klu_symbolic *symbolic;
  klu_numeric *numeric;
} klu_backend;

static void destroy(void *self)
{
  klu_backend *klu = self;
  if (!klu) {
    return;
  }
  if (klu->numeric) {
    (void)klu_free_numeric(&klu->numeric, &klu->common);
  }
  if (klu->symbolic) {
    (void)klu_free_symbolic(&klu->symbolic, &klu->common);
  }
  baum_i_free(klu->matrix);
  baum_i_free(klu->scale);
  baum_i_pattern_clear(&klu->pattern);
  baum_i_free(klu);
}

static bool set_up(klu_backend *klu, const baum_i_kkt_structure *structure)
{
  (void)klu_defaults(&klu->common); /* fails for NULL only */
  klu->common.scale = -1;           /* the matrix comes scaled */
  klu->common.halt_if_singular = 1;
  if (baum_i_pattern_create(structure, &klu->pattern) != BAUM_OK) {
    return false;
  }
  baum_i_pattern *pattern = &klu->pattern;
  klu->matrix = baum_i_alloc((size_t)pattern->column_start[pattern->n], sizeof *klu->matrix);
  klu->scale = baum_i_alloc((size_t)pattern->n, sizeof *klu->scale);
  if (!klu->matrix || !klu->scale) {
    return false;
  }
  klu->symbolic = klu_analyze(pattern->n, pattern->column_start, pattern->row, &klu->common);
  return klu->symbolic != NULL;
}

static baum_status create(const baum_i_kkt_structure *structure, void **out)
{
  *out = NULL;
  klu_backend *klu = baum_i_alloc(1, sizeof *klu);
  if (!klu) {
    return BAUM_ERR_MEMORY;
  }
  if (!set_up(klu, structure)) {
    destroy(klu);
    return BAUM_ERR_MEMORY;
  }
  *out = klu;
  return BAUM_OK;
}

static baum_status choose(klu_backend *klu)
{
  if (klu->numeric) {
    (void)klu_free_numeric(&klu->numeric, &klu->common);
  }
  klu->numeric = klu_factor(klu->pattern.column_start, klu->pattern.row, klu->matrix, klu->symbolic,
                            &klu->common);
  if (klu->numeric) {
    return BAUM_OK;
  }
  return klu->common.status == KLU_SINGULAR ? BAUM_ERR_SINGULAR : BAUM_ERR_MEMORY;
}

static baum_status keep(klu_backend *klu)
{
  int done = klu_refactor(klu->pattern.column_start, klu->pattern.row, klu->matrix, klu->symbolic,
                          klu->numeric, &klu->common);
  return done && klu->common.status == KLU_OK ? BAUM_OK : BAUM_ERR_SINGULAR;
}

static baum_status factor(void *self, const baum_i_kkt_values *values, const double *scale,
                          baum_i_kkt_effort effort)
{
  klu_backend *klu = self;
  if (effort != BAUM_I_EFFORT_KEEP) {
    bool careful = effort == BAUM_I_EFFORT_CAREFUL;
    klu->root = careful ? careful_root : usual_root;
    klu->common.tol = careful ? careful_threshold : usual_threshold;
  }
  klu->common.rcond = 0.0;
  baum_i_scale_weigh(klu->pattern.structure, values, scale, klu->root, klu->scale);
  baum_i_pattern_fill(&klu->pattern, values, klu->scale, klu->matrix);
  baum_status status = effort == BAUM_I_EFFORT_KEEP ? keep(klu) : choose(klu);
  if (status == BAUM_OK) {
    (void)klu_rcond(klu->symbolic, klu->numeric, &klu->common);
  }
  return status;
}

static void apply_scale(const klu_backend *klu, double *x)
{
  for (int i = 0; i < klu->pattern.n; i++) {
    x[i] *= klu->scale[i];
  }
}

static baum_status solve(void *self, double *x)
{
  klu_backend *klu = self;
  apply_scale(klu, x);
  (void)klu_solve(klu->symbolic, klu->numeric, klu->pattern.n, 1, x, &klu->common);
  apply_scale(klu, x);
  return BAUM_OK;
}

static double rcond(const void *self)
{
  const klu_backend *klu = self;
  return klu->common.rcond;
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
