/* SPDX-License-Identifier: BSD-3-Clause */
/* Assembles the Jacobian dF/dy + c dF/dy' of the residual forms (dae_residual.c) from the blocks of
 * all elements. Instead of q, the variables are displacements of length nv. The rows of q' - N v
 * are multiplied by N^+. The matrix therefore has nv rows and nv columns for the positions:
 *
 *          q                                             v                       lambda
 *   q      c I - N^+ (N v)_q N                           -I
 *   v      (M v')_q + (J^T lambda)_q - g_q               c M - g_v               J^T
 *   lambda index 1: (J w)_q - gamma_q - 2 alpha nu_q     (c + 2 alpha) J         0
 *                   + beta^2 J,  w = v' + 2 alpha v      - gamma_v
 *          index 2: (J v)_q - nu_q                       J                       0
 *          index 3: J                                    0                       0
 *
 * The form GGL has the rows of index 2. With u = v - W^-1 J^T mu, where W is the metric of
 * metric.c, the following rows differ or are added:
 *
 *          q                                             v                       lambda  mu
 *   q      c I - N^+ (N u)_q N + W^-1 (J^T mu)_q         -I                      0       W^-1 J^T
 *   mu     J                                             0                       0       0
 *
 * If row i has its own gains alpha_i and beta_i, (J w)_q is still computed with w = v' + 2 alpha v.
 * A second linearization adds the missing part 2 (alpha_i - alpha) (J v)_q.
 *
 * A row of velocity level has no Phi. At index 1 it has no term beta^2 J. At index 3 it has the
 * entries of index 2. For GGL its row of mu has only a 1 on the diagonal.
 *
 * The function walk() visits all blocks and emits their entries in a fixed order. The first walk
 * finds the pattern of the matrix and the slot in which each entry is stored. Later walks add
 * values to these slots. An omitted row has a 1 on its diagonal and no other values.
 */
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/dynamics.h"

struct baum_i_residual_matrix {
  baum_i_compressed pattern; /* its slots are in the order in which a walk emits the entries */
};

/* The place to which a walk emits its entries. */
typedef struct sink {
  /* Collects the positions of entries while the pattern is found; otherwise NULL. */
  baum_i_places *places;
  const int32_t *slot; /* while values are added, points to the slot of the next entry */
  double *values;
} sink;

static void emit(sink *s, int row, int col, double value)
{
  if (s->places) {
    baum_i_places_add(s->places, row, col);
  } else {
    s->values[*s->slot++] += value;
  }
}

/* The arguments from which the functions of a walk compute entries. */
typedef struct factors {
  const baum_workspace *w;
  const baum_dae *dae;
  double c;
} factors;

/* ---- the walk ---- */

static void walk_rates(const factors *f, sink *s)
{
  int nv = f->w->mechanism->nv;
  for (int i = 0; i < nv; i++) {
    emit(s, i, i, f->c);
    emit(s, i, nv + i, -1.0);
  }
  for (int k = 1; k <= f->w->mechanism->body_count; k++) {
    const baum_i_body *body = f->w->mechanism->bodies[k];
    for (int i = 0; body->manifold && i < body->nv * body->nv; i++) {
      emit(s, body->v + i / body->nv, body->v + i % body->nv, -f->w->rate_q[body->mass + i]);
    }
  }
}

static void walk_bodies(const factors *f, sink *s)
{
  const baum_workspace *w = f->w;
  int nv = w->mechanism->nv;
  for (int k = 1; k <= w->mechanism->body_count; k++) {
    const baum_i_body *body = w->mechanism->bodies[k];
    for (int i = 0; i < body->nv; i++) {
      for (int j = 0; j < body->nv; j++) {
        int at = body->mass + i * body->nv + j;
        int row = nv + body->v + i;
        emit(s, row, body->v + j, w->mass_q[at] - w->body_force_q[at]);
        emit(s, row, nv + body->v + j, f->c * w->mass[at] - w->body_force_v[at]);
      }
    }
  }
}

static void walk_forces(const factors *f, sink *s)
{
  const baum_workspace *w = f->w;
  int nv = w->mechanism->nv;
  for (int k = 0; k < w->mechanism->force_count; k++) {
    const baum_i_force *force = w->mechanism->forces[k];
    const baum_i_span *span = &force->span;
    for (int i = 0; i < span->nl; i++) {
      for (int j = 0; j < span->nl; j++) {
        int at = force->square + i * span->nl + j;
        emit(s, nv + span->columns[i], span->columns[j], -w->force_q[at]);
        emit(s, nv + span->columns[i], nv + span->columns[j], -w->force_v[at]);
      }
    }
  }
}

static void walk_multipliers(const factors *f, const baum_i_joint *joint, sink *s)
{
  const baum_workspace *w = f->w;
  int nv = w->mechanism->nv;
  const baum_i_span *span = &joint->span;
  for (int i = 0; i < span->nl; i++) {
    for (int j = 0; j < span->nl; j++) {
      emit(s, nv + span->columns[i], span->columns[j], w->jtl_q[joint->square + i * span->nl + j]);
    }
    for (int r = 0; r < joint->rows; r++) {
      emit(s, nv + span->columns[i], 2 * nv + joint->row + r,
           w->jacobian[joint->jacobian + r * span->nl + i]);
    }
  }
}

/* Emit the derivatives of W^-1 J^T mu in the rows of q. */
static void walk_correction(const factors *f, const baum_i_joint *joint, sink *s)
{
  const baum_workspace *w = f->w;
  const baum_i_span *span = &joint->span;
  int first = 2 * w->mechanism->nv + w->mechanism->nc + joint->row;
  for (int i = 0; i < span->nl; i++) {
    int row = span->columns[i];
    double inverse = 1.0 / w->metric[row];
    for (int j = 0; j < span->nl; j++) {
      emit(s, row, span->columns[j], inverse * w->jtm_q[joint->square + i * span->nl + j]);
    }
    for (int r = 0; r < joint->rows; r++) {
      emit(s, row, first + r, inverse * w->jacobian[joint->jacobian + r * span->nl + i]);
    }
  }
}

/* The following three functions emit the entries of a constraint row in one column of q and in the
 * same column of v. The entries are derivatives of Phi'' with the stabilization terms (index 1), of
 * Phi' (index 2), or of Phi (index 3). `at` is the index of the entry in J, (J w)_q and so on.
 * `keep` is 1, or 0 if the row is replaced by a 1 on its diagonal. */

static void emit_acceleration(const factors *f, int row, int column, int at, double keep, sink *s)
{
  const baum_workspace *w = f->w;
  int number = row - 2 * w->mechanism->nv;
  double gain = baum_i_row_gain(w, number);
  double damping = 2.0 * f->dae->alpha * gain;
  double beta = baum_i_is_velocity_row(w->mechanism, number) ? 0.0 : f->dae->beta * gain;
  double more = w->row_gains ? 2.0 * f->dae->alpha * (gain - 1.0) * w->jv_q[at] : 0.0;
  emit(s, row, column,
       keep * (w->jw_q[at] + more - w->gamma_q[at] - damping * w->nu_q[at] +
               beta * beta * w->jacobian[at]));
  emit(s, row, w->mechanism->nv + column,
       keep * ((f->c + damping) * w->jacobian[at] - w->gamma_v[at]));
}

static void emit_velocity(const factors *f, int row, int column, int at, double keep, sink *s)
{
  const baum_workspace *w = f->w;
  emit(s, row, column, keep * (w->jw_q[at] - w->nu_q[at]));
  emit(s, row, w->mechanism->nv + column, keep * w->jacobian[at]);
}

static void emit_position(const factors *f, int row, int column, int at, double keep, sink *s)
{
  emit(s, row, column, keep * f->w->jacobian[at]);
}

typedef void emit_fn(const factors *f, int row, int column, int at, double keep, sink *s);

/* Emit all entries of row r of a joint. The rows of all joints begin at `first`, and the rows of
 * this joint at `first` + joint->row. An omitted row, and any row if `equation` is false, has only
 * a 1 on its diagonal. */
static void walk_row(const factors *f, const baum_i_joint *joint, int r, int first, bool equation,
                     emit_fn *entry, sink *s)
{
  const baum_workspace *w = f->w;
  int row = first + joint->row + r;
  double keep = equation && !w->rows.omitted[joint->row + r] ? 1.0 : 0.0;
  emit(s, row, row, 1.0 - keep);
  for (int j = 0; j < joint->span.nl; j++) {
    int at = joint->jacobian + r * joint->span.nl + j;
    entry(f, row, joint->span.columns[j], at, keep, s);
  }
}

static emit_fn *entry_of(baum_residual index)
{
  switch (index) {
  case BAUM_RESIDUAL_INDEX2:
  case BAUM_RESIDUAL_GGL: return emit_velocity;
  case BAUM_RESIDUAL_INDEX3: return emit_position;
  case BAUM_RESIDUAL_INDEX1:
  default: return emit_acceleration;
  }
}

static void walk_joint(const factors *f, const baum_i_joint *joint, sink *s)
{
  int first = 2 * f->w->mechanism->nv;
  int positions = joint->rows - joint->velocity_rows;
  emit_fn *entry = entry_of(f->dae->index);
  emit_fn *velocity_entry = f->dae->index == BAUM_RESIDUAL_INDEX3 ? emit_velocity : entry;
  walk_multipliers(f, joint, s);
  for (int r = 0; r < joint->rows; r++) {
    walk_row(f, joint, r, first, true, r < positions ? entry : velocity_entry, s);
  }
  if (f->dae->index == BAUM_RESIDUAL_GGL) {
    walk_correction(f, joint, s);
    for (int r = 0; r < joint->rows; r++) {
      walk_row(f, joint, r, first + f->w->mechanism->nc, r < positions, emit_position, s);
    }
  }
}

static void walk(const factors *f, sink *s)
{
  walk_rates(f, s);
  walk_bodies(f, s);
  walk_forces(f, s);
  for (int k = 0; k < f->w->mechanism->joint_count; k++) {
    walk_joint(f, f->w->mechanism->joints[k], s);
  }
}

/* ---- the pattern ---- */

baum_status baum_i_residual_matrix_create(const baum_workspace *workspace, baum_residual index,
                                          baum_i_residual_matrix **out)
{
  *out = NULL;
  baum_i_residual_matrix *matrix = baum_i_alloc(1, sizeof *matrix);
  BAUM_I_TRY(baum_i_check_memory(matrix));
  const baum_mechanism *m = workspace->mechanism;
  const baum_dae dae = {.index = index};
  const factors f = {.w = workspace, .dae = &dae, .c = 0.0};
  baum_i_places places = {0};
  sink s = {.places = &places};
  walk(&f, &s);
  int size = baum_i_residual_size(m, index) - m->nq + m->nv;
  if (baum_i_compress(&places, size, &matrix->pattern) != BAUM_OK) {
    baum_i_free(matrix);
    return baum_i_fail_memory();
  }
  *out = matrix;
  return BAUM_OK;
}

void baum_i_residual_matrix_destroy(baum_i_residual_matrix *matrix)
{
  if (matrix) {
    baum_i_compressed_clear(&matrix->pattern);
    baum_i_free(matrix);
  }
}

const baum_i_compressed *baum_i_residual_matrix_pattern(const baum_i_residual_matrix *matrix)
{
  return &matrix->pattern;
}

/* ---- the values ---- */

/* Set `direction`, the vector by which J is multiplied in the rows of lambda: w of (J w)_q for
 * index 1, otherwise v of (J v)_q. */
static void choose_direction(const baum_dae *dae, int nv, const double *v, const double *dv,
                             double *direction)
{
  bool index1 = dae->index == BAUM_RESIDUAL_INDEX1;
  for (int i = 0; i < nv; i++) {
    direction[i] = index1 ? dv[i] + 2.0 * dae->alpha * v[i] : v[i];
  }
}

/* Compute (J v)_q. The call also sets other blocks, which the main linearization then
 * overwrites. */
static baum_status linearize_rates(baum_workspace *w, const double *v, const double *lambda)
{
  const baum_i_joint_blocks blocks = {w->jv_q, w->jtl_q, w->gamma_q, w->gamma_v, w->nu_q};
  return baum_i_mechanism_linearize_joints(&w->point, v, lambda, &blocks);
}

/* Linearize with mu first. The linearization with lambda comes second, because it must overwrite
 * the blocks that both linearizations set. */
static baum_status linearize_joints(baum_workspace *w, const baum_dae *dae, const double *v,
                                    const double *dv)
{
  const baum_mechanism *m = w->mechanism;
  const double *lambda = v + m->nv;
  double *direction = w->work_v;
  baum_i_joint_blocks blocks = {w->jw_q, w->jtm_q, w->gamma_q, w->gamma_v, w->nu_q};
  choose_direction(dae, m->nv, v, dv, direction);
  if (dae->index == BAUM_RESIDUAL_GGL) {
    BAUM_I_TRY(baum_i_mechanism_linearize_joints(&w->point, direction, lambda + m->nc, &blocks));
  }
  if (dae->index == BAUM_RESIDUAL_INDEX1 && w->row_gains) {
    BAUM_I_TRY(linearize_rates(w, v, lambda));
  }
  blocks.jtl_q = w->jtl_q;
  return baum_i_mechanism_linearize_joints(&w->point, direction, lambda, &blocks);
}

static baum_status linearize(baum_workspace *w, const baum_dae *dae, double t, const double *y,
                             const double *dy)
{
  int nq = w->mechanism->nq;
  const double *v = y + nq;
  const double *dv = dy + nq;
  const baum_i_body_blocks bodies = {w->mass_q, w->body_force_q, w->body_force_v};
  const baum_i_force_blocks forces = {w->force_q, w->force_v};
  BAUM_I_TRY(baum_i_velocity_stage(w, t, y, v));
  if (!w->mechanism->flat) {
    bool corrected = dae->index == BAUM_RESIDUAL_GGL;
    const double *mu = v + w->mechanism->nv + w->mechanism->nc;
    baum_i_linearize_rate(w->mechanism, w->point.q,
                          corrected ? baum_i_corrected_velocities(w, v, mu) : v, w->rate_q,
                          w->work_q);
  }
  BAUM_I_TRY(baum_i_mechanism_linearize_bodies(&w->point, dv, &bodies));
  BAUM_I_TRY(linearize_joints(w, dae, v, dv));
  return baum_i_mechanism_linearize_forces(&w->point, &forces);
}

baum_status baum_i_residual_matrix_fill(const baum_i_residual_matrix *matrix,
                                        baum_workspace *workspace, const baum_dae *dae, double c,
                                        double t, const double *y, const double *dy, double *values)
{
  BAUM_I_TRY(linearize(workspace, dae, t, y, dy));
  memset(values, 0, (size_t)matrix->pattern.start[matrix->pattern.n] * sizeof *values);
  const factors f = {.w = workspace, .dae = dae, .c = c};
  sink s = {.slot = matrix->pattern.slot, .values = values};
  walk(&f, &s);
  return BAUM_OK;
}
