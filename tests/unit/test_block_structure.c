/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests which couplings the block solver stores, and which structures it refuses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "linear/block.h"

/* ---- nets ---- */

/* A structure of bodies and joints. Bodies have three velocities, and each joint has two rows
 * between two bodies. */
typedef struct net {
  baum_i_kkt_structure structure;
  baum_i_mass_block *masses;
  baum_i_row_block *rows;
  int *columns;
  unsigned char *diagonal;
  unsigned char *fixed;
  baum_i_block_pin *pins;
} net;

static net make_net(int bodies, int most_rows)
{
  net n = {
    .masses = calloc((size_t)bodies, sizeof *n.masses),
    .rows = calloc((size_t)most_rows, sizeof *n.rows),
    .columns = calloc((size_t)most_rows, 6 * sizeof *n.columns),
    .diagonal = malloc((size_t)bodies),
    .fixed = calloc((size_t)bodies, 1),
    .pins = calloc((size_t)most_rows, sizeof *n.pins),
  };
  assert_true(n.masses && n.rows && n.columns && n.diagonal && n.fixed && n.pins);
  memset(n.diagonal, 1, (size_t)bodies);
  for (int i = 0; i < bodies; i++) {
    n.masses[i] = (baum_i_mass_block){.first = 3 * i, .size = 3, .value = 9 * i};
  }
  n.structure = (baum_i_kkt_structure){
    .nv = 3 * bodies, .mass_block_count = bodies, .mass_blocks = n.masses, .row_blocks = n.rows};
  return n;
}

static void join(net *n, int a, int b)
{
  int k = n->structure.row_block_count++;
  int *columns = n->columns + 6 * (size_t)k;
  for (int c = 0; c < 3; c++) {
    columns[c] = 3 * a + c;
    columns[3 + c] = 3 * b + c;
  }
  n->rows[k] = (baum_i_row_block){
    .row = n->structure.nc, .rows = 2, .cols = 6, .col = columns, .value = 12 * k};
  n->structure.nc += 2;
}

static baum_status create_net(const net *n, int *hub, baum_i_block **out)
{
  const baum_i_block_layout layout = {
    .structure = &n->structure, .pins = n->pins, .diagonal = n->diagonal, .fixed = n->fixed};
  return baum_i_block_create(&layout, hub, out);
}

static void free_net(net *n)
{
  free(n->masses);
  free(n->rows);
  free(n->columns);
  free(n->diagonal);
  free(n->fixed);
  free(n->pins);
}

static net make_star(int arms)
{
  net n = make_net(arms + 1, arms);
  for (int k = 0; k < arms; k++) {
    join(&n, 3, k < 3 ? k : k + 1); /* body 3, the hub, is part of every joint */
  }
  return n;
}

static void a_chain_of_bodies_couples_neighbouring_joints(void **state)
{
  (void)state;
  enum { BODIES = 30 };
  net n = make_net(BODIES, BODIES);
  for (int k = 1; k < BODIES; k++) {
    join(&n, k - 1, k);
  }
  baum_i_block *b = NULL;
  assert_int_equal(create_net(&n, NULL, &b), BAUM_OK);
  assert_int_equal(b->node_count, BODIES - 1);
  assert_int_equal(b->off_count, BODIES - 2);
  assert_int_equal(b->zero_count, 0);
  /* No joint is a pin. Every coupling is therefore in the list of general pairs, and sets its own
   * block. */
  assert_int_equal(b->first_count, BODIES - 2);
  assert_int_equal(b->full_pair_count, 0);
  assert_int_equal(b->side_count, 2 * (BODIES - 1));
  assert_int_equal(b->entry_count, 0); /* all entries are read directly from J */
  for (int i = 0; i < b->side_count; i++) {
    assert_int_equal(b->side_from[2 * i], 12 * (i / 2) + 3 * (i % 2));
  }
  baum_i_block_destroy(b);
  free_net(&n);
}

/* Two joints between the same bodies are coupled by both bodies. The two couplings are added up in
 * one block. */
static void two_joints_of_the_same_bodies_share_a_block(void **state)
{
  (void)state;
  net n = make_net(2, 2);
  join(&n, 0, 1);
  join(&n, 1, 0);
  baum_i_block *b = NULL;
  assert_int_equal(create_net(&n, NULL, &b), BAUM_OK);
  assert_int_equal(b->off_count, 1);
  assert_int_equal(b->first_count, 1);
  assert_int_equal(b->full_pair_count, 1);
  baum_i_block_destroy(b);
  free_net(&n);
}

static void hubs_are_refused_and_named(void **state)
{
  (void)state;
  baum_i_block *b = NULL;
  int hub = 77;
  net few = make_star(48);
  assert_int_equal(create_net(&few, &hub, &b), BAUM_OK);
  assert_int_equal(hub, -1);
  assert_int_equal(b->off_count, 48 * 47 / 2);
  baum_i_block_destroy(b);
  free_net(&few);
  net many = make_star(49);
  assert_int_equal(create_net(&many, &hub, &b), BAUM_ERR_SINGULAR);
  assert_null(b);
  assert_int_equal(hub, 3);
  many.diagonal[1] = 0; /* changes the numbering of the body blocks */
  assert_int_equal(create_net(&many, &hub, &b), BAUM_ERR_SINGULAR);
  assert_int_equal(hub, 3);
  many.diagonal[3] = 0;
  assert_int_equal(create_net(&many, &hub, &b), BAUM_ERR_SINGULAR);
  assert_int_equal(hub, 3);
  many.diagonal[3] = 1;
  many.fixed[3] = 1;
  assert_int_equal(create_net(&many, &hub, &b), BAUM_OK);
  assert_int_equal(hub, -1);
  assert_int_equal(b->off_count, 0);
  baum_i_block_destroy(b);
  free_net(&many);
}

/* A cubic grid of bodies. Each body has at most six joints. During elimination, however, all joints
 * of a whole plane become coupled with each other. */
static void dense_nets_are_refused(void **state)
{
  (void)state;
  enum { SIDE = 12 };
  net n = make_net(SIDE * SIDE * SIDE, 3 * SIDE * SIDE * SIDE);
  for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
    int x = i % SIDE;
    int y = i / SIDE % SIDE;
    int z = i / (SIDE * SIDE);
    if (x + 1 < SIDE) {
      join(&n, i, i + 1);
    }
    if (y + 1 < SIDE) {
      join(&n, i, i + SIDE);
    }
    if (z + 1 < SIDE) {
      join(&n, i, i + SIDE * SIDE);
    }
  }
  baum_i_block *b = NULL;
  int hub = 77;
  assert_int_equal(create_net(&n, &hub, &b), BAUM_ERR_SINGULAR);
  assert_null(b);
  assert_int_equal(hub, -1);
  free_net(&n);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_chain_of_bodies_couples_neighbouring_joints),
    cmocka_unit_test(two_joints_of_the_same_bodies_share_a_block),
    cmocka_unit_test(hubs_are_refused_and_named),
    cmocka_unit_test(dense_nets_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
