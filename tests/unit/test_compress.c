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
  return (int32_t)((saddle_random(seed) + 1.0) / 2.0 * (SIZE - 1e-9)); /* of [-1, 1) */
}

static baum_i_places random_places(size_t count, uint64_t seed)
{
  baum_i_places places;
  assert_int_equal(baum_i_places_create(count, &places), BAUM_OK);
  for (size_t k = 0; k < count; k++) {
    int32_t row = any_index(&seed);
    baum_i_places_add(&places, row, any_index(&seed));
  }
  return places;
}

static void assert_ascending(const int32_t *start, const int32_t *row)
{
  assert_int_equal(start[0], 0);
  for (int32_t j = 0; j < SIZE; j++) {
    for (int32_t k = start[j] + 1; k < start[j + 1]; k++) {
      assert_true(row[k - 1] < row[k]);
    }
  }
}

/* Every listed place is found where its slot says, and there are no others. */
static void assert_same_places(const baum_i_places *places, const int32_t *start,
                               const int32_t *row, const int32_t *slot)
{
  bool is_listed[SIZE][SIZE] = {{false}};
  int different = 0;
  for (size_t k = 0; k < places->count; k++) {
    int32_t column = places->column[k];
    assert_true(slot[k] >= start[column] && slot[k] < start[column + 1]);
    assert_int_equal(row[slot[k]], places->row[k]);
    different += is_listed[places->row[k]][column] ? 0 : 1;
    is_listed[places->row[k]][column] = true;
  }
  assert_int_equal(start[SIZE], different);
}

static void a_list_of_places_becomes_ascending_columns(void **state)
{
  (void)state;
  int32_t start[SIZE + 1];
  int32_t row[MOST];
  int32_t slot[MOST];
  for (size_t count = 0; count <= MOST; count += 8) {
    baum_i_places places = random_places(count, 3 + count);
    assert_int_equal(baum_i_compress(&places, SIZE, start, row, slot), BAUM_OK);
    assert_ascending(start, row);
    assert_same_places(&places, start, row, slot);
    baum_i_places_clear(&places);
  }
}

static void more_places_than_an_index_can_count_are_refused(void **state)
{
  (void)state;
  baum_i_places places = {.count = 7};
  assert_int_equal(baum_i_places_create((size_t)INT32_MAX + 1, &places), BAUM_ERR_MEMORY);
  assert_int_equal(places.count, 0);
  assert_null(places.row);
  baum_i_places_clear(&places);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_list_of_places_becomes_ascending_columns),
    cmocka_unit_test(more_places_than_an_index_can_count_are_refused),
  };
  return cmocka_run_group_tests_name("compress", tests, NULL, NULL);
}
