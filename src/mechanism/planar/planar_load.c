/* SPDX-License-Identifier: BSD-3-Clause */
/* A load on one body in the plane. It consists of a force f at the point s, and a torque t. If the
 * load has an input u, the force and the torque are multiplied by u. Below, f and t include this
 * factor. With p = A s, the generalized force g with respect to (x, y, angle) is
 *
 *   ground axes    g = (f_x, f_y, p x f + t)   g_q: only the entry (angle, angle), -p . f
 *                  V = -f . (r + p) when t = 0
 *   follows_body   g = (A f, s x f + t)        g_q: only the entries (x, angle) and (y, angle);
 *                                              they are the vector A f rotated by 90 degrees
 *
 * where a x b = a_1 b_2 - a_2 b_1 for vectors a and b in the plane. A load that has a torque has no
 * potential, because the work of a torque depends on the number of revolutions. A load that has an
 * input has no potential, because a change of the input would change the potential without work.
 */
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/planar/planar.h"

/* Parameters. */
enum { POINT = 0, FORCE = 2, TORQUE = 4, PARAMETER_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_FIELD(baum_planar_load_def, body, BODY),
  BAUM_I_NUMBERS(baum_planar_load_def, point, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_planar_load_def, force, FINITE, "N", 0.0),
  BAUM_I_NUMBERS(baum_planar_load_def, torque, FINITE, "N m", 0.0),
  BAUM_I_FIELD(baum_planar_load_def, follows_body, FLAG),
  BAUM_I_FIELD(baum_planar_load_def, input, INPUT),
  {0},
};

/* In older versions, the struct ended with the field `follows_body`. The field `input` begins in
 * the padding bytes that followed it. */
static const size_t former[] = {
  offsetof(baum_planar_load_def, follows_body) + sizeof(bool),
  0,
};

/* ---- definition ---- */

/* Check a load on a particle. A particle has neither axes nor an angle. */
static baum_status check_on_particle(const baum_planar_load_def *def, const char *label)
{
  if (def->point[0] != 0.0 || def->point[1] != 0.0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: point is (%g, %g) m, must be (0, 0) on a particle",
                       label, def->point[0], def->point[1]);
  }
  if (def->torque != 0.0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: torque is %g N m, must be 0 on a particle", label,
                       def->torque);
  }
  if (def->follows_body) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: follows_body is true, but the body is a particle and does not rotate",
                       label);
  }
  return BAUM_OK;
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_planar_load_def *def = given;
  BAUM_I_TRY(baum_i_planar_check_body(mechanism, def->body, label, "body"));
  int index = baum_i_body_index(mechanism, def->body);
  if (index == 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: body is ground, which does not move", label);
  }
  bool particle = mechanism->bodies[index]->type->frame == BAUM_I_FRAME_PARTICLE;
  return particle ? check_on_particle(def, label) : BAUM_OK;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  (void)mechanism;
  const baum_planar_load_def *def = force->element.def;
  parameters[POINT] = def->point[0];
  parameters[POINT + 1] = def->point[1];
  parameters[FORCE] = def->force[0];
  parameters[FORCE + 1] = def->force[1];
  parameters[TORQUE] = def->torque;
  return BAUM_OK;
}

/* ---- one load ---- */

typedef struct load {
  baum_i_marker at;
  double force[2]; /* in ground axes */
  double torque;
  bool follows_body;
  bool has_potential;
} load;

/* Set f, which is in ground axes and multiplied by the input. Returns the input, or 1 if there is
 * none. */
static inline double set_force(const baum_planar_load_def *def, const baum_i_point *point,
                               const baum_i_frame *frame, const double *numbers, double f[2])
{
  double scale = baum_i_input_factor(point, def->input);
  f[0] = scale * numbers[FORCE];
  f[1] = scale * numbers[FORCE + 1];
  if (def->follows_body) {
    double x = f[0];
    f[0] = frame->c * x - frame->s * f[1];
    f[1] = frame->s * x + frame->c * f[1];
  }
  return scale;
}

static load load_at(const baum_i_force *element, const baum_i_point *point)
{
  const baum_planar_load_def *def = element->element.def;
  const double *numbers = point->parameters + element->element.parameter;
  const baum_i_frame *frame = &point->frames[element->span.bodies[0]];
  load l = {
    .at = baum_i_marker_on(frame, numbers + POINT),
    .follows_body = def->follows_body,
    .has_potential = !def->follows_body && numbers[TORQUE] == 0.0 && !baum_i_has_input(def->input),
  };
  l.torque = numbers[TORQUE] * set_force(def, point, frame, numbers, l.force);
  return l;
}

static void set_force_q(const load *l, double out[9])
{
  if (l->follows_body) {
    out[2] = -l->force[1];
    out[5] = l->force[0];
  } else {
    out[8] = -(l->at.arm[0] * l->force[0] + l->at.arm[1] * l->force[1]);
  }
}

/* ---- type ---- */

/* Add the force only. Terms that only the energy and derivatives need are not computed. */
static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_force *element = group->forces[i];
    const double *numbers = point->parameters + element->element.parameter;
    const baum_i_frame *frame = &point->frames[element->span.bodies[0]];
    double f[2];
    double torque = numbers[TORQUE] * set_force(element->element.def, point, frame, numbers, f);
    baum_i_pair arm = baum_i_arm_on(frame, numbers + POINT);
    const double three[3] = {f[0], f[1], arm[0] * f[1] - arm[1] * f[0] + torque};
    baum_i_columns_scatter_one(point->mechanism, &element->span, three, out);
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_force *element, baum_i_point *point, double *sum)
{
  load l = load_at(element, point);
  *sum -= l.has_potential ? l.force[0] * l.at.r[0] + l.force[1] * l.at.r[1] : 0.0;
  return BAUM_OK;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  load l = load_at(element, point);
  if (!l.has_potential) {
    sum[BAUM_I_POWER_LOADS] +=
      l.force[0] * l.at.dr[0] + l.force[1] * l.at.dr[1] + l.torque * l.at.w;
  }
  return BAUM_OK;
}

/* Set the derivative with respect to q. The force g does not depend on v. */
static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  if (blocks->force_q) {
    load l = load_at(element, point);
    double three[9] = {0.0};
    set_force_q(&l, three);
    baum_i_columns_pack_force(point->mechanism, element, BAUM_I_PLANE, three, blocks->force_q);
  }
  return BAUM_OK;
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(planar_load, "planar load", fields), .former = former,
                 .check = check, .parameter_count = PARAMETER_COUNT},
  .lower = lower,
  .force = force,
  .potential = potential,
  .linearize = linearize,
  .power = power,
};

BAUM_I_DEFINE(force, planar_load, type)
