/* SPDX-License-Identifier: BSD-3-Clause */
#include "drawn_crank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"

const char DRAWN_HOSTILE[] = "</script></title><b>\"'&\\ \xd7\x90\xd7\x91";

baum_body_id drawn_body(baum_mechanism *m, const char *name, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = name;
  def.inertia = 0.02;
  def.position[0] = x;
  def.position[1] = y;
  check(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

static void add_slider(baum_mechanism *m, baum_body_id body)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = "guide";
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  def.point_a[0] = 0.0;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  check(baum_mechanism_add_planar_translational(m, &def, NULL));
}

baum_mechanism *drawn_crank(void)
{
  baum_mechanism *m = create_mechanism();
  baum_body_id crank = drawn_body(m, "crank", 0.5, 0.0);
  baum_body_id rod = drawn_body(m, "rod", 2.0, 0.2);
  baum_body_id block = drawn_body(m, "block", 3.0, 0.0);
  baum_body_id wheel = drawn_body(m, DRAWN_HOSTILE, 2.0, 1.0);
  add_planar_pin(m, "O", BAUM_GROUND, crank, 0.0, 0.0);
  add_planar_pin(m, "A", crank, rod, 1.0, 0.0);
  add_planar_pin(m, "B", rod, block, 3.0, 0.0);
  add_planar_pin(m, "C", rod, wheel, 2.0, 1.0);
  add_slider(m, block);
  return m;
}
