/* SPDX-License-Identifier: BSD-3-Clause */
/* Crossings: what a run has come through close to singular configurations. It only watches;
 * singular_step.h steps. */
#ifndef BAUM_I_SIMULATE_CROSSING_H
#define BAUM_I_SIMULATE_CROSSING_H

#include "simulate/hermite.h"
#include "simulate/run.h"

enum {
  BAUM_I_PASSAGES = 64, /* kept; more are counted */
  BAUM_I_RECENT = 3     /* states */
};

/* One under way, or just found between two steps. */
typedef struct baum_i_crossing {
  double from;         /* [s] last clear state before */
  double largest_turn; /* [-] change of the velocity in a step, of its size */
  int32_t gap;         /* no singular configuration is on the way, as far as can be seen there */
  int32_t joint;       /* of the least pivot, -1: none */
} baum_i_crossing;

struct baum_i_crossings {
  /* Numbers alone, saved up to `recent`. */
  double usual; /* largest pivot so far */
  baum_i_crossing present;
  int32_t recent_count;
  int32_t clear_count;
  int32_t open;
  int32_t unseen;      /* the last recent state has not been looked at */
  int32_t joint_noted; /* of its smallest pivot, where it is near; -1: none */

  baum_i_knot recent[BAUM_I_RECENT]; /* last states, the last one last */
  baum_i_knot clear
    [BAUM_I_HERMITE_MOST]; /* states away from singular configurations, not too close together */
  baum_i_knot at;          /* a state between two */
  baum_i_knot other;
  baum_i_knot between;
  baum_i_knot lowest; /* of the crossing under way: t, pivot and q */
  baum_near_singular kept[BAUM_I_PASSAGES];
};

/* The last recent state; there is one. */
static inline const baum_i_knot *baum_i_last_knot(const baum_i_crossings *crossings)
{
  return &crossings->recent[crossings->recent_count - 1];
}

baum_status baum_i_crossings_create(baum_simulation *run);
void baum_i_crossings_destroy(baum_i_crossings *crossings); /* NULL is fine */

/* From here on crossings may be NULL: nothing is done.
 * What comes next is not the motion that was before. */
void baum_i_crossings_forget(baum_i_crossings *crossings);

/* A state of the run, at which the last solution was made. Evaluates nothing. */
void baum_i_crossings_note(baum_simulation *run, const baum_i_state *state);

/* Pivots to come are others, and compare with none before: what is under way ends. Not for NULL. */
void baum_i_crossings_end(baum_simulation *run);

/* Look at the state that has been noted last; may evaluate. What functions of the user answer is
 * not told. */
void baum_i_crossings_look(baum_simulation *run);

/* A step of variable length that has just been taken. May evaluate; look at the end afterwards. */
void baum_i_crossings_step(baum_simulation *run, const baum_i_state *end);

/* branch.c: what has become of the motion, from the clear states before to the last recent one,
 * into *out. */
void baum_i_branch_decide(baum_simulation *run, baum_near_singular *out);

/* branch.c: least pivot, of the usual one, of the motion through `knots` from the first to the
 * last; time and joint of it. INFINITY where evaluations fail. */
double baum_i_branch_least_pivot(baum_simulation *run, const baum_i_knot *knots, int count,
                                 double *at, int *joint);

/* branch.c: largest difference of two velocities (nv), over the scales. */
double baum_i_velocity_change(const baum_mechanism *mechanism, const double *v, const double *w);

/* branch.c: is there no singular configuration near the last recent state, or near the motion
 * through the recent ones at t, where its pivot is given? */
bool baum_i_branch_has_gap_at_end(baum_simulation *run);
bool baum_i_branch_has_gap(baum_simulation *run, double t, double pivot);

/* branch.c: could the violation of the last recent state have made such a least pivot of a singular
 * configuration? */
bool baum_i_branch_is_opened(baum_simulation *run, double pivot);

#endif
