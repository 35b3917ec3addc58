/* SPDX-License-Identifier: BSD-3-Clause */
/* The public functions of baum/dynamics.h. They check their arguments, call the stages of the
 * evaluation, and copy the results, which are stored as blocks, to the caller's dense arrays. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/dynamics.h"
#include "mechanism/definition.h"

/* ---- arguments ---- */

static baum_status fail_null(const char *call, const char *what)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is NULL", call, what);
}

static baum_status check_finite(const char *call, const char *what, const double *values, int count)
{
  if (!values && count > 0) {
    return fail_null(call, what);
  }
  for (int i = 0; i < count; i++) {
    if (!isfinite(values[i])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s[%d] is %g, must be finite", call, what, i,
                         values[i]);
    }
  }
  return BAUM_OK;
}

static baum_status check_point(const char *call, const baum_workspace *w, double t, const double *q,
                               const double *out)
{
  if (!w) {
    return fail_null(call, "the workspace");
  }
  if (!out) {
    return fail_null(call, "the output");
  }
  BAUM_I_TRY(baum_i_check_finite(call, "t", "s", t));
  BAUM_I_TRY(check_finite(call, "q", q, w->mechanism->nq));
  return baum_i_check_idle(w, call, "the workspace");
}

static baum_status check_state(const char *call, const baum_workspace *w, double t, const double *q,
                               const double *v, const double *out)
{
  BAUM_I_TRY(check_point(call, w, t, q, out));
  return check_finite(call, "v", v, w->mechanism->nv);
}

/* Copy values to the caller's array, unless the array is NULL. */
static void give(const double *values, double *out, int count)
{
  if (out) {
    memcpy(out, values, (size_t)count * sizeof *out);
  }
}

/* ---- creation ---- */

/* Find the redundant rows in the design configuration at t = 0. If the design configuration cannot
 * be assembled or evaluated, all rows are kept. Later evaluations then report the error. */
static baum_status find_redundancy(baum_workspace *w)
{
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = baum_i_find_rows(w, 0.0, w->mechanism->design_q);
  BAUM_I_TRY(status == BAUM_ERR_MEMORY ? status : baum_i_message_settle(BAUM_OK, &kept));
  return baum_i_use_blocks(w);
}

baum_status baum_workspace_create(const baum_mechanism *mechanism, baum_workspace **out)
{
  if (!out) {
    return fail_null("baum_workspace_create", "out");
  }
  *out = NULL;
  BAUM_I_TRY(baum_i_check_frozen(mechanism, "baum_workspace_create"));
  BAUM_I_TRY(baum_i_workspace_create(mechanism, BAUM_I_KKT_AUTO, out));
  baum_status status = find_redundancy(*out);
  if (status != BAUM_OK) {
    baum_workspace_destroy(*out);
    *out = NULL;
  }
  return status;
}

baum_status baum_workspace_design(baum_workspace *workspace, double *q, double *v)
{
  if (!workspace) {
    return fail_null("baum_workspace_design", "the workspace");
  }
  give(workspace->mechanism->design_q, q, workspace->mechanism->nq);
  give(workspace->mechanism->design_v, v, workspace->mechanism->nv);
  return BAUM_OK;
}

/* ---- configuration manifold ---- */

baum_status baum_workspace_rate(baum_workspace *workspace, const double *q, const double *v,
                                double *dq)
{
  BAUM_I_TRY(check_state("baum_workspace_rate", workspace, 0.0, q, v, dq));
  baum_i_rate(workspace->mechanism, q, v, dq);
  return BAUM_OK;
}

baum_status baum_workspace_move(baum_workspace *workspace, const double *dx, double *q)
{
  const char *call = "baum_workspace_move";
  BAUM_I_TRY(check_point(call, workspace, 0.0, q, q));
  BAUM_I_TRY(check_finite(call, "dx", dx, workspace->mechanism->nv));
  baum_i_move(workspace->mechanism, 1.0, dx, q);
  return BAUM_OK;
}

baum_status baum_workspace_difference(baum_workspace *workspace, const double *from,
                                      const double *to, double *dx)
{
  const char *call = "baum_workspace_difference";
  BAUM_I_TRY(check_point(call, workspace, 0.0, from, dx));
  BAUM_I_TRY(check_finite(call, "to", to, workspace->mechanism->nq));
  baum_i_difference(workspace->mechanism, from, to, dx);
  return BAUM_OK;
}

/* ---- position level ---- */

baum_status baum_workspace_phi(baum_workspace *workspace, double t, const double *q, double *phi)
{
  BAUM_I_TRY(check_point("baum_workspace_phi", workspace, t, q, phi));
  baum_i_point_set(&workspace->point, t, q, NULL);
  BAUM_I_TRY(baum_i_mechanism_phi(&workspace->point, workspace->phi));
  BAUM_I_TRY(baum_i_check_rows(workspace, "Phi", workspace->phi));
  give(workspace->phi, phi, workspace->mechanism->nc);
  return BAUM_OK;
}

baum_status baum_workspace_jacobian(baum_workspace *workspace, double t, const double *q,
                                    double *jacobian)
{
  BAUM_I_TRY(check_point("baum_workspace_jacobian", workspace, t, q, jacobian));
  baum_i_point_set(&workspace->point, t, q, NULL);
  BAUM_I_TRY(baum_i_mechanism_jacobian(&workspace->point, workspace->jacobian));
  BAUM_I_TRY(baum_i_check_jacobian(workspace));
  size_t nv = (size_t)workspace->mechanism->nv;
  memset(jacobian, 0, (size_t)workspace->mechanism->nc * nv * sizeof *jacobian);
  for (int k = 0; k < workspace->structure.row_block_count; k++) {
    const baum_i_row_block *block = &workspace->structure.row_blocks[k];
    for (int i = 0; i < block->rows; i++) {
      double *row = jacobian + (size_t)(block->row + i) * nv;
      for (int j = 0; j < block->cols; j++) {
        row[block->col[j]] = workspace->jacobian[block->value + i * block->cols + j];
      }
    }
  }
  return BAUM_OK;
}

baum_status baum_workspace_nu(baum_workspace *workspace, double t, const double *q, double *nu)
{
  BAUM_I_TRY(check_point("baum_workspace_nu", workspace, t, q, nu));
  baum_i_point_set(&workspace->point, t, q, NULL);
  BAUM_I_TRY(baum_i_mechanism_nu(&workspace->point, workspace->nu));
  BAUM_I_TRY(baum_i_check_rows(workspace, "nu", workspace->nu));
  give(workspace->nu, nu, workspace->mechanism->nc);
  return BAUM_OK;
}

baum_status baum_workspace_mass(baum_workspace *workspace, double t, const double *q, double *mass)
{
  BAUM_I_TRY(check_point("baum_workspace_mass", workspace, t, q, mass));
  baum_i_point_set(&workspace->point, t, q, NULL);
  BAUM_I_TRY(baum_i_evaluate_mass(workspace));
  size_t nv = (size_t)workspace->mechanism->nv;
  memset(mass, 0, nv * nv * sizeof *mass);
  for (int k = 0; k < workspace->structure.mass_block_count; k++) {
    const baum_i_mass_block *block = &workspace->structure.mass_blocks[k];
    for (int i = 0; i < block->size; i++) {
      memcpy(mass + (size_t)(block->first + i) * nv + block->first,
             workspace->mass + block->value + i * block->size, (size_t)block->size * sizeof *mass);
    }
  }
  return BAUM_OK;
}

/* ---- velocity level ---- */

baum_status baum_workspace_gamma(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *gamma)
{
  BAUM_I_TRY(check_state("baum_workspace_gamma", workspace, t, q, v, gamma));
  baum_i_point_set(&workspace->point, t, q, v);
  BAUM_I_TRY(baum_i_mechanism_gamma(&workspace->point, workspace->gamma));
  BAUM_I_TRY(baum_i_check_rows(workspace, "gamma", workspace->gamma));
  give(workspace->gamma, gamma, workspace->mechanism->nc);
  return BAUM_OK;
}

baum_status baum_workspace_force(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *force)
{
  BAUM_I_TRY(check_state("baum_workspace_force", workspace, t, q, v, force));
  baum_i_point_set(&workspace->point, t, q, v);
  BAUM_I_TRY(baum_i_mechanism_force(&workspace->point, workspace->force));
  BAUM_I_TRY(baum_i_check_velocities(workspace, "force", workspace->force));
  give(workspace->force, force, workspace->mechanism->nv);
  return BAUM_OK;
}

baum_status baum_workspace_energy(baum_workspace *workspace, double t, const double *q,
                                  const double *v, double *kinetic, double *potential)
{
  double found[2] = {0.0, 0.0};
  BAUM_I_TRY(check_state("baum_workspace_energy", workspace, t, q, v, found));
  BAUM_I_TRY(baum_i_energy(workspace, t, q, v, &found[0], &found[1]));
  if (!isfinite(found[0]) || !isfinite(found[1])) {
    return baum_i_fail(BAUM_ERR_NOT_FINITE,
                       "t = %.9g s: the kinetic energy is %g J and the potential energy is %g J; "
                       "both must be finite",
                       t, found[0], found[1]);
  }
  give(&found[0], kinetic, 1);
  give(&found[1], potential, 1);
  return BAUM_OK;
}

/* ---- solutions ---- */

static baum_status check_gains(const char *call, double alpha, double beta)
{
  BAUM_I_TRY(baum_i_check_finite(call, "alpha", "1/s", alpha));
  return baum_i_check_finite(call, "beta", "1/s", beta);
}

/* Called after a solution. Choose other independent rows if the present ones are ill-conditioned.
 * Returns true if the solution must be repeated. */
static bool has_chosen_rows(baum_workspace *w, baum_status status, double t, const double *q)
{
  bool solved = status == BAUM_OK || status == BAUM_ERR_SINGULAR || status == BAUM_ERR_CONVERGENCE;
  return solved && baum_i_choose_rows(w, t, q, baum_i_smallest_pivot(w, NULL), BAUM_I_ROWS_BEST);
}

static baum_status accelerate(baum_workspace *w, double t, const double *q, const double *v,
                              double alpha, double beta)
{
  return alpha != 0.0 || beta != 0.0 ? baum_i_acceleration(w, t, q, v, alpha, beta)
                                     : baum_i_reported_acceleration(w, t, q, v);
}

baum_status baum_workspace_acceleration(baum_workspace *workspace, double t, const double *q,
                                        const double *v, double alpha, double beta, double *a,
                                        double *lambda)
{
  const char *call = "baum_workspace_acceleration";
  /* check_state() refuses an output that is NULL. a and lambda may be NULL here, so &t is passed in
   * their place. */
  BAUM_I_TRY(check_state(call, workspace, t, q, v, &t));
  BAUM_I_TRY(check_gains(call, alpha, beta));
  baum_status status = accelerate(workspace, t, q, v, alpha, beta);
  if (has_chosen_rows(workspace, status, t, q)) {
    status = accelerate(workspace, t, q, v, alpha, beta);
  }
  BAUM_I_TRY(status);
  if (workspace->rows.count > 0) {
    BAUM_I_TRY(baum_i_check_omitted_rows(workspace, v, alpha, beta));
  }
  give(workspace->a, a, workspace->mechanism->nv);
  give(workspace->lambda, lambda, workspace->mechanism->nc);
  return BAUM_OK;
}

baum_status baum_workspace_reaction(baum_workspace *workspace, double t, const double *q,
                                    const double *lambda, baum_joint_id joint, double *reaction)
{
  const char *call = "baum_workspace_reaction";
  BAUM_I_TRY(check_point(call, workspace, t, q, reaction));
  BAUM_I_TRY(check_finite(call, "lambda", lambda, workspace->mechanism->nc));
  BAUM_I_TRY(baum_i_check_joint(workspace->mechanism, joint, call, "joint"));
  BAUM_I_TRY(baum_i_position_stage(workspace, t, q));
  baum_i_reaction(workspace, baum_i_joint_index(workspace->mechanism, joint), lambda, reaction);
  return BAUM_OK;
}

/* ---- residual forms ---- */

static baum_status check_dae(const char *call, const baum_workspace *w, const baum_dae *dae,
                             double t, const double *y, const double *dy)
{
  if (!w || !dae) {
    return fail_null(call, w ? "dae" : "the workspace");
  }
  if (dae->index < BAUM_RESIDUAL_INDEX1 || dae->index > BAUM_RESIDUAL_GGL) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: index is %d, must be 1, 2, 3 or 4 (GGL)", call,
                       (int)dae->index);
  }
  int size = baum_i_residual_size(w->mechanism, dae->index);
  BAUM_I_TRY(check_gains(call, dae->alpha, dae->beta));
  BAUM_I_TRY(baum_i_check_finite(call, "t", "s", t));
  BAUM_I_TRY(check_finite(call, "y", y, size));
  BAUM_I_TRY(check_finite(call, "dy", dy, size));
  return baum_i_check_idle(w, call, "the workspace");
}

static baum_status need_metric(baum_workspace *w, const baum_dae *dae)
{
  return dae->index == BAUM_RESIDUAL_GGL ? baum_i_need_metric(w) : BAUM_OK;
}

baum_status baum_workspace_residual(baum_workspace *workspace, const baum_dae *dae, double t,
                                    const double *y, const double *dy, double *residual)
{
  const char *call = "baum_workspace_residual";
  BAUM_I_TRY(check_dae(call, workspace, dae, t, y, dy));
  BAUM_I_TRY(residual ? BAUM_OK : fail_null(call, "the output"));
  BAUM_I_TRY(need_metric(workspace, dae));
  return baum_i_residual(workspace, dae, t, y, dy, residual);
}

baum_status baum_workspace_residual_jacobian(baum_workspace *workspace, const baum_dae *dae,
                                             double c, double t, const double *y, const double *dy,
                                             baum_sparse *out)
{
  const char *call = "baum_workspace_residual_jacobian";
  BAUM_I_TRY(out ? BAUM_OK : fail_null(call, "the output"));
  BAUM_I_TRY(check_dae(call, workspace, dae, t, y, dy));
  BAUM_I_TRY(baum_i_check_finite(call, "c", "1/s", c));
  BAUM_I_TRY(need_metric(workspace, dae));
  return baum_i_residual_jacobian(workspace, dae, c, t, y, dy, out);
}

/* ---- assembly and projection ---- */

static baum_status mark_held(const baum_mechanism *m, const baum_body_id *held, int32_t count,
                             bool *flags)
{
  memcpy(flags, m->held, (size_t)m->nv * sizeof *flags);
  for (int32_t k = 0; k < count; k++) {
    BAUM_I_TRY(baum_i_check_body(m, held[k], "baum_workspace_assemble", "held"));
    int index = baum_i_body_index(m, held[k]);
    for (int j = 0; index > 0 && j < m->bodies[index]->nv; j++) {
      flags[m->bodies[index]->v + j] = true;
    }
  }
  return BAUM_OK;
}

/* Check q and v. Velocities may be NaN, but positions may not. */
static baum_status check_guess(const char *call, const baum_workspace *w, double t, const double *q,
                               const double *v)
{
  BAUM_I_TRY(check_point(call, w, t, q, &t));
  if (!v) {
    return fail_null(call, "v");
  }
  for (int i = 0; i < w->mechanism->nv; i++) {
    if (isinf(v[i])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: v[%d] is %g, must be finite, or NaN if free", call,
                         i, v[i]);
    }
  }
  return BAUM_OK;
}

baum_status baum_workspace_assemble(baum_workspace *workspace, double t, double *q, double *v,
                                    const baum_body_id *held, int32_t held_count)
{
  const char *call = "baum_workspace_assemble";
  BAUM_I_TRY(check_guess(call, workspace, t, q, v));
  if (held_count < 0 || (held_count > 0 && !held)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: held is NULL or held_count (%d) is negative", call,
                       (int)held_count);
  }
  bool *flags = baum_i_alloc((size_t)workspace->mechanism->nv, sizeof *flags);
  BAUM_I_TRY(baum_i_check_memory(flags));
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = mark_held(workspace->mechanism, held, held_count, flags);
  if (status == BAUM_OK) {
    status = baum_i_assemble(workspace, t, q, v, flags);
  }
  baum_i_free(flags);
  return baum_i_message_settle(status, &kept);
}

/* Project a copy of (q, v). */
static baum_status project(baum_workspace *w, double t, const double *q, const double *v,
                           double *copy)
{
  double *v_copy = copy + w->mechanism->nq;
  give(q, copy, w->mechanism->nq);
  give(v, v_copy, w->mechanism->nv);
  return baum_i_project(w, t, copy, v_copy);
}

static baum_status project_and_check(baum_workspace *w, double t, const double *q, const double *v,
                                     double *copy)
{
  const double *v_copy = copy + w->mechanism->nq;
  baum_status status = project(w, t, q, v, copy);
  if (has_chosen_rows(w, status, t, q)) {
    status = project(w, t, q, v, copy);
  }
  BAUM_I_TRY(status);
  BAUM_I_TRY(baum_i_check_positions(w, "projected pose", copy));
  BAUM_I_TRY(baum_i_check_velocities(w, "projected velocity", v_copy));
  baum_i_point_set(&w->point, t, copy, v_copy);
  BAUM_I_TRY(baum_i_check_sides(w, t, "projection"));
  return baum_i_check_projection(w, t, copy, v_copy, v);
}

baum_status baum_workspace_project(baum_workspace *workspace, double t, double *q, double *v)
{
  BAUM_I_TRY(check_state("baum_workspace_project", workspace, t, q, v, &t));
  const baum_mechanism *m = workspace->mechanism;
  double *copy = baum_i_alloc((size_t)m->nq + (size_t)m->nv, sizeof *copy);
  BAUM_I_TRY(baum_i_check_memory(copy));
  baum_status status = project_and_check(workspace, t, q, v, copy);
  if (status == BAUM_OK) {
    give(copy, q, m->nq);
    give(copy + m->nq, v, m->nv);
  }
  baum_i_free(copy);
  return status;
}
