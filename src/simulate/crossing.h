/* SPDX-License-Identifier: BSD-3-Clause */
/* Singularity crossings: monitors how a run passes near singular configurations. Steps that begin
 * or end near such configurations are changed in singular_step.c. */
#ifndef BAUM_I_SIMULATE_CROSSING_H
#define BAUM_I_SIMULATE_CROSSING_H

#include "simulate/hermite.h"
#include "simulate/run.h"

enum {
  BAUM_I_NEAR_SINGULAR_KEPT = 64, /* number of stored intervals; later ones are only counted */
  BAUM_I_RECENT = 3               /* number of stored recent states */
};

/* A crossing that has begun, or that has been found between two steps. */
typedef struct baum_i_crossing {
  /* [s] time of the last state that was not near-singular, just before the crossing */
  double from;
  double largest_turn; /* [-] largest relative change of the velocity in a step */
  /* 1: the pivots indicate a gap between branches instead of a singular configuration */
  int32_t gap;
  int32_t joint; /* joint of the smallest pivot; -1: none */
} baum_i_crossing;

struct baum_i_crossings {
  /* The members before `recent` are plain numbers. They are part of a saved run. */
  double usual; /* largest pivot so far */
  baum_i_crossing present;
  int32_t recent_count;
  int32_t clear_count;
  int32_t open;
  int32_t unseen;      /* 1: the last recent state has not been examined */
  int32_t joint_noted; /* joint of the smallest pivot of the last recent state, or -1 */

  baum_i_knot recent[BAUM_I_RECENT]; /* last states in order of time */
  /* clear states, which are far from singular configurations and from each other */
  baum_i_knot clear[BAUM_I_HERMITE_MOST];
  /* `at`, `other` and `between` are scratch memory for states between the recent ones */
  baum_i_knot at;
  baum_i_knot other;
  baum_i_knot between;
  baum_i_knot lowest; /* t, pivot and q of the state with the lowest pivot of the crossing */
  baum_near_singular kept[BAUM_I_NEAR_SINGULAR_KEPT];
};

/* Return the last recent state. There must be one. */
static inline const baum_i_knot *baum_i_last_knot(const baum_i_crossings *crossings)
{
  return &crossings->recent[crossings->recent_count - 1];
}

baum_status baum_i_crossings_create(baum_simulation *run);
void baum_i_crossings_destroy(baum_i_crossings *crossings); /* NULL is allowed */

/* The following functions do nothing if `crossings` or run->crossings is NULL, except where
 * noted. */

/* Discard the states, because another motion begins. */
void baum_i_crossings_forget(baum_i_crossings *crossings);

/* Store a state of the run and its pivot. The function evaluates nothing, so the last solution in
 * the workspace must belong to this state. */
void baum_i_crossings_note(baum_simulation *run, const baum_i_state *state);

/* End the present crossing and discard the states, because later pivots cannot be compared with
 * earlier ones. run->crossings must not be NULL. */
void baum_i_crossings_end(baum_simulation *run);

/* Recompute the pivots of the last states after other rows have been omitted, so that they can be
 * compared with later pivots. A crossing that has begun continues. run->crossings must not be
 * NULL. */
void baum_i_crossings_renew(baum_simulation *run);

/* Examine the state that was noted last. This may evaluate the mechanism, but failures of user
 * functions are not reported. */
void baum_i_crossings_look(baum_simulation *run);

/* Note a variable step that has just been taken. Returns true if this function has evaluated
 * accelerations, so that the workspace may contain the accelerations of another state than the end
 * of the step. Call baum_i_crossings_look() for the end of the step afterwards. */
bool baum_i_crossings_step(baum_simulation *run, const baum_i_state *end);

/* branch.c: decide on which branch the motion has left the singular configuration. For this,
 * compare the newest state with continuations of the states before the near-singular interval.
 * Write the result to *out. */
void baum_i_branch_decide(baum_simulation *run, baum_near_singular *out);

/* branch.c: find the least pivot of the equations of motion on the curve through `knots`, and
 * return it divided by the usual pivot. Write the time of the least pivot to *at and its joint to
 * *joint. Returns INFINITY if evaluations fail. */
double baum_i_branch_least_pivot(baum_simulation *run, const baum_i_knot *knots, int count,
                                 double *at, int *joint);

/* branch.c: return the largest scaled difference of two velocities (nv). */
double baum_i_velocity_change(const baum_mechanism *mechanism, const double *v, const double *w);

/* branch.c: tell whether there is a gap between branches instead of a singular configuration. The
 * first function examines the last recent state. The second examines the motion at a time t between
 * the recent states, at which the smallest pivot is `pivot`. */
bool baum_i_branch_has_gap_at_end(baum_simulation *run);
bool baum_i_branch_has_gap(baum_simulation *run, double t, double pivot);

/* branch.c: tell whether the violation of the last recent state may have raised the smallest pivot
 * of a singular configuration to the value `pivot`. */
bool baum_i_branch_is_opened(baum_simulation *run, double pivot);

#endif
