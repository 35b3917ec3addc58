/* SPDX-License-Identifier: BSD-3-Clause */
/* Predictive control of a slider-crank: a controller tries torques of the motor on the run itself.
 * Every two milliseconds the controller saves the run, simulates one revolution of the crank with
 * each of two torques, and restores the saved run after each trial. It then chooses the torque with
 * which the mean speed of the crank is closer to the set point. Saving and restoring allocate no
 * memory. With a one-step method and the block solver, the run continues as if there had been no
 * trial. */
#include <time.h>

#include "slider_crank_model.h"

enum { STEPS = 20 /* per interval */, AHEAD = 420, INTERVALS = 125 /* per row */, ROWS = 8 };

static const double STEP = 1e-4;   /* [s] */
static const double SPEED = 150.0; /* [rad/s] set point and initial speed */
static const double BRAKE = -0.1;  /* [N m] always on */
static const double FULL = 0.6;    /* [N m] torque of the motor when it is on */

typedef struct plant {
  baum_simulation *run;
  baum_joint_id pin;
  baum_input_id motor;
  unsigned char *buffer;
  size_t capacity;
  long tries;
  double seconds; /* wall time spent in saving and restoring */
} plant;

static double now(void)
{
  struct timespec t;
  (void)timespec_get(&t, TIME_UTC);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double angle(const plant *p)
{
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, p->pin);
  double crank[2];
  CHECK(baum_simulation_get(p->run, &channel, 1, crank));
  return crank[0];
}

/* Simulates the next AHEAD steps with a given torque, and restores the run. Returns by how much the
 * mean speed differs from the set point. */
static double try_torque(plant *p, double torque)
{
  size_t size = 0;
  double begun = now();
  CHECK(baum_simulation_save(p->run, p->buffer, p->capacity, &size));
  double saved = now();
  double from = angle(p);
  CHECK(baum_simulation_set_input(p->run, p->motor, torque));
  CHECK(baum_simulation_step(p->run, AHEAD));
  double speed = (angle(p) - from) / (STEP * AHEAD);
  double tried = now();
  CHECK(baum_simulation_restore(p->run, p->buffer, size));
  p->seconds += saved - begun + now() - tried;
  p->tries++;
  return fabs(speed - SPEED);
}

static baum_mechanism *build(slider_crank *s, plant *p)
{
  baum_mechanism *mechanism = NULL; /* a copy, because s.mechanism is frozen */
  CHECK(baum_mechanism_copy(s->mechanism, &mechanism));
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = s->crank;
  load.torque = BRAKE;
  CHECK(baum_mechanism_add_planar_load(mechanism, &load, NULL));
  load.torque = 1.0;
  CHECK(baum_mechanism_add_input(mechanism, "motor", 0.0, &load.input));
  CHECK(baum_mechanism_add_planar_load(mechanism, &load, NULL));
  CHECK(baum_mechanism_freeze(mechanism));
  p->pin = s->pin_a;
  p->motor = load.input;
  return mechanism;
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "predictive_control");
  slider_crank s = slider_crank_build(false);
  plant p = {0};
  baum_mechanism *mechanism = build(&s, &p);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.step = STEP;
  CHECK(baum_simulation_create(mechanism, &options, &p.run));
  /* The capacity is sufficient for every state of the run. */
  CHECK(baum_simulation_save(p.run, NULL, 0, &p.capacity));
  p.buffer = malloc(p.capacity);
  if (!p.buffer) {
    return EXIT_FAILURE;
  }
  printf("slider-crank against a brake, its motor on or off\n\n");
  static const example_column columns[] = {{"t", "t [s]", 'f', 2},
                                           {"speed", "mean speed [rad/s]", 'f', 2},
                                           {"on", "motor on [%]", 'f', 0}};
  example_table("speed", columns, 3, true);
  double speed = 0.0;
  for (int row = 0; row < ROWS; row++) {
    double begun = angle(&p);
    int on = 0;
    for (int k = 0; k < INTERVALS; k++) {
      bool full = try_torque(&p, FULL) < try_torque(&p, 0.0);
      on += full;
      CHECK(baum_simulation_set_input(p.run, p.motor, full ? FULL : 0.0));
      CHECK(baum_simulation_step(p.run, STEPS));
    }
    speed = (angle(&p) - begun) / (STEP * STEPS * INTERVALS);
    example_number(baum_simulation_time(p.run));
    example_number(speed);
    example_number(100.0 * on / INTERVALS);
  }
  baum_counters c;
  CHECK(baum_simulation_counters(p.run, &c, sizeof c));
  example_counters(p.run);
  printf("%ld trials; saving and restoring together take %.1f us per trial\n", p.tries,
         1e6 * p.seconds / (double)p.tries);
  example_expect("speed at the end, off by [rad/s]", fabs(speed - SPEED), 0.03 * SPEED);
  example_expect("steps counted beyond the motion", (double)c.steps - ROWS * INTERVALS * STEPS,
                 0.0);
  example_expect("largest violation max|Phi| [m]", c.max_phi, 1e-4);
  free(p.buffer);
  baum_simulation_destroy(p.run);
  baum_mechanism_destroy(mechanism);
  baum_mechanism_destroy(s.mechanism);
  return example_end();
}
