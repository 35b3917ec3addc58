/* SPDX-License-Identifier: BSD-3-Clause */
#include "solvers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linear/backend.h"
#include "linear/pattern.h"
#include "linear/scale.h"

void solver_read_workspace(const baum_workspace *w, double *a, double *lambda)
{
  memcpy(a, w->a, (size_t)w->mechanism->nv * sizeof *a);
  memcpy(lambda, w->lambda, (size_t)w->mechanism->nc * sizeof *lambda);
}

/* ---- the library without blocks: KLU with scaling, checks and refinement ---- */

static void *front_create(scene *at)
{
  return at;
}

static bool front_run(void *self, int last_phase)
{
  (void)last_phase;
  scene *at = self;
  baum_i_block_path *path = at->workspace->path;
  at->workspace->path = NULL;
  baum_status status =
    baum_i_acceleration(at->workspace, 0.0, at->q, at->v, SOLVER_GAIN, SOLVER_GAIN);
  at->workspace->path = path;
  return status == BAUM_OK;
}

static void front_read(const void *self, double *a, double *lambda)
{
  const scene *at = self;
  solver_read_workspace(at->workspace, a, lambda);
}

static void front_destroy(void *self)
{
  (void)self; /* the scene owns it */
}

static const solver FRONT = {.name = "klu_checked",
                             .create = front_create,
                             .run = front_run,
                             .read = front_read,
                             .destroy = front_destroy};

/* ---- code that "KLU alone" and dense elimination share ---- */

typedef struct common {
  scene *at;
  int nv;
  int n; /* nv + nc */
  baum_i_kkt_values values;
  double *x; /* (n) */
} common;

static bool make_common(common *c, scene *at)
{
  baum_workspace *w = at->workspace;
  *c = (common){.at = at, .nv = w->mechanism->nv, .n = w->mechanism->nv + w->mechanism->nc};
  c->values = (baum_i_kkt_values){
    .mass = w->mass, .jacobian = w->jacobian, .omitted = baum_i_omitted_rows(w)};
  c->x = calloc((size_t)c->n + 1, sizeof *c->x);
  return c->x != NULL;
}

static bool run_geometry(common *c)
{
  baum_workspace *w = c->at->workspace;
  if (baum_i_velocity_stage(w, 0.0, c->at->q, c->at->v) != BAUM_OK) {
    return false;
  }
  memcpy(c->x, w->force, (size_t)c->nv * sizeof *c->x);
  double *right = c->x + c->nv;
  for (int i = 0; i < c->n - c->nv; i++) {
    bool omitted = c->values.omitted && c->values.omitted[i];
    double r =
      w->gamma[i] - 2.0 * SOLVER_GAIN * w->phi_rate[i] - SOLVER_GAIN * SOLVER_GAIN * w->phi[i];
    right[i] = omitted ? 0.0 : r;
  }
  return true;
}

static void read_common(const common *c, double *a, double *lambda)
{
  memcpy(a, c->x, (size_t)c->nv * sizeof *a);
  memcpy(lambda, c->x + c->nv, (size_t)(c->n - c->nv) * sizeof *lambda);
}

/* ---- KLU alone: each evaluation reuses the pivots of the first factorization; no checks ---- */

typedef struct klu_solver {
  common c;
  double *scale; /* (n) computed only once, and not in every evaluation */
  void *backend;
  baum_i_pattern pattern; /* needed to measure the time of filling the matrix */
} klu_solver;

static void klu_destroy(void *self)
{
  klu_solver *s = self;
  if (s) {
    baum_i_klu_ops.destroy(s->backend);
    baum_i_pattern_clear(&s->pattern);
    free(s->scale);
    free(s->c.x);
    free(s);
  }
}

static bool klu_set_up(klu_solver *s, scene *at)
{
  const baum_i_kkt_structure *structure = &at->workspace->structure;
  if (!make_common(&s->c, at) || !run_geometry(&s->c) ||
      baum_i_pattern_create(structure, &s->pattern) != BAUM_OK ||
      baum_i_klu_ops.create(structure, &s->backend) != BAUM_OK) {
    return false;
  }
  s->scale = calloc((size_t)s->c.n + 1, sizeof *s->scale);
  if (!s->scale) {
    return false;
  }
  baum_i_scale_compute(structure, &s->c.values, s->scale);
  return baum_i_klu_ops.factor(s->backend, &s->c.values, s->scale, BAUM_I_EFFORT_CHOOSE) == BAUM_OK;
}

static void *klu_create(scene *at)
{
  klu_solver *s = calloc(1, sizeof *s);
  if (s && !klu_set_up(s, at)) {
    klu_destroy(s);
    return NULL;
  }
  return s;
}

/* The call that factors the matrix also fills it. The phase of assembly is therefore run only if it
 * is the last phase. In this case the matrix is filled separately. */
static bool klu_run(void *self, int last_phase)
{
  klu_solver *s = self;
  bool done = run_geometry(&s->c);
  if (done && last_phase == PHASE_ASSEMBLY) {
    baum_i_pattern_fill(&s->pattern, &s->c.values, s->scale, 1.0);
  }
  if (done && last_phase >= PHASE_FACTOR) {
    done = baum_i_klu_ops.factor(s->backend, &s->c.values, s->scale, BAUM_I_EFFORT_KEEP) == BAUM_OK;
  }
  if (done && last_phase >= PHASE_SOLVE) {
    done = baum_i_klu_ops.solve(s->backend, s->c.x) == BAUM_OK;
  }
  return done;
}

static void klu_read(const void *self, double *a, double *lambda)
{
  const klu_solver *s = self;
  read_common(&s->c, a, lambda);
}

static const solver KLU = {.name = "klu",
                           .has_phases = true,
                           .create = klu_create,
                           .run = klu_run,
                           .read = klu_read,
                           .destroy = klu_destroy};

/* ---- dense Gaussian elimination of the whole matrix with partial pivoting ---- */

enum { LARGEST_DENSE = 200 };

typedef struct dense_solver {
  common c;
  double *matrix; /* (n x n) row-major */
} dense_solver;

static void dense_destroy(void *self)
{
  dense_solver *s = self;
  if (s) {
    free(s->matrix);
    free(s->c.x);
    free(s);
  }
}

static void *dense_create(scene *at)
{
  const baum_mechanism *m = at->workspace->mechanism;
  if (m->nv + m->nc > LARGEST_DENSE) {
    return NULL;
  }
  dense_solver *s = calloc(1, sizeof *s);
  if (!s) {
    return NULL;
  }
  bool made = make_common(&s->c, at);
  s->matrix = calloc((size_t)s->c.n * (size_t)s->c.n + 1, sizeof *s->matrix);
  if (!made || !s->matrix) {
    dense_destroy(s);
    return NULL;
  }
  return s;
}

static void fill_mass(const dense_solver *s)
{
  const baum_workspace *w = s->c.at->workspace;
  for (int b = 0; b < w->structure.mass_block_count; b++) {
    const baum_i_mass_block *block = &w->structure.mass_blocks[b];
    for (int i = 0; i < block->size; i++) {
      memcpy(s->matrix + (size_t)(block->first + i) * (size_t)s->c.n + block->first,
             w->mass + block->value + i * block->size, (size_t)block->size * sizeof *s->matrix);
    }
  }
}

static void fill_row(const dense_solver *s, const baum_i_row_block *block, int i)
{
  size_t n = (size_t)s->c.n;
  size_t row = (size_t)(s->c.nv + block->row + i);
  if (s->c.values.omitted && s->c.values.omitted[block->row + i]) {
    s->matrix[row * n + row] = 1.0;
    return;
  }
  const double *value = s->c.values.jacobian + block->value + (ptrdiff_t)i * block->cols;
  for (int k = 0; k < block->cols; k++) {
    s->matrix[row * n + (size_t)block->col[k]] = value[k];
    s->matrix[(size_t)block->col[k] * n + row] = value[k];
  }
}

static void dense_fill(const dense_solver *s)
{
  const baum_i_kkt_structure *structure = &s->c.at->workspace->structure;
  memset(s->matrix, 0, (size_t)s->c.n * (size_t)s->c.n * sizeof *s->matrix);
  fill_mass(s);
  for (int b = 0; b < structure->row_block_count; b++) {
    for (int i = 0; i < structure->row_blocks[b].rows; i++) {
      fill_row(s, &structure->row_blocks[b], i);
    }
  }
}

/* Exchanges row k with the row that has the largest entry in column k, together with their right
 * sides. */
static bool dense_pivot(dense_solver *s, int k)
{
  int n = s->c.n;
  int best = k;
  for (int i = k + 1; i < n; i++) {
    if (fabs(s->matrix[i * n + k]) > fabs(s->matrix[best * n + k])) {
      best = i;
    }
  }
  for (int j = 0; j < n && best != k; j++) {
    double kept = s->matrix[k * n + j];
    s->matrix[k * n + j] = s->matrix[best * n + j];
    s->matrix[best * n + j] = kept;
  }
  double kept = s->c.x[k];
  s->c.x[k] = s->c.x[best];
  s->c.x[best] = kept;
  return s->matrix[k * n + k] != 0.0;
}

/* Reduces the matrix to upper triangular form, together with the right side. */
static bool dense_factor(dense_solver *s)
{
  int n = s->c.n;
  for (int k = 0; k < n; k++) {
    if (!dense_pivot(s, k)) {
      return false;
    }
    const double *pivot_row = s->matrix + (ptrdiff_t)k * n;
    for (int i = k + 1; i < n; i++) {
      double *row = s->matrix + (ptrdiff_t)i * n;
      double factor = row[k] / pivot_row[k];
      for (int j = k + 1; j < n; j++) {
        row[j] -= factor * pivot_row[j];
      }
      s->c.x[i] -= factor * s->c.x[k];
    }
  }
  return true;
}

static void dense_substitute(dense_solver *s)
{
  int n = s->c.n;
  for (int k = n - 1; k >= 0; k--) {
    const double *row = s->matrix + (ptrdiff_t)k * n;
    double sum = s->c.x[k];
    for (int j = k + 1; j < n; j++) {
      sum -= row[j] * s->c.x[j];
    }
    s->c.x[k] = sum / row[k];
  }
}

static bool dense_run(void *self, int last_phase)
{
  dense_solver *s = self;
  bool done = run_geometry(&s->c);
  if (done && last_phase >= PHASE_ASSEMBLY) {
    dense_fill(s);
  }
  if (done && last_phase >= PHASE_FACTOR) {
    done = dense_factor(s);
  }
  if (done && last_phase >= PHASE_SOLVE) {
    dense_substitute(s);
  }
  return done;
}

static void dense_read(const void *self, double *a, double *lambda)
{
  const dense_solver *s = self;
  read_common(&s->c, a, lambda);
}

static const solver DENSE = {.name = "dense",
                             .has_phases = true,
                             .create = dense_create,
                             .run = dense_run,
                             .read = dense_read,
                             .destroy = dense_destroy};

const solver *solver_at(int k)
{
  static const solver *const all[] = {&solver_block, &solver_block_plain, &KLU, &FRONT, &DENSE};
  return k < (int)(sizeof all / sizeof all[0]) ? all[k] : NULL;
}

const solver *solver_in_space_at(int k)
{
  static const solver *const all[] = {&solver_automatic, &solver_block_plain, &KLU, &FRONT, &DENSE};
  return k < (int)(sizeof all / sizeof all[0]) ? all[k] : NULL;
}
