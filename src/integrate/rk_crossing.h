/* SPDX-License-Identifier: BSD-3-Clause */
/* How a Runge-Kutta method with variable steps passes singular configurations
 * (docs/theory/singular.md).
 *
 * sqrt(p), with p the smallest pivot relative to the usual one, falls linearly towards such a
 * configuration. Accelerations next to it are inaccurate, and errors grow however small the steps
 * are. Therefore a step passes the configuration between two stages; if no step of a sensible
 * length is accurate enough, a step of fixed length passes over it. */
#ifndef BAUM_I_INTEGRATE_RK_CROSSING_H
#define BAUM_I_INTEGRATE_RK_CROSSING_H

#include "integrate/rk.h"

typedef struct baum_i_rk_crossing {
  double gap;   /* middle of the widest gap between stages, as a fraction of the step */
  double ahead; /* [s] from the start of the step to a singular configuration; INFINITY: none is
                   near */
  double over;  /* [s] a step over a configuration */
  double least; /* [s] shorter steps are replaced by it; 0 if no singular configuration is near */
  double pivot; /* at the start of the step, relative to the usual pivot */
  double pivot_end; /* at its end */
  double usual;     /* largest pivot so far */
  int held;         /* steps in a row that were held up near a configuration */
} baum_i_rk_crossing;

void baum_i_rk_crossing_open(baum_i_rk_crossing *crossing, const baum_i_rk_table *table);

/* Start at t, where the first rate has just been evaluated. */
void baum_i_rk_crossing_begin(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                              const baum_i_problem *problem, double t);

/* Prepare a step from t: find `ahead` and `least`. */
void baum_i_rk_crossing_look(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                             const baum_i_problem *problem, double t);

/* [s] Adjust the length of a step from t. *forced: the length was below `least`, so the step passes
 * over the configuration. */
double baum_i_rk_crossing_length(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                 const baum_i_problem *problem, double t, double length,
                                 bool *forced);

/* Error, relative to the scales, that a step by h may have whatever the tolerance. */
double baum_i_rk_crossing_error(const baum_i_rk_crossing *crossing, double h, bool forced);

/* Check the end of a step, which has just been evaluated. false: it must not end in this
 * configuration. */
bool baum_i_rk_crossing_may_end(baum_i_rk_crossing *crossing, const baum_i_problem *problem);

/* Continue after an accepted step: its end is the start of the next, of length `next`. */
void baum_i_rk_crossing_go_on(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                              const baum_i_problem *problem, double next);

/* Note that a try by h was refused. */
void baum_i_rk_crossing_refuse(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                               const baum_i_problem *problem, double h);

/* Is the method stuck? */
bool baum_i_rk_crossing_is_held(const baum_i_rk_crossing *crossing);

#endif
