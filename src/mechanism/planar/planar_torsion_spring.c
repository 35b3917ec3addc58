/* SPDX-License-Identifier: BSD-3-Clause */
/* Torsion spring and damper in parallel between two bodies in the plane. The relative angle
 * phi = angle_b - angle_a is continuous, so it may exceed a full revolution. The spring has the
 * stiffness k, the damping c and the free angle phi_0. With the six columns x_a y_a angle_a x_b y_b
 * angle_b:
 *
 *   T   = k (phi - phi_0) + c phi'                 restoring torque
 *   h   = phi_q = (0 0 -1 0 0 1)                   (6 columns)
 *   g   = -T h                                     (6 entries)
 *   V   = k (phi - phi_0)^2 / 2
 *   g_q = -k h h^T,   g_v = -c h h^T               (6 x 6)
 *
 * A spring with a user's law T(phi, phi') has no V, and in g_q and g_v the derivatives T_phi and
 * T_phi' replace k and c.
 */
#include "mechanism/definition.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/planar/planar.h"

BAUM_I_CHECK_SPRING_DEF(baum_planar_torsion_spring_def);

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_BODIES(baum_planar_torsion_spring_def),
  BAUM_I_SPRING_FIELDS(baum_planar_torsion_spring_def, "N m/rad", "N m s/rad", free_angle, OPTIONAL,
                       "rad"),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  BAUM_I_TRY(baum_i_planar_check_bodies(mechanism, def, label));
  return baum_i_planar_check_angles(mechanism, def, label);
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  double a = baum_i_design_frame(mechanism, force->span.bodies[0]).angle;
  double b = baum_i_design_frame(mechanism, force->span.bodies[1]).angle;
  baum_i_spring_lower(force, b - a, parameters);
  return BAUM_OK;
}

/* ---- one spring ---- */

/* Return the angle phi and its rate. */
static baum_i_stretch stretch(const baum_i_force *force, const baum_i_point *point)
{
  const baum_i_frame *a = &point->frames[force->span.bodies[0]];
  const baum_i_frame *b = &point->frames[force->span.bodies[1]];
  return (baum_i_stretch){b->angle - a->angle, b->w - a->w, 1.0, false};
}

static baum_status torque_at(const baum_i_force *force, baum_i_point *point, baum_i_tension *out)
{
  const baum_i_stretch now = stretch(force, point);
  baum_i_spring_law law = baum_i_spring_law_of(force, point);
  return baum_i_tension_at(&law, point, now.length, now.rate, out);
}

/* Write -factor h h^T to the block of the force. */
static void put_square(const baum_i_force *force, const baum_mechanism *mechanism, double factor,
                       double *squares)
{
  const double six[36] = {
    [6 * 2 + 2] = -factor, [6 * 2 + 5] = factor, [6 * 5 + 2] = factor, [6 * 5 + 5] = -factor};
  baum_i_columns_pack_force(mechanism, force, BAUM_I_PLANE, six, squares);
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_force *element = group->forces[i];
    baum_i_tension t;
    BAUM_I_TRY(torque_at(element, point, &t));
    const double six[6] = {0.0, 0.0, t.value, 0.0, 0.0, -t.value};
    baum_i_columns_scatter(point->mechanism, &element->span, six, out);
  }
  return BAUM_OK;
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  baum_i_tension t;
  BAUM_I_TRY(torque_at(element, point, &t));
  put_square(element, point->mechanism, t.by_length, blocks->force_q);
  put_square(element, point->mechanism, t.by_rate, blocks->force_v);
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(planar_torsion_spring, "planar torsion spring", fields),
                 .check = check, .parameter_count = BAUM_I_SPRING_NUMBERS,
                 .check_derivatives = baum_i_spring_check},
  .lower = lower,
  .force = force,
  .linearize = linearize,
  BAUM_I_SPRING_MEMBERS(baum_planar_torsion_spring_def),
  .stretch = stretch,
};

BAUM_I_DEFINE(force, planar_torsion_spring, type)
