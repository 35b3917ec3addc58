/* SPDX-License-Identifier: BSD-3-Clause */
/* Front end of the saddle-point solvers. It scales, checks accuracy, refines, and requests new
 * pivots or another solver.
 *
 * The factorizations form a ladder, from cheap to robust:
 *
 *   KEEP     keep the pivots of the last factorization
 *   CHOOSE   choose pivots for the present values
 *   CAREFUL  choose pivots for accuracy alone
 *   LAST     rank-revealing QR, least squares
 *
 * Factoring climbs this ladder until the estimated reciprocal condition number (rcond) is large
 * enough. Solving climbs further if refinement does not reduce the residual to rounding level. */
#include "linear/kkt.h"

#include <math.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/backend.h"
#include "linear/residual.h"
#include "linear/scale.h"
#include "linear/whiten.h"

enum { MOST_REFINEMENTS = 3 };

/* If rcond is below this, the next rung of the ladder is tried. If rcond is below this on all
 * rungs, the matrix counts as nearly singular. */
static const double trusted_rcond = 1e-10;
/* New pivots are chosen if rcond is below doubtful_rcond and below `fallen` times the value that it
 * had when the present pivots were chosen. After such a decrease, rcond measures neither the
 * accuracy nor the distance from a singular configuration. */
static const double doubtful_rcond = 1e-6;
static const double fallen = 0.01;
/* If rcond is below this, LU is useless even with pivots chosen for accuracy. */
static const double least_rcond = 1e-15;
/* If rcond is below this, a pivot may be only a rounding error. Pivots of dependent rows are up to
 * 1e-14 times the largest pivot. */
static const double rounding_rcond = 1e-13;
/* Largest contradiction between dependent rows that is accepted, relative to the right-hand
 * side. */
static const double contradiction = 1e-8;

typedef enum ladder_rung { RUNG_KEEP, RUNG_CHOOSE, RUNG_CAREFUL, RUNG_LAST } ladder_rung;

typedef struct kkt_solver {
  const baum_i_kkt_ops *ops;
  void *self;
  bool has_pivots;
  double chosen_rcond; /* rcond when the pivots were chosen */
} kkt_solver;

struct baum_i_kkt {
  const baum_i_kkt_structure *structure;
  int n;
  kkt_solver first;    /* created by baum_i_kkt_prepare(), or on first use */
  kkt_solver last;     /* solver of RUNG_LAST, created on first use */
  kkt_solver *present; /* the solver of the last factorization */
  ladder_rung present_rung;
  ladder_rung top_rung;
  baum_i_kkt_quality quality;
  baum_i_kkt_counters counters;
  baum_i_kkt_values values;    /* changed by `whitening` if bodies are slender */
  baum_i_whitening *whitening; /* NULL if there are no bodies in space */
  baum_i_residual_islands islands;
  double *memory; /* memory of the five arrays below */
  double *scale;
  double *b;
  double *x;
  double *residual; /* refine() replaces the residual by the correction */
  double *size;
};

static bool make_room(baum_i_kkt *kkt)
{
  size_t n = (size_t)kkt->n;
  kkt->memory = baum_i_alloc(5 * n, sizeof *kkt->memory);
  if (!kkt->memory) {
    return false;
  }
  kkt->scale = kkt->memory;
  kkt->b = kkt->scale + n;
  kkt->x = kkt->b + n;
  kkt->residual = kkt->x + n;
  kkt->size = kkt->residual + n;
  return true;
}

static const ladder_rung TOP_RUNG[] = {
  [BAUM_I_KKT_AUTO] = RUNG_LAST, [BAUM_I_KKT_KLU] = RUNG_CAREFUL, [BAUM_I_KKT_QR] = RUNG_CHOOSE};

baum_status baum_i_kkt_create(const baum_i_kkt_structure *structure, baum_i_kkt_choice choice,
                              baum_i_kkt **out)
{
  *out = NULL;
  baum_i_kkt *kkt = baum_i_alloc(1, sizeof *kkt);
  BAUM_I_TRY(baum_i_check_memory(kkt));
  kkt->structure = structure;
  kkt->n = structure->nv + structure->nc;
  kkt->quality = BAUM_I_KKT_SINGULAR;
  kkt->present = &kkt->first;
  kkt->first.ops = choice == BAUM_I_KKT_QR ? &baum_i_qr_ops : &baum_i_klu_ops;
  kkt->last.ops = &baum_i_qr_ops;
  kkt->top_rung = TOP_RUNG[choice];
  if (!make_room(kkt) || baum_i_whitening_create(structure, &kkt->whitening) != BAUM_OK ||
      baum_i_residual_islands_find(structure, &kkt->islands) != BAUM_OK) {
    baum_i_kkt_destroy(kkt);
    return baum_i_fail_memory();
  }
  *out = kkt;
  return BAUM_OK;
}

/* Creates a solver unless it exists. Returns BAUM_OK or BAUM_ERR_MEMORY, without a message. */
static baum_status make_solver(const baum_i_kkt *kkt, kkt_solver *solver)
{
  return solver->self ? BAUM_OK : solver->ops->create(kkt->structure, &solver->self);
}

baum_status baum_i_kkt_prepare(baum_i_kkt *kkt)
{
  return make_solver(kkt, &kkt->first) == BAUM_OK ? BAUM_OK : baum_i_fail_memory();
}

void baum_i_kkt_destroy(baum_i_kkt *kkt)
{
  if (!kkt) {
    return;
  }
  kkt->first.ops->destroy(kkt->first.self);
  kkt->last.ops->destroy(kkt->last.self);
  baum_i_whitening_destroy(kkt->whitening);
  baum_i_residual_islands_clear(&kkt->islands);
  baum_i_free(kkt->memory);
  baum_i_free(kkt);
}

/* ---- factor ---- */

static bool are_finite(const double *x, int count)
{
  for (int i = 0; i < count; i++) {
    if (!isfinite(x[i])) {
      return false;
    }
  }
  return true;
}

static bool values_are_finite(const baum_i_kkt_structure *structure,
                              const baum_i_kkt_values *values)
{
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    if (!are_finite(values->mass + block->value, block->size * block->size)) {
      return false;
    }
  }
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    if (!are_finite(values->jacobian + block->value, block->rows * block->cols)) {
      return false;
    }
  }
  return !values->shift || are_finite(values->shift, structure->nc);
}

static double present_rcond(const baum_i_kkt *kkt)
{
  return kkt->present->ops->rcond(kkt->present->self);
}

/* The effort of each rung. The solver of RUNG_LAST has only one way to choose pivots. */
static const baum_i_kkt_effort EFFORT[] = {[RUNG_KEEP] = BAUM_I_EFFORT_KEEP,
                                           [RUNG_CHOOSE] = BAUM_I_EFFORT_CHOOSE,
                                           [RUNG_CAREFUL] = BAUM_I_EFFORT_CAREFUL,
                                           [RUNG_LAST] = BAUM_I_EFFORT_CHOOSE};

static baum_status factor_at(baum_i_kkt *kkt, ladder_rung rung)
{
  kkt_solver *solver = rung == RUNG_LAST ? &kkt->last : &kkt->first;
  kkt->counters.fallbacks += rung == RUNG_LAST;
  BAUM_I_TRY(make_solver(kkt, solver));
  kkt->present = solver;
  kkt->present_rung = rung;
  kkt->counters.factorizations++;
  kkt->counters.full_factorizations += rung != RUNG_KEEP;
  baum_status status = solver->ops->factor(solver->self, &kkt->values, kkt->scale, EFFORT[rung]);
  solver->has_pivots = status == BAUM_OK && solver->ops->keeps_pivots;
  if (status == BAUM_OK && rung != RUNG_KEEP) {
    solver->chosen_rcond = present_rcond(kkt);
  }
  return status;
}

static bool is_trusted(const baum_i_kkt *kkt)
{
  double rcond = present_rcond(kkt);
  if (kkt->present_rung == RUNG_KEEP && rcond < doubtful_rcond &&
      rcond < fallen * kkt->present->chosen_rcond) {
    return false;
  }
  bool is_careful = kkt->present_rung >= RUNG_CAREFUL;
  return rcond >= (is_careful ? least_rcond : trusted_rcond);
}

static baum_i_kkt_quality judge(const baum_i_kkt *kkt, baum_status status)
{
  if (status != BAUM_OK) {
    return BAUM_I_KKT_SINGULAR;
  }
  bool is_good = kkt->present_rung != RUNG_LAST && present_rcond(kkt) >= trusted_rcond;
  return is_good ? BAUM_I_KKT_GOOD : BAUM_I_KKT_NEAR_SINGULAR;
}

/* Factors, beginning at rung `start`, until the result is trusted or the top rung is reached. */
static baum_status climb(baum_i_kkt *kkt, ladder_rung start)
{
  baum_status status = factor_at(kkt, start);
  while (kkt->present_rung < kkt->top_rung &&
         (status == BAUM_ERR_SINGULAR || (status == BAUM_OK && !is_trusted(kkt)))) {
    status = factor_at(kkt, kkt->present_rung + 1);
  }
  if (status == BAUM_OK && kkt->present->ops->keeps_pivots && present_rcond(kkt) < least_rcond) {
    status =
      BAUM_ERR_SINGULAR; /* LU would divide by rounding errors, which residuals do not show */
  }
  kkt->quality = judge(kkt, status);
  return status;
}

static baum_status add_message(baum_status status)
{
  return status == BAUM_ERR_MEMORY ? baum_i_fail_memory() : status;
}

baum_status baum_i_kkt_factor(baum_i_kkt *kkt, const baum_i_kkt_values *values)
{
  if (!values_are_finite(kkt->structure, values)) {
    kkt->quality = BAUM_I_KKT_SINGULAR;
    return BAUM_ERR_NOT_FINITE;
  }
  kkt->values = *values;
  baum_i_whitening_set(kkt->whitening, &kkt->values);
  baum_i_scale_compute(kkt->structure, &kkt->values, kkt->scale);
  /* Kept pivots would fail close to a singular configuration. */
  bool keep = kkt->first.has_pivots && kkt->quality == BAUM_I_KKT_GOOD;
  return add_message(climb(kkt, keep ? RUNG_KEEP : RUNG_CHOOSE));
}

/* ---- solve ---- */

/* Both arrays may be NULL if count is 0. */
static void copy(const double *from, int count, double *to)
{
  for (int i = 0; i < count; i++) {
    to[i] = from[i];
  }
}

static void load_right_side(baum_i_kkt *kkt, const double *f, const double *r)
{
  int nv = kkt->structure->nv;
  copy(f, nv, kkt->b);
  baum_i_whitening_convert_force(kkt->whitening, kkt->b);
  for (int i = 0; i < kkt->structure->nc; i++) {
    bool omitted = kkt->values.omitted && kkt->values.omitted[i];
    kkt->b[nv + i] = omitted ? 0.0 : r[i];
  }
}

static baum_status solve_once(baum_i_kkt *kkt)
{
  copy(kkt->b, kkt->n, kkt->x);
  baum_status status = kkt->present->ops->solve(kkt->present->self, kkt->x);
  baum_i_residual_form(kkt->structure, &kkt->values, kkt->b, kkt->x, kkt->residual, kkt->size);
  return status;
}

static baum_status refine(baum_i_kkt *kkt)
{
  kkt->counters.refinements++;
  baum_status status = kkt->present->ops->solve(kkt->present->self, kkt->residual);
  for (int i = 0; i < kkt->n; i++) {
    kkt->x[i] += kkt->residual[i];
  }
  baum_i_residual_form(kkt->structure, &kkt->values, kkt->b, kkt->x, kkt->residual, kkt->size);
  return status;
}

static bool is_at_rounding(const baum_i_kkt *kkt)
{
  return baum_i_residual_is_rounding(kkt->n, &kkt->islands, kkt->scale, kkt->residual, kkt->size);
}

/* Tells whether all rows with a large residual are negligible. Returns false below RUNG_CAREFUL if
 * there is a higher rung, because climbing may then help.
 */
static bool is_at_noise(const baum_i_kkt *kkt)
{
  bool is_careful = kkt->present_rung >= RUNG_CAREFUL || kkt->present_rung == kkt->top_rung;
  return is_careful && baum_i_residual_is_noise(kkt->n, &kkt->islands, kkt->scale, kkt->residual,
                                                kkt->size, present_rcond(kkt));
}

/* Tells whether a matrix without full rank was solved by least squares. */
static bool is_least_squares(const baum_i_kkt *kkt)
{
  return present_rcond(kkt) == 0.0;
}

/* Tells whether a least-squares solution nearly satisfies all rows. This function replaces the test
 * for rounding level: if rows contradict each other, unknowns may be so large that rounding errors
 * dominate the other rows. */
static bool is_nearly_met(const baum_i_kkt *kkt)
{
  return baum_i_residual_is_below(kkt->n, &kkt->islands, kkt->scale, kkt->residual, kkt->b,
                                  contradiction);
}

/* Tells whether rows of an island contradict each other and the solver has divided by a rounding
 * error. The residual does not show this, but accelerations are then of the order of the right-hand
 * side divided by rcond. Close to a singular configuration in which rows agree, multipliers may
 * reach this order, but accelerations do not. If rcond is below least_rcond, the matrix is singular
 * to rounding, and multipliers of this size are a sign of contradiction, too. */
static bool is_divided_by_rounding(const baum_i_kkt *kkt)
{
  double rcond = present_rcond(kkt);
  int count = rcond < least_rcond ? kkt->n : kkt->structure->nv;
  if (rcond >= rounding_rcond) {
    return false;
  }
  baum_i_residual_largest(kkt->n, &kkt->islands, kkt->scale, kkt->b);
  for (int i = 0; i < count; i++) {
    double side = kkt->islands.largest[kkt->islands.of[i]];
    if (fabs(kkt->x[i] / kkt->scale[i]) * rcond > contradiction * side) {
      return true;
    }
  }
  return false;
}

/* Returns BAUM_ERR_SINGULAR if the residual stays large or rows contradict each other. */
static baum_status solve_refined(baum_i_kkt *kkt)
{
  BAUM_I_TRY(solve_once(kkt));
  bool done = is_at_rounding(kkt);
  for (int k = 0; k < MOST_REFINEMENTS && !done; k++) {
    BAUM_I_TRY(refine(kkt));
    done = is_at_rounding(kkt);
  }
  done = is_least_squares(kkt) ? is_nearly_met(kkt) : done || is_at_noise(kkt);
  return done && !is_divided_by_rounding(kkt) ? BAUM_OK : BAUM_ERR_SINGULAR;
}

static baum_status solve_climbing(baum_i_kkt *kkt)
{
  baum_status status = solve_refined(kkt);
  while (status == BAUM_ERR_SINGULAR && kkt->present_rung < kkt->top_rung) {
    status = climb(kkt, kkt->present_rung + 1);
    if (status == BAUM_OK) {
      status = solve_refined(kkt);
    }
  }
  return status;
}

baum_status baum_i_kkt_solve(baum_i_kkt *kkt, const double *f, const double *r, double *a,
                             double *lambda)
{
  if (kkt->quality == BAUM_I_KKT_SINGULAR) {
    return BAUM_ERR_SINGULAR;
  }
  load_right_side(kkt, f, r);
  if (!are_finite(kkt->b, kkt->n)) {
    return BAUM_ERR_NOT_FINITE;
  }
  BAUM_I_TRY(add_message(solve_climbing(kkt)));
  copy(kkt->x, kkt->structure->nv, a);
  baum_i_whitening_restore_motion(kkt->whitening, a);
  copy(kkt->x + kkt->structure->nv, kkt->structure->nc, lambda);
  return BAUM_OK;
}

baum_status baum_i_kkt_factor_and_solve(baum_i_kkt *kkt, const baum_i_kkt_values *values,
                                        const double *f, const double *r, double *a, double *lambda)
{
  BAUM_I_TRY(baum_i_kkt_factor(kkt, values));
  return baum_i_kkt_solve(kkt, f, r, a, lambda);
}

void baum_i_kkt_forget(baum_i_kkt *kkt)
{
  kkt->first.has_pivots = false;
}

baum_i_kkt_quality baum_i_kkt_get_quality(const baum_i_kkt *kkt)
{
  return kkt->quality;
}

const char *baum_i_kkt_backend(const baum_i_kkt *kkt)
{
  return kkt->present->ops->name;
}

double baum_i_kkt_rcond(const baum_i_kkt *kkt)
{
  return kkt->quality == BAUM_I_KKT_SINGULAR ? 0.0 : present_rcond(kkt);
}

baum_i_kkt_counters baum_i_kkt_get_counters(const baum_i_kkt *kkt)
{
  return kkt->counters;
}
