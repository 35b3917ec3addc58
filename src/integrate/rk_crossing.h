/* SPDX-License-Identifier: BSD-3-Clause */
/* Lets a Runge-Kutta method with variable steps pass singular configurations
 * (docs/theory/singular.md).
 *
 * Let p be the smallest pivot relative to its usual value. sqrt(p) decreases linearly towards a
 * singular configuration. Near the configuration, accelerations are inaccurate, and smaller steps
 * do not reduce the error. A step therefore passes the configuration between two stages. If no step
 * of a sensible length is accurate enough, a step of fixed length passes over the configuration. */
#ifndef BAUM_I_INTEGRATE_RK_CROSSING_H
#define BAUM_I_INTEGRATE_RK_CROSSING_H

#include "integrate/rk.h"

typedef struct baum_i_rk_crossing {
  double gap; /* middle of the widest gap between stages, as a fraction of the step */
  /* [s] from the start of the step to a singular configuration; INFINITY: none is near */
  double ahead;
  double over; /* [s] length of a step over a singular configuration */
  /* [s] a step shorter than this is lengthened to `over`; 0: no singular configuration is near */
  double least;
  double pivot;     /* smallest pivot at the start of the step, relative to the usual pivot */
  double pivot_end; /* the same at the end of the step */
  double usual;     /* largest pivot so far */
  int held;         /* number of successive tiny steps near a singular configuration */
} baum_i_rk_crossing;

void baum_i_rk_crossing_open(baum_i_rk_crossing *crossing, const baum_i_rk_table *table);

/* Start at t. The rate at t must have been evaluated last. Afterwards the workspace contains Phi
 * and Phi' of the start. */
baum_status baum_i_rk_crossing_begin(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                     const baum_i_problem *problem, double t);

/* Prepare a step from t: find `ahead` and `least`. */
void baum_i_rk_crossing_look(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                             const baum_i_problem *problem, double t);

/* Adjust the length of a step from t, and return the new length [s]. *forced is set to true if the
 * length was below `least`, so that the returned step passes over the configuration. */
double baum_i_rk_crossing_length(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                 const baum_i_problem *problem, double t, double length,
                                 bool *forced);

/* Return the error, relative to the scales, that a step by h may have even if it exceeds the
 * tolerance. */
double baum_i_rk_crossing_error(const baum_i_rk_crossing *crossing, double h, bool forced);

/* Check the end (t_end, end) of a step by h. This end must have been evaluated last. Returns false
 * if the step must not end there. */
bool baum_i_rk_crossing_may_end(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                                const baum_i_problem *problem, double h, double t_end,
                                const double *end);

/* Continue after an accepted step. Its end is the start of the next step, which has the length
 * `next`. */
void baum_i_rk_crossing_go_on(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                              const baum_i_problem *problem, double next);

/* Count a refused try of length h if it was tiny. */
void baum_i_rk_crossing_refuse(baum_i_rk_crossing *crossing, const baum_i_rk *rk,
                               const baum_i_problem *problem, double h);

/* Tell whether the method is stuck. */
bool baum_i_rk_crossing_is_held(const baum_i_rk_crossing *crossing);

#endif
