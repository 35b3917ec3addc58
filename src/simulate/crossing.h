/* SPDX-License-Identifier: BSD-3-Clause */
/* Singularity crossings: monitors how a run passes near singular configurations. singular_step.c
 * changes steps there. */
#ifndef BAUM_I_SIMULATE_CROSSING_H
#define BAUM_I_SIMULATE_CROSSING_H

#include "simulate/hermite.h"
#include "simulate/run.h"

enum {
  BAUM_I_NEAR_SINGULAR_KEPT = 64, /* number of stored intervals; later ones are only counted */
  BAUM_I_RECENT = 3               /* states */
};

/* A crossing that has begun, or that has been found between two steps. */
typedef struct baum_i_crossing {
  double from;         /* [s] last state before it that was not near-singular */
  double largest_turn; /* [-] largest relative change of the velocity in a step */
  /* 1: the pivots indicate a gap between branches instead of a singular configuration */
  int32_t gap;
  int32_t joint; /* joint of the smallest pivot; -1: none */
} baum_i_crossing;

struct baum_i_crossings {
  /* The members before `recent` are plain numbers, which are saved. */
  double usual; /* largest pivot so far */
  baum_i_crossing present;
  int32_t recent_count;
  int32_t clear_count;
  int32_t open;
  int32_t unseen;      /* 1: the last recent state has not been examined */
  int32_t joint_noted; /* joint of the smallest pivot of that state, or -1 */

  baum_i_knot recent[BAUM_I_RECENT]; /* last states in order of time */
  /* clear states, which are far from singular ones and from each other */
  baum_i_knot clear[BAUM_I_HERMITE_MOST];
  baum_i_knot at; /* scratch: states between others */
  baum_i_knot other;
  baum_i_knot between;
  baum_i_knot lowest; /* t, pivot and q of the lowest pivot of the present crossing */
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

/* Note a state of the run. The last solution must be that of this state. Evaluates nothing. */
void baum_i_crossings_note(baum_simulation *run, const baum_i_state *state);

/* End the present crossing, because later pivots cannot be compared with earlier ones. crossings
 * must not be NULL. */
void baum_i_crossings_end(baum_simulation *run);

/* Find the pivots of the last states again after other rows have been omitted. They can then be
 * compared with later pivots. An open interval stays open. crossings must not be NULL. */
void baum_i_crossings_renew(baum_simulation *run);

/* Examine the state that was noted last. May evaluate. Failures of user functions are not
 * reported. */
void baum_i_crossings_look(baum_simulation *run);

/* Note a variable step that has just been taken. Returns true if this function has evaluated
 * accelerations, so that the workspace may contain those of another state than the end of the step.
 * Call baum_i_crossings_look() for the end of the step afterwards. */
bool baum_i_crossings_step(baum_simulation *run, const baum_i_state *end);

/* branch.c: decide on which branch the motion has left the singular configuration. For this,
 * compare the newest state with continuations of the states before the near-singular interval.
 * Write the result to *out. */
void baum_i_branch_decide(baum_simulation *run, baum_near_singular *out);

/* branch.c: return the least pivot, relative to the usual one, of the motion through `knots`, and
 * its time and joint. Returns INFINITY if evaluations fail. */
double baum_i_branch_least_pivot(baum_simulation *run, const baum_i_knot *knots, int count,
                                 double *at, int *joint);

/* branch.c: return the largest scaled difference of two velocities (nv). */
double baum_i_velocity_change(const baum_mechanism *mechanism, const double *v, const double *w);

/* branch.c: tell whether there is a gap between branches instead of a singular configuration. The
 * first function examines the last recent state. The second examines a time t among the recent
 * states, at which the motion has the given pivot. */
bool baum_i_branch_has_gap_at_end(baum_simulation *run);
bool baum_i_branch_has_gap(baum_simulation *run, double t, double pivot);

/* branch.c: tell whether the violation of the last recent state may have raised the smallest pivot
 * of a singular configuration to this value. */
bool baum_i_branch_is_opened(baum_simulation *run, double pivot);

#endif
