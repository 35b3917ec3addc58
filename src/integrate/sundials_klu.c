/* SPDX-License-Identifier: BSD-3-Clause */
/* Factors Newton's matrix by KLU and keeps pivots; see sundials_klu.h. */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/sundials_klu.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include "base/alloc.h"

/* ---- life ---- */

enum { ARRAYS = 5 };

static baum_status make_arrays(baum_i_sundials_klu *klu, int n)
{
  size_t stride = (size_t)n;
  klu->numbers = baum_i_alloc(ARRAYS * stride, sizeof *klu->numbers);
  BAUM_I_TRY(baum_i_check_memory(klu->numbers));
  klu->defect = klu->numbers;
  klu->size = klu->numbers + stride;
  klu->entry = klu->numbers + 2 * stride;
  klu->right = N_VMake_Serial(n, klu->numbers + 3 * stride, klu->sundials->context);
  klu->solution = N_VMake_Serial(n, klu->numbers + 4 * stride, klu->sundials->context);
  return klu->right && klu->solution ? BAUM_OK : baum_i_fail_memory();
}

static baum_status make_solver(baum_i_sundials_klu *klu, const baum_i_compressed *pattern)
{
  SUNContext context = klu->sundials->context;
  int32_t n = pattern->n;
  klu->matrix = SUNSparseMatrix(n, n, pattern->start[n], CSC_MAT, context);
  if (klu->matrix) {
    klu->solver = SUNLinSol_KLU(klu->right, klu->matrix, context);
  }
  return klu->solver ? BAUM_OK : baum_i_fail_memory();
}

baum_status baum_i_sundials_klu_open(baum_i_sundials_klu *klu, baum_i_sundials *sundials,
                                     baum_residual index)
{
  klu->sundials = sundials;
  BAUM_I_TRY(baum_i_residual_matrix_create(sundials->problem->workspace, index, &klu->form));
  const baum_i_compressed *pattern = baum_i_residual_matrix_pattern(klu->form);
  BAUM_I_TRY(make_arrays(klu, pattern->n));
  return make_solver(klu, pattern);
}

void baum_i_sundials_klu_close(baum_i_sundials_klu *klu)
{
  (void)SUNLinSolFree(klu->solver);
  SUNMatDestroy(klu->matrix);
  N_VDestroy(klu->right);
  N_VDestroy(klu->solution);
  baum_i_free(klu->numbers);
  baum_i_residual_matrix_destroy(klu->form);
}

/* ---- the matrix ---- */

/* Restore the pattern, which SUNDIALS may erase before each evaluation. */
static void copy_pattern(const baum_i_compressed *pattern, SUNMatrix matrix)
{
  sunindextype *starts = SUNSparseMatrix_IndexPointers(matrix);
  sunindextype *indices = SUNSparseMatrix_IndexValues(matrix);
  for (int32_t i = 0; i <= pattern->n; i++) {
    starts[i] = pattern->start[i];
  }
  for (int32_t i = 0; i < pattern->start[pattern->n]; i++) {
    indices[i] = pattern->row[i];
  }
}

baum_status baum_i_sundials_klu_fill(baum_i_sundials_klu *klu, const baum_dae *dae, double c,
                                     double t, const double *y, const double *dy)
{
  copy_pattern(baum_i_residual_matrix_pattern(klu->form), klu->matrix);
  return baum_i_residual_matrix_fill(klu->form, klu->sundials->problem->workspace, dae, c, t, y, dy,
                                     SUNSparseMatrix_Data(klu->matrix));
}

/* ---- factor ---- */

/* Find the largest entry of each row, but at least DBL_MIN. */
static void find_entries(const baum_i_sundials_klu *klu)
{
  const sunindextype *indices = SUNSparseMatrix_IndexValues(klu->matrix);
  const double *values = SUNSparseMatrix_Data(klu->matrix);
  sunindextype n = SUNSparseMatrix_Columns(klu->matrix);
  for (sunindextype i = 0; i < n; i++) {
    klu->entry[i] = DBL_MIN;
  }
  for (sunindextype p = 0; p < SUNSparseMatrix_IndexPointers(klu->matrix)[n]; p++) {
    double x = fabs(values[p]);
    klu->entry[indices[p]] = x > klu->entry[indices[p]] ? x : klu->entry[indices[p]];
  }
}

static int choose_pivots(baum_i_sundials_klu *klu)
{
  klu->fresh = true;
  klu->sundials->pivots_forgotten = false;
  klu->sundials->full_factorizations++;
  (void)SUNLinSol_KLUReInit(klu->solver, klu->matrix, 0, SUNKLU_REINIT_PARTIAL);
  if (SUNLinSolSetup_KLU(klu->solver, klu->matrix) == 0) {
    return 0;
  }
  bool memory = SUNLinSol_KLUGetCommon(klu->solver)->status == KLU_OUT_OF_MEMORY;
  return memory ? baum_i_sundials_answer(klu->sundials, baum_i_fail_memory()) : 1;
}

int baum_i_sundials_klu_factor(baum_i_sundials_klu *klu)
{
  sun_klu_numeric *numeric = SUNLinSol_KLUGetNumeric(klu->solver);
  klu->fresh = false;
  find_entries(klu);
  if (!numeric || klu->sundials->pivots_forgotten) {
    return choose_pivots(klu);
  }
  /* void pointers, because the name of KLU's index type depends on its release. */
  void *starts = SUNSparseMatrix_IndexPointers(klu->matrix);
  void *indices = SUNSparseMatrix_IndexValues(klu->matrix);
  int kept = (int)sun_klu_refactor(starts, indices, SUNSparseMatrix_Data(klu->matrix),
                                   SUNLinSol_KLUGetSymbolic(klu->solver), numeric,
                                   SUNLinSol_KLUGetCommon(klu->solver));
  return kept ? 0 : choose_pivots(klu);
}

/* ---- solve ---- */

/* Compute the arrays defect and size of *klu for a solution x. x and b must be different arrays. */
static void form_residual(const baum_i_sundials_klu *klu, const double *x, const double *b)
{
  const sunindextype *starts = SUNSparseMatrix_IndexPointers(klu->matrix);
  const sunindextype *indices = SUNSparseMatrix_IndexValues(klu->matrix);
  const double *values = SUNSparseMatrix_Data(klu->matrix);
  sunindextype n = SUNSparseMatrix_Columns(klu->matrix);
  for (sunindextype i = 0; i < n; i++) {
    klu->defect[i] = b[i];
    klu->size[i] = fabs(b[i]);
  }
  for (sunindextype j = 0; j < n; j++) {
    for (sunindextype p = starts[j]; p < starts[j + 1]; p++) {
      double term = values[p] * x[j];
      klu->defect[indices[p]] -= term;
      klu->size[indices[p]] += fabs(term);
    }
  }
}

/* Tell whether a solution is accurate enough for Newton's iteration. Each row of A and b is first
 * divided by the largest entry of A in this row. The residuals b - A x of all rows must then be at
 * most 1e-6 times the largest |b| + |A| |x| of a row. NaN is not accurate. */
static bool is_accurate(const baum_i_sundials_klu *klu, N_Vector x, N_Vector b)
{
  sunindextype n = SUNSparseMatrix_Columns(klu->matrix);
  form_residual(klu, N_VGetArrayPointer(x), N_VGetArrayPointer(b));
  double largest = 0.0;
  for (sunindextype i = 0; i < n; i++) {
    double size = klu->size[i] / klu->entry[i];
    largest = size > largest ? size : largest;
  }
  bool accurate = true;
  for (sunindextype i = 0; i < n; i++) {
    accurate = accurate && fabs(klu->defect[i]) <= 1e-6 * largest * klu->entry[i];
  }
  return accurate;
}

int baum_i_sundials_klu_solve(baum_i_sundials_klu *klu, N_Vector x, N_Vector b)
{
  int failed = SUNLinSolSolve_KLU(klu->solver, klu->matrix, x, b, 0.0);
  if (failed == 0 && (klu->fresh || is_accurate(klu, x, b))) {
    return 0;
  }
  failed = choose_pivots(klu);
  return failed != 0 ? failed : SUNLinSolSolve_KLU(klu->solver, klu->matrix, x, b, 0.0);
}

static int solve_displacements(baum_i_sundials_klu *klu, double c, N_Vector x, N_Vector b)
{
  const baum_mechanism *m = klu->sundials->problem->workspace->mechanism;
  const double *q = klu->sundials->present;
  double *right = N_VGetArrayPointer(klu->right);
  const double *solution = N_VGetArrayPointer(klu->solution);
  size_t rest = (size_t)(N_VGetLength(b) - m->nq) * sizeof *right;
  memcpy(right, baum_i_sundials_split(klu->sundials, q, N_VGetArrayPointer(b)),
         (size_t)m->nv * sizeof *right);
  memcpy(right + m->nv, N_VGetArrayPointer(b) + m->nq, rest);
  int failed = baum_i_sundials_klu_solve(klu, klu->solution, klu->right);
  baum_i_sundials_join(klu->sundials, q, solution, 1.0 / c, N_VGetArrayPointer(x));
  memcpy(N_VGetArrayPointer(x) + m->nq, solution + m->nv, rest);
  return failed;
}

int baum_i_sundials_klu_solve_positions(baum_i_sundials_klu *klu, double c, N_Vector x, N_Vector b)
{
  bool flat = klu->sundials->problem->workspace->mechanism->flat;
  return flat ? baum_i_sundials_klu_solve(klu, x, b) : solve_displacements(klu, c, x, b);
}

/* ---- the linear solver that SUNDIALS calls ---- */

static SUNLinearSolver_Type tell_type(SUNLinearSolver solver)
{
  (void)solver;
  return SUNLINEARSOLVER_DIRECT;
}

static int release(SUNLinearSolver solver)
{
  SUNLinSolFreeEmpty(solver);
  return 0;
}

SUNLinearSolver baum_i_sundials_front(const baum_i_sundials *sundials, void *content,
                                      int (*factor)(SUNLinearSolver, SUNMatrix),
                                      int (*solve)(SUNLinearSolver, SUNMatrix, N_Vector, N_Vector,
                                                   sunrealtype))
{
  SUNLinearSolver front = SUNLinSolNewEmpty(sundials->context);
  if (front) {
    front->content = content;
    front->ops->gettype = tell_type;
    front->ops->setup = factor;
    front->ops->solve = solve;
    front->ops->free = release;
  }
  return front;
}

#endif
