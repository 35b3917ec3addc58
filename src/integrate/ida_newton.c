/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's iteration of IDA. The unknowns are y = (q, v, lambda), and for GGL (q, v, lambda, mu).
 * BDF sets y' = c y + ..., where c = O(1/h).
 *
 * Convergence. The size of a correction d is the root of the sum of squares of
 *
 *   q, v     root mean square of d / tolerance
 *   lambda   largest |d_i| n_i / E, where n_i is the norm of row i of J with scaled columns, so
 *            that |d_i| n_i and E are energies, and
 *            E = 1/100 (largest |lambda_i| n_i) + |c| (largest M_jj s_j tolerance_v_j);
 *            the second term is the uncertainty of M v' = c M v + ... at the tolerance of v
 *   mu       likewise with actions in place of energies, and
 *            E = 1/100 (largest |mu_i| n_i) + |c| (largest W_jj s_j tolerance_q_j),
 *            whose second term is the uncertainty of W q' = c W q + ... = W v - J^T mu
 *
 * where s_j is the scale of coordinate j, and W is the metric of GGL (docs/notation.md).
 *
 * If lambda is in the error test, E is at most the tolerance of that test,
 *
 *   tolerance_lambda rtol max(largest |lambda_i| n_i, largest M_jj s_j^2 / T^2)
 *
 * The second term, the kinetic energy at the rate 1/T, keeps this tolerance positive if all
 * multipliers are zero. This tolerance is an energy. Divided by n_i, it gives the tolerance of
 * lambda_i. If tolerance_lambda is smaller than tolerance_q and tolerance_v, Newton's iteration
 * multiplies the tolerances of q and v by tolerance_lambda / min(tolerance_q, tolerance_v). Without
 * this factor, the remaining errors of q and v would cause errors of lambda that no shorter step
 * reduces. In measurements, runs without this factor took 40 times as many steps.
 *
 * At index 3, v is a difference of q divided by h. Its rounding error is c eps s, where eps is the
 * unit roundoff. The tolerance of v is therefore at least |c| tolerance_q / 10. The iteration ends
 * if the first correction is below IDA's bound (0.33), or if the convergence rate of this step
 * predicts an error below the bound after a later correction.
 *
 * IDA's own convergence test does not work for these equations. No fixed tolerance is suitable for
 * multipliers, because they may be zero and their rounding errors grow with c. Without any test,
 * multipliers diverge: at order 5 the prediction amplifies an error 63-fold, and an iteration with
 * an older matrix leaves up to a quarter of it. In measurements, multipliers became 1e14 times too
 * large; their rounding errors then changed q and v, and no step converged. IDA also uses the
 * convergence rate of an earlier step with the same matrix, which shortens steps by a third.
 *
 * Older matrices. The matrix A(c0) was factored for an earlier coefficient c0. With r = c / c0 it
 * gives the present matrix A(c), up to terms that are smaller by a factor of h:
 *
 *   A(c) = R^-1 A(c0) C^-1,  R = diag(r, 1, r^(k - 1) at index k),  C = diag(r^-2, r^-1, 1)
 *
 * For mu, the entry of R is r^2 and the entry of C is r^-1. For rows of velocity level at index 3,
 * k = 2. The solution is therefore x = C A(c0)^-1 R b. IDA itself would multiply the solution by 2
 * / (1 + r), which is a compromise for stiff equations. With this factor, each iteration leaves the
 * fraction (1 - r) / (1 + r) of the error of the multipliers. */
#include "integrate/integrator.h"

#if BAUM_HAVE_SUNDIALS

#include "integrate/ida_newton.h"

#include <float.h>
#include <math.h>

#include <ida/ida.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

/* Errors of multipliers do not accumulate, so the tolerance only has to prevent divergence. With
 * all values from 1e-1 to 1e-4, the number of iterations is the same. */
static const double MULTIPLIER_TOLERANCE = 1e-2;
/* With this factor, the tolerance of v at rtol 1e-13 is 50 times the rounding error of v. Errors of
 * the motion are the same as with the factor 0.01, and runs take fewer steps than with the factor
 * 1. */
static const double INDEX3_VELOCITY_TOLERANCE = 0.1;
/* Largest convergence rate, as in IDA. Above it IDA computes a new matrix or takes a smaller
 * step. */
static const double WORST_RATE = 0.9;

static const baum_workspace *workspace_of(const baum_i_ida_newton *newton)
{
  return newton->sundials->problem->workspace;
}

/* ---- sizes ---- */

void baum_i_ida_newton_measure(baum_i_ida_newton *newton)
{
  const baum_workspace *w = workspace_of(newton);
  double *inertia = N_VGetArrayPointer(newton->inertia);
  baum_i_row_displacements(w, N_VGetArrayPointer(newton->displacement));
  for (int k = 0; k < w->structure.mass_block_count; k++) {
    const baum_i_mass_block *block = &w->structure.mass_blocks[k];
    for (int i = 0; i < block->size; i++) {
      int j = block->first + i;
      inertia[j] = w->mass[block->value + i * block->size + i] * w->mechanism->scale[j];
    }
  }
}

/* Return the largest |x_i| n_i of multipliers x, or NaN if one of them is NaN. */
static double largest_of(const baum_i_ida_newton *newton, const double *x)
{
  const double *displacement = N_VGetArrayPointer(newton->displacement);
  double largest = 0.0;
  for (int i = 0; i < workspace_of(newton)->mechanism->nc && !isnan(largest); i++) {
    double size = fabs(x[i]) * displacement[i];
    largest = size <= largest ? largest : size;
  }
  return largest;
}

/* Set the tolerance of lambda in the error test, and write the weights of lambda. */
static void weigh_multipliers(baum_i_ida_newton *newton, double *weights)
{
  const baum_i_problem *problem = newton->sundials->problem;
  const baum_mechanism *mechanism = workspace_of(newton)->mechanism;
  const double *displacement = N_VGetArrayPointer(newton->displacement);
  const double *inertia = N_VGetArrayPointer(newton->inertia);
  newton->tested = problem->tolerance_lambda;
  newton->share = fmin(1.0, newton->tested / fmin(problem->tolerance_q, problem->tolerance_v));
  if (isinf(newton->tested)) {
    return;
  }
  double size = newton->energy;
  for (int j = 0; j < mechanism->nv; j++) {
    size = fmax(size, inertia[j] * mechanism->scale[j] * problem->rate * problem->rate);
  }
  newton->tested *= problem->rtol * size;
  for (int i = 0; i < mechanism->nc; i++) {
    weights[i] = displacement[i] / newton->tested;
  }
}

/* Return the tolerance of displacement j. */
static double position_tolerance(const baum_i_ida_newton *newton, int j)
{
  const baum_i_problem *problem = newton->sundials->problem;
  double scale = workspace_of(newton)->mechanism->scale[j];
  return problem->tolerance_q * (problem->rtol * scale + problem->atol);
}

void baum_i_ida_newton_begin_step(baum_i_ida_newton *newton, const double *multipliers,
                                  double *weights)
{
  const baum_workspace *w = workspace_of(newton);
  const double *inertia = N_VGetArrayPointer(newton->inertia);
  int nq = w->mechanism->nq;
  int nv = w->mechanism->nv;
  bool ggl = newton->index == BAUM_RESIDUAL_GGL;
  newton->momentum_q = newton->momentum_v = newton->action_q = 0.0;
  newton->energy = largest_of(newton, multipliers);
  newton->action = ggl ? largest_of(newton, multipliers + w->mechanism->nc) : 0.0;
  for (int j = 0; j < nv; j++) {
    double tolerance = position_tolerance(newton, j);
    newton->momentum_q = fmax(newton->momentum_q, inertia[j] * tolerance);
    newton->momentum_v = fmax(newton->momentum_v, inertia[j] / weights[nq + j]);
    double metric = ggl ? w->metric[j] * w->mechanism->scale[j] : 0.0;
    newton->action_q = fmax(newton->action_q, metric * tolerance);
  }
  weigh_multipliers(newton, weights + nq + nv);
}

static bool is_index3(const baum_i_ida_newton *newton)
{
  return newton->index == BAUM_RESIDUAL_INDEX3;
}

static double size_of_motion(const baum_i_ida_newton *newton, double c, const double *d,
                             const double *weights)
{
  int nq = workspace_of(newton)->mechanism->nq;
  int nv = workspace_of(newton)->mechanism->nv;
  double least = is_index3(newton) ? INDEX3_VELOCITY_TOLERANCE * c : 0.0;
  double sum = 0.0;
  for (int i = 0; i < nq; i++) {
    double position = d[i] * weights[i];
    sum += position * position;
  }
  for (int i = 0; i < nv; i++) {
    double weight = weights[nq + i];
    double velocity =
      d[nq + i] *
      (least > 0.0 ? 1.0 / fmax(1.0 / weight, least * position_tolerance(newton, i)) : weight);
    sum += velocity * velocity;
  }
  return sqrt(sum / (nq + nv));
}

static double size_of_lambda(const baum_i_ida_newton *newton, double c, const double *d)
{
  double least = is_index3(newton) ? INDEX3_VELOCITY_TOLERANCE * c * newton->momentum_q : 0.0;
  double tolerance = MULTIPLIER_TOLERANCE * newton->energy + c * fmax(newton->momentum_v, least);
  return largest_of(newton, d) / (fmin(tolerance, newton->tested) + DBL_MIN);
}

static double size_of_mu(const baum_i_ida_newton *newton, double c, const double *d)
{
  double tolerance = MULTIPLIER_TOLERANCE * newton->action + c * newton->action_q;
  return newton->index == BAUM_RESIDUAL_GGL ? largest_of(newton, d) / (tolerance + DBL_MIN) : 0.0;
}

/* ---- the test ---- */

/* Test whether the iteration has converged. A NaN counts as not converged. */
static int test(SUNNonlinearSolver solver, N_Vector sum, N_Vector correction, sunrealtype tolerance,
                N_Vector weights, void *user)
{
  (void)sum;
  baum_i_ida_newton *newton = user;
  const baum_mechanism *mechanism = workspace_of(newton)->mechanism;
  const double *d = N_VGetArrayPointer(correction);
  double c = 0.0;
  int before = 0;
  (void)IDAGetCurrentCj(newton->sundials->memory, &c);
  (void)SUNNonlinSolGetCurIter(solver, &before);
  double motion = size_of_motion(newton, fabs(c), d, N_VGetArrayPointer(weights)) / newton->share;
  const double *multipliers = d + mechanism->nq + mechanism->nv;
  double lambda = size_of_lambda(newton, fabs(c), multipliers);
  double mu = size_of_mu(newton, fabs(c), multipliers + mechanism->nc);
  double size = hypot(motion, hypot(lambda, mu));
  if (before == 0) {
    newton->first = size;
    return size <= tolerance ? 0 : SUN_NLS_CONTINUE;
  }
  double rate = pow(size / newton->first, 1.0 / before);
  if (!(rate <= WORST_RATE)) {
    return SUN_NLS_CONV_RECVR;
  }
  return rate / (1.0 - rate) * size <= tolerance ? 0 : SUN_NLS_CONTINUE;
}

int baum_i_ida_newton_attach(baum_i_ida_newton *newton)
{
  void *ida = newton->sundials->memory;
  newton->solver = SUNNonlinSol_Newton(newton->sundials->y, newton->sundials->context);
  int flag = newton->solver ? IDASetNonlinearSolver(ida, newton->solver) : IDA_MEM_FAIL;
  if (flag == IDA_SUCCESS) {
    /* Call this after IDASetNonlinearSolver(), which sets IDA's own test. */
    flag = (int)SUNNonlinSolSetConvTestFn(newton->solver, test, newton);
  }
  return flag;
}

void baum_i_ida_newton_close(baum_i_ida_newton *newton)
{
  (void)SUNNonlinSolFree(newton->solver);
}

/* ---- older matrices ---- */

static void scale(double *x, int n, double factor)
{
  for (int i = 0; i < n; i++) {
    x[i] *= factor;
  }
}

void baum_i_ida_newton_scale_right(const baum_i_ida_newton *newton, double ratio, N_Vector right)
{
  const baum_mechanism *mechanism = workspace_of(newton)->mechanism;
  double *b = N_VGetArrayPointer(right);
  double *rows = b + mechanism->nq + mechanism->nv;
  scale(b, mechanism->nq, ratio);
  for (int i = 0; i < mechanism->nc && newton->index != BAUM_RESIDUAL_INDEX1; i++) {
    bool position = is_index3(newton) && !baum_i_is_velocity_row(mechanism, i);
    rows[i] *= position ? ratio * ratio : ratio;
  }
  if (newton->index == BAUM_RESIDUAL_GGL) {
    scale(rows + mechanism->nc, mechanism->nc, ratio * ratio);
  }
}

void baum_i_ida_newton_scale_solution(const baum_i_ida_newton *newton, double ratio,
                                      N_Vector solution)
{
  const baum_mechanism *mechanism = workspace_of(newton)->mechanism;
  double *x = N_VGetArrayPointer(solution);
  double *v = x + mechanism->nq;
  scale(x, mechanism->nq, 1.0 / (ratio * ratio));
  scale(v, mechanism->nv, 1.0 / ratio);
  if (newton->index == BAUM_RESIDUAL_GGL) {
    scale(v + mechanism->nv + mechanism->nc, mechanism->nc, 1.0 / ratio);
  }
}

#endif
