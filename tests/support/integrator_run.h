/* SPDX-License-Identifier: BSD-3-Clause */
/* One integrator on one mechanism, driven as a simulation drives it but without its monitors; and
 * small mechanisms whose motion is known. */
#ifndef BAUM_TEST_INTEGRATOR_RUN_H
#define BAUM_TEST_INTEGRATOR_RUN_H

#include "integrate/integrator.h"

enum { RUN_SIZE_MAX = 24 };

/* What to run; integrator_setup() gives the rest to start from. */
typedef struct integrator_setup {
  baum_mechanism *mechanism; /* frozen, with an exact design; owned by the caller */
  const baum_integrator *integrator;
  baum_formulation formulation; /* BAUM_FORMULATION_DEFAULT: the first of the integrator's */
  bool fixed;                   /* step of one length, else of the integrator's choice */
  double gain;                  /* [1/s] alpha and beta where the formulation has them */
  double step;                  /* [s] > 0, fixed step */
  double rtol;                  /* variable step */
  double direction;             /* +1, -1 */
} integrator_setup;

/* Fixed where the integrator can. */
integrator_setup integrator_setup_make(baum_mechanism *mechanism, const baum_integrator *integrator,
                                       baum_formulation formulation);

/* A run; not to be moved while it is open. */
typedef struct integrator_run {
  const baum_integrator *integrator;
  baum_workspace *workspace;
  baum_i_problem problem;
  baum_i_state state;
  double step;
  void *self;
  int64_t steps;
  double state_q[RUN_SIZE_MAX];
  double state_v[RUN_SIZE_MAX];
  double q[RUN_SIZE_MAX]; /* at the time of integrator_run_to(): the state, or interpolated */
  double v[RUN_SIZE_MAX];
} integrator_run;

/* Fails the test on any error, but for create's, which it returns; then nothing is to be closed. */
baum_status integrator_run_open(integrator_run *run, const integrator_setup *setup);
void integrator_run_close(integrator_run *run);

/* One step. Fixed: of run->step, projected where the formulation says so; state untouched on
 * failure. */
baum_status integrator_run_step(integrator_run *run);

/* Steps up to t, which is on the grid of a fixed step; then q and v. */
baum_status integrator_run_to(integrator_run *run, double t);

/* Put the run at t, q, v and restart, in a direction. */
baum_status integrator_run_restart(integrator_run *run, double t, const double *q, const double *v,
                                   double direction);

/* q and v (2) of a known motion. */
typedef void motion_fn(double t, double q[2], double v[2]);

/* By what factor the largest error up to t falls when rtol falls tenfold: slope of log error over
 * log rtol, from seven tolerances between 1e-4 and 1e-10. */
double tolerance_factor(const integrator_setup *setup, double t, motion_fn *motion, double rate);

/* ---- mechanisms; destroy them ---- */

/* Point of 1 kg on a rod of 1 m about the origin, at rest level with it, gravity 9.81. */
baum_mechanism *make_pendulum(void);
/* Its motion at t. */
void pendulum_motion(double t, double q[2], double v[2]);

/* The same with a user force of zero, "faulty", that returns `answer` when |t| > `after`. */
typedef struct force_fault {
  double after;
  int answer;
  int64_t calls;
} force_fault;
baum_mechanism *make_faulty_pendulum(force_fault *fault);

/* Free point of 1 kg, thrown from the origin with (1, 2) m/s. */
baum_mechanism *make_throw(void);
void throw_motion(double t, double q[2], double v[2]);

/* Free point of 1 kg on a spring of 4 N/m and no length, at rest at (1, 0), no gravity: x = cos 2
 * t. */
baum_mechanism *make_oscillator(void);
void oscillator_motion(double t, double q[2], double v[2]);

/* Free point of 1 kg on a damper of 1e4 N s/m and a weak spring about the origin, from (1, 0) at
 * rest: it swings nearly as the pendulum does, and along the damper motion dies at 1e4 1/s. */
baum_mechanism *make_stiff(void);

/* Largest of |q - q'| and |v - v'| / rate over (nv). */
double motion_error(int nv, const double *q, const double *v, const double *want_q,
                    const double *want_v, double rate);

#endif
