/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "one_coordinate.h"
#include "user_models.h"

baum_mechanism *one_coordinate(double x, double v, baum_force_fn *force, void *user,
                               baum_input_id *input)
{
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 1;
  def.q = &x;
  def.v = &v;
  def.mass = user_mass_of_first;
  def.force = force;
  def.user = user;
  baum_mechanism *mechanism = create_mechanism();
  if (input) {
    check(baum_mechanism_add_input(mechanism, "u", 0.0, input));
  }
  check(baum_mechanism_add_coordinates(mechanism, &def, NULL));
  check(baum_mechanism_set_characteristic_length(mechanism, 1.0));
  check(baum_mechanism_freeze(mechanism));
  return mechanism;
}
