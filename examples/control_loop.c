/* SPDX-License-Identifier: BSD-3-Clause */
/* A control loop: every millisecond a controller looks at the crank of the slider-crank and sets the torque of its
 * motor, so that the speed stays what it is when a brake comes on. Fixed steps make the work of an interval
 * bounded: ten steps, which allocate nothing. In each interval a second controller tries its two torques, none and
 * full, on the run itself for some milliseconds ahead, goes back by what was saved, and takes the better one. */
#include <time.h>

#include "slider_crank_model.h"

enum { STEPS = 10 /* of one interval */, INTERVALS = 250 /* of one row */, ROWS = 12 };
enum { AHEAD = 40 /* steps that a torque is tried for */, BINS = 8, BUFFER = 1 << 15 };

static const double STEP = 1e-4;         /* [s] */
static const double SPEED = 150.0;       /* [rad/s] wanted, and at start */
static const double PROPORTIONAL = 0.02; /* [N m s/rad] */
static const double INTEGRAL = 0.1;      /* [N m/rad] */
static const double BRAKE = -0.2;        /* [N m] */
static const double BRAKE_TIME = 1.0;    /* [s] when it comes on */
static const double FULL = 0.4;          /* [N m] of the controller that tries */

typedef struct loop {
  baum_simulation *run;
  baum_joint_id pin;
  baum_input_id motor;
  baum_input_id brake;
  double crank[2]; /* [rad] angle and [rad/s] rate */
  double work;     /* [J] done by the motor and, negative, by the brake */
  double longest;  /* [s] wall time of an interval */
  double longest_step; /* [s] of its steps, one of them */
  long histogram[BINS]; /* intervals of 2^k us to twice that; the first and last all below and above */
} loop;

/* A torque on the crank as large as an input says. */
static baum_input_id add_torque(baum_mechanism *mechanism, baum_body_id crank, const char *name)
{
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = crank;
  load.torque = 1.0;
  CHECK(baum_mechanism_add_input(mechanism, name, 0.0, &load.input));
  CHECK(baum_mechanism_add_planar_load(mechanism, &load, NULL));
  return load.input;
}

static void look(loop *l)
{
  const baum_channel channel = {.quantity = BAUM_JOINT_COORDINATE, .joint = l->pin};
  CHECK(baum_simulation_get(l->run, &channel, 1, l->crank));
}

/* The integral of the speed's error is what the angle lags behind. */
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

static void count(loop *l, double interval, double step)
{
  int bin = (int)floor(log2(fmax(1e6 * interval, 1.0)));
  l->histogram[bin < BINS ? bin : BINS - 1]++;
  l->longest = fmax(l->longest, interval);
  l->longest_step = fmax(l->longest_step, step);
}

/* By how much the speed is off on the average, when a torque acts for a while; the run is put back. */
static double try_torque(loop *l, double torque)
{
  static unsigned char buffer[BUFFER];
  size_t size = 0;
  double before = l->crank[0];
  CHECK(baum_simulation_save(l->run, buffer, sizeof buffer, &size));
  CHECK(baum_simulation_set_input(l->run, l->motor, torque));
  CHECK(baum_simulation_step(l->run, AHEAD));
  look(l);
  double speed = (l->crank[0] - before) / (STEP * AHEAD);
  CHECK(baum_simulation_restore(l->run, buffer, size));
  look(l);
  return fabs(speed - SPEED);
}

/* With the model itself in place of gains. */
static double predictive_controller(loop *l)
{
  double without = try_torque(l, 0.0);
  return try_torque(l, FULL) < without ? FULL : 0.0;
}

static void interval(loop *l, bool predicts)
{
  double begun = seconds();
  double t = baum_simulation_time(l->run);
  double motor = predicts ? predictive_controller(l) : controller(l, t);
  double brake = t < BRAKE_TIME ? 0.0 : BRAKE;
  CHECK(baum_simulation_set_input(l->run, l->motor, motor));
  CHECK(baum_simulation_set_input(l->run, l->brake, brake));
  double stepping = seconds();
  CHECK(baum_simulation_step(l->run, STEPS));
  double step = (seconds() - stepping) / STEPS;
  double before = l->crank[0];
  look(l);
  l->work += (motor + brake) * (l->crank[0] - before);
  count(l, seconds() - begun, step);
}

/* How long intervals have taken, and the longest of them: what a real-time loop has to have room for. */
static void tell_times(const loop *l, const char *controller_is)
{
  static const example_column columns[] = {{"from", "from [us]", 'd', 6}, {"n", "intervals", 'd', 9}};
  printf("\n%s: longest interval %.0f us, longest mean step of an interval %.2f us\n", controller_is,
         1e6 * l->longest, 1e6 * l->longest_step);
  example_table(controller_is, columns, 2, true);
  for (int k = 0; k < BINS; k++) {
    example_number(k == 0 ? 0.0 : ldexp(1.0, k));
    example_number((double)l->histogram[k]);
  }
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "control_loop");
  slider_crank s = slider_crank_build(false);
  baum_mechanism *plant = NULL; /* a copy, for s.mechanism is frozen */
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
  look(&l);
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
  baum_counters c;
  CHECK(baum_simulation_counters(l.run, &c, sizeof c));
  example_counters(l.run);
  printf("longest interval of the loop: %.0f us\n", 1e6 * l.longest);
  example_expect("speed change under the brake [rad/s]", speed[4] - speed[3], -2.0);
  example_expect("speed at the end, off by [rad/s]", fabs(speed[ROWS - 1] - SPEED), 0.005 * SPEED);
  example_expect("energy change less net work [J]", fabs(c.energy_change - l.work), 1.0);
  example_expect("largest violation max|Phi| [m]", c.max_phi, 1e-4);

  baum_simulation_destroy(l.run);
  baum_mechanism_destroy(plant);
  baum_mechanism_destroy(s.mechanism);
  return example_end();
}
