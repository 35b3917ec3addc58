/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_coordinates.h"

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
  static const baum_joint_coordinate names[ORACLE_JOINT_KINDS][3] = {
    [ORACLE_REVOLUTE] = {BAUM_COORDINATE_ANGLE},
    [ORACLE_UNIVERSAL] = {BAUM_COORDINATE_ANGLE, BAUM_COORDINATE_ANGLE_B},
    [ORACLE_CYLINDRICAL] = {BAUM_COORDINATE_DISPLACEMENT, BAUM_COORDINATE_ANGLE},
    [ORACLE_PRISMATIC] = {BAUM_COORDINATE_DISPLACEMENT},
    [ORACLE_PLANAR] = {BAUM_COORDINATE_X, BAUM_COORDINATE_Y, BAUM_COORDINATE_ANGLE},
    [ORACLE_ON_LINE] = {BAUM_COORDINATE_DISPLACEMENT},
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
