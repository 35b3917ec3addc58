/* SPDX-License-Identifier: BSD-3-Clause */
/* A slider-crank in space. The crank rotates about the z axis. The slider moves on a line parallel
 * to x, which lies beside and above the crank. With the following chain of joints, the mechanism
 * has one degree of freedom:
 *
 *   ground - revolute - crank - spherical - rod - universal - slider - prismatic - ground
 *
 * The crank is released at 20 rad/s. The program checks the run in two ways. If p is the angle of
 * the crank, the slider must be at x = R cos p + sqrt(L^2 - (BESIDE - R sin p)^2 - ABOVE^2). The
 * energy must stay constant. */
#include <string.h>

#include <baum/baum.h>

#include "example_util.h"

static const double CRANK = 0.1;   /* [m] R */
static const double ROD = 0.35;    /* [m] L */
static const double BESIDE = 0.05; /* [m] y of the slider */
static const double ABOVE = 0.08;  /* [m] z of the slider */
static const double SPEED = 20.0;  /* [rad/s] of the crank at the start */
static const double SPAN = 1.0;    /* [s] */

typedef struct slider_crank {
  baum_mechanism *mechanism;
  baum_body_id crank, rod, slider;
  baum_joint_id shaft, ball, cross, guide;
} slider_crank;

static double slider_at(double angle)
{
  double y = BESIDE - CRANK * sin(angle);
  return CRANK * cos(angle) + sqrt(ROD * ROD - y * y - ABOVE * ABOVE);
}

/* ---- bodies ---- */

/* Adds a slender bar whose x axis points from one given point to another. The quaternion rotates
 * the ground's x axis to the direction d of the bar by the smallest angle: it is (1 + d_x, 0, -d_z,
 * d_y), normalized. */
static baum_body_id add_bar(slider_crank *s, const char *name, double mass, const double from[3],
                            const double to[3], double spin)
{
  baum_spatial_body_def bar = baum_spatial_body_def_default();
  double d[3];
  double square = 0.0;
  for (int i = 0; i < 3; i++) {
    bar.position[i] = 0.5 * (from[i] + to[i]);
    d[i] = to[i] - from[i];
    square += d[i] * d[i];
  }
  double length = sqrt(square);
  double scale = 1.0 / sqrt(2.0 * (1.0 + d[0] / length));
  bar.orientation[0] = scale * (1.0 + d[0] / length);
  bar.orientation[2] = -scale * d[2] / length;
  bar.orientation[3] = scale * d[1] / length;
  bar.name = name;
  bar.mass = mass;
  bar.inertia[0] = 1e-4 * mass;
  bar.inertia[1] = bar.inertia[2] = mass * square / 12.0;
  bar.angular_velocity[2] = spin;
  baum_body_id id;
  CHECK(baum_mechanism_add_spatial_body(s->mechanism, &bar, &id));
  return id;
}

static baum_body_id add_slider(slider_crank *s, const double at[3])
{
  baum_spatial_body_def slider = baum_spatial_body_def_default();
  slider.name = "slider";
  slider.mass = 0.4;
  slider.inertia[0] = slider.inertia[1] = slider.inertia[2] = 1e-4;
  memcpy(slider.position, at, sizeof slider.position);
  baum_body_id id;
  CHECK(baum_mechanism_add_spatial_body(s->mechanism, &slider, &id));
  return id;
}

/* ---- joints, each given by its point and axis in ground axes ---- */

static void add_joints(slider_crank *s, const double a[3], const double b[3])
{
  baum_spatial_revolute_def shaft = baum_spatial_revolute_def_default(); /* about z */
  shaft.body_a = BAUM_GROUND;
  shaft.body_b = s->crank;
  memset(shaft.point, 0, sizeof shaft.point);
  CHECK(baum_mechanism_add_spatial_revolute(s->mechanism, &shaft, &s->shaft));

  baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
  ball.body_a = s->crank;
  ball.body_b = s->rod;
  memcpy(ball.point, a, sizeof ball.point);
  CHECK(baum_mechanism_add_spatial_spherical(s->mechanism, &ball, &s->ball));

  /* The default axis is the z axis of the slider. */
  baum_spatial_universal_def cross = baum_spatial_universal_def_default();
  cross.body_a = s->slider;
  cross.body_b = s->rod;
  memcpy(cross.point, b, sizeof cross.point);
  cross.axis_b[0] = a[1] - b[1]; /* horizontal and perpendicular to the rod */
  cross.axis_b[1] = b[0] - a[0];
  cross.axis_b[2] = 0.0;
  CHECK(baum_mechanism_add_spatial_universal(s->mechanism, &cross, &s->cross));

  baum_spatial_prismatic_def guide = baum_spatial_prismatic_def_default();
  guide.body_a = BAUM_GROUND;
  guide.body_b = s->slider;
  memcpy(guide.point, b, sizeof guide.point);
  guide.axis[0] = 1.0;
  guide.axis[2] = 0.0;
  CHECK(baum_mechanism_add_spatial_prismatic(s->mechanism, &guide, &s->guide));
}

static slider_crank build(void)
{
  const double o[3] = {0.0, 0.0, 0.0};
  const double a[3] = {CRANK, 0.0, 0.0};
  const double b[3] = {slider_at(0.0), BESIDE, ABOVE};
  slider_crank s;
  CHECK(baum_mechanism_create(&s.mechanism));
  CHECK(baum_mechanism_set_gravity(s.mechanism, 0.0, 0.0, -9.81));
  s.crank = add_bar(&s, "crank", 0.2, o, a, SPEED);
  s.rod = add_bar(&s, "rod", 0.3, a, b, NAN);
  s.slider = add_slider(&s, b);
  add_joints(&s, a, b);
  CHECK(baum_mechanism_freeze(s.mechanism));
  return s;
}

/* ---- the run ---- */

int main(int argc, char **argv)
{
  static const example_column columns[] = {{"t", "t [s]", 'f', 2},
                                           {"angle", "crank [rad]", 'f', 6},
                                           {"rate", "[rad/s]", 'f', 4},
                                           {"x", "slider [m]", 'f', 6},
                                           {"force", "guide on slider [N]", 'f', 3}};
  example_begin(argc, argv, "spatial_slider_crank");
  slider_crank s = build();
  baum_mobility mobility;
  CHECK(baum_mechanism_mobility(s.mechanism, &mobility, sizeof mobility));
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-10;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(s.mechanism, &options, &run));

  enum { ANGLE = 0, POSE = 2, REACTION = 9, ENERGY = 15, WIDTH = 17 };
  const baum_channel channels[] = {baum_channel_of_joint(BAUM_JOINT_COORDINATE, s.shaft),
                                   baum_channel_of_body(BAUM_BODY_POSE, s.slider),
                                   baum_channel_of_joint(BAUM_JOINT_REACTION, s.guide),
                                   baum_channel_of(BAUM_ENERGY)};
  example_table("motion", columns, 5, true);
  double start = NAN;
  double place_error = 0.0;
  double energy_error = 0.0;
  for (int k = 0; k <= 20; k++) {
    double row[WIDTH];
    CHECK(baum_simulation_advance_to(run, SPAN * k / 20.0));
    CHECK(baum_simulation_get(run, channels, 4, row));
    double energy = row[ENERGY] + row[ENERGY + 1];
    start = k == 0 ? energy : start;
    place_error = fmax(place_error, fabs(row[POSE] - slider_at(row[ANGLE])));
    energy_error = fmax(energy_error, fabs(energy - start));
    example_number(baum_simulation_time(run));
    example_number(row[ANGLE]);
    example_number(row[ANGLE + 1]);
    example_number(row[POSE]);
    example_number(hypot(row[REACTION + 1], row[REACTION + 2]));
  }
  example_counters(run);
  example_expect("degrees of freedom minus 1", fabs(mobility.degrees_of_freedom - 1.0), 0.0);
  example_expect("slider against the closed form [m]", place_error, 1e-12);
  example_expect("energy change [J]", energy_error, 1e-8);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
  return example_end();
}
