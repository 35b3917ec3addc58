/* SPDX-License-Identifier: BSD-3-Clause */
#include "definitions.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mechanism/mechanism.h"

void check_refused(baum_mechanism *mechanism, add_fn *add, const void *def, const char *message)
{
  const int before[3] = {mechanism->body_count, mechanism->joint_count, mechanism->force_count};
  assert_int_equal(add(mechanism, def), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), message);
  const int after[3] = {mechanism->body_count, mechanism->joint_count, mechanism->force_count};
  assert_memory_equal(before, after, sizeof before);
}

void check_bad_numbers(baum_mechanism *mechanism, add_fn *add, const void *good, size_t size,
                       const bad_number *numbers, int count)
{
  for (int i = 0; i < count; i++) {
    char *def = malloc(size);
    assert_non_null(def);
    memcpy(def, good, size);
    memcpy(def + numbers[i].offset, &numbers[i].value, sizeof(double));
    check_refused(mechanism, add, def, numbers[i].message);
    free(def);
  }
}

void check_same_definition(const void *got, const void *want, size_t size)
{
  const baum_i_def_head *got_head = got;
  const baum_i_def_head *want_head = want;
  assert_int_equal(got_head->struct_size, want_head->struct_size);
  assert_string_equal(got_head->name, want_head->name);
  assert_ptr_not_equal(got_head->name, want_head->name);
  size_t head = sizeof(baum_i_def_head);
  assert_memory_equal((const char *)got + head, (const char *)want + head, size - head);
}
