/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies that cannot move (islands.h) are left out of what a run needs for its motion: their
 * accelerations are zero, and what holds them need not be solved.
 *
 * This is so while they are at rest where their rows are fulfilled. In other states (a start that is taken
 * as given) they are solved for as all others, so that the formulation can deal with them. Multipliers,
 * too, come from the whole.
 */
#ifndef BAUM_I_DYNAMICS_IMMOBILE_H
#define BAUM_I_DYNAMICS_IMMOBILE_H

#include "dynamics/block_path.h"

struct baum_i_immobile {
  baum_i_block_path *path;  /* for all the rest */
  baum_i_left_out left_out; /* what that is not for */
  int count;                /* of velocities */
  int *velocity;            /* (count) which they are */
  double *position;         /* (count) where they rest */
  int row_count;            /* of what holds them */
  int *row;                 /* (row_count) which they are */
  double *phi;              /* (row_count) Phi where they rest */
  bool rests;               /* the present state has them there */
};

/* Find them and leave them out from now on, if they rest in this state and blocks suit the rest.
 * Velocities of theirs that are rounding, as assembly leaves them, become zero. BAUM_OK or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_leave_out_immobile(baum_workspace *workspace, double t, const double *q,
                                      double *v);
/* The path for the redundant rows as they are now; *out is NULL where they are not what holds these bodies, or blocks do not
 * suit. Statuses of baum_i_block_path_create(). */
baum_status baum_i_immobile_make_path(baum_workspace *workspace, baum_i_block_path **out);

void baum_i_immobile_destroy(baum_i_immobile *immobile); /* NULL is fine */

/* To be called for every state that comes from outside of the motion: whether they rest there, with
 * velocities as above. */
void baum_i_look_at_immobile(baum_workspace *workspace, const double *q, double *v);

/* What motion goes by: the path without them, or the whole one, or NULL. */
baum_i_block_path *baum_i_motion_path(const baum_workspace *workspace);

/* In between, workspace->path is that path. Enter returns what leave has to put back. */
baum_i_block_path *baum_i_enter_motion(baum_workspace *workspace);
void baum_i_leave_motion(baum_workspace *workspace, baum_i_block_path *whole);

#endif
