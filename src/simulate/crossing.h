/* SPDX-License-Identifier: BSD-3-Clause */
/* Singularity crossings: how a run has passed near singular configurations. This part only
 * monitors; singular_step.c takes steps. */
#ifndef BAUM_I_SIMULATE_CROSSING_H
#define BAUM_I_SIMULATE_CROSSING_H

#include "simulate/hermite.h"
#include "simulate/run.h"

enum {
  BAUM_I_NEAR_SINGULAR_KEPT = 64, /* number of stored intervals; further ones are only counted */
  BAUM_I_RECENT = 3               /* states */
};

/* A crossing that has begun, or has just been found between two steps. */
typedef struct baum_i_crossing {
  double from;         /* [s] last clear state before it */
  double largest_turn; /* [-] largest change of the velocity in a step, relative to its size */
  /* 1: as far as the pivots show, there is a gap and no singular configuration on the way */
  int32_t gap;
  int32_t joint; /* joint of the smallest pivot, -1: none */
} baum_i_crossing;

struct baum_i_crossings {
  /* Plain numbers up to `recent`, which are saved. */
  double usual; /* largest pivot so far */
  baum_i_crossing present;
  int32_t recent_count;
  int32_t clear_count;
  int32_t open;
  int32_t unseen;      /* the last recent state has not been examined */
  int32_t joint_noted; /* joint of that state's smallest pivot, if it is near; -1: none */

  baum_i_knot recent[BAUM_I_RECENT]; /* last states, the last one last */
  baum_i_knot clear
    [BAUM_I_HERMITE_MOST]; /* states away from singular configurations, not too close together */
  baum_i_knot at;          /* a state between two */
  baum_i_knot other;
  baum_i_knot between;
  baum_i_knot lowest; /* of the crossing under way: t, pivot and q */
  baum_near_singular kept[BAUM_I_NEAR_SINGULAR_KEPT];
};

/* The last recent state, which must exist. */
static inline const baum_i_knot *baum_i_last_knot(const baum_i_crossings *crossings)
{
  return &crossings->recent[crossings->recent_count - 1];
}

baum_status baum_i_crossings_create(baum_simulation *run);
void baum_i_crossings_destroy(baum_i_crossings *crossings); /* NULL is fine */

/* The following functions do nothing if crossings are NULL. Forget the states, because another
 * motion begins. */
void baum_i_crossings_forget(baum_i_crossings *crossings);

/* Note a state of the run, for which the last solution was made. Evaluates nothing. */
void baum_i_crossings_note(baum_simulation *run, const baum_i_state *state);

/* End a crossing under way, because the coming pivots cannot be compared with those before. Not for
 * NULL. */
void baum_i_crossings_end(baum_simulation *run);

/* Examine the state that was noted last; may evaluate. Failures of user functions are not
 * reported. */
void baum_i_crossings_look(baum_simulation *run);

/* Note a variable step that has just been taken. May evaluate; call look() for its end
 * afterwards. */
void baum_i_crossings_step(baum_simulation *run, const baum_i_state *end);

/* branch.c: decide which branch the motion has taken, from the clear states before to the last
 * recent one, into *out. */
void baum_i_branch_decide(baum_simulation *run, baum_near_singular *out);

/* branch.c: least pivot, relative to the usual one, of the motion through `knots` from the first to
 * the last, with its time and joint. INFINITY if evaluations fail. */
double baum_i_branch_least_pivot(baum_simulation *run, const baum_i_knot *knots, int count,
                                 double *at, int *joint);

/* branch.c: largest difference of two velocities (nv), over the scales. */
double baum_i_velocity_change(const baum_mechanism *mechanism, const double *v, const double *w);

/* branch.c: with the given pivot, is there a gap instead of a singular configuration near the last
 * recent state, or at t near the motion through the recent states? */
bool baum_i_branch_has_gap_at_end(baum_simulation *run);
bool baum_i_branch_has_gap(baum_simulation *run, double t, double pivot);

/* branch.c: could the violation of the last recent state have raised the smallest pivot of a
 * singular configuration to this value? */
bool baum_i_branch_is_opened(baum_simulation *run, double pivot);

#endif
