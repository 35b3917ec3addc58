/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations by blocks: the way that most evaluations take.
 *
 * Revolute joints go straight from frames into the solver (pins.h); other joints come as blocks of
 * J. Masses and forces that do not change are there already. What the path cannot solve with
 * confidence it hands over, without a message: then the whole system is factored as kkt.h does it.
 */
#ifndef BAUM_I_DYNAMICS_BLOCK_PATH_H
#define BAUM_I_DYNAMICS_BLOCK_PATH_H

#include "dynamics/dynamics.h"
#include "dynamics/pins.h"
#include "linear/block.h"

struct baum_i_block_path {
  baum_i_block *block;
  const baum_i_block_kernel *kernel;
  const baum_i_block_sides_kernel *sides_kernel;
  const baum_i_pins_kernel *pins_kernel;
  double *points;              /* (even pin_count x 4) */
  int group_count;             /* joints that are not pins of the block */
  baum_i_joint_group *groups;  /* (group_count) */
  const baum_i_joint **joints; /* behind the groups */
  double *constant_force;      /* (nv) of the bodies whose force depends on nothing */
  bool force_is_constant;      /* and there is no other */
  bool mass_is_constant;
  bool always_check; /* many nodes: the residual is looked at whatever the pivots are */
  bool uneven;       /* so are masses: it is looked at where a is small against a0 */
  int fixed_count;   /* fixed bodies that are not solved for */
  int64_t factorizations;
  int64_t refinements;
};

/* For the redundant rows as they are known now; for_motion: fixed bodies and rows between these are
 * not solved for. BAUM_OK also where blocks do not suit, as *verdict tells; then *out is NULL.
 * BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE. */
baum_status baum_i_block_path_create(baum_workspace *workspace, bool for_motion,
                                     baum_i_block_verdict *verdict, baum_i_block_path **out);
void baum_i_block_path_destroy(baum_i_block_path *path); /* NULL is fine */

/* The paths of a workspace: for all and for its motion, which is the same where no body is fixed.
 * Likewise; *verdict is of that for all. */
typedef struct baum_i_paths {
  baum_i_block_path *all;
  baum_i_block_path *motion;
} baum_i_paths;

baum_status baum_i_paths_create(baum_workspace *workspace, baum_i_block_verdict *verdict,
                                baum_i_paths *out);
void baum_i_paths_destroy(const baum_i_paths *paths);

/* Right side of the rows: bending gamma - damping Phi' - stiffness Phi; of the bodies: g or
 * nothing. */
typedef struct baum_i_right_side {
  double bending;
  double damping;
  double stiffness;
  bool force;
  const double *row_gains; /* (nc) f: damping f Phi' and stiffness f^2 Phi; NULL: 1 */
} baum_i_right_side;

/* a, lambda, Phi, Phi' and gamma of the workspace; J only for joints that are not pins. v may be
 * NULL where the right side needs none. BAUM_ERR_SINGULAR: handed over. */
baum_status baum_i_block_path_solve(baum_workspace *workspace, baum_i_block_path *path, double t,
                                    const double *q, const double *v,
                                    const baum_i_right_side *right);

/* acceleration.c: a (0 of fixed bodies) and lambda with any right side, by the path of the motion
 * or else by the solver of the whole system. Also BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY. */
baum_status baum_i_solve_motion(baum_workspace *workspace, double t, const double *q,
                                const double *v, const baum_i_right_side *right);

/* The message of a status of the workspace's solver; returns the status. */
baum_status baum_i_report_constraints(const baum_workspace *workspace, baum_status status);

/* Pivots alone, also where they are bad. */
baum_status baum_i_block_path_factor(baum_workspace *workspace, baum_i_block_path *path, double t,
                                     const double *q);

#endif
