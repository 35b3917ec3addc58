/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "linear/peel.h"

enum { MOST_JOINTS = 8, BODIES = 6, PIN_SIZE = 12 };

/* A graph of bodies that have three velocities. Pins (two rows) and motors (one row) connect
 * them. */
typedef struct graph {
  baum_i_row_block blocks[MOST_JOINTS];
  int columns[MOST_JOINTS][6];
  double jacobian[MOST_JOINTS * PIN_SIZE];
  double column_scale[3 * BODIES];
  baum_i_kkt_structure structure;
} graph;

static void begin_graph(graph *d)
{
  memset(d, 0, sizeof *d);
  d->structure = (baum_i_kkt_structure){.nv = 3 * BODIES, .row_blocks = d->blocks};
  for (int j = 0; j < 3 * BODIES; j++) {
    d->column_scale[j] = 1.0;
  }
}

static double *add_rows(graph *d, int rows, const int bodies[2])
{
  int b = d->structure.row_block_count++;
  baum_i_row_block *block = &d->blocks[b];
  *block = (baum_i_row_block){
    .row = d->structure.nc, .rows = rows, .col = d->columns[b], .value = b * PIN_SIZE};
  for (int side = 0; side < 2; side++) {
    for (int j = 0; j < 3 && bodies[side] >= 0; j++) {
      d->columns[b][block->cols++] = 3 * bodies[side] + j;
    }
  }
  d->structure.nc += rows;
  return d->jacobian + block->value;
}

/* Adds a pin. Its arm is (x, y) on each of the two bodies. The body -1 is ground. */
static void pin(graph *d, int body_a, int body_b, double x, double y)
{
  double *value = add_rows(d, 2, (const int[2]){body_a, body_b});
  for (int row = 0; row < 2; row++) {
    for (int side = 0; side < 2; side++) {
      if ((side == 0 ? body_a : body_b) >= 0) {
        double sign = side == 0 ? 1.0 : -1.0;
        *value++ = row == 0 ? sign : 0.0;
        *value++ = row == 1 ? sign : 0.0;
        *value++ = row == 0 ? -y : x;
      }
    }
  }
}

static void motor(graph *d, int body_a, int body_b)
{
  double *value = add_rows(d, 1, (const int[2]){body_a, body_b});
  value[2] = 1.0;
  value[5] = body_a >= 0 && body_b >= 0 ? -1.0 : 0.0;
}

/* Removes the rows whose independence follows from the structure of the graph (see linear/peel.h).
 * Returns how many rows remain. */
static int peel(const graph *d, unsigned char peeled[2 * MOST_JOINTS])
{
  int left = d->structure.nc;
  memset(peeled, 0, 2 * MOST_JOINTS);
  assert_int_equal(baum_i_peel(&d->structure, d->jacobian, d->column_scale, peeled), BAUM_OK);
  for (int i = 0; i < d->structure.nc; i++) {
    left -= peeled[i];
  }
  return left;
}

static void an_open_chain_with_motors_is_peeled_off_completely(void **state)
{
  (void)state;
  graph d;
  unsigned char peeled[2 * MOST_JOINTS];
  begin_graph(&d);
  pin(&d, -1, 0, 0.5, 0.2);
  motor(&d, -1, 0);
  pin(&d, 0, 1, 0.3, -0.4);
  pin(&d, 1, 2, 0.1, 0.7);
  motor(&d, 1, 2);
  pin(&d, 0, 3, 0.2, 0.2); /* a side branch */
  assert_int_equal(peel(&d, peeled), 0);
}

static void loops_are_kept_and_open_chains_on_them_are_peeled_off(void **state)
{
  (void)state;
  graph d;
  unsigned char peeled[2 * MOST_JOINTS];
  begin_graph(&d);
  pin(&d, 2, 3, 0.6, 0.1); /* rows 0 and 1: this pin connects body 3 with the loop */
  pin(&d, -1, 0, 0.5, 0.2);
  pin(&d, 0, 1, 0.3, -0.4);
  pin(&d, 1, 2, 0.1, 0.7);
  pin(&d, 2, -1, 0.4, 0.3);
  pin(&d, 3, 4, 0.6, 0.6); /* rows 10 and 11: this pin connects body 4 with body 3 */
  assert_int_equal(peel(&d, peeled), 8);
  assert_true(peeled[0] && !peeled[2] && !peeled[9] && peeled[11]);
}

static void a_joint_added_twice_is_kept_with_the_chain_that_carries_it(void **state)
{
  (void)state;
  graph d;
  unsigned char peeled[2 * MOST_JOINTS];
  begin_graph(&d);
  pin(&d, -1, 0, 0.5, 0.2);
  pin(&d, 0, 1, 0.3, -0.4);
  pin(&d, 0, 1, 0.3, -0.4);
  assert_int_equal(peel(&d, peeled), 6);
}

static void rows_that_are_not_clearly_independent_are_kept(void **state)
{
  (void)state;
  graph d;
  unsigned char peeled[2 * MOST_JOINTS];
  const double offsets[] = {1e-2, 1e-4, 0.0};
  for (int k = 0; k < 3; k++) {
    begin_graph(&d);
    double *value = add_rows(&d, 2, (const int[2]){-1, 0});
    value[0] = value[3] = 1.0;
    value[4] = offsets[k];
    assert_int_equal(peel(&d, peeled), k == 0 ? 0 : 2);
  }
  /* Two rows must not be peeled off: a row of zeros, and a row whose squares overflow. */
  for (int k = 0; k < 2; k++) {
    begin_graph(&d);
    double *value = add_rows(&d, 1, (const int[2]){-1, 0});
    value[0] = k == 0 ? 0.0 : 1e200;
    assert_int_equal(peel(&d, peeled), 1);
  }
}

static void rows_and_columns_may_have_any_size(void **state)
{
  (void)state;
  graph d;
  unsigned char peeled[2 * MOST_JOINTS];
  begin_graph(&d);
  pin(&d, -1, 0, 0.5, 0.2);
  pin(&d, 0, 1, 0.3, -0.4);
  for (int k = 0; k < 2 * PIN_SIZE; k++) {
    d.jacobian[k] *= 1e-30;
  }
  for (int j = 0; j < 6; j++) {
    d.column_scale[j] = pow(10.0, 10.0 + j / 3); /* the same for all columns of a body */
  }
  assert_int_equal(peel(&d, peeled), 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_open_chain_with_motors_is_peeled_off_completely),
    cmocka_unit_test(loops_are_kept_and_open_chains_on_them_are_peeled_off),
    cmocka_unit_test(a_joint_added_twice_is_kept_with_the_chain_that_carries_it),
    cmocka_unit_test(rows_that_are_not_clearly_independent_are_kept),
    cmocka_unit_test(rows_and_columns_may_have_any_size),
  };
  return cmocka_run_group_tests_name("peel", tests, NULL, NULL);
}
