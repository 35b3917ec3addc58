/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Evaluation of a frozen mechanism at one state, without a run: Phi, J, nu, gamma, M, g,
 *  accelerations, residuals, assembly and projection.
 *
 *  Arguments: times t [s], positions q (nq) and velocities v (nv) must be finite. No output may
 *  overlap an input. Outputs are not written on failure. Dense matrices are row-major. Rows and
 *  columns are in the order of adding. Units follow the coordinates.
 *
 *  Every call returns BAUM_OK, BAUM_ERR_ARGUMENT (NULL or not finite), BAUM_ERR_CALLBACK or
 *  BAUM_ERR_NOT_FINITE (the message names the element), BAUM_ERR_STATE (called from a user function
 *  that this workspace is calling), and the statuses that its own comment adds.
 *
 *  Threads: one workspace is used by one thread at a time. Any number of workspaces may share a
 *  mechanism.
 */
#ifndef BAUM_DYNAMICS_H
#define BAUM_DYNAMICS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Memory for evaluating one mechanism. */
typedef struct baum_workspace baum_workspace;

/** Create a workspace; it keeps the mechanism alive. Redundant rows are determined here, from the
 *  design configuration at t = 0.
 *  @param      mechanism  frozen
 *  @param[out] out        receives it, NULL on failure; release it with baum_workspace_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_workspace_create(const baum_mechanism *mechanism, baum_workspace **out);

/** Release a workspace. @param workspace  may be NULL */
BAUM_API void baum_workspace_destroy(baum_workspace *workspace);

/** Read the design configuration and the given initial velocities.
 *  @param      workspace  of the mechanism
 *  @param[out] q,v        (nq), (nv); v is NaN where it is free. Each may be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_workspace_design(baum_workspace *workspace, double *q, double *v);

/** Change an input. Until then it has its initial value.
 *  @param workspace  of the mechanism
 *  @param input      one of its inputs
 *  @param value      finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_workspace_set_input(baum_workspace *workspace, baum_input_id input,
                                              double value);

/** Read an input.
 *  @param workspace  may be NULL
 *  @param input      one of the mechanism
 *  @return  its present value; NaN for NULL and other ids */
BAUM_API double baum_workspace_input(const baum_workspace *workspace, baum_input_id input);

/** Compute q' = N(q) v. It equals v if q is a vector, as for planar bodies.
 *  @param      workspace  of the mechanism
 *  @param[in]  q,v        (nq), (nv)
 *  @param[out] dq         (nq)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_rate(baum_workspace *workspace, const double *q,
                                         const double *v, double *dq);

/** Move positions by a displacement dx (nv): q + dx if q is a vector.
 *  @param         workspace  of the mechanism
 *  @param[in]     dx         (nv)
 *  @param[in,out] q          (nq)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_move(baum_workspace *workspace, const double *dx, double *q);

/** Compute the displacement by which baum_workspace_move() takes one configuration to another.
 *  @param      workspace  of the mechanism
 *  @param[in]  from,to    (nq) each
 *  @param[out] dx         (nv)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_difference(baum_workspace *workspace, const double *from,
                                               const double *to, double *dx);

/** Evaluate the constraints Phi(q, t) (1).
 *  @param      workspace,t,q  see the top of this file
 *  @param[out] phi            (nc) [m], [rad] or the unit of a user constraint
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_phi(baum_workspace *workspace, double t, const double *q,
                                        double *phi);

/** Evaluate the velocity Jacobian J = dPhi/dq N (3). N is the identity if q is a vector.
 *  @param      workspace,t,q  see the top of this file
 *  @param[out] jacobian       (nc x nv)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_jacobian(baum_workspace *workspace, double t, const double *q,
                                             double *jacobian);

/** Evaluate nu = -dPhi/dt, the right side of J v = nu (3).
 *  @param      workspace,t,q  see the top of this file
 *  @param[out] nu             (nc)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_nu(baum_workspace *workspace, double t, const double *q,
                                       double *nu);

/** Evaluate gamma, the right side of J a = gamma (4).
 *  @param      workspace,t,q,v  see the top of this file
 *  @param[out] gamma            (nc)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_gamma(baum_workspace *workspace, double t, const double *q,
                                          const double *v, double *gamma);

/** Evaluate the mass matrix M.
 *  @param      workspace,t,q  see the top of this file
 *  @param[out] mass           (nv x nv)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_mass(baum_workspace *workspace, double t, const double *q,
                                         double *mass);

/** Evaluate the force vector g: applied forces, gravity and velocity terms.
 *  @param      workspace,t,q,v  see the top of this file
 *  @param[out] force            (nv)
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_force(baum_workspace *workspace, double t, const double *q,
                                          const double *v, double *force);

/** Evaluate the kinetic energy and the potential energy of gravity, springs, constant loads and
 *  user potentials.
 *  @param      workspace,t,q,v    see the top of this file
 *  @param[out] kinetic,potential  [J] Each may be NULL.
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_energy(baum_workspace *workspace, double t, const double *q,
                                           const double *v, double *kinetic, double *potential);

/** Solve M a + J^T lambda = g, J a = gamma - 2 alpha Phi' - beta^2 Phi (7) for accelerations and
 *  multipliers; alpha = beta = 0 gives (5).
 *
 *  Redundant rows are omitted from the solution. Where multipliers are not unique, the function
 *  returns those of least norm, with lambda_i multiplied by |row i of J M^-1/2|. They balance the
 *  forces to a relative 1e-9. If the remaining rows become nearly dependent, the workspace looks
 *  for a better choice of omitted rows. A new choice allocates memory; baum_workspace_residual()
 *  then omits the same rows.
 *  @param      workspace,t,q,v  see the top of this file
 *  @param      alpha,beta       [1/s] finite
 *  @param[out] a                (nv) May be NULL.
 *  @param[out] lambda           (nc) May be NULL.
 *  @return  also BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY, BAUM_ERR_INCONSISTENT (the accelerations
 *           violate an omitted row; the message names a joint) */
BAUM_API baum_status baum_workspace_acceleration(baum_workspace *workspace, double t,
                                                 const double *q, const double *v, double alpha,
                                                 double beta, double *a, double *lambda);

/** Compute the reaction of a joint: force and moment on its body_b, see planar.h and spatial.h. For
 *  user constraints, gears and couplings it is the generalized force -J^T lambda on the velocities
 *  of their bodies.
 *  @param      workspace,t,q  see the top of this file
 *  @param[in]  lambda         (nc)
 *  @param      joint          one of the mechanism
 *  @param[out] reaction       (width) as the channel BAUM_JOINT_REACTION; 3 for planar, 6 for
 *                             spatial joints
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_reaction(baum_workspace *workspace, double t, const double *q,
                                             const double *lambda, baum_joint_id joint,
                                             double *reaction);

/** The equations that baum_workspace_residual() evaluates: q' - N v, M v' + J^T lambda - g, and the
 *  constraints below.
 *
 *  GGL (Gear, Gupta, Leimkuhler 1985) replaces the first equation by q' - N (v - W^-1 J^T mu) and
 *  adds one unknown mu for each row. All mu of the exact solution are zero. W is constant and
 *  diagonal: the diagonal of M in the design configuration at t = 0. Entries M_kk below m / s_k^2
 *  are raised to m / s_k^2, where s_k is the scale of coordinate k and m is a millionth of the
 *  largest M_jj s_j^2. */
typedef enum baum_residual {
  BAUM_RESIDUAL_INDEX1 = 1, /**< J v' - gamma + 2 alpha Phi' + beta^2 Phi. */
  BAUM_RESIDUAL_INDEX2 = 2, /**< Phi' = J v - nu. */
  BAUM_RESIDUAL_INDEX3 = 3, /**< Phi. */
  BAUM_RESIDUAL_GGL = 4     /**< Phi' = J v - nu, then Phi. */
} baum_residual;

/** Which equations, and their gains. */
typedef struct baum_dae {
  baum_residual index; /**< Form of the constraints. */
  double alpha;        /**< [1/s] finite; used by index 1. */
  double beta;         /**< [1/s] finite; used by index 1. */
} baum_dae;

/** A sparse matrix in compressed columns with sorted rows. The caller owns the arrays. */
typedef struct baum_sparse {
  int32_t *columns; /**< (size + 1) starts of the columns. May be NULL. */
  int32_t *rows;    /**< (nonzeros). May be NULL. */
  double *values;   /**< (nonzeros). May be NULL. */
  int32_t nonzeros; /**< [-] number of entries; always written. */
} baum_sparse;

/** Evaluate the residual F(t, y, y') of the differential-algebraic equations with y = (q, v,
 *  lambda); for GGL y = (q, v, lambda, mu). The equations of an omitted redundant row i are
 *  replaced by lambda_i = 0, for GGL also by mu_i = 0.
 *  @param      workspace,t  see the top of this file
 *  @param[in]  dae          which equations
 *  @param[in]  y,dy         (nq + nv + nc) each; (nq + nv + 2 nc) for GGL
 *  @param[out] residual     of the same size
 *  @return  see the top of this file */
BAUM_API baum_status baum_workspace_residual(baum_workspace *workspace, const baum_dae *dae,
                                             double t, const double *y, const double *dy,
                                             double *residual);

/** Evaluate the Jacobian dF/dy + c dF/dy' of the residual F of baum_workspace_residual(). Its
 *  pattern depends on dae->index only. To learn the number of entries, first call the function with
 *  all arrays of `out` NULL. The function allocates memory, so do not use it in inner loops.
 *  @param      workspace,t  see the top of this file
 *  @param[in]  dae          which equations
 *  @param      c            [1/s] finite
 *  @param[in]  y,dy         as for baum_workspace_residual()
 *  @param[out] out          receives nonzeros; its arrays are filled unless they are NULL
 *  @return  also BAUM_ERR_MEMORY */
BAUM_API baum_status baum_workspace_residual_jacobian(baum_workspace *workspace,
                                                      const baum_dae *dae, double c, double t,
                                                      const double *y, const double *dy,
                                                      baum_sparse *out);

/** Assemble: move q by the least mass-weighted change that satisfies Phi(q, t) = 0, and complete v.
 *  Each Newton step is the least possible change. The sum of the steps is close to the least
 *  possible unless J changes much during the move. In that case list the bodies that must not move
 *  in `held`.
 *  @param         workspace,t  see the top of this file
 *  @param[in,out] q            (nq) initial guess on entry; unchanged on failure
 *  @param[in,out] v            (nv) finite entries are kept exactly; NaN entries follow from the
 *                              constraints, with the least norm if undetermined. Unchanged on
 *                              failure.
 *  @param[in]     held         (held_count) bodies that keep their positions, in addition to those
 *                              whose definition sets `held`. May be NULL if held_count is 0.
 *  @param         held_count   [-] >= 0
 *  @return  also BAUM_ERR_INCONSISTENT (the message names the joints in conflict),
 *           BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_workspace_assemble(baum_workspace *workspace, double t, double *q,
                                             double *v, const baum_body_id *held,
                                             int32_t held_count);

/** Project onto the constraints: change q, then v, by the least amount in the metric of M.
 *  @param         workspace,t  see the top of this file
 *  @param[in,out] q,v          (nq), (nv) near the constraints; unchanged on failure
 *  @return  also BAUM_ERR_CONVERGENCE, BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY, BAUM_ERR_INCONSISTENT
 *           (redundant rows contradict the others) */
BAUM_API baum_status baum_workspace_project(baum_workspace *workspace, double t, double *q,
                                            double *v);

#ifdef __cplusplus
}
#endif

#endif
