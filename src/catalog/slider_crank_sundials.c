/* SPDX-License-Identifier: BSD-3-Clause */
/* The slider-crank of the SUNDIALS examples idaSlCrank_dns and idasSlCrank_dns (R. Serban),
 * interpreted as rigid bodies. A crank rotates about the origin and has a pin at its end. The
 * centre of the rod moves along the x axis. In the axes of the rod, the pin is at (-1, 0), and a
 * force (1, 0) acts at the point (1, 0). A spring and a damper connect the middle of the crank to
 * the point halfway between the pin and the centre of the rod. There is no gravity.
 */
#include "catalog/catalog.h"

#include <math.h>

#include "catalog/data/slider_crank_sundials.h"

enum { CRANK, CRANK_INERTIA, ROD_MASS, ROD_INERTIA, STIFFNESS, DAMPING, FREE_LENGTH, FORCE, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [CRANK] = {"crank", "m", "length of the crank; the rod is 1 m from its pin to its centre",
             BAUM_I_POSITIVE},
  [CRANK_INERTIA] = {"crank_inertia", "kg m^2", "of the crank about the origin", BAUM_I_POSITIVE},
  [ROD_MASS] = {"rod_mass", "kg", "of the rod", BAUM_I_POSITIVE},
  [ROD_INERTIA] = {"rod_inertia", "kg m^2", "of the rod about its centre of mass", BAUM_I_POSITIVE},
  [STIFFNESS] = {"stiffness", "N/m", "of the spring", BAUM_I_POSITIVE},
  [DAMPING] = {"damping", "N s/m", "of the damper", BAUM_I_ANY},
  [FREE_LENGTH] = {"free_length", "m", "of the spring", BAUM_I_POSITIVE},
  [FORCE] = {"force", "N", "on the end of the rod, to the right", BAUM_I_ANY},
};

/* Computes the state of a body from the angle of the crank. The centre of the rod is 1 m from pin
 * B, on the line y = 0.
 */
static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_mover at = {{0.0, 0.0}, {0.0, 0.0}};
  if (body == 0) {
    return baum_i_mover_state(&at, q[0], v[0]);
  }
  baum_i_mover_go(&at, q[0], v[0], p[CRANK], 0.0);
  double angle = -asin(at.r[1]);
  double rate = -at.v[1] / cos(angle);
  baum_i_mover_go(&at, angle, rate, 1.0, 0.0);
  return baum_i_mover_state(&at, angle, rate);
}

static int guide(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[1];
  return 0;
}

static int guide_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[1] = 1.0;
  return 0;
}

static void add_guide(baum_i_parts *parts, baum_body_id rod)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "guide";
  def.row_count = 1;
  def.phi = guide;
  def.jacobian = guide_jacobian;
  baum_i_parts_constraint(parts, rod, def);
}

static void add_forces(baum_i_parts *parts, const double *p, baum_body_id crank, baum_body_id rod)
{
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  spring.name = "spring";
  spring.body_a = crank;
  spring.body_b = rod;
  spring.point_a[0] = p[CRANK] / 2;
  spring.point_b[0] = -0.5;
  spring.point_a[1] = spring.point_b[1] = 0.0;
  spring.stiffness = p[STIFFNESS];
  spring.damping = p[DAMPING];
  spring.free_length = p[FREE_LENGTH];
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_spring(parts->mechanism, &spring, NULL));
  baum_planar_load_def load = baum_planar_load_def_default();
  load.name = "push";
  load.body = rod;
  load.point[0] = 1.0;
  load.force[0] = p[FORCE];
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_load(parts->mechanism, &load, NULL));
}

static void build(baum_i_parts *parts, const double *p)
{
  baum_i_parts_gravity(parts, 0.0);
  double slope = -asin(p[CRANK]);
  const baum_i_body_state at[2] = {{.q = {0.0, 0.0, acos(0.0)}}, {.q = {cos(slope), 0.0, slope}}};
  baum_body_id crank =
    baum_i_parts_body_at(parts, "crank", 1.0, p[CRANK_INERTIA], at[0], BAUM_I_GIVE_NONE);
  baum_body_id rod =
    baum_i_parts_body_at(parts, "rod", p[ROD_MASS], p[ROD_INERTIA], at[1], BAUM_I_GIVE_NONE);
  baum_i_parts_hinge(parts, "A", BAUM_GROUND, 0.0, crank, 0.0);
  baum_i_parts_hinge(parts, "B", crank, p[CRANK], rod, -1.0);
  add_guide(parts, rod);
  add_forces(parts, p, crank, rod);
}

const baum_i_catalog_mechanism baum_i_slider_crank_sundials = {
  .name = "slider_crank_sundials",
  .title = "slider-crank of two bodies with a spring, a damper and a force, from rest",
  .source = "LLNL/sundials, examples/ida/serial/idaSlCrank_dns.c (R. Serban)",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 24 digits; "
    "a second, independent model in double precision agrees to 14.9 digits; the 41 published rows "
    "have 5 digits; they contain the error of a run at rtol 1e-6",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmr", 2),
  .defaults = (const double[COUNT]){0.5, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0, 1.0},
  .end = 10.0,
  BAUM_I_CATALOG_SERIES(SUNDIALS_SLIDER_CRANK, 15, 15),
};
