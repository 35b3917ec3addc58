/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  A workspace evaluates a frozen mechanism at one state, without a run. It computes the
 *  constraints Phi, their Jacobian J, the right-hand sides of the velocity constraints J v = nu and
 *  of the acceleration constraints J a = gamma, the mass matrix M, the forces g, accelerations and
 *  residuals. It can also assemble a mechanism and project a state onto the constraints. The page
 *  "docs/notation.md" explains the symbols and lists the numbered equations.
 *
 *  Arguments: times t [s], positions q (nq) and velocities v (nv) must be finite. No output may
 *  overlap an input. If a call fails, it does not write its outputs. Dense matrices are row-major.
 *  Coordinates are in the order in which the bodies were added, and constraint rows are in the
 *  order in which the joints were added. The units of results follow from the units of the
 *  coordinates.
 *
 *  Every call may return BAUM_OK, BAUM_ERR_ARGUMENT (an argument is NULL or not finite),
 *  BAUM_ERR_CALLBACK or BAUM_ERR_NOT_FINITE (the message names the element), or BAUM_ERR_STATE (the
 *  call comes from a user function that the same workspace is calling). The comments of the
 *  functions name the other statuses that a function may return.
 *
 *  Threads: only one thread at a time may use a workspace. Any number of workspaces may share a
 *  mechanism. */
#ifndef BAUM_DYNAMICS_H
#define BAUM_DYNAMICS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A workspace. It evaluates one mechanism, and contains the memory that the evaluation needs. */
typedef struct baum_workspace baum_workspace;

/** Create a workspace. The mechanism stays in memory as long as the workspace exists. This call
 *  also determines the redundant constraint rows: it assembles the mechanism at t = 0, starting
 *  from the design configuration, and examines J there and in configurations near it.
 *  @param      mechanism  frozen
 *  @param[out] out        receives the workspace, NULL on failure; release it with
 *                         baum_workspace_destroy()
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (not frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_workspace_create(const baum_mechanism *mechanism, baum_workspace **out);

/** Release a workspace. @param workspace  may be NULL */
BAUM_API void baum_workspace_destroy(baum_workspace *workspace);

/** Read the design configuration and the given initial velocities. The design configuration
 *  consists of the positions in the definitions of the bodies.
 *  @param      workspace  a workspace of the mechanism
 *  @param[out] q          (nq); may be NULL
 *  @param[out] v          (nv), NaN where no initial velocity is given; may be NULL
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_workspace_design(baum_workspace *workspace, double *q, double *v);

/** Change the value of an input in this workspace. Before the first such call, the input has its
 *  initial value.
 *  @param workspace  a workspace of the mechanism
 *  @param input      an input of the mechanism
 *  @param value      finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_workspace_set_input(baum_workspace *workspace, baum_input_id input,
                                              double value);

/** Read an input.
 *  @param workspace  may be NULL
 *  @param input      an input of the mechanism
 *  @return  present value of the input; NaN for NULL and for ids that are not inputs of the
 *           mechanism */
BAUM_API double baum_workspace_input(const baum_workspace *workspace, baum_input_id input);

/** Choose the number of whole revolutions in an angle of a spatial joint. Positions determine such
 *  an angle only up to whole revolutions. After this call, the functions of this workspace use the
 *  possible value that is nearest to `angle`. Before the first such call, they use the value
 *  nearest to 0.
 *  @param workspace   a workspace of the mechanism
 *  @param joint       a spatial joint
 *  @param coordinate  one of the angles of the joint; BAUM_COORDINATE_FIRST is allowed if the first
 *                     coordinate of the joint is an angle
 *  @param angle       [rad] finite
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (the call comes from a user function that
 *           the same workspace is calling) */
BAUM_API baum_status baum_workspace_set_angle(baum_workspace *workspace, baum_joint_id joint,
                                              baum_joint_coordinate coordinate, double angle);

/** Compute the time derivative of the positions, q' = N(q) v. For planar bodies, q' equals v.
 *  @param      workspace  a workspace of the mechanism
 *  @param[in]  q          (nq) positions
 *  @param[in]  v          (nv) velocities
 *  @param[out] dq         (nq) q'
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_rate(baum_workspace *workspace, const double *q,
                                         const double *v, double *dq);

/** Move positions by the displacement dx. For planar bodies, the result is q + dx.
 *  @param         workspace  a workspace of the mechanism
 *  @param[in]     dx         (nv) the displacement
 *  @param[in,out] q          (nq) the positions
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_move(baum_workspace *workspace, const double *dx, double *q);

/** Compute the displacement dx between two configurations: baum_workspace_move() with this dx moves
 *  `from` to `to`.
 *  @param      workspace  a workspace of the mechanism
 *  @param[in]  from       (nq) positions
 *  @param[in]  to         (nq) other positions
 *  @param[out] dx         (nv) the displacement
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_difference(baum_workspace *workspace, const double *from,
                                               const double *to, double *dx);

/** Evaluate the constraints Phi(q, t).
 *  @param      workspace      a workspace of the mechanism
 *  @param      t              [s] time
 *  @param[in]  q              (nq) positions
 *  @param[out] phi            (nc) [m], [rad] or the unit of a user constraint
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_phi(baum_workspace *workspace, double t, const double *q,
                                        double *phi);

/** Evaluate the velocity Jacobian J = (dPhi/dq) N, where N is the matrix in q' = N v. For planar
 *  bodies, N is the identity matrix.
 *  @param      workspace      a workspace of the mechanism
 *  @param      t              [s] time
 *  @param[in]  q              (nq) positions
 *  @param[out] jacobian       (nc x nv)
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_jacobian(baum_workspace *workspace, double t, const double *q,
                                             double *jacobian);

/** Evaluate nu = -dPhi/dt, the right-hand side of the velocity constraints J v = nu.
 *  @param      workspace      a workspace of the mechanism
 *  @param      t              [s] time
 *  @param[in]  q              (nq) positions
 *  @param[out] nu             (nc)
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_nu(baum_workspace *workspace, double t, const double *q,
                                       double *nu);

/** Evaluate gamma, the right-hand side of the acceleration constraints J a = gamma.
 *  @param      workspace        a workspace of the mechanism
 *  @param      t                [s] time
 *  @param[in]  q                (nq) positions
 *  @param[in]  v                (nv) velocities
 *  @param[out] gamma            (nc)
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_gamma(baum_workspace *workspace, double t, const double *q,
                                          const double *v, double *gamma);

/** Evaluate the mass matrix M.
 *  @param      workspace      a workspace of the mechanism
 *  @param      t              [s] time
 *  @param[in]  q              (nq) positions
 *  @param[out] mass           (nv x nv)
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_mass(baum_workspace *workspace, double t, const double *q,
                                         double *mass);

/** Evaluate the force vector g, which is the sum of applied forces, gravity and velocity terms
 *  (such as gyroscopic moments).
 *  @param      workspace        a workspace of the mechanism
 *  @param      t                [s] time
 *  @param[in]  q                (nq) positions
 *  @param[in]  v                (nv) velocities
 *  @param[out] force            (nv)
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_force(baum_workspace *workspace, double t, const double *q,
                                          const double *v, double *force);

/** Evaluate the kinetic energy and the potential energy. The potential energy is the sum of the
 *  potentials of gravity, springs, loads that are only a constant force in ground axes, and user
 *  potentials.
 *  @param      workspace        a workspace of the mechanism
 *  @param      t                [s] time
 *  @param[in]  q                (nq) positions
 *  @param[in]  v                (nv) velocities
 *  @param[out] kinetic          [J] kinetic energy. May be NULL.
 *  @param[out] potential        [J] potential energy. May be NULL.
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_energy(baum_workspace *workspace, double t, const double *q,
                                           const double *v, double *kinetic, double *potential);

/** Solve M a + J^T lambda = g and J a = gamma - 2 alpha Phi' - beta^2 Phi for the accelerations a
 *  and the multipliers lambda. The gains alpha and beta are those of Baumgarte's stabilization.
 *  With alpha = beta = 0, the equations are not stabilized.
 *
 *  The solution omits redundant constraint rows. Where multipliers are not unique, the function
 *  returns the multipliers of least norm. This norm weights each lambda_i with the length of row i
 *  of J M^(-1/2). The returned multipliers satisfy M a + J^T lambda = g with a relative error
 *  of at most 1e-9. If the rows that are not omitted become nearly dependent on each other, the
 *  workspace chooses other rows to omit, which allocates memory. From then on,
 *  baum_workspace_residual() omits the same rows.
 *  @param      workspace        a workspace of the mechanism
 *  @param      t                [s] time
 *  @param[in]  q                (nq) positions
 *  @param[in]  v                (nv) velocities
 *  @param      alpha            [1/s] finite
 *  @param      beta             [1/s] finite
 *  @param[out] a                (nv) accelerations. May be NULL.
 *  @param[out] lambda           (nc) multipliers. May be NULL.
 *  @return  a status listed at the top of this header, or BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY,
 *           BAUM_ERR_INCONSISTENT (the accelerations violate an omitted row; the message names a
 *           joint) */
BAUM_API baum_status baum_workspace_acceleration(baum_workspace *workspace, double t,
                                                 const double *q, const double *v, double alpha,
                                                 double beta, double *a, double *lambda);

/** Compute the reaction of a joint. For most joints, the reaction is the force and the moment on
 *  body_b; planar.h and spatial.h give the details. For user constraints, gears and couplings, the
 *  reaction is the generalized force -J^T lambda of their rows, with one number for each velocity
 *  of their bodies.
 *  @param      workspace      a workspace of the mechanism
 *  @param      t              [s] time
 *  @param[in]  q              (nq) positions
 *  @param[in]  lambda         (nc) multipliers, as baum_workspace_acceleration() returns them
 *  @param      joint          a joint of the mechanism
 *  @param[out] reaction       (width) with as many numbers as the channel BAUM_JOINT_REACTION of
 *                             this joint has columns, such as 3 for a planar joint and 6 for a
 *                             spatial joint
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_reaction(baum_workspace *workspace, double t, const double *q,
                                             const double *lambda, baum_joint_id joint,
                                             double *reaction);

/** The form of the equations that baum_workspace_residual() evaluates. The residual has three
 *  parts: q' - N v, where the matrix N maps velocities to q'; M v' + J^T lambda - g; and the
 *  constraints in one of the forms below.
 *
 *  GGL (Gear, Gupta, Leimkuhler 1985) replaces the first part by q' - N (v - W^-1 J^T mu), with one
 *  additional unknown mu for each constraint row. In the exact solution all mu are zero. W is a
 *  constant diagonal matrix. Its diagonal is the diagonal of M in the design configuration at
 *  t = 0, but very small entries are raised: entry k is at least m / s_k^2, where s_k is the scale
 *  of coordinate k, and m is a millionth of the largest of all products M_jj s_j^2.
 *
 *  Rows of velocity level (non-holonomic constraints J v = nu) have no Phi; for these rows, Phi'
 *  stands for J v - nu. INDEX1 contains J v' - gamma + alpha Phi' for them, INDEX3 contains Phi'
 *  instead of Phi, and GGL contains mu_i instead of Phi. */
typedef enum baum_residual {
  BAUM_RESIDUAL_INDEX1 = 1, /**< J v' - gamma + 2 alpha Phi' + beta^2 Phi. */
  BAUM_RESIDUAL_INDEX2 = 2, /**< Phi' = J v - nu. */
  BAUM_RESIDUAL_INDEX3 = 3, /**< Phi. */
  BAUM_RESIDUAL_GGL = 4     /**< Phi' = J v - nu of all rows, followed by Phi of all rows. */
} baum_residual;

/** The differential-algebraic equations to evaluate: the form of the constraints, and Baumgarte's
 *  gains. */
typedef struct baum_dae {
  baum_residual index; /**< Form of the constraints. */
  double alpha; /**< [1/s] Baumgarte's gain alpha, finite; used only by BAUM_RESIDUAL_INDEX1. */
  double beta;  /**< [1/s] Baumgarte's gain beta, finite; used only by BAUM_RESIDUAL_INDEX1. */
} baum_dae;

/** A sparse square matrix in compressed-column form. It has one row and one column for each of the
 *  unknowns y of baum_workspace_residual(). Within a column, entries are sorted by row. The caller
 *  owns the arrays. */
typedef struct baum_sparse {
  /** (size + 1) for each column, the index of its first entry in the other two arrays; then the
   *  number of entries. size is the number of columns. May be NULL. */
  int32_t *columns;
  int32_t *rows;    /**< (nonzeros) row of each entry, counted from 0. May be NULL. */
  double *values;   /**< (nonzeros) value of each entry. May be NULL. */
  int32_t nonzeros; /**< [-] number of entries; written even if the arrays are NULL. */
} baum_sparse;

/** Evaluate the residual F(t, y, y') of the differential-algebraic equations. The unknowns are
 *  y = (q, v, lambda), or y = (q, v, lambda, mu) with BAUM_RESIDUAL_GGL. If row i is redundant and
 *  omitted, its constraint is replaced by the equation lambda_i = 0. GGL has two equations for each
 *  row, Phi' = 0 and Phi = 0. If row i is omitted, lambda_i = 0 replaces the first one, and
 *  mu_i = 0 replaces the second one.
 *  @param      workspace    a workspace of the mechanism
 *  @param      t            [s] time
 *  @param[in]  dae          the equations to evaluate
 *  @param[in]  y            (nq + nv + nc), or (nq + nv + 2 nc) for GGL: the unknowns
 *  @param[in]  dy           y', of the same size as y
 *  @param[out] residual     F, of the same size as y
 *  @return  a status listed at the top of this header */
BAUM_API baum_status baum_workspace_residual(baum_workspace *workspace, const baum_dae *dae,
                                             double t, const double *y, const double *dy,
                                             double *residual);

/** Evaluate the Jacobian dF/dy + c dF/dy' of the residual F that baum_workspace_residual()
 *  computes. The sparsity pattern of this matrix depends only on dae->index. To learn the number of
 *  entries, first call the function with NULL for all arrays of `out`. The function allocates
 *  memory, so do not use it in inner loops.
 *  @param      workspace    a workspace of the mechanism
 *  @param      t            [s] time
 *  @param[in]  dae          the equations to evaluate
 *  @param      c            [1/s] finite
 *  @param[in]  y            the unknowns, as for baum_workspace_residual()
 *  @param[in]  dy           y', as for baum_workspace_residual()
 *  @param[out] out          receives the number of entries (nonzeros); its arrays are filled unless
 *                           they are NULL
 *  @return  a status listed at the top of this header, or BAUM_ERR_MEMORY */
BAUM_API baum_status baum_workspace_residual_jacobian(baum_workspace *workspace,
                                                      const baum_dae *dae, double c, double t,
                                                      const double *y, const double *dy,
                                                      baum_sparse *out);

/** Assemble the mechanism: change q until Phi(q, t) = 0, and compute the velocities that are not
 *  given. Newton's method computes the change of q, and each of its steps is the smallest possible
 *  one in the mass-weighted norm. The sum of the steps is therefore close to the smallest possible
 *  change, unless J changes much during the move. If J changes much and bodies move more than you
 *  want, list in `held` the bodies that must not move.
 *  @param         workspace    a workspace of the mechanism
 *  @param         t            [s] time
 *  @param[in,out] q            (nq) initial guess on entry; unchanged on failure
 *  @param[in,out] v            (nv) velocities. Finite entries do not change. Entries that are NaN
 *                              are computed from the constraints. If the constraints do not
 *                              determine these entries, the function chooses the velocities with
 *                              the smallest mass-weighted norm. Unchanged on failure.
 *  @param[in]     held         (held_count) bodies that assembly must not move, in addition to
 *                              those whose definition sets `held`. May be NULL if held_count is 0.
 *  @param         held_count   [-] >= 0
 *  @return  a status listed at the top of this header, or BAUM_ERR_INCONSISTENT (the message names
 *           the joints in conflict), BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_workspace_assemble(baum_workspace *workspace, double t, double *q,
                                             double *v, const baum_body_id *held,
                                             int32_t held_count);

/** Project a state onto the constraints: change q by the least amount such that Phi = 0, and then v
 *  by the least amount such that J v = nu. The amounts are measured in the norm of the mass matrix
 *  M. For a slender rod, whose axial moment of inertia is very small, this norm uses a larger
 *  moment of inertia about the axis.
 *  @param         workspace    a workspace of the mechanism
 *  @param         t            [s] time
 *  @param[in,out] q            (nq) positions that violate the constraints only a little; unchanged
 *                              on failure
 *  @param[in,out] v            (nv) velocities that violate the constraints only a little;
 *                              unchanged on failure
 *  @return  a status listed at the top of this header, or BAUM_ERR_CONVERGENCE, BAUM_ERR_SINGULAR,
 *           BAUM_ERR_MEMORY, BAUM_ERR_INCONSISTENT (redundant rows contradict the other rows, or
 *           two axes of a joint point in opposite directions) */
BAUM_API baum_status baum_workspace_project(baum_workspace *workspace, double t, double *q,
                                            double *v);

#ifdef __cplusplus
}
#endif

#endif
