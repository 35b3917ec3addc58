/* SPDX-License-Identifier: BSD-3-Clause */
/* A control loop. Every millisecond a controller reads the angle and the speed of the crank of a
 * slider-crank, and sets the torque of the motor. It keeps the speed constant, even when a brake is
 * switched on. In each interval of one millisecond, the run takes ten steps of fixed length. These
 * steps allocate no memory, so the computing time of an interval is bounded. A table shows the wall
 * times of the intervals. */
#include <time.h>

#include "slider_crank_model.h"

enum { STEPS = 10 /* per interval */, INTERVALS = 250 /* per row */, ROWS = 12, BINS = 8 };

static const double STEP = 1e-4;         /* [s] */
static const double SPEED = 150.0;       /* [rad/s] set point and initial speed */
static const double PROPORTIONAL = 0.02; /* [N m s/rad] */
static const double INTEGRAL = 0.1;      /* [N m/rad] */
static const double BRAKE = -0.2;        /* [N m] */
static const double BRAKE_TIME = 1.0;    /* [s] time at which the brake is switched on */

typedef struct loop {
  baum_simulation *run;
  baum_joint_id pin;
  baum_input_id motor;
  baum_input_id brake;
  double crank[2];     /* [rad] angle and [rad/s] angular velocity */
  double work;         /* [J] net work of motor and brake; the work of the brake is negative */
  double longest;      /* [s] longest wall time of an interval */
  double longest_step; /* [s] largest mean wall time of a step in an interval */
  /* Element k counts the intervals that take 2^k to 2^(k+1) us. The last element counts all longer
   * intervals. */
  long histogram[BINS];
} loop;

/* Adds a load of 1 N m on the crank, and an input that multiplies this load. The value of the input
 * is therefore the torque in N m. */
static baum_input_id add_torque(baum_mechanism *mechanism, baum_body_id crank, const char *name)
{
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = crank;
  load.torque = 1.0;
  CHECK(baum_mechanism_add_input(mechanism, name, 0.0, &load.input));
  CHECK(baum_mechanism_add_planar_load(mechanism, &load, NULL));
  return load.input;
}

static void read_channels(loop *l)
{
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, l->pin);
  CHECK(baum_simulation_get(l->run, &channel, 1, l->crank));
}

/* A proportional-integral controller. The integral of the speed error is the difference between the
 * desired and the actual angle. */
static double controller(const loop *l, double t)
{
  return PROPORTIONAL * (SPEED - l->crank[1]) + INTEGRAL * (SPEED * t - l->crank[0]);
}

static double seconds(void)
{
  struct timespec now;
  (void)timespec_get(&now, TIME_UTC);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void clock_interval(loop *l, double whole, double step)
{
  int bin = (int)log2(fmax(1e6 * whole, 1.0));
  l->histogram[bin < BINS ? bin : BINS - 1]++;
  l->longest = fmax(l->longest, whole);
  l->longest_step = fmax(l->longest_step, step);
}

static void interval(loop *l)
{
  double begun = seconds();
  double t = baum_simulation_time(l->run);
  double motor = controller(l, t);
  double brake = t < BRAKE_TIME ? 0.0 : BRAKE;
  CHECK(baum_simulation_set_input(l->run, l->motor, motor));
  CHECK(baum_simulation_set_input(l->run, l->brake, brake));
  double ready = seconds();
  CHECK(baum_simulation_step(l->run, STEPS));
  double step = (seconds() - ready) / STEPS;
  double before = l->crank[0];
  read_channels(l);
  l->work += (motor + brake) * (l->crank[0] - before);
  clock_interval(l, seconds() - begun, step);
}

static void tell_times(const loop *l)
{
  static const example_column columns[] = {{"from", "at least [us]", 'd', 0},
                                           {"intervals", "intervals", 'd', 0}};
  printf("\n");
  example_table("times", columns, 2, true);
  for (int k = 0; k < BINS; k++) {
    example_number(k == 0 ? 0.0 : ldexp(1.0, k));
    example_number((double)l->histogram[k]);
  }
  printf("longest interval %.0f us, longest mean time of a step in an interval %.2f us\n",
         1e6 * l->longest, 1e6 * l->longest_step);
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "control_loop");
  slider_crank s = slider_crank_build(false);
  baum_mechanism *plant = NULL; /* a copy, because s.mechanism is frozen */
  loop l = {.pin = s.pin_a};
  CHECK(baum_mechanism_copy(s.mechanism, &plant));
  l.motor = add_torque(plant, s.crank, "motor");
  l.brake = add_torque(plant, s.crank, "brake");
  CHECK(baum_mechanism_freeze(plant));

  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.step = STEP;
  CHECK(baum_simulation_create(plant, &options, &l.run));
  printf("slider-crank kept at %g rad/s, with a brake from %g s on\n\n", SPEED, BRAKE_TIME);

  static const example_column columns[] = {{"t", "t [s]", 'f', 2},
                                           {"speed", "mean speed [rad/s]", 'f', 2},
                                           {"work", "net work [J]", 'f', 3}};
  example_table("speed", columns, 3, true);
  double speed[ROWS];
  read_channels(&l);
  for (int row = 0; row < ROWS; row++) {
    double begun = l.crank[0];
    for (int k = 0; k < INTERVALS; k++) {
      interval(&l);
    }
    speed[row] = (l.crank[0] - begun) / (STEP * STEPS * INTERVALS);
    example_number(baum_simulation_time(l.run));
    example_number(speed[row]);
    example_number(l.work);
  }
  tell_times(&l);
  baum_counters c;
  CHECK(baum_simulation_counters(l.run, &c, sizeof c));
  example_counters(l.run);
  example_expect("speed change under the brake [rad/s]", speed[4] - speed[3], -2.0);
  example_expect("speed at the end, off by [rad/s]", fabs(speed[ROWS - 1] - SPEED), 0.005 * SPEED);
  example_expect("energy change minus net work [J]", fabs(c.energy_change - l.work), 1.0);
  example_expect("largest violation max|Phi| [m]", c.max_phi, 1e-4);

  baum_simulation_destroy(l.run);
  baum_mechanism_destroy(plant);
  baum_mechanism_destroy(s.mechanism);
  return example_end();
}
