/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Evaluation of a frozen mechanism at a point, without a run. Simulations do this by themselves; a
 *  workspace is for those who need Phi, J, nu, gamma, M, g or an acceleration of their own accord.
 *
 *  Arguments: t [s], positions q (nq), velocities v (nv), all finite. No output may overlap an
 *  input; outputs are untouched on failure.
 *  Dense matrices are row-major. Rows and columns are in the order of adding. Units follow the
 *  coordinates.
 *  Threads: one workspace is used by one thread at a time; any number may share a mechanism.
 *  NULL: q, v and every array are required unless an argument says otherwise.
 *  Every call returns BAUM_OK, BAUM_ERR_ARGUMENT (NULL or not finite), BAUM_ERR_CALLBACK or
 *  BAUM_ERR_NOT_FINITE (the message names the element), BAUM_ERR_STATE (from a function of the user
 *  that the workspace is calling), and what its own text adds.
 */
#ifndef BAUM_DYNAMICS_H
#define BAUM_DYNAMICS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Memory for evaluating one mechanism. */
typedef struct baum_workspace baum_workspace;

/** Make a workspace; it keeps the mechanism alive. Redundant rows are found here, from the design
 *  configuration at t = 0.
 *  @param[in]  mechanism  frozen
 *  @param[out] out        receives it, NULL on failure; release with baum_workspace_destroy()
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_workspace_create(const baum_mechanism *mechanism, baum_workspace **out);

/** Give up a workspace.
 *  @param workspace  may be NULL
 */
BAUM_API void baum_workspace_destroy(baum_workspace *workspace);

/** The design configuration and the given velocities, NaN where free.
 *  @param[out] q,v  (nq), (nv); each may be NULL
 *  @return          BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_workspace_design(baum_workspace *workspace, double *q, double *v);

/** Change an input, which has its initial value before.
 *  @param value  finite
 *  @return       BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_workspace_set_input(baum_workspace *workspace, baum_input_id input,
                                              double value);

/** Present value of an input; NaN for NULL and for ids of others. */
BAUM_API double baum_workspace_input(const baum_workspace *workspace, baum_input_id input);

/** Rates of positions q' = N(q) v; v where q is a vector, as in the plane.
 *  @param[in]  q,v  (nq), (nv)
 *  @param[out] dq   (nq)
 */
BAUM_API baum_status baum_workspace_rate(baum_workspace *workspace, const double *q,
                                         const double *v, double *dq);

/** Move positions by a displacement of velocity size: q + dx where q is a vector.
 *  @param[in]     dx  (nv)
 *  @param[in,out] q   (nq)
 */
BAUM_API baum_status baum_workspace_move(baum_workspace *workspace, const double *dx, double *q);

/** The displacement by which baum_workspace_move() leads from one configuration to another.
 *  @param[in]  from,to  (nq) each
 *  @param[out] dx       (nv)
 */
BAUM_API baum_status baum_workspace_difference(baum_workspace *workspace, const double *from,
                                               const double *to, double *dx);

/** Constraint residual Phi(q, t) (1).
 *  @param[in]  q    (nq)
 *  @param[out] phi  (nc) [m], [rad] or the unit of a user constraint
 */
BAUM_API baum_status baum_workspace_phi(baum_workspace *workspace, double t, const double *q,
                                        double *phi);

/** Velocity Jacobian J = dPhi/dq N (3), N the identity where q is a vector.
 *  @param[out] jacobian  (nc x nv)
 */
BAUM_API baum_status baum_workspace_jacobian(baum_workspace *workspace, double t, const double *q,
                                             double *jacobian);

/** nu = -dPhi/dt, so that J v = nu (3).
 *  @param[out] nu  (nc)
 */
BAUM_API baum_status baum_workspace_nu(baum_workspace *workspace, double t, const double *q,
                                       double *nu);

/** gamma, so that J a = gamma (4).
 *  @param[out] gamma  (nc)
 */
BAUM_API baum_status baum_workspace_gamma(baum_workspace *workspace, double t, const double *q,
                                          const double *v, double *gamma);

/** Mass matrix M.
 *  @param[out] mass  (nv x nv)
 */
BAUM_API baum_status baum_workspace_mass(baum_workspace *workspace, double t, const double *q,
                                         double *mass);

/** Force vector g: applied, gravity and velocity terms.
 *  @param[out] force  (nv)
 */
BAUM_API baum_status baum_workspace_force(baum_workspace *workspace, double t, const double *q,
                                          const double *v, double *force);

/** Kinetic and potential energy; the latter of gravity, springs, steady loads and user potentials.
 *  @param[out] kinetic,potential  [J]; each may be NULL
 */
BAUM_API baum_status baum_workspace_energy(baum_workspace *workspace, double t, const double *q,
                                           const double *v, double *kinetic, double *potential);

/** Acceleration and multipliers of M a + J^T lambda = g, J a = gamma - 2 alpha Phi' - beta^2 Phi
 *  (7); with alpha = beta = 0 those of (5). Redundant rows are left out of the solution; where
 *  multipliers are not unique they are those of least norm in rows scaled by M, as far as the
 *  constraints are met, and balance the forces to 1e-9 in any case. Which rows are left
 *  out changes where the others come close to dependent; this allocates, and the residual forms
 *  leave them out, too, from then on.
 *  @param      alpha,beta  [1/s] finite
 *  @param[out] a           (nv); may be NULL
 *  @param[out] lambda      (nc); may be NULL
 *  @return                 also BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_workspace_acceleration(baum_workspace *workspace, double t,
                                                 const double *q, const double *v, double alpha,
                                                 double beta, double *a, double *lambda);

/** Force and moment of a joint on its body_b: see planar.h. For others, such as user constraints,
 *  gears and couplings: -J^T lambda over its bodies.
 *  @param[in]  lambda    (nc)
 *  @param[out] reaction  (width) as the channel BAUM_JOINT_REACTION, 3 for planar joints
 */
BAUM_API baum_status baum_workspace_reaction(baum_workspace *workspace, double t, const double *q,
                                             const double *lambda, baum_joint_id joint,
                                             double *reaction);

/** Which equations baum_workspace_residual() evaluates: q' - N v, M v' + J^T lambda - g, and
 *  constraints. GGL (Gear, Gupta, Leimkuhler 1985) has q' - N (v - W^-1 J^T mu) instead of the
 *  first, and with mu as many unknowns more; mu is zero but for the errors of a method. W is
 *  constant and diagonal: the diagonal of M in the design configuration at t = 0, for coordinates
 *  of scale s with less than a millionth of the largest M_kk s_k^2 that millionth over s^2. */
typedef enum baum_residual {
  BAUM_RESIDUAL_INDEX1 = 1, /**< J v' - gamma + 2 alpha Phi' + beta^2 Phi. */
  BAUM_RESIDUAL_INDEX2 = 2, /**< Phi' = J v - nu. */
  BAUM_RESIDUAL_INDEX3 = 3, /**< Phi. */
  BAUM_RESIDUAL_GGL = 4     /**< Phi' = J v - nu, then Phi. */
} baum_residual;

/** Which equations, and their gains. */
typedef struct baum_dae {
  baum_residual index; /**< Form. */
  double alpha;        /**< [1/s] finite; used by index 1. */
  double beta;         /**< [1/s] finite; used by index 1. */
} baum_dae;

/** A sparse matrix in compressed columns with sorted rows; the arrays are the caller's. */
typedef struct baum_sparse {
  int32_t *columns; /**< (size + 1) starts of the columns. May be NULL. */
  int32_t *rows;    /**< (nonzeros). May be NULL. */
  double *values;   /**< (nonzeros). May be NULL. */
  int32_t nonzeros; /**< Number of entries; always written. */
} baum_sparse;

/** Residual F(t, y, y') of the differential-algebraic equations with y = (q, v, lambda), for GGL
 *  (q, v, lambda, mu). Rows that are redundant read lambda_i, and mu_i, instead.
 *  @param[in]  dae       which equations
 *  @param[in]  y,dy      (nq + nv + nc) each, (nq + nv + 2 nc) for GGL
 *  @param[out] residual  as many
 */
BAUM_API baum_status baum_workspace_residual(baum_workspace *workspace, const baum_dae *dae,
                                             double t, const double *y, const double *dy,
                                             double *residual);

/** Jacobian dF/dy + c dF/dy' of that residual. Its pattern depends on dae->index only. Allocates:
 *  for use outside of inner loops. To learn the size call first with all arrays of `out` NULL.
 *  @param      c    [1/s] finite
 *  @param[out] out  nonzeros, and what is asked for by an array that is not NULL
 *  @return          also BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_workspace_residual_jacobian(baum_workspace *workspace,
                                                      const baum_dae *dae, double c, double t,
                                                      const double *y, const double *dy,
                                                      baum_sparse *out);

/** Assemble: move q the least (weighted by mass) so that Phi(q, t) = 0, and complete v. Each Newton
 *  step is the least, so that a move over which J turns is near the least only: give `held` what
 *  must stay.
 *  @param[in,out] q     (nq) a guess on entry; unchanged on failure
 *  @param[in,out] v     (nv) finite entries are held exactly, NaN ones follow from the constraints
 *                       and are least where undetermined; unchanged on failure
 *  @param[in]     held  (held_count) bodies whose positions stay; may be NULL when held_count is 0.
 *                       Bodies whose definition says `held` stay too.
 *  @return              also BAUM_ERR_INCONSISTENT (names the joints that conflict),
 *                       BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY
 */
BAUM_API baum_status baum_workspace_assemble(baum_workspace *workspace, double t, double *q,
                                             double *v, const baum_body_id *held,
                                             int32_t held_count);

/** Project onto the constraints: q by the least change in the metric of M, then v likewise.
 *  @param[in,out] q,v  (nq), (nv) near the constraints; unchanged on failure
 *  @return             also BAUM_ERR_CONVERGENCE, BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY,
 *                      BAUM_ERR_INCONSISTENT (redundant rows that the others do not meet)
 */
BAUM_API baum_status baum_workspace_project(baum_workspace *workspace, double t, double *q,
                                            double *v);

#ifdef __cplusplus
}
#endif

#endif
