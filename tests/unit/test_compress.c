/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "linear/compress.h"
#include "saddle.h"

enum { SIZE = 12, MOST = 200 };

static int32_t any_index(uint64_t *seed)
{
  return (int32_t)((saddle_random(seed) + 1.0) / 2.0 * (SIZE - 1e-9)); /* 0 .. SIZE - 1 */
}

/* Draws random places of matrix entries. Returns them as a list, and as two arrays of rows and
 * columns. */
static baum_i_places random_places(size_t count, uint64_t seed, int32_t *rows, int32_t *columns)
{
  baum_i_places places = {0};
  for (size_t k = 0; k < count; k++) {
    rows[k] = any_index(&seed);
    columns[k] = any_index(&seed);
    baum_i_places_add(&places, rows[k], columns[k]);
  }
  return places;
}

static void assert_ascending(const baum_i_compressed *c)
{
  assert_int_equal(c->start[0], 0);
  for (int32_t j = 0; j < SIZE; j++) {
    for (int32_t k = c->start[j] + 1; k < c->start[j + 1]; k++) {
      assert_true(c->row[k - 1] < c->row[k]);
    }
  }
}

/* Checks that slot[k] is the place of entry k in the compressed matrix, and that this matrix has no
 * other entries. */
static void assert_same_places(size_t count, const int32_t *rows, const int32_t *columns,
                               const baum_i_compressed *c)
{
  bool is_listed[SIZE][SIZE] = {{false}};
  int different = 0;
  for (size_t k = 0; k < count; k++) {
    assert_true(c->slot[k] >= c->start[columns[k]] && c->slot[k] < c->start[columns[k] + 1]);
    assert_int_equal(c->row[c->slot[k]], rows[k]);
    different += is_listed[rows[k]][columns[k]] ? 0 : 1;
    is_listed[rows[k]][columns[k]] = true;
  }
  assert_int_equal(c->start[SIZE], different);
}

static void a_list_of_places_becomes_ascending_columns(void **state)
{
  (void)state;
  int32_t rows[MOST];
  int32_t columns[MOST];
  for (size_t count = 0; count <= MOST; count += 8) {
    baum_i_places places = random_places(count, 3 + count, rows, columns);
    baum_i_compressed c;
    assert_int_equal(baum_i_compress(&places, SIZE, &c), BAUM_OK);
    assert_ascending(&c);
    assert_same_places(count, rows, columns, &c);
    assert_int_equal(places.count, 0);
    assert_null(places.list);
    baum_i_compressed_clear(&c);
  }
}

static void more_places_than_an_index_can_count_are_refused(void **state)
{
  (void)state;
  baum_i_places places = {.count = INT32_MAX};
  baum_i_places_add(&places, 1, 2);
  assert_true(places.broken);
  assert_int_equal(places.count, INT32_MAX);
  baum_i_compressed c = {.n = 7};
  places.count = 0;
  assert_int_equal(baum_i_compress(&places, SIZE, &c), BAUM_ERR_MEMORY);
  assert_null(c.start);
  assert_false(places.broken);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_list_of_places_becomes_ascending_columns),
    cmocka_unit_test(more_places_than_an_index_can_count_are_refused),
  };
  return cmocka_run_group_tests_name("compress", tests, NULL, NULL);
}
