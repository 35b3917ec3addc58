/* SPDX-License-Identifier: BSD-3-Clause */
/* This example shows events and break times. In the first part a pendulum bounces at a stop, and
 * the run finds the times of the bounces. In the second part a torque acts on a pendulum during
 * short intervals, whose times are known in advance. */
#include <baum/baum.h>

#include "example_util.h"

enum { BOUNCES = 8, KICKS = 3 };

static const double LENGTH = 1.0;      /* [m] of a uniform rod of 1 kg */
static const double ANGLE = 1.0;       /* [rad] initial angle */
static const double STOP = 0.0;        /* [rad] angle of the stop, below the pin */
static const double RESTITUTION = 0.9; /* [-] speed after a bounce / speed before it */

typedef struct pendulum {
  baum_mechanism *mechanism;
  baum_joint_id pin;
  baum_input_id kick; /* [N m] torque on the rod */
} pendulum;

static pendulum build(void)
{
  pendulum p;
  CHECK(baum_mechanism_create(&p.mechanism));
  baum_planar_body_def rod = baum_planar_body_def_default();
  rod.mass = 1.0;
  rod.inertia = LENGTH * LENGTH / 12.0;
  rod.angle = ANGLE;
  rod.position[0] = LENGTH / 2.0 * sin(ANGLE);
  rod.position[1] = -LENGTH / 2.0 * cos(ANGLE);
  rod.angular_velocity = 0.0;
  baum_body_id body;
  CHECK(baum_mechanism_add_planar_body(p.mechanism, &rod, &body));
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.body_b = body;
  pin.point[0] = pin.point[1] = 0.0;
  CHECK(baum_mechanism_add_planar_revolute(p.mechanism, &pin, &p.pin));
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = body;
  load.torque = 1.0;
  CHECK(baum_mechanism_add_input(p.mechanism, "kick", 0.0, &p.kick));
  load.input = p.kick;
  CHECK(baum_mechanism_add_planar_load(p.mechanism, &load, NULL));
  CHECK(baum_mechanism_freeze(p.mechanism));
  return p;
}

static baum_simulation *start(const pendulum *p)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-10;
  options.energy_account = true;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(p->mechanism, &options, &run));
  return run;
}

/* ---- events: times that the run finds ---- */

/* Returns the duration [s] of a quarter of a swing of the given amplitude. For a uniform rod of
 * length l it is K(sin(angle / 2)) sqrt(2 l / (3 g)). The arithmetic-geometric mean gives the
 * complete elliptic integral K (Abramowitz, Stegun 1964, 17.6.3). */
static double quarter(double angle)
{
  double a = 1.0;
  double b = cos(angle / 2.0);
  for (int k = 0; k < 8; k++) {
    double mean = (a + b) / 2.0;
    b = sqrt(a * b);
    a = mean;
  }
  return acos(-1.0) / (2.0 * a) * sqrt(2.0 * LENGTH / (3.0 * 9.81));
}

static void add_stop(baum_simulation *run, const pendulum *p)
{
  baum_event_def stop = baum_event_def_default();
  stop.name = "stop";
  stop.joint = p->pin;
  stop.value = STOP;
  stop.direction = -1; /* falling */
  CHECK(baum_simulation_add_event(run, &stop, NULL));
}

/* Sets the velocities after a bounce. The run has stopped at the event of this bounce. */
static void bounce(baum_simulation *run)
{
  double v[3];
  for (int i = 0; i < 3; i++) {
    v[i] = -RESTITUTION * baum_simulation_v(run)[i];
  }
  CHECK(baum_simulation_set_state(run, baum_simulation_time(run), baum_simulation_q(run), v));
}

/* Compares the bounces with the exact times. A bounce multiplies the kinetic energy by
 * RESTITUTION^2. In the next swing this energy becomes potential energy. The potential energy is
 * proportional to 1 - cos(angle), so it gives the amplitude. */
static double tell_bounces(baum_simulation *run)
{
  static const example_column columns[] = {{"bounce", "bounce", 'd', 0},
                                           {"t", "t [s]", 'f', 9},
                                           {"rate", "rate before [rad/s]", 'f', 9},
                                           {"error", "error of t [s]", 'e', 1}};
  example_table("bounces", columns, 4, true);
  double exact = quarter(ANGLE);
  double worst = 0.0;
  for (int k = 0; k < BOUNCES; k++) {
    baum_status status = baum_simulation_advance_to(run, 100.0);
    if (status != BAUM_STOP_EVENT) {
      CHECK(status);
      return INFINITY;
    }
    double error = baum_simulation_time(run) - exact;
    worst = fmax(worst, fabs(error));
    example_number(k + 1);
    example_number(baum_simulation_time(run));
    example_number(baum_simulation_v(run)[2]);
    example_number(error);
    bounce(run);
    double left = pow(RESTITUTION, 2.0 * (k + 1)) * (1.0 - cos(ANGLE));
    exact += 2.0 * quarter(acos(1.0 - left));
  }
  return worst;
}

/* ---- break times: known in advance ---- */

static double tell_kicks(baum_simulation *run, const pendulum *p)
{
  static const example_column columns[] = {{"t", "t [s]", 'f', 2},
                                           {"kick", "kick [N m]", 'f', 1},
                                           {"work", "work of kicks [J]", 'f', 6},
                                           {"energy", "energy [J]", 'f', 6},
                                           {"residual", "residual [J]", 'e', 1}};
  const double times[2 * KICKS] = {1.0, 1.05, 2.0, 2.05, 3.0, 3.05};
  const double torques[2 * KICKS] = {10.0, 0.0, 10.0, 0.0, 10.0, 0.0};
  CHECK(baum_simulation_schedule_input(run, p->kick, times, torques, 2 * KICKS));
  printf("\n");
  example_table("kicks", columns, 5, true);
  double worst = 0.0;
  for (int k = 0; k < 2 * KICKS; k++) {
    baum_energy_account account;
    CHECK(baum_simulation_advance_to(run, times[k]));
    CHECK(baum_simulation_energy_account(run, &account, sizeof account));
    example_number(times[k]);
    example_number(baum_simulation_input(run, p->kick));
    example_number(account.loads);
    example_number(account.kinetic + account.potential);
    example_number(account.residual);
    worst = fmax(worst, fabs(account.residual));
  }
  return worst;
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "events");
  pendulum p = build();
  baum_simulation *bouncing = start(&p);
  baum_simulation *kicked = start(&p);
  printf("a rod of 1 m falls from %g rad against a stop at %g rad, and bounces\n\n", ANGLE, STOP);
  add_stop(bouncing, &p);
  double time_error = tell_bounces(bouncing);
  double residual = tell_kicks(kicked, &p);
  baum_counters counters;
  CHECK(baum_simulation_counters(kicked, &counters, sizeof counters));
  example_counters(kicked);
  example_expect("times of bounces, off by [s]", time_error, 1e-8);
  example_expect("residual of the energy [J]", residual, 1e-8);
  example_expect("rejected steps where kicks are known", (double)counters.rejected, 5.0);
  baum_simulation_destroy(bouncing);
  baum_simulation_destroy(kicked);
  baum_mechanism_destroy(p.mechanism);
  return example_end();
}
