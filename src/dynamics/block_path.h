/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes accelerations by the block solver, which most evaluations use.
 *
 * A *block path* is a block solver together with the data from which its system is computed: the
 * joints, the omitted rows, and the constant forces. Planar revolute joints (pins.h) and most
 * joints in space (space_joints.h) are computed directly from the frames of bodies, in the hot
 * files (base/hot.h) pins_hot.c and space_joints_hot.c. Other joints are copied from blocks of J.
 * Constant masses and forces are set once. If the path cannot solve a system reliably, it gives up
 * without a message, and the solver of kkt.h factors the whole system.
 */
#ifndef BAUM_I_DYNAMICS_BLOCK_PATH_H
#define BAUM_I_DYNAMICS_BLOCK_PATH_H

#include "dynamics/dynamics.h"
#include "dynamics/pins.h"
#include "dynamics/space_joints.h"
#include "linear/block.h"
#include "linear/space_block.h"

/* An omitted row, whose multiplier is always 0. */
typedef struct baum_i_omitted_row {
  int row;
  int value;          /* index of the row's first value in the blocks of J */
  int count;          /* number of values of the row */
  const int *columns; /* (count) column of each value */
} baum_i_omitted_row;

/* The block solver is `space` if the mechanism has bodies in space and no bodies with user
 * coordinates. Otherwise it is `block`. The other pointer is NULL. */
struct baum_i_block_path {
  baum_i_space *space;
  const baum_i_space_kernel *space_kernel;
  const baum_i_space_refine_kernel *refine_kernel;
  const baum_i_space_sides_kernel *space_sides;
  const baum_i_space_factor_kernel *factor_kernel;
  const baum_i_space_residual_kernel *residual_kernel;
  const baum_i_space_bodies_kernel *bodies_kernel;
  const baum_i_space_joints_kernel *joints_kernel;
  baum_i_space_joints space_joints;
  bool has_planar;   /* at least one body is planar */
  bool only_hot;     /* hot files compute all joints (space_joints.h) */
  bool only_weights; /* all bodies are in space, and there are no force elements */
  baum_i_block *block;
  const baum_i_block_kernel *kernel;
  const baum_i_block_sides_kernel *sides_kernel;
  const baum_i_pins_kernel *pins_kernel;
  double *points;              /* (4 pin_count, pin_count rounded up to even) points of pins */
  int group_count;             /* number of groups of joints that no hot file evaluates */
  baum_i_joint_group *groups;  /* (group_count) */
  const baum_i_joint **joints; /* the joints of all groups */
  int omitted_count;
  int rated_count;             /* number of omitted rows whose Phi' is computed from J */
  baum_i_omitted_row *omitted; /* (omitted_count) the rated_count rows come first */
  double *constant_force;      /* (nv) constant forces; 0 for bodies whose force varies */
  bool force_is_constant;      /* all forces are constant */
  bool mass_is_constant;
  bool always_check;    /* `block` has many nodes: check the residual of every solution */
  bool uneven;          /* masses differ by large factors, so that digits may cancel */
  bool weak;            /* the last solution could not be trusted without refinement */
  double largest_pivot; /* largest result of the measure in pivot.c */
  int fixed_count;      /* number of fixed bodies that the path excludes */
  int64_t factorizations;
  int64_t refinements;
};

/* The size of the system that a path solves. Nodes that share a body are coupled
 * (linear/block.h). */
typedef struct baum_i_block_size {
  int nodes;
  int couplings;
  int fill;           /* couplings of nodes that share no body; elimination adds them */
  int most_couplings; /* largest number of couplings of one node */
} baum_i_block_size;

/* Create a path for the present set of omitted rows. If `for_motion` is true, the path also
 * excludes fixed bodies and the rows between them. If the block solver does not suit the mechanism,
 * returns BAUM_OK with *out = NULL and the reason in *verdict. Otherwise returns BAUM_OK,
 * BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_block_path_create(baum_workspace *workspace, bool for_motion,
                                     baum_i_block_verdict *verdict, baum_i_block_path **out);
void baum_i_block_path_destroy(baum_i_block_path *path); /* NULL is allowed */

/* space_joints.c: the first function finds the joints that space_joints_hot.c evaluates, and marks
 * them in `is_done`. The second one sets the constants of these joints. The first two functions
 * return BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_space_joints_find(const baum_workspace *workspace, baum_i_space *space,
                                     unsigned char *is_done, baum_i_space_joints *out);
baum_status baum_i_space_joints_set(const baum_workspace *workspace, const baum_i_space *space,
                                    baum_i_space_joints *joints);
void baum_i_space_joints_clear(const baum_i_space_joints *joints);

/* The same with spin rows: spins[k] (joint_count) is the number of the body whose spin row belongs
 * to joint k, or 0. NULL: no spin rows. */
baum_status baum_i_block_path_create_with(baum_workspace *workspace, bool for_motion,
                                          const int *spins, baum_i_block_verdict *verdict,
                                          baum_i_block_path **out);

/* spin_rows.c: replace a path in space by one with spin rows if this is more accurate. May fail
 * like baum_i_block_path_create(); *path is then unchanged. */
baum_status baum_i_add_spin_rows(baum_workspace *workspace, bool for_motion,
                                 baum_i_block_path **path);

/* The two paths of a workspace: one for all bodies, and one for the motion without fixed bodies.
 * They are the same path if no body is fixed. The verdict of baum_i_paths_create() describes the
 * path for all bodies. */
typedef struct baum_i_paths {
  baum_i_block_path *all;
  baum_i_block_path *motion;
} baum_i_paths;

baum_status baum_i_paths_create(baum_workspace *workspace, baum_i_block_verdict *verdict,
                                baum_i_paths *out);
void baum_i_paths_destroy(const baum_i_paths *paths);

/* Right-hand side of the system. The right-hand side of the rows is bending gamma - damping Phi' -
 * stiffness Phi. The right-hand side of the bodies is g if `force` is true, otherwise zero. */
typedef struct baum_i_right_side {
  double bending;
  double damping;
  double stiffness;
  bool force;
  /* (nc) factor f of each row. The terms of the row are then damping f Phi' and stiffness f^2 Phi.
   * NULL: all factors are 1. */
  const double *row_gains;
} baum_i_right_side;

/* The first part of baum_i_block_path_solve(): evaluate a state and write it to the solver. May
 * fail with BAUM_ERR_SINGULAR if M is not positive definite. */
baum_status baum_i_block_path_evaluate(baum_workspace *workspace, const baum_i_block_path *path,
                                       double t, const double *q, const double *v,
                                       const baum_i_right_side *right);

/* Set a, lambda, Phi, Phi' and gamma of the workspace, and J of joints in the path's groups. v may
 * be NULL if the right-hand side does not need it. Returns BAUM_ERR_SINGULAR if the path gives
 * up. */
baum_status baum_i_block_path_solve(baum_workspace *workspace, baum_i_block_path *path, double t,
                                    const double *q, const double *v,
                                    const baum_i_right_side *right);

/* Solve with the factors of the last solution. The first function sets out (nv) to the vector with
 * J out = r (nc) that is smallest in the metric of M. The second function sets out to P x
 * (normal_part.c), the part of x (nv) that the constraints remove. Both may return
 * BAUM_ERR_NOT_FINITE, or BAUM_ERR_SINGULAR if refinement does not converge, without a message. */
baum_status baum_i_block_path_meet_rows(const baum_i_block_path *path, const double *r,
                                        double *out);
baum_status baum_i_block_path_normal_part(const baum_i_block_path *path, const double *x,
                                          double *out);

baum_i_block_size baum_i_block_path_size(const baum_i_block_path *path);

/* acceleration.c: set a (0 for fixed bodies) and lambda for any right-hand side. This function uses
 * workspace->motion. If this path gives up, the function uses the solver of the whole system. May
 * fail with BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. */
baum_status baum_i_solve_motion(baum_workspace *workspace, double t, const double *q,
                                const double *v, const baum_i_right_side *right);

/* Return the forces (nv) with which the last acceleration was computed. */
static inline const double *baum_i_solved_force(const baum_workspace *w)
{
  const baum_i_block_path *path = w->solved_by;
  return path && path->force_is_constant ? path->constant_force : w->force;
}

/* Set the message for a status of the workspace's solver, and return the status. */
baum_status baum_i_report_constraints(const baum_workspace *workspace, baum_status status);

/* Factor the matrix to find its pivots, even if they are bad. May fail with BAUM_ERR_SINGULAR if M
 * is not positive definite. */
baum_status baum_i_block_path_factor(baum_workspace *workspace, baum_i_block_path *path, double t,
                                     const double *q);

#endif
