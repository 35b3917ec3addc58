/* SPDX-License-Identifier: BSD-3-Clause */
#include "construct.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <baum/planar.h>

#include "check.h"

baum_mechanism *create_mechanism(void)
{
  baum_mechanism *m = NULL;
  check(baum_mechanism_create(&m));
  return m;
}

baum_joint_id add_planar_pin(baum_mechanism *m, const char *name, baum_body_id a, baum_body_id b,
                             double x, double y)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  baum_joint_id id;
  def.name = name;
  def.body_a = a;
  def.body_b = b;
  def.point[0] = x;
  def.point[1] = y;
  check(baum_mechanism_add_planar_revolute(m, &def, &id));
  return id;
}

baum_joint_id add_planar_weld(baum_mechanism *m, baum_body_id a, baum_body_id b, double x, double y)
{
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  baum_joint_id id;
  def.body_a = a;
  def.body_b = b;
  def.point[0] = x;
  def.point[1] = y;
  check(baum_mechanism_add_planar_fixed(m, &def, &id));
  return id;
}
