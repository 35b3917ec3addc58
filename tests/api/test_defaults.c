/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests that the texts after `Default:` in the headers agree with the values that the default
 * functions set. Also tests that a definition is unchanged after it was added and read back. */
#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "every_element.h"

/* ---- the headers ---- */

enum { HEADER_SIZE = 65536, TEXT_SIZE = 128, NAME_SIZE = 64, FILL = 0xA5, OTHER_FILL = 0x5A };

static const char *const header_names[] = {"mechanism.h",      "planar.h",  "planar_joints.h",
                                           "simulation.h",     "spatial.h", "spatial_joints.h",
                                           "spatial_points.h", "spline.h"};
enum { HEADERS = sizeof header_names / sizeof *header_names };

/* Reads the text of all headers, one after the other. The caller frees this text. */
static char *read_headers(void)
{
  char *text = calloc(HEADERS, HEADER_SIZE);
  assert_non_null(text);
  size_t used = 0;
  for (int k = 0; k < HEADERS; k++) {
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/../../include/baum/%s", BAUM_TEST_DATA, header_names[k]);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t size = fread(text + used, 1, HEADER_SIZE, file);
    assert_in_range(size, 1, HEADER_SIZE - 1);
    used += size;
    (void)fclose(file);
  }
  return text;
}

/* Finds the definition of a struct. Returns the position after its opening brace, and sets *end to
 * its closing brace. */
static const char *find_struct(const char *headers, const char *name, const char **end)
{
  char opening[TEXT_SIZE];
  char closing[TEXT_SIZE];
  (void)snprintf(opening, sizeof opening, "typedef struct %s {", name);
  (void)snprintf(closing, sizeof closing, "} %s;", name);
  const char *begin = strstr(headers, opening);
  *end = begin ? strstr(begin, closing) : NULL;
  if (!begin || !*end) {
    fail_msg("no struct %s in the headers", name);
  }
  return begin + strlen(opening);
}

/* Finds the last name of a declaration, which precedes its semicolon. */
static void name_of(const char *semicolon, char name[TEXT_SIZE])
{
  const char *last = semicolon;
  if (last[-1] == ']') {
    do {
      last--;
    } while (*last != '[');
  }
  while (isspace((unsigned char)last[-1])) {
    last--;
  }
  const char *first = last;
  while (isalnum((unsigned char)first[-1]) || first[-1] == '_') {
    first--;
  }
  (void)snprintf(name, TEXT_SIZE, "%.*s", (int)(last - first), first);
}

/* Finds the text after "Default: " in a comment. If there is none, the text is "". */
static void default_of(const char *comment, const char *comment_end, char text[TEXT_SIZE])
{
  const char *given = strstr(comment, "Default: ");
  text[0] = '\0';
  if (given && given < comment_end) {
    given += strlen("Default: ");
    (void)snprintf(text, TEXT_SIZE, "%.*s", (int)(comment_end - given), given);
  }
}

/* Reads the next declaration from `from` on. Finds its name, and the text after "Default: " in its
 * comment. The comment may be before or after the declaration. Returns the end of the declaration.
 * Returns NULL if there are no more declarations. */
static const char *next_field(const char *from, const char *end, char name[TEXT_SIZE],
                              char text[TEXT_SIZE])
{
  const char *comment = from + strspn(from, " \n");
  bool before = strncmp(comment, "/**", 3) == 0;
  const char *semicolon = strchr(before ? strstr(comment, "*/") : from, ';');
  if (!semicolon || semicolon >= end) {
    return NULL;
  }
  name_of(semicolon, name);
  comment = before ? comment : semicolon;
  const char *comment_end = strstr(comment, "*/");
  assert_non_null(comment_end);
  default_of(comment, comment_end, text);
  return before ? semicolon + 1 : comment_end + 2;
}

/* ---- comparing a text with a value ---- */

static bool begins(const char *text, const char *with)
{
  return strncmp(text, with, strlen(with)) == 0;
}

static int64_t integer_of(const unsigned char *bytes, size_t size)
{
  int32_t narrow;
  int64_t wide;
  memcpy(&narrow, bytes, sizeof narrow);
  memcpy(&wide, bytes, size == sizeof wide ? sizeof wide : sizeof narrow);
  return size == sizeof wide ? wide : narrow;
}

static bool is_zero(const unsigned char *bytes, size_t size)
{
  while (size > 0 && bytes[size - 1] == 0) {
    size--;
  }
  return size == 0;
}

static bool numbers_are(const char *text, const unsigned char *bytes, size_t size)
{
  double value[BAUM_I_FIELD_SIZE_MAX];
  size_t count = size / sizeof *value;
  memcpy(value, bytes, size);
  bool same = true;
  if (begins(text, "all 0")) {
    return is_zero(bytes, size);
  }
  if (begins(text, "NaN")) {
    for (size_t i = 0; i < count; i++) {
      same = same && isnan(value[i]);
    }
    return same;
  }
  char *next = NULL;
  for (size_t i = 0; i < count; i++) {
    text += strspn(text, "(, ");
    same = same && value[i] == strtod(text, &next) && next != text;
    text = next;
  }
  return same;
}

/* Tells whether a text is a number, or one of the enumerators that occur as defaults, with this
 * value. */
static bool integer_is(const char *text, int64_t value)
{
  static const struct {
    const char *name;
    int64_t value;
  } enumerators[] = {{"BAUM_FORMULATION_DEFAULT", BAUM_FORMULATION_DEFAULT},
                     {"BAUM_GAINS_DEFAULT", BAUM_GAINS_DEFAULT},
                     {"BAUM_START_ASSEMBLE", BAUM_START_ASSEMBLE},
                     {"BAUM_SOLVER_AUTO", BAUM_SOLVER_AUTO},
                     {"BAUM_COORDINATE_FIRST", BAUM_COORDINATE_FIRST}};
  for (size_t k = 0; k < sizeof enumerators / sizeof *enumerators; k++) {
    if (begins(text, enumerators[k].name)) {
      return value == enumerators[k].value;
    }
  }
  return isdigit((unsigned char)text[0]) && value == strtoll(text, NULL, 10);
}

static bool is_nothing(const char *text, const char *word, const unsigned char *bytes, size_t size)
{
  return begins(text, word) && is_zero(bytes, size);
}

/* Tells whether an id has the value of a text. Defaults of ids are "none" and BAUM_GROUND. */
static bool id_is(const char *text, const unsigned char *bytes, size_t size)
{
  if (begins(text, "BAUM_GROUND")) {
    return memcmp(bytes, &BAUM_GROUND, size) == 0;
  }
  return is_nothing(text, "none", bytes, size);
}

static bool flag_is(const char *text, unsigned char flag)
{
  return flag <= 1 && begins(text, flag ? "true" : "false");
}

/* Tells whether the bytes of a field have the value that its text documents. */
static bool is_as_documented(const element_field *field, const char *text, const any_def *def)
{
  const unsigned char *bytes = def->bytes + field->offset;
  switch (field->type) {
  case FIELD_NAME:
  case FIELD_FUNCTION:
  case FIELD_ARRAY: return is_nothing(text, "NULL", bytes, field->size);
  case FIELD_ID: return id_is(text, bytes, field->size);
  case FIELD_NUMBERS: return numbers_are(text, bytes, field->size);
  case FIELD_INTEGER: return integer_is(text, integer_of(bytes, field->size));
  case FIELD_GAINS: return integer_is(text, integer_of(bytes, sizeof(int32_t)));
  case FIELD_FLAG: return flag_is(text, bytes[0]);
  case FIELD_SIZE:
  default: return text[0] == '\0';
  }
}

/* ---- structs that have defaults ---- */

/* A struct that is a definition, or the options of a run. */
typedef struct defaults {
  char name[NAME_SIZE];
  size_t size;
  void (*init)(any_def *def, size_t caller_size);
  element_fields fields;
} defaults;

static void init_options(any_def *def, size_t caller_size)
{
  baum_simulation_options_init((void *)def, caller_size);
}

enum { STRUCTS = ELEMENT_KINDS + 1 };

static defaults defaults_of(int k)
{
  defaults d = {
    "baum_simulation_options", sizeof(baum_simulation_options), init_options, {.count = 0}};
  if (k < ELEMENT_KINDS) {
    const element_kind *kind = &element_kinds[k];
    (void)snprintf(d.name, sizeof d.name, "baum_%s_def", kind->name);
    d.size = kind->size;
    d.init = kind->init;
    d.fields = element_fields_of(kind);
  } else {
    d.fields.count = OPTION_FIELDS;
    memcpy(d.fields.list, option_fields, sizeof option_fields);
  }
  return d;
}

static void check_struct(const char *headers, const defaults *d)
{
  any_def def;
  memset(&def, FILL, sizeof def);
  d->init(&def, d->size);
  assert_int_equal(def.head.struct_size, d->size);
  const char *end;
  const char *at = find_struct(headers, d->name, &end);
  char name[TEXT_SIZE];
  char text[TEXT_SIZE];
  int k = 0;
  while ((at = next_field(at, end, name, text)) != NULL) {
    if (k >= d->fields.count || strcmp(name, d->fields.list[k].name) != 0) {
      fail_msg("%s: field %d is %s, which its table does not have there", d->name, k, name);
    }
    if (!is_as_documented(&d->fields.list[k], text, &def)) {
      fail_msg("%s: default of %s is not \"%s\"", d->name, name, text);
    }
    k++;
  }
  assert_int_equal(k, d->fields.count);
}

static void documented_defaults_are_the_real_ones(void **state)
{
  (void)state;
  char *headers = read_headers();
  for (int k = 0; k < STRUCTS; k++) {
    defaults d = defaults_of(k);
    check_struct(headers, &d);
  }
  free(headers);
}

static void the_default_functions_set_every_field(void **state)
{
  (void)state;
  for (int k = 0; k < STRUCTS; k++) {
    defaults d = defaults_of(k);
    any_def one;
    any_def two;
    memset(&one, FILL, sizeof one);
    memset(&two, OTHER_FILL, sizeof two);
    d.init(&one, d.size);
    d.init(&two, d.size);
    assert_memory_equal(&one, &two, d.size);
    assert_int_equal(one.bytes[d.size], FILL);
  }
}

static void init_writes_at_most_the_callers_size(void **state)
{
  (void)state;
  for (int k = 0; k < STRUCTS; k++) {
    defaults d = defaults_of(k);
    any_def whole;
    d.init(&whole, d.size);
    for (size_t size = 0; size <= d.size + 16; size++) {
      size_t written = size < sizeof(size_t) ? 0 : (size < d.size ? size : d.size);
      any_def def;
      memset(&def, FILL, sizeof def);
      d.init(&def, size);
      for (size_t i = written; i < sizeof def; i++) {
        assert_int_equal(def.bytes[i], FILL);
      }
      if (written > 0) {
        assert_int_equal(def.head.struct_size, written);
        assert_memory_equal(def.bytes + sizeof(size_t), whole.bytes + sizeof(size_t),
                            written - sizeof(size_t));
      }
    }
    d.init(NULL, d.size);
  }
}

/* ---- reading definitions back ---- */

static size_t array_bytes(const element_kind *kind, const element_field *field, const any_def *def)
{
  const element_fields fields = element_fields_of(kind);
  bool ids = strcmp(field->name, "bodies") == 0;
  size_t bytes[2] = {sizeof(double), sizeof(baum_body_id)};
  for (int k = 0; k < fields.count; k++) {
    const char *name = fields.list[k].name;
    bool counts = ids ? strcmp(name, "body_count") == 0
                      : strcmp(name, "size") == 0 || strcmp(name, "count") == 0;
    if (counts) {
      const element_field *count = &fields.list[k];
      return (size_t)integer_of(def->bytes + count->offset, count->size) * bytes[ids ? 1 : 0];
    }
  }
  return 0;
}

static const char *pointer_at(const any_def *def, const element_field *field)
{
  const char *pointer;
  memcpy(&pointer, def->bytes + field->offset, sizeof pointer);
  return pointer;
}

/* Checks that two names or arrays have the same content at different addresses, so that one is a
 * copy of the other. */
static void check_same_copied(const element_kind *kind, const element_field *field,
                              const any_def *got, const any_def *want)
{
  const char *a = pointer_at(got, field);
  const char *b = pointer_at(want, field);
  assert_int_equal(a == NULL, b == NULL);
  if (b && field->type == FIELD_NAME) {
    assert_string_equal(a, b);
  } else if (b) {
    assert_memory_equal(a, b, array_bytes(kind, field, want));
  }
  assert_true(!b || a != b);
}

static void check_same(const element_kind *kind, const any_def *got, const any_def *want)
{
  const element_fields fields = element_fields_of(kind);
  for (int k = 0; k < fields.count; k++) {
    const element_field *field = &fields.list[k];
    if (field->type == FIELD_NAME || field->type == FIELD_ARRAY) {
      check_same_copied(kind, field, got, want);
    } else {
      assert_memory_equal(got->bytes + field->offset, want->bytes + field->offset, field->size);
    }
  }
}

static void check_is_in(const baum_mechanism *mechanism, const element_kind *kind, any_id id,
                        const any_def *want)
{
  any_def got;
  assert_int_equal(kind->get(mechanism, id, &got, kind->size), BAUM_OK);
  check_same(kind, &got, want);
}

/* Makes a definition with the same bodies and joints, but with another name and other numbers. */
static any_def change(const element_kind *kind, const any_def *good, const char *name)
{
  const element_fields fields = element_fields_of(kind);
  any_def def = *good;
  def.head.name = name;
  for (int k = 0; k < fields.count; k++) {
    const element_field *field = &fields.list[k];
    double value[FIELD_NUMBERS_MAX];
    bool keeps_length = strcmp(field->name, "orientation") == 0;
    bool is_replaced = strcmp(field->name, "ratio") == 0; /* by the law of the coupling */
    if (field->type != FIELD_NUMBERS || keeps_length || is_replaced) {
      continue;
    }
    memcpy(value, def.bytes + field->offset, field->size);
    for (size_t i = 0; i < field->size / sizeof *value; i++) {
      value[i] = isnan(value[i]) ? value[i] : 1.25 * value[i];
    }
    memcpy(def.bytes + field->offset, value, field->size);
  }
  return def;
}

static void every_definition_comes_back_as_it_was_given(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    any_def good;
    element_kinds[k].good(&parts, &good);
    check_is_in(parts.mechanism, &element_kinds[k], every_element_id(&parts, &element_kinds[k]),
                &good);
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void a_copy_is_open_has_the_same_ids_and_changes_alone(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_mechanism *copy = NULL;
  assert_int_equal(baum_mechanism_copy(parts.mechanism, &copy), BAUM_OK);
  assert_false(baum_mechanism_is_frozen(copy));
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    any_id id = every_element_id(&parts, kind);
    any_def good;
    char name[] = "another";
    kind->good(&parts, &good);
    check_is_in(copy, kind, id, &good);
    any_def changed = change(kind, &good, name);
    assert_int_equal(kind->set(copy, id, &changed), BAUM_OK);
    name[0] = 'X';
    changed.head.name = "another";
    check_is_in(copy, kind, id, &changed);
    check_is_in(parts.mechanism, kind, id, &good);
  }
  assert_int_equal(baum_mechanism_freeze(copy), BAUM_OK);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(copy);
}

static void a_definition_read_back_can_be_set_again(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    any_id id = every_element_id(&parts, kind);
    any_def good;
    any_def got;
    kind->good(&parts, &good);
    assert_int_equal(kind->get(parts.mechanism, id, &got, kind->size), BAUM_OK);
    assert_int_equal(kind->set(parts.mechanism, id, &got), BAUM_OK);
    check_is_in(parts.mechanism, kind, id, &good);
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void get_writes_at_most_the_callers_size(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (int k = 0; k < ELEMENT_KINDS; k++) {
    const element_kind *kind = &element_kinds[k];
    any_id id = every_element_id(&parts, kind);
    for (size_t size = sizeof(size_t); size <= kind->size + 16; size += 4) {
      size_t written = size < kind->size ? size : kind->size;
      any_def def;
      memset(&def, FILL, sizeof def);
      assert_int_equal(kind->get(parts.mechanism, id, &def, size), BAUM_OK);
      assert_int_equal(def.head.struct_size, written);
      assert_int_equal(def.bytes[written], FILL);
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- names ---- */

static void names_are_copied_and_default_to_family_and_number(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  char name[] = "first";
  baum_planar_body_def body = baum_planar_body_def_default();
  baum_body_id first;
  baum_body_id second;
  body.name = name;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &body, &first), BAUM_OK);
  name[0] = 'X';
  body.name = NULL;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &body, &second), BAUM_OK);
  baum_joint_id joint = add_planar_pin(mechanism, NULL, first, second, 0.0, 0.0);
  assert_string_equal(baum_mechanism_body_name(mechanism, first), "first");
  assert_string_equal(baum_mechanism_body_name(mechanism, second), "body2");
  assert_string_equal(baum_mechanism_body_name(mechanism, BAUM_GROUND), "ground");
  assert_string_equal(baum_mechanism_joint_name(mechanism, joint), "joint1");
  assert_null(baum_mechanism_body_name(mechanism, (baum_body_id){0, 0}));
  assert_null(baum_mechanism_joint_name(mechanism, (baum_joint_id){7, joint.tag}));
  baum_mechanism_destroy(mechanism);
}

/* ---- gravity and characteristic length ---- */

static void gravity_and_scale_default_as_documented_and_can_be_set(void **state)
{
  (void)state;
  double gravity[3];
  double length = 0.0;
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_get_gravity(mechanism, gravity), BAUM_OK);
  const double want[3] = {0.0, -9.81, 0.0};
  assert_memory_equal(gravity, want, sizeof want);
  assert_int_equal(baum_mechanism_get_characteristic_length(mechanism, &length), BAUM_OK);
  assert_true(isnan(length));
  assert_int_equal(baum_mechanism_set_gravity(mechanism, 1.0, 2.0, 3.0), BAUM_OK);
  assert_int_equal(baum_mechanism_set_characteristic_length(mechanism, 7.0), BAUM_OK);
  baum_mechanism *copy = NULL;
  assert_int_equal(baum_mechanism_copy(mechanism, &copy), BAUM_OK);
  const double set[3] = {1.0, 2.0, 3.0};
  assert_int_equal(baum_mechanism_get_gravity(copy, gravity), BAUM_OK);
  assert_memory_equal(gravity, set, sizeof set);
  assert_int_equal(baum_mechanism_get_characteristic_length(copy, &length), BAUM_OK);
  ASSERT_NEAR(length, 7.0, 0.0, 0.0);
  baum_mechanism_destroy(copy);
  baum_mechanism_destroy(mechanism);
}

static void sizes_rows_and_columns_follow_the_order_of_adding(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  int32_t size[3] = {0, 0, 0};
  assert_int_equal(baum_mechanism_sizes(parts.mechanism, &size[0], &size[1], &size[2]), BAUM_OK);
  const int32_t sizes[3] = {EVERY_NQ, EVERY_NV, EVERY_NC};
  assert_memory_equal(size, sizes, sizeof sizes);
  const baum_joint_id joints[] = {parts.pin,  parts.rod,   parts.guide,
                                  parts.weld, parts.motor, parts.circle};
  const int32_t counts[] = {2, 1, 2, 3, 1, 1};
  int32_t next = 0;
  for (int k = 0; k < 6; k++) {
    int32_t first = -1;
    int32_t count = -1;
    assert_int_equal(baum_mechanism_rows(parts.mechanism, joints[k], &first, &count), BAUM_OK);
    assert_int_equal(first, next);
    assert_int_equal(count, counts[k]);
    next += counts[k];
  }
  int32_t q = -1;
  int32_t v = -1;
  assert_int_equal(baum_mechanism_columns(parts.mechanism, parts.bob, &q, &v), BAUM_OK);
  assert_int_equal(q, 9);
  assert_int_equal(v, 9);
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(documented_defaults_are_the_real_ones),
    cmocka_unit_test(the_default_functions_set_every_field),
    cmocka_unit_test(init_writes_at_most_the_callers_size),
    cmocka_unit_test(every_definition_comes_back_as_it_was_given),
    cmocka_unit_test(a_copy_is_open_has_the_same_ids_and_changes_alone),
    cmocka_unit_test(a_definition_read_back_can_be_set_again),
    cmocka_unit_test(get_writes_at_most_the_callers_size),
    cmocka_unit_test(names_are_copied_and_default_to_family_and_number),
    cmocka_unit_test(gravity_and_scale_default_as_documented_and_can_be_set),
    cmocka_unit_test(sizes_rows_and_columns_follow_the_order_of_adding),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
