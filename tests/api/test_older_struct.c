/* SPDX-License-Identifier: BSD-3-Clause */
/* If a program was compiled with an older version, its definitions and options are shorter structs.
 * The fields that these structs do not have must get their default values. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "every_element.h"

enum { WORD = sizeof(size_t), FILL = 0xA5, TEXT_SIZE = 1024 };

/* Tells whether a field is completely within the first `size` bytes. */
static bool is_within(const element_field *field, size_t size)
{
  return field->offset + field->size <= size;
}

/* Two structs with the same meaning. From a given size on, all bytes of `whole` are defaults. `cut`
 * has this size, and the bytes after its end are garbage. */
typedef struct two_structs {
  any_def whole;
  any_def cut;
} two_structs;

static two_structs cut_at(const any_def *good, const any_def *defaults, size_t size,
                          const element_field *fields, int field_count)
{
  two_structs two = {.whole = *defaults};
  memset(&two.cut, FILL, sizeof two.cut);
  for (int k = 0; k < field_count; k++) {
    if (is_within(&fields[k], size)) {
      memcpy(two.whole.bytes + fields[k].offset, good->bytes + fields[k].offset, fields[k].size);
      memcpy(two.cut.bytes + fields[k].offset, good->bytes + fields[k].offset, fields[k].size);
    }
  }
  two.whole.head.struct_size = defaults->head.struct_size;
  two.cut.head.struct_size = size;
  return two;
}

/* Returns the size of an older struct that ended with this field. Padding to a whole word is
 * included. */
static size_t older_size(const element_field *last)
{
  size_t end = last->offset + last->size;
  return (end + WORD - 1) / WORD * WORD;
}

/* ---- definitions ---- */

/* Compares all fields except arrays. Arrays are copies at different addresses. */
static void check_same_fields(const element_kind *kind, const any_def *a, const any_def *b)
{
  const element_fields fields = element_fields_of(kind);
  for (int k = 0; k < fields.count; k++) {
    const element_field *field = &fields.list[k];
    if (field->type != FIELD_NAME && field->type != FIELD_ARRAY) {
      assert_memory_equal(a->bytes + field->offset, b->bytes + field->offset, field->size);
    }
  }
  assert_string_equal(a->head.name, b->head.name);
}

/* Adds the element to a copy of the mechanism and reads it back. */
static baum_status add_to_copy(const baum_mechanism *mechanism, const element_kind *kind,
                               const any_def *def, any_def *got, char text[TEXT_SIZE])
{
  baum_mechanism *copy = NULL;
  any_id id = {0, 0};
  assert_int_equal(baum_mechanism_copy(mechanism, &copy), BAUM_OK);
  baum_status status = kind->add(copy, def, &id);
  (void)snprintf(text, TEXT_SIZE, "%s", status == BAUM_OK ? "" : baum_message());
  if (status == BAUM_OK) {
    assert_int_equal(kind->get(copy, id, got, kind->size), BAUM_OK);
    got->head.name = def->head.name; /* the name of the element is freed together with the copy */
    assert_int_equal(kind->set(copy, id, def), BAUM_OK);
  }
  baum_mechanism_destroy(copy);
  return status;
}

static bool check_cut(const every_element *parts, const element_kind *kind, size_t size)
{
  const element_fields fields = element_fields_of(kind);
  any_def good;
  any_def defaults;
  memset(&defaults, 0, sizeof defaults);
  kind->good(parts, &good);
  kind->init(&defaults, kind->size);
  two_structs two = cut_at(&good, &defaults, size, fields.list, fields.count);
  any_def got[2];
  char text[2][TEXT_SIZE];
  baum_status whole = add_to_copy(parts->mechanism, kind, &two.whole, &got[0], text[0]);
  baum_status cut = add_to_copy(parts->mechanism, kind, &two.cut, &got[1], text[1]);
  assert_int_equal(cut, whole);
  assert_string_equal(text[0], text[1]);
  if (whole == BAUM_OK) {
    check_same_fields(kind, &got[0], &got[1]);
    assert_int_equal(got[1].head.struct_size, kind->size);
  }
  return whole == BAUM_OK;
}

static void a_shorter_definition_has_defaults_where_it_ends(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  int accepted = 0;
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    const element_fields fields = element_fields_of(kind);
    for (int f = 1; f < fields.count; f++) {
      accepted += check_cut(&parts, kind, older_size(&fields.list[f]));
    }
  }
  /* The test is only useful if many definitions are accepted, and not all refused. */
  assert_in_range(accepted, 2 * ELEMENT_KINDS, 1000);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- options ---- */

/* Creates a run with these options and returns the status of the creation. Writes to `text` the
 * explanation of the run, or the message if the creation failed. */
static baum_status run_with(const baum_mechanism *mechanism, const any_def *def,
                            char text[TEXT_SIZE])
{
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(mechanism, (const void *)def, &run);
  (void)snprintf(text, TEXT_SIZE, "%s",
                 status == BAUM_OK ? baum_simulation_explain(run) : baum_message());
  baum_simulation_destroy(run);
  return status;
}

static void shorter_options_have_defaults_where_they_end(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = baum_simulation_options_default();
  any_def good;
  any_def defaults;
  memset(&defaults, 0, sizeof defaults);
  memcpy(&defaults, &o, sizeof o);
  o.integrator = baum_euler();
  o.step = 1e-3;
  memcpy(&good, &o, sizeof o);
  int accepted = 0;
  for (int f = 1; f < OPTION_FIELDS; f++) {
    two_structs two =
      cut_at(&good, &defaults, older_size(&option_fields[f]), option_fields, OPTION_FIELDS);
    char text[2][TEXT_SIZE];
    baum_status whole = run_with(parts.mechanism, &two.whole, text[0]);
    baum_status cut = run_with(parts.mechanism, &two.cut, text[1]);
    assert_int_equal(cut, whole);
    assert_string_equal(text[0], text[1]);
    accepted += whole == BAUM_OK;
  }
  /* These options need the fields up to `step`. Every size that includes `step` must be
   * accepted. */
  assert_int_equal(accepted, OPTION_FIELDS - 5);
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_shorter_definition_has_defaults_where_it_ends),
    cmocka_unit_test(shorter_options_have_defaults_where_they_end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
