/* SPDX-License-Identifier: BSD-3-Clause */
/* Singular configurations in the way of a Runge-Kutta method that chooses its steps
 * (docs/theory/singular.md).
 *
 * sqrt(p), with p the smallest pivot of what is usual, falls in a straight line towards such a
 * pose. Accelerations next to it are poor, and errors there grow however small a step is. So the
 * configuration is passed between two stages, and where no step of a sensible length is good
 * enough, one goes over it.
 */
#ifndef BAUM_I_INTEGRATE_RK_CROSSING_H
#define BAUM_I_INTEGRATE_RK_CROSSING_H

#include "integrate/rk.h"

typedef struct baum_i_rk_crossing {
  double gap;       /* middle of the widest gap between stages, of the step */
  double ahead;     /* [s] from the start of the step to a singular configuration; INFINITY: none is
                   near */
  double over;      /* [s] a step over a configuration */
  double least;     /* [s] step shorter than which it is taken; 0 where no pose is near */
  double pivot;     /* at the start of the step, of the usual one */
  double pivot_end; /* at its end */
  double usual;     /* largest pivot so far */
  int held;         /* steps in a row that were held up near a configuration */
} baum_i_rk_crossing;

void baum_i_rk_crossing_open(baum_i_rk_crossing *crossing, const baum_i_rk_table *table);

/* At t, where the first rate has just been evaluated. */
void baum_i_rk_crossing_begin(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                              const baum_i_problem *problem, double t);

/* Before a step from t: ahead and least. */
void baum_i_rk_crossing_look(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                             const baum_i_problem *problem, double t);

/* [s] What becomes of a step of this length from t. forced: that step is below least. */
double baum_i_rk_crossing_length(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                 const baum_i_problem *problem, double t, double length,
                                 bool *forced);

/* Error of the scales that a step by h may have, whatever the tolerance. */
double baum_i_rk_crossing_error(const baum_i_rk_crossing *crossing, double h, bool forced);

/* At the end of a step, evaluated just now. false: it ends in a configuration and must not. */
bool baum_i_rk_crossing_may_end(baum_i_rk_crossing *crossing, const baum_i_problem *problem);

/* After a step was accepted: its end is the start of the next, of length `next`. */
void baum_i_rk_crossing_go_on(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                              const baum_i_problem *problem, double next);

/* A try by h was refused. */
void baum_i_rk_crossing_refuse(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                               const baum_i_problem *problem, double h);

/* Is there no way on? */
bool baum_i_rk_crossing_is_held(const baum_i_rk_crossing *crossing);

#endif
