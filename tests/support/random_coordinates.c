/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_coordinates.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "check.h"

/* Chooses a random joint and one of its coordinates. Returns -1 if the joint has no coordinate, or
 * if it has a driver. */
static int choose_coordinate(random_spatial *r, int *number)
{
  const spatial_oracle *o = &r->oracle;
  int n = chance_below(&r->chance, o->joint_count + 1) - 1;
  int count = n < 0 ? 0 : oracle_coordinate_count(o->joints[n].kind);
  for (int k = 0; k < o->joint_count && count > 0; k++) {
    count = o->joints[k].kind == ORACLE_DRIVER && o->joints[k].of == n ? 0 : count;
  }
  *number = count > 1 ? chance_below(&r->chance, count) : 0;
  return count > 0 ? n : -1;
}

/* Returns the name that the library gives to a coordinate. For the first coordinate of a joint, the
 * result is sometimes BAUM_COORDINATE_FIRST. */
static baum_joint_coordinate name_of(random_spatial *r, oracle_kind kind, int number)
{
  static const baum_joint_coordinate names[ORACLE_PAIR_KINDS][3] = {
    [ORACLE_REVOLUTE] = {BAUM_COORDINATE_ANGLE},
    [ORACLE_UNIVERSAL] = {BAUM_COORDINATE_ANGLE, BAUM_COORDINATE_ANGLE_B},
    [ORACLE_CYLINDRICAL] = {BAUM_COORDINATE_DISPLACEMENT, BAUM_COORDINATE_ANGLE},
    [ORACLE_PRISMATIC] = {BAUM_COORDINATE_DISPLACEMENT},
    [ORACLE_PLANAR] = {BAUM_COORDINATE_X, BAUM_COORDINATE_Y, BAUM_COORDINATE_ANGLE},
    [ORACLE_ON_LINE] = {BAUM_COORDINATE_DISPLACEMENT},
    [ORACLE_SCREW] = {BAUM_COORDINATE_DISPLACEMENT, BAUM_COORDINATE_ANGLE},
  };
  bool silent = number == 0 && chance_below(&r->chance, 2) == 0;
  return silent ? BAUM_COORDINATE_FIRST : names[kind][number];
}

void random_spatial_add_driver(random_spatial *r)
{
  int number;
  int n = choose_coordinate(r, &number);
  if (n < 0) {
    return;
  }
  oracle_joint *joint = &r->oracle.joints[r->oracle.joint_count++];
  *joint = (oracle_joint){.kind = ORACLE_DRIVER, .of = n, .coordinate = number};
  joint->start[0] = r->start;
  joint->start[1] = (double)oracle_design_coordinate(&r->oracle, &r->oracle.joints[n], number);
  baum_driver_def def = baum_driver_def_default();
  def.joint = r->oracle.joints[n].id;
  def.coordinate = name_of(r, r->oracle.joints[n].kind, number);
  def.law = oracle_law;
  def.user = joint->start;
  check(baum_mechanism_add_driver(r->mechanism, &def, &joint->id));
}

void random_spatial_add_joint_spring(random_spatial *r)
{
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  int number;
  int n = choose_coordinate(r, &number);
  if (n < 0) {
    return;
  }
  oracle_force *f = &o->forces[o->force_count++];
  *f = (oracle_force){.kind = ORACLE_JOINT_SPRING, .of = n, .coordinate = number};
  f->stiffness = chance_decade(c, 1.0, 100.0);
  f->damping = chance_below(c, 2) == 0 ? 0.0 : chance_decade(c, 0.01, 10.0);
  double design = (double)oracle_design_coordinate(o, &o->joints[n], number);
  double free_value = design + chance_number(c, -1.0, 1.0);
  f->free_length = free_value;
  baum_joint_spring_def def = baum_joint_spring_def_default();
  def.joint = o->joints[n].id;
  def.coordinate = name_of(r, o->joints[n].kind, number);
  def.stiffness = f->stiffness;
  def.damping = f->damping;
  def.free_value = free_value;
  check(baum_mechanism_add_joint_spring(r->mechanism, &def, NULL));
}

static bool is_angle(oracle_kind kind, int number)
{
  return kind == ORACLE_REVOLUTE || kind == ORACLE_UNIVERSAL ||
         (kind == ORACLE_PLANAR && number == 2) ||
         ((kind == ORACLE_CYLINDRICAL || kind == ORACLE_SCREW) && number == 1);
}

/* Chooses the second joint of a coupling. Prefers a joint that has a body in common with joint n,
 * as gears on a carrier have. */
static int choose_second(random_spatial *r, int n, int *number)
{
  const oracle_joint *joints = r->oracle.joints;
  int found = -1;
  for (int k = 0; k < 6 && n >= 0; k++) {
    found = choose_coordinate(r, number);
    if (found >= 0 && (joints[found].a == joints[n].a || joints[found].b == joints[n].b ||
                       joints[found].a == joints[n].b || joints[found].b == joints[n].a)) {
      break;
    }
  }
  return found;
}

void random_spatial_add_coupling(random_spatial *r)
{
  static const double revolution = 6.283185307179586;
  chance *c = &r->chance;
  spatial_oracle *o = &r->oracle;
  int number;
  int other;
  int n = choose_coordinate(r, &number);
  int k = choose_second(r, n, &other);
  if (n < 0 || k < 0 || (n == k && number == other)) {
    return;
  }
  bool angle = is_angle(o->joints[n].kind, number);
  bool to_angle = is_angle(o->joints[k].kind, other);
  int teeth = 1 + chance_below(c, 5); /* of the second gear */
  oracle_joint *joint = random_spatial_next_joint(r, ORACLE_COUPLING, 0, 0);
  joint->of = n;
  joint->coordinate = number;
  joint->to = k;
  joint->to_coordinate = other;
  joint->ratio = (1.0 + chance_below(c, 5)) / teeth * (chance_below(c, 2) == 0 ? 1.0 : -1.0);
  joint->period = to_angle ? revolution / (angle ? teeth : 1)
                  : angle  ? revolution * fabs(joint->ratio)
                           : 0.0;
  joint->offset = oracle_design_coordinate(o, &o->joints[k], other) -
                  joint->ratio * oracle_design_coordinate(o, &o->joints[n], number);
  baum_coupling_def def = baum_coupling_def_default();
  def.joint_a = o->joints[n].id;
  def.joint_b = o->joints[k].id;
  def.coordinate_a = name_of(r, o->joints[n].kind, number);
  def.coordinate_b = name_of(r, o->joints[k].kind, other);
  def.ratio = joint->ratio;
  check(baum_mechanism_add_coupling(r->mechanism, &def, &joint->id));
}
