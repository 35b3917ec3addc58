/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "asked.h"
#include "check.h"
#include "construct.h"

const asked_name asked_names[ASKED_KINDS] = {
  [ASKED_MASS] = {"\"masses\"", "mass()"},
  [ASKED_FORCE] = {"\"masses\"", "force()"},
  [ASKED_POTENTIAL] = {"\"masses\"", "potential()"},
  [ASKED_PHI] = {"\"hoop\"", "phi()"},
  [ASKED_JACOBIAN] = {"\"hoop\"", "jacobian()"},
  [ASKED_NU] = {"\"hoop\"", "nu()"},
  [ASKED_GAMMA] = {"\"hoop\"", "gamma()"},
  [ASKED_GUST] = {"\"gust\"", "force()"},
  [ASKED_WEIGHT] = {"\"gust\"", "potential()"},
  [ASKED_TWIST] = {"\"twist\"", "law()"},
  [ASKED_COIL] = {"\"coil\"", "law()"},
  [ASKED_LEAD] = {"\"lead\"", "law()"},
  [ASKED_MOTOR] = {"\"motor\"", "law()"},
  [ASKED_TRACK] = {"\"track\"", "curve()"},
  [ASKED_EVENT] = {"\"gate\"", "function()"},
};

static int visit(void *user, asked_kind k, double *out)
{
  asked *b = user;
  if (b->kind != k || b->fault == ASKED_FINE) {
    return 0;
  }
  b->calls++;
  if (b->fault == ASKED_CALLS_BACK && !b->inside) {
    b->inside = true;
    b->back(b);
    b->inside = false;
  }
  if (b->fault == ASKED_GIVES_NAN && out) {
    out[0] = (double)NAN;
  }
  return b->fault == ASKED_STOPS ? -7 : 0;
}

/* ---- functions ---- */

static int mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  out[0] = 1.0;
  return visit(user, ASKED_MASS, out);
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)t;
  (void)v;
  out[0] = -q[0] * inputs[0];
  return visit(user, ASKED_FORCE, out);
}

static int potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 0.5 * q[0] * q[0];
  return visit(user, ASKED_POTENTIAL, out);
}

static int phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = 0.5 * (q[0] * q[0] + q[1] * q[1] - 1.0);
  return visit(user, ASKED_PHI, out);
}

static int jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = q[0];
  out[1] = q[1];
  return visit(user, ASKED_JACOBIAN, out);
}

static int nu(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  return visit(user, ASKED_NU, out);
}

static int gamma_of(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  out[0] = -(v[0] * v[0] + v[1] * v[1]);
  return visit(user, ASKED_GAMMA, out);
}

static int gust(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  out[2] = 0.1;
  return visit(user, ASKED_GUST, out);
}

static int weight(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = -0.1 * q[2];
  return visit(user, ASKED_WEIGHT, out);
}

/* Sets the tension or torque of a spring, and its derivatives. */
static int spring(double length, double rate, double out[3])
{
  out[0] = 3.0 * length + 0.1 * rate;
  out[1] = 3.0;
  out[2] = 0.1;
  return 0;
}

static int twist(double length, double rate, double out[3], void *user)
{
  return spring(length, rate, out) + visit(user, ASKED_TWIST, out);
}

static int coil(double length, double rate, double out[3], void *user)
{
  return spring(length, rate, out) + visit(user, ASKED_COIL, out);
}

static int lead(double x, double f[3], void *user)
{
  f[0] = 2.0 * x;
  f[1] = 2.0;
  return visit(user, ASKED_LEAD, f);
}

static int motor(double t, double s[3], void *user)
{
  s[0] = 0.5 * t;
  s[1] = 0.5;
  return visit(user, ASKED_MOTOR, s);
}

/* The curve y = x^2 / 10. */
static int track(const double xy[2], double out[6], void *user)
{
  out[0] = xy[1] - 0.1 * xy[0] * xy[0];
  out[1] = -0.2 * xy[0];
  out[2] = 1.0;
  out[3] = -0.2;
  return visit(user, ASKED_TRACK, out);
}

/* An event function that never becomes zero. */
int asked_gate(double t, const double *q, const double *v, const double *inputs, double *out,
               void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = 1.0;
  return visit(user, ASKED_EVENT, out);
}

int asked_progress(const baum_simulation *run, double t, void *user)
{
  (void)run;
  (void)t;
  return visit(user, ASKED_PROGRESS, NULL);
}

/* ---- a mechanism with all user functions ---- */

static void add_masses(asked *b)
{
  baum_coordinates_def def = baum_coordinates_def_default();
  const double design_q = 0.3;
  def.name = "masses";
  def.size = 1;
  def.q = &design_q;
  def.mass = mass;
  def.force = force;
  def.potential = potential;
  def.user = b;
  check(baum_mechanism_add_input(b->mechanism, "stiffness", 1.0, &b->input));
  check(baum_mechanism_add_coordinates(b->mechanism, &def, NULL));
}

static baum_body_id add_particle(asked *b, double x)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  baum_body_id id;
  def.position[0] = x;
  check(baum_mechanism_add_planar_particle(b->mechanism, &def, &id));
  return id;
}

static void add_hoop(asked *b)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  const baum_body_id bead = add_particle(b, 1.0);
  def.name = "hoop";
  def.bodies = &bead;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = phi;
  def.jacobian = jacobian;
  def.nu = nu;
  def.gamma = gamma_of;
  def.user = b;
  check(baum_mechanism_add_user_constraint(b->mechanism, &def, NULL));
}

static baum_joint_id add_pinned(asked *b, double x, baum_body_id *id)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.position[0] = x;
  check(baum_mechanism_add_planar_body(b->mechanism, &def, id));
  return add_planar_pin(b->mechanism, NULL, BAUM_GROUND, *id, x, 0.5);
}

static void add_arms(asked *b)
{
  baum_body_id arm;
  baum_body_id other;
  baum_coupling_def coupling = baum_coupling_def_default();
  coupling.name = "lead";
  coupling.joint_a = add_pinned(b, 3.0, &arm);
  coupling.joint_b = add_pinned(b, 5.0, &other);
  coupling.law = lead;
  coupling.user = b;
  check(baum_mechanism_add_coupling(b->mechanism, &coupling, NULL));
  baum_planar_torsion_spring_def torsion = baum_planar_torsion_spring_def_default();
  torsion.name = "twist";
  torsion.body_a = BAUM_GROUND;
  torsion.body_b = arm;
  torsion.law = twist;
  torsion.user = b;
  check(baum_mechanism_add_planar_torsion_spring(b->mechanism, &torsion, NULL));
  baum_user_force_def wind = baum_user_force_def_default();
  wind.name = "gust";
  wind.bodies = &arm;
  wind.body_count = 1;
  wind.force = gust;
  wind.potential = weight;
  wind.user = b;
  check(baum_mechanism_add_user_force(b->mechanism, &wind, NULL));
}

static void add_motor(asked *b)
{
  baum_body_id crank;
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = add_pinned(b, 7.0, &crank);
  def.law = motor;
  def.user = b;
  check(baum_mechanism_add_driver(b->mechanism, &def, &b->motor));
}

static void add_track(asked *b)
{
  const baum_body_id pea = add_particle(b, 0.0);
  baum_planar_curve_def def = baum_planar_curve_def_default();
  def.name = "track";
  def.body_a = BAUM_GROUND;
  def.body_b = pea;
  def.point[0] = def.point[1] = 0.0;
  def.curve = track;
  def.user = b;
  check(baum_mechanism_add_planar_curve(b->mechanism, &def, NULL));
  baum_planar_spring_def s = baum_planar_spring_def_default();
  s.name = "coil";
  s.body_a = BAUM_GROUND;
  s.body_b = pea;
  s.point_a[0] = 1.0;
  s.point_a[1] = 2.0;
  s.point_b[0] = s.point_b[1] = 0.0;
  s.law = coil;
  s.user = b;
  check(baum_mechanism_add_planar_spring(b->mechanism, &s, NULL));
}

void asked_make(asked *b)
{
  *b = (asked){.fault = ASKED_FINE};
  b->mechanism = create_mechanism();
  add_masses(b);
  add_hoop(b);
  add_arms(b);
  add_motor(b);
  add_track(b);
  check(baum_mechanism_freeze(b->mechanism));
}
