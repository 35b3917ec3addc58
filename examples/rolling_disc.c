/* SPDX-License-Identifier: BSD-3-Clause */
/* A thin disc rolls on a plane without slipping. The joint restricts the height of the disc and two
 * velocities of its contact point. The disc therefore has three degrees of freedom of velocity, but
 * five of position: it can roll to every place, and arrive there with every heading.
 *
 * The first disc rolls steadily on a circle. Let b be the elevation of its axis, W the angular
 * velocity of its heading, m its mass, R its radius, and A and C its moments of inertia across and
 * along the axis. Then the angular velocity n about the axis must satisfy
 *
 *   n W cos b (C + m R^2) = A W^2 sin b cos b - m g R sin b
 *
 * The second disc rolls faster and wobbles. For both discs, the program prints the coefficient of
 * friction that prevents slipping, and checks the energy. */
#include <string.h>

#include <baum/baum.h>

#include "example_util.h"

static const double MASS = 0.5;     /* [kg] */
static const double RADIUS = 0.2;   /* [m] */
static const double GRAVITY = 9.81; /* [m/s^2] */
static const double TILT = 0.25;    /* [rad] b at the start */
static const double TURNING = 1.2;  /* [rad/s] W at the start */
static const double SPAN = 3.0;     /* [s] */

enum { ROWS = 25, DISCS = 2 };

typedef struct disc {
  baum_mechanism *mechanism;
  baum_body_id body;
  baum_joint_id contact;
} disc;

/* Returns the angular velocity n of the steady motion. */
static double steady_rate(void)
{
  double across = MASS * RADIUS * RADIUS / 4.0;
  double along = 2.0 * across;
  double right = across * TURNING * TURNING * sin(TILT) - MASS * GRAVITY * RADIUS * tan(TILT);
  return right / (TURNING * (along + MASS * RADIUS * RADIUS));
}

/* Builds a disc whose axis is the y axis of the body. It rolls along x at the start. The centre of
 * the circle is the origin. */
static disc build(double rate)
{
  disc d;
  baum_spatial_body_def body = baum_spatial_body_def_default();
  body.name = "disc";
  body.mass = MASS;
  body.inertia[0] = body.inertia[2] = MASS * RADIUS * RADIUS / 4.0;
  body.inertia[1] = 2.0 * body.inertia[0];
  body.position[1] = -RADIUS * rate / TURNING;
  body.position[2] = RADIUS * cos(TILT);
  body.orientation[0] = cos(0.5 * TILT);
  body.orientation[1] = sin(0.5 * TILT);
  body.velocity[0] = RADIUS * rate;
  body.angular_velocity[1] = rate; /* in the axes of the body */
  body.angular_velocity[2] = TURNING * cos(TILT);
  baum_spatial_rolling_disc_def contact = baum_spatial_rolling_disc_def_default();
  contact.name = "contact";
  contact.radius = RADIUS;
  contact.normal[1] = contact.axis_b[2] = 0.0;
  contact.normal[2] = contact.axis_b[1] = 1.0;
  CHECK(baum_mechanism_create(&d.mechanism));
  CHECK(baum_mechanism_set_gravity(d.mechanism, 0.0, 0.0, -GRAVITY));
  CHECK(baum_mechanism_add_spatial_body(d.mechanism, &body, &d.body));
  contact.body_b = d.body;
  CHECK(baum_mechanism_add_spatial_rolling_disc(d.mechanism, &contact, &d.contact));
  CHECK(baum_mechanism_freeze(d.mechanism));
  return d;
}

/* The largest deviations from the expected motion during a run, and the range of the tilt. */
typedef struct findings {
  double circle;   /* [m] distance of the centre from its place on the circle */
  double energy;   /* [J] change */
  double slip;     /* [m/s] velocity of the contact point */
  double friction; /* [-] largest coefficient of friction that is needed */
  double lowest;   /* [rad] smallest tilt */
  double highest;  /* [rad] largest tilt */
} findings;

static findings simulate(const disc *d, double rate)
{
  enum { POSE = 0, REACTION = 7, ENERGY = 13, WIDTH = 15 };
  findings out = {.lowest = INFINITY, .highest = -INFINITY};
  const baum_channel channels[] = {baum_channel_of_body(BAUM_BODY_POSE, d->body),
                                   baum_channel_of_joint(BAUM_JOINT_REACTION, d->contact),
                                   baum_channel_of(BAUM_ENERGY)};
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-10;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(d->mechanism, &options, &run));
  double start = NAN;
  for (int k = 0; k < ROWS; k++) {
    double t = SPAN * k / (ROWS - 1);
    double row[WIDTH];
    baum_counters counters;
    CHECK(baum_simulation_advance_to(run, t));
    CHECK(baum_simulation_get(run, channels, 3, row));
    CHECK(baum_simulation_counters(run, &counters, sizeof counters));
    double circle = RADIUS * rate / TURNING;
    double tilt = asin(2.0 * (row[POSE + 5] * row[POSE + 6] + row[POSE + 3] * row[POSE + 4]));
    double friction = hypot(row[REACTION], row[REACTION + 1]) / row[REACTION + 2];
    double energy = row[ENERGY] + row[ENERGY + 1];
    start = k == 0 ? energy : start;
    out.circle = fmax(out.circle, hypot(row[POSE] - circle * sin(TURNING * t),
                                        row[POSE + 1] + circle * cos(TURNING * t)));
    out.energy = fmax(out.energy, fabs(energy - start));
    out.slip = fmax(out.slip, counters.max_phi_rate);
    out.friction = fmax(out.friction, friction);
    out.lowest = fmin(out.lowest, tilt);
    out.highest = fmax(out.highest, tilt);
    example_number(t);
    example_number(row[POSE]);
    example_number(row[POSE + 1]);
    example_number(tilt);
    example_number(friction);
  }
  baum_simulation_destroy(run);
  return out;
}

int main(int argc, char **argv)
{
  static const char *const names[DISCS] = {"steady", "faster"};
  static const example_column columns[] = {{"t", "t [s]", 'f', 2},
                                           {"x", "x [m]", 'f', 6},
                                           {"y", "y [m]", 'f', 6},
                                           {"tilt", "tilt [rad]", 'f', 6},
                                           {"friction", "friction [-]", 'f', 4}};
  example_begin(argc, argv, "rolling_disc");
  findings found[DISCS];
  baum_mobility mobility;
  for (int k = 0; k < DISCS; k++) {
    double rate = (k == 0 ? 1.0 : 1.3) * steady_rate();
    disc d = build(rate);
    CHECK(baum_mechanism_mobility(d.mechanism, &mobility, sizeof mobility));
    example_table(names[k], columns, 5, true);
    found[k] = simulate(&d, rate);
    baum_mechanism_destroy(d.mechanism);
  }
  example_expect("degrees of freedom minus 3", fabs(mobility.degrees_of_freedom - 3.0), 0.0);
  example_expect("position degrees of freedom minus 5",
                 fabs(mobility.position_degrees_of_freedom - 5.0), 0.0);
  example_expect("steady: off the circle by [m]", found[0].circle, 1e-8);
  example_expect("steady: change of the tilt [rad]", found[0].highest - found[0].lowest, 1e-8);
  double friction = fabs(RADIUS * steady_rate() * TURNING) / GRAVITY;
  example_expect("steady: friction, off by", fabs(found[0].friction - friction), 1e-8);
  double wobble = found[1].highest - found[1].lowest;
  example_expect("faster: missing tilt change [rad]", fmax(0.0, 0.02 - wobble), 0.0);
  for (int k = 0; k < DISCS; k++) {
    char what[64];
    (void)snprintf(what, sizeof what, "%s: energy change [J]", names[k]);
    example_expect(what, found[k].energy, 1e-8);
    (void)snprintf(what, sizeof what, "%s: slip [m/s]", names[k]);
    example_expect(what, found[k].slip, 1e-12);
  }
  return example_end();
}
