/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs an integrator in the same way as a simulation, but without warnings and counters. The file
 * also declares small mechanisms whose motion is known. */
#ifndef BAUM_TEST_INTEGRATOR_RUN_H
#define BAUM_TEST_INTEGRATOR_RUN_H

#include "integrate/integrator.h"

enum { RUN_SIZE_MAX = 24 };

/* Describes what is to be run. integrator_setup_make() sets all fields. */
typedef struct integrator_setup {
  baum_mechanism *mechanism; /* frozen, with an exact design configuration; the caller owns it */
  const baum_integrator *integrator;
  /* BAUM_FORMULATION_DEFAULT is the first formulation of the integrator. */
  baum_formulation formulation;
  bool fixed;       /* true for a fixed step, false for a variable step */
  double gain;      /* [1/s] alpha and beta, if the formulation has gains */
  double step;      /* [s] > 0, for a fixed step */
  double rtol;      /* for a variable step */
  double direction; /* +1 or -1 */
} integrator_setup;

/* Returns default settings, with a fixed step if the integrator has one. */
integrator_setup integrator_setup_make(baum_mechanism *mechanism, const baum_integrator *integrator,
                                       baum_formulation formulation);

/* A run of an integrator. While it is open, its address must not change. */
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
  double q[RUN_SIZE_MAX]; /* set by integrator_run_to(), if necessary by interpolation */
  double v[RUN_SIZE_MAX];
} integrator_run;

/* Opens a run. If the integrator cannot be created, returns the error, and the run need not be
 * closed. Any other error fails the test. */
baum_status integrator_run_open(integrator_run *run, const integrator_setup *setup);
void integrator_run_close(integrator_run *run);

/* Takes one step. A fixed step has the length run->step. If the formulation is projection, the
 * step includes a projection. If the step fails, the state stays unchanged. */
baum_status integrator_run_step(integrator_run *run);

/* Advances to t, and sets q and v to their values at t. With a fixed step, t must be a multiple of
 * the step. */
baum_status integrator_run_to(integrator_run *run, double t);

/* Sets t, q, v and the direction of time, and restarts the integrator. */
baum_status integrator_run_restart(integrator_run *run, double t, const double *q, const double *v,
                                   double direction);

/* Computes q and v (2) of a known motion at t. */
typedef void motion_fn(double t, double q[2], double v[2]);

/* Returns the factor by which the largest motion_error() up to t decreases when rtol decreases by a
 * factor of 10. The factor is computed from the slope of the line through log error as a function
 * of log rtol, for seven tolerances from 1e-4 to 1e-10. */
double tolerance_factor(const integrator_setup *setup, double t, motion_fn *motion, double rate);

/* ---- mechanisms, which the caller destroys ---- */

/* Makes a particle of 1 kg on a rod of 1 m from the origin. It starts at rest, and the rod is
 * horizontal. Gravity is 9.81 m/s^2. */
baum_mechanism *make_pendulum(void);
/* Computes the exact motion of this pendulum at time t. */
void pendulum_motion(double t, double q[2], double v[2]);

/* Data of the user force "faulty" on a pendulum. The force is zero, but its function returns
 * `answer` if |t| > `after`. */
typedef struct force_fault {
  double after;
  int answer;
  int64_t calls;
} force_fault;
baum_mechanism *make_faulty_pendulum(force_fault *fault);

/* Makes a free particle of 1 kg under gravity. It starts at the origin with the velocity (1, 2)
 * m/s. */
baum_mechanism *make_throw(void);
void throw_motion(double t, double q[2], double v[2]);

/* Makes a particle of 1 kg with the force -4 q and without gravity. It starts at rest at (1, 0), so
 * x = cos 2 t. */
baum_mechanism *make_oscillator(void);
void oscillator_motion(double t, double q[2], double v[2]);

/* Makes a particle of 1 kg. A damper of 1e4 N s/m and a spring of 1 N/m connect it to the origin.
 * It starts at rest at (1, 0). Motion along the damper decays at the rate 1e4 1/s, so the particle
 * swings almost like the pendulum. */
baum_mechanism *make_stiff(void);

/* Returns the largest of the numbers |q - want_q| and |v - want_v| / rate of all nv coordinates. */
double motion_error(int nv, const double *q, const double *v, const double *want_q,
                    const double *want_v, double rate);

#endif
