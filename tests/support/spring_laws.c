/* SPDX-License-Identifier: BSD-3-Clause */
#include "spring_laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

spring_law spring_law_good = {0, 0, 0};

void spring_law_cubic_at(double length, double rate, double out[3])
{
  out[0] = 2.0 + 3.0 * length * length * length + 0.4 * rate + 0.1 * length * rate * rate;
  out[1] = 9.0 * length * length + 0.1 * rate * rate;
  out[2] = 0.4 + 0.2 * length * rate;
}

int spring_law_cubic(double length, double rate, double out[3], void *user)
{
  const spring_law *law = user;
  if (out[0] != 0.0 || out[1] != 0.0 || out[2] != 0.0) {
    return -77;
  }
  spring_law_cubic_at(length, rate, out);
  if (law->wrong > 0) {
    out[law->wrong] += 1.0;
  }
  if (law->spoil > 0) {
    out[law->spoil - 1] = (double)NAN;
  }
  return law->answer;
}

void check_spring_law_fails(test_point *p, baum_status status, bool retry, const char *message)
{
  double force[TEST_SIZE_MAX];
  double squares[2 * TEST_SIZE_MAX * TEST_SIZE_MAX];
  const baum_i_force_blocks blocks = {squares, squares + (ptrdiff_t)TEST_SIZE_MAX * TEST_SIZE_MAX};
  for (int i = 0; i < 2; i++) {
    test_point_update(p);
    assert_int_equal(i == 0 ? baum_i_mechanism_force(&p->point, force)
                            : baum_i_mechanism_linearize_forces(&p->point, &blocks),
                     status);
    assert_string_equal(baum_message(), message);
    assert_int_equal(p->point.retry, retry);
  }
}

void check_spring_law_verdict(baum_mechanism *mechanism, const char *name, int entry)
{
  baum_status status = baum_mechanism_check_derivatives(mechanism);
  assert_int_equal(status, entry > 0 ? BAUM_ERR_ARGUMENT : BAUM_OK);
  if (entry > 0) {
    char begin[128];
    (void)snprintf(begin, sizeof begin, "force 1 \"%s\": law()[%d] is ", name, entry);
    assert_memory_equal(baum_message(), begin, strlen(begin));
    assert_non_null(strstr(baum_message(), " but finite differences of law()[0] give "));
  }
  baum_mechanism_destroy(mechanism);
}
