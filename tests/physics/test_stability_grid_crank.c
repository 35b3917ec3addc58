/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the predicted stability with the stability of runs, for the free slider-crank. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "stability_grid.h"

#define DEFINE(integrator) DEFINE_GRID(integrator, FREE_CRANK)
EVERY_INTEGRATOR(DEFINE)

int main(void)
{
  const struct CMUnitTest tests[] = {EVERY_INTEGRATOR(LIST_GRID)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
