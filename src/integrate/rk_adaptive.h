/* SPDX-License-Identifier: BSD-3-Clause */
/* Embedded Runge-Kutta pairs, which estimate their error and choose their step: one implementation,
 * and a table for each pair. With a fixed step they use baum_i_rk_step() of rk.h. */
#ifndef BAUM_I_INTEGRATE_RK_ADAPTIVE_H
#define BAUM_I_INTEGRATE_RK_ADAPTIVE_H

#include "base/message.h"
#include "integrate/rk.h"
#include "integrate/rk_crossing.h"
#include "integrate/step_control.h"

/* The table of a pair with s stages. Rates are numbered from 0. Rate s is the rate at the end of
 * the step, which is also the first rate of the next step. After it come extra rates, which only
 * the interpolant uses. */
typedef struct baum_i_rk_pair {
  const char *name; /* name of the integrator in messages */
  baum_i_rk_table table;
  int error_order;       /* the estimate grows with h^error_order */
  int error_count;       /* number of rates in the estimate: s, or s + 1 with the rate at the end */
  const double *error;   /* (error_count) weights of the estimate */
  const double *error3;  /* (error_count) weights of an estimate of order 3, or NULL */
  int extra;             /* number of extra rates */
  const double *extra_c; /* (extra) times of the extra rates, as fractions of the step */
  /* weights of all earlier rates for each extra rate, in rows of s + 1, s + 2, ... numbers */
  const double *extra_a;
  int dense;               /* number of terms F_4, F_5, ... of the interpolant */
  const double *dense_row; /* (dense x (s + 1 + extra)) weights of the rates in these terms */
} baum_i_rk_pair;

/* Memory of a run. */
typedef struct baum_i_rk_adaptive {
  baum_i_rk rk; /* first member, because baum_i_rk_step() uses it */
  const baum_i_rk_pair *pair;
  baum_i_step_control control;
  double t;        /* start of the last step */
  double t_end;    /* end of the last step */
  double h;        /* signed length of the last step */
  double *end;     /* (size) (q, v) at the end of the last step */
  double *weights; /* (size) 1 / tolerance */
  double *dense;   /* ((3 + pair->dense) x size) F_1, F_2, ... of the interpolant */
  bool has_step;   /* the members from t to weights belong to an accepted step */
  bool has_dense;  /* `dense` belongs to the same step */
  bool unfinished; /* a start or step failed, so the next step restarts */
  int64_t rejected;
  int64_t forced;
  baum_i_rk_crossing crossing;
  /* The next three members describe the last evaluation that failed and so caused a shorter try. */
  baum_status failure;         /* BAUM_OK: none */
  double failure_t;            /* start of the try in which it failed */
  baum_i_kept_message message; /* message of the evaluation that failed */
} baum_i_rk_adaptive;

/* The functions for the table baum_integrator. `table` points to a baum_i_rk_pair. */
baum_status baum_i_rk_adaptive_open(void *self, const void *table, const baum_i_problem *problem,
                                    const baum_i_state *start);
baum_status baum_i_rk_adaptive_advance(void *self, const baum_i_problem *problem,
                                       baum_i_state *state);
baum_status baum_i_rk_adaptive_interpolate(void *self, const baum_i_problem *problem, double t,
                                           double *q, double *v);
baum_status baum_i_rk_adaptive_restart(void *self, const baum_i_problem *problem,
                                       const baum_i_state *state);
void baum_i_rk_adaptive_forget(void *self);
void baum_i_rk_adaptive_statistics(const void *self, baum_i_statistics *out);

/* clang-format off */
#define BAUM_I_RK_ADAPTIVE_OPERATIONS                                                 \
  BAUM_I_RK_CHOICES,                                                                  \
  .evaluates_end = true,                                                              \
  .memory = sizeof(baum_i_rk_adaptive),                                               \
  .open = baum_i_rk_adaptive_open,                                                    \
  .close = baum_i_rk_close, /* baum_i_rk is the first member */                      \
  .step = baum_i_rk_step,                                                             \
  .advance = baum_i_rk_adaptive_advance,                                              \
  .interpolate = baum_i_rk_adaptive_interpolate,                                      \
  .restart = baum_i_rk_adaptive_restart,                                              \
  .forget = baum_i_rk_adaptive_forget,                                                \
  .statistics = baum_i_rk_adaptive_statistics
/* clang-format on */

#endif
