/* SPDX-License-Identifier: BSD-3-Clause */
/* A bar is pinned to ground. Two pins join a second bar rigidly to the first. One of the four rows
 * of these two pins is redundant. The row that is best omitted changes twice per revolution.
 * Include after cmocka.h. */
#ifndef BAUM_TEST_LOCKED_PAIR_H
#define BAUM_TEST_LOCKED_PAIR_H

#include "catalog/parts.h"
#include "check.h"

enum { LOCKED_NV = 6 };

static inline baum_body_id locked_pair_bar(baum_i_parts *parts, double x, double y, double rate)
{
  const baum_i_body_state at = {{x, y, 0.0}, {-rate * y, rate * x, rate}};
  return baum_i_parts_body_at(parts, NULL, 1.0, 0.1, at, BAUM_I_GIVE_ALL);
}

/* The bars make full revolutions if their initial angular velocity `rate` is above 6 rad/s. If
 * `welded` is set, a weld replaces the two pins. */
static inline baum_mechanism *locked_pair_make(double rate, bool welded)
{
  baum_mechanism *m = NULL;
  baum_i_parts parts = baum_i_parts_begin();
  baum_body_id first = locked_pair_bar(&parts, 0.5, 0.0, rate);
  baum_body_id second = locked_pair_bar(&parts, 1.2, 0.3, rate);
  (void)baum_i_parts_pin(&parts, "foot", (baum_i_spot){BAUM_GROUND, {0.0, 0.0}},
                         (baum_i_spot){first, {-0.5, 0.0}});
  if (welded) {
    baum_planar_fixed_def def = baum_planar_fixed_def_default();
    def.body_a = first;
    def.body_b = second;
    def.point[0] = 0.9;
    def.point[1] = 0.0;
    check(baum_mechanism_add_planar_fixed(parts.mechanism, &def, NULL));
  } else {
    (void)baum_i_parts_pin(&parts, "one", (baum_i_spot){first, {0.4, 0.0}},
                           (baum_i_spot){second, {-0.3, -0.3}});
    (void)baum_i_parts_pin(&parts, "two", (baum_i_spot){first, {0.6, 0.25}},
                           (baum_i_spot){second, {-0.1, -0.05}});
  }
  check(baum_i_parts_finish(&parts, &m));
  return m;
}

#endif
