/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs an integrator as a simulation does, but without monitors; and small mechanisms whose motion
 * is known. */
#ifndef BAUM_TEST_INTEGRATOR_RUN_H
#define BAUM_TEST_INTEGRATOR_RUN_H

#include "integrate/integrator.h"

enum { RUN_SIZE_MAX = 24 };

/* What to run; integrator_setup_make() sets all fields. */
typedef struct integrator_setup {
  baum_mechanism *mechanism; /* frozen, with an exact design configuration; owned by the caller */
  const baum_integrator *integrator;
  baum_formulation formulation; /* BAUM_FORMULATION_DEFAULT: the integrator's first */
  bool fixed;                   /* fixed step, else variable */
  double gain;                  /* [1/s] alpha and beta, if the formulation has gains */
  double step;                  /* [s] > 0, fixed step */
  double rtol;                  /* variable step */
  double direction;             /* +1, -1 */
} integrator_setup;

/* With a fixed step if the integrator has one. */
integrator_setup integrator_setup_make(baum_mechanism *mechanism, const baum_integrator *integrator,
                                       baum_formulation formulation);

/* A run; its address must not change while it is open. */
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
  double q[RUN_SIZE_MAX]; /* result of integrator_run_to(): the state or interpolated */
  double v[RUN_SIZE_MAX];
} integrator_run;

/* Fails the test on any error except that of create, which it returns; then there is nothing to
 * close. */
baum_status integrator_run_open(integrator_run *run, const integrator_setup *setup);
void integrator_run_close(integrator_run *run);

/* Takes one step. A fixed step has the length run->step and includes the projection of the
 * formulation; on failure the state is unchanged. */
baum_status integrator_run_step(integrator_run *run);

/* Advances to t and sets q and v. With a fixed step t must be a multiple of it. */
baum_status integrator_run_to(integrator_run *run, double t);

/* Sets t, q, v and the direction, and restarts. */
baum_status integrator_run_restart(integrator_run *run, double t, const double *q, const double *v,
                                   double direction);

/* Gives q and v (2) of a known motion. */
typedef void motion_fn(double t, double q[2], double v[2]);

/* Factor by which the largest error up to t falls when rtol falls tenfold: slope of log error over
 * log rtol for seven tolerances between 1e-4 and 1e-10. */
double tolerance_factor(const integrator_setup *setup, double t, motion_fn *motion, double rate);

/* ---- mechanisms, which the caller destroys ---- */

/* A particle of 1 kg on a rod of 1 m, released at rest level with the origin, gravity 9.81. */
baum_mechanism *make_pendulum(void);
/* Its exact motion at time t. */
void pendulum_motion(double t, double q[2], double v[2]);

/* A pendulum with an additional user force of zero, "faulty", which returns `answer` if |t| >
 * `after`. */
typedef struct force_fault {
  double after;
  int answer;
  int64_t calls;
} force_fault;
baum_mechanism *make_faulty_pendulum(force_fault *fault);

/* A free particle of 1 kg, thrown from the origin with (1, 2) m/s. */
baum_mechanism *make_throw(void);
void throw_motion(double t, double q[2], double v[2]);

/* A particle of 1 kg under the force -4 q, at rest at (1, 0), without gravity: x = cos 2 t. */
baum_mechanism *make_oscillator(void);
void oscillator_motion(double t, double q[2], double v[2]);

/* A particle of 1 kg with a damper of 1e4 N s/m and a weak spring to the origin, from (1, 0) at
 * rest. It swings nearly like the pendulum; motion along the damper decays at 1e4 1/s. */
baum_mechanism *make_stiff(void);

/* Largest of |q - want_q| and |v - want_v| / rate over (nv). */
double motion_error(int nv, const double *q, const double *v, const double *want_q,
                    const double *want_v, double rate);

#endif
