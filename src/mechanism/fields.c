/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions that use the tables of fields. They set the defaults of definitions, check and copy
 * definitions, add them to digests, and find the bodies that a definition names. */
#include "mechanism/fields.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/identify.h"

/* Largest number of rows or coordinates of one element. A larger number is probably a mistake. The
 * product of two such numbers does not overflow an int. */
enum { COUNT_MAX = 10000 };

/* ---- defaults ---- */

void baum_i_fields_set(const baum_i_definition *definition, void *def)
{
  memset(def, 0, definition->size);
  ((baum_i_def_head *)def)->struct_size = definition->size;
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    char *at = (char *)def + f->offset;
    if (f->kind == BAUM_I_FIELD_NUMBERS) {
      for (size_t k = 0; k < f->size / sizeof(double); k++) {
        double value = baum_i_field_default(f, k);
        memcpy(at + k * sizeof value, &value, sizeof value);
      }
    } else if (f->kind == BAUM_I_FIELD_CARRIER) {
      memcpy(at, &BAUM_GROUND, f->size);
    } else if (f->kind == BAUM_I_FIELD_CLAIM) {
      *(bool *)(void *)at = true;
    }
  }
}

/* ---- numbers ---- */

/* For each rule: which numbers it allows besides positive finite ones, and the end of the message
 * for a number that it refuses. */
static const struct {
  bool nan, negative, zero;
  const char *remedy;
} rules[] = {
  [BAUM_I_RULE_FINITE] = {false, true, true, ""},
  [BAUM_I_RULE_POSITIVE] = {false, false, false, " and > 0"},
  [BAUM_I_RULE_NOT_NEGATIVE] = {false, false, true, " and >= 0"},
  [BAUM_I_RULE_NOT_ZERO] = {false, true, false, " and not 0"},
  [BAUM_I_RULE_OPTIONAL] = {true, true, true, ", or NaN if not given"},
  [BAUM_I_RULE_FREE] = {true, true, true, ", or NaN if free"},
  [BAUM_I_RULE_OPTIONAL_POSITIVE] = {true, false, false, " and > 0"},
  [BAUM_I_RULE_OPTIONAL_NOT_NEGATIVE] = {true, false, true, " and >= 0"},
  [BAUM_I_RULE_POINT] = {false, true, true, ""},
  [BAUM_I_RULE_DIRECTION] = {false, true, true, ""},
};

static bool is_allowed(baum_i_rule rule, double value)
{
  bool fine =
    isfinite(value) && (value >= 0.0 || rules[rule].negative) && (value != 0.0 || rules[rule].zero);
  return fine || (isnan(value) && rules[rule].nan);
}

baum_status baum_i_check_number(const char *label, const char *field, const char *unit,
                                baum_i_rule rule, double value)
{
  if (is_allowed(rule, value)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %g%s%s, must be finite%s", label, field, value,
                     unit[0] ? " " : "", unit, rules[rule].remedy);
}

/* Check number k of a field with several numbers. */
static baum_status check_entry(const baum_i_def_field *f, const double *values, int k,
                               const char *label)
{
  if (is_allowed(f->rule, values[k])) {
    return BAUM_OK;
  }
  return baum_i_check_number(label, baum_i_text_of("%s[%d]", f->name, k).text, f->unit, f->rule,
                             values[k]);
}

static baum_status check_numbers(const baum_i_def_field *f, const double *values, const char *label)
{
  const int count = (int)(f->size / sizeof *values);
  if (count == 1) {
    return baum_i_check_number(label, f->name, f->unit, f->rule, values[0]);
  }
  int absent = 0;
  int zeros = 0;
  for (int k = 0; k < count; k++) {
    absent += isnan(values[k]) ? 1 : 0;
    zeros += values[k] == 0.0 ? 1 : 0;
  }
  if (f->rule == BAUM_I_RULE_POINT && absent == count) {
    return BAUM_OK;
  }
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(check_entry(f, values, k, label));
  }
  if (f->rule == BAUM_I_RULE_DIRECTION && zeros == count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %s, which has no direction", label, f->name,
                       count == 2 ? "(0, 0)" : "(0, 0, 0)");
  }
  return BAUM_OK;
}

/* ---- pointers ---- */

static const void *pointer_at(const baum_i_def_field *f, const void *def)
{
  const void *pointer;
  memcpy(&pointer, baum_i_field_at(f, def), sizeof pointer);
  return pointer;
}

static void set_pointer(const baum_i_def_field *f, void *def, const void *pointer)
{
  memcpy((char *)def + f->offset, &pointer, sizeof pointer);
}

/* Return how many numbers or ids an array contains. */
static int32_t count_of(const baum_i_def_field *f, const void *def)
{
  const char *bytes = def;
  const int32_t *counter = (const int32_t *)(const void *)(bytes + f->counter);
  const int32_t *instead = (const int32_t *)(const void *)(bytes + f->instead);
  return (*counter != 0 ? *counter : *instead) * baum_i_field_stride(f);
}

static bool has_function(const baum_i_def_field *f, const void *def)
{
  void (*function)(void);
  memcpy(&function, baum_i_field_at(f, def), sizeof function);
  return function != NULL;
}

bool baum_i_fields_have_function(const baum_i_definition *definition, const void *def)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    if (f->kind >= BAUM_I_FIELD_FUNCTION && f->kind < BAUM_I_FIELD_USER && has_function(f, def)) {
      return true;
    }
  }
  return false;
}

static baum_status check_array(const baum_i_def_field *f, const void *def, const char *label)
{
  const double *values = pointer_at(f, def);
  const int count = values ? count_of(f, def) : 0;
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(check_entry(f, values, k, label));
  }
  return BAUM_OK;
}

baum_status baum_i_check_given(const char *label, const char *field, bool given)
{
  return given ? BAUM_OK
               : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is NULL, must be given", label, field);
}

baum_status baum_i_check_points_given(const char *label, bool point, bool a, bool b,
                                      bool point_allowed)
{
  if (point && (a || b)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: point and %s are both given; give point alone, or point_a and point_b",
                       label, a ? "point_a" : "point_b");
  }
  if (a != b) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is given, but not %s", label,
                       a ? "point_a" : "point_b", a ? "point_b" : "point_a");
  }
  return point || a
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: no point is given; give %spoint_a and point_b",
                         label, point_allowed ? "point, or " : "");
}

static baum_status check_function(const baum_i_def_field *f, const void *def, const char *label)
{
  return baum_i_check_given(label, baum_i_text_of("%s()", f->name).text, has_function(f, def));
}

/* ---- counts and ids ---- */

static baum_status check_count(const char *label, const char *field, int32_t value)
{
  if (value <= 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %d, must be > 0", label, field, (int)value);
  }
  if (value > COUNT_MAX) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %d, must be at most %d", label, field,
                       (int)value, (int)COUNT_MAX);
  }
  return BAUM_OK;
}

static baum_status check_one_of_bodies(const baum_mechanism *mechanism, const baum_body_id *bodies,
                                       int k, const char *label)
{
  const baum_i_text field = baum_i_text_of("bodies[%d]", k);
  BAUM_I_TRY(baum_i_check_body(mechanism, bodies[k], label, field.text));
  if (baum_i_body_index(mechanism, bodies[k]) == 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is ground, which has no coordinates", label,
                       field.text);
  }
  for (int i = 0; i < k; i++) {
    if (bodies[i].index1 == bodies[k].index1) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: bodies[%d] and %s are the same body", label, i,
                         field.text);
    }
  }
  return BAUM_OK;
}

static baum_status check_bodies(const baum_i_def_field *f, const baum_mechanism *mechanism,
                                const void *def, const char *label)
{
  const baum_body_id *bodies = pointer_at(f, def);
  const int32_t count = count_of(f, def);
  BAUM_I_TRY(check_count(label, "body_count", count));
  BAUM_I_TRY(baum_i_check_given(label, f->name, bodies != NULL));
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(check_one_of_bodies(mechanism, bodies, k, label));
  }
  return BAUM_OK;
}

static baum_status check_path(const baum_i_def_field *f, const baum_mechanism *mechanism,
                              const void *def, const char *label)
{
  const baum_body_id *bodies = pointer_at(f, def);
  const int32_t count = count_of(f, def);
  if (count < 2) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: point_count is %d, must be at least 2", label,
                       (int)count);
  }
  BAUM_I_TRY(check_count(label, "point_count", count));
  BAUM_I_TRY(baum_i_check_given(label, f->name, bodies != NULL));
  for (int k = 0; k < count; k++) {
    const baum_i_text field = baum_i_text_of("%s[%d]", f->name, k);
    BAUM_I_TRY(baum_i_check_body(mechanism, bodies[k], label, field.text));
  }
  return BAUM_OK;
}

static baum_status check_points(const baum_i_def_field *f, const void *def, const char *label)
{
  const double *values = pointer_at(f, def);
  const int32_t count = count_of(f, def);
  BAUM_I_TRY(baum_i_check_given(label, f->name, values != NULL));
  for (int32_t k = 0; k < count; k++) {
    const baum_i_text field = baum_i_text_of("%s[%d][%d]", f->name, (int)k / 3, (int)k % 3);
    BAUM_I_TRY(baum_i_check_number(label, field.text, "m", f->rule, values[k]));
  }
  return BAUM_OK;
}

/* ---- all fields ---- */

/* Check the fields that give the lengths of arrays. */
static baum_status check_counts(const baum_i_definition *definition, const void *def,
                                const char *label)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    bool counts = f->kind == BAUM_I_FIELD_COUNT || f->kind == BAUM_I_FIELD_OPTIONAL_COUNT;
    int32_t count = counts ? *(const int32_t *)baum_i_field_at(f, def) : 0;
    if (f->kind == BAUM_I_FIELD_COUNT || count != 0) {
      BAUM_I_TRY(check_count(label, f->name, count));
    }
  }
  return BAUM_OK;
}

static baum_status check_input(const baum_mechanism *mechanism, const baum_input_id *id,
                               const char *label, const char *field)
{
  bool none = id->index1 == 0 && id->tag == 0;
  return none ? BAUM_OK : baum_i_check_input(mechanism, *id, label, field);
}

/* Refuse a definition that gives a law and also one of the numbers that the law replaces. */
static baum_status check_law(const baum_i_definition *definition, const void *def,
                             const char *label)
{
  const baum_i_def_field *law = definition->fields;
  while (law->name && !(law->kind == BAUM_I_FIELD_LAW && has_function(law, def))) {
    law++;
  }
  for (const baum_i_def_field *f = definition->fields; law->name && f->name; f++) {
    if (f->kind == BAUM_I_FIELD_NUMBERS && f->offset >= law->counter) {
      const double value = *(const double *)baum_i_field_at(f, def);
      const double usual = baum_i_field_default(f, 0);
      if (value != usual && !(isnan(value) && isnan(usual))) {
        return baum_i_fail(BAUM_ERR_ARGUMENT,
                           "%s: %s is %g, but law is given, which replaces %s; give only one of "
                           "them",
                           label, f->name, value, f->name);
      }
    }
  }
  return BAUM_OK;
}

static baum_status check_field(const baum_i_def_field *f, const baum_mechanism *mechanism,
                               const void *def, const char *label)
{
  const void *at = baum_i_field_at(f, def);
  switch ((int)f->kind) {
  case BAUM_I_FIELD_NUMBERS: return check_numbers(f, at, label);
  case BAUM_I_FIELD_ARRAY: return check_array(f, def, label);
  case BAUM_I_FIELD_BODY:
  case BAUM_I_FIELD_CARRIER:
    return baum_i_check_body(mechanism, *(const baum_body_id *)at, label, f->name);
  case BAUM_I_FIELD_BODIES: return check_bodies(f, mechanism, def, label);
  case BAUM_I_FIELD_PATH: return check_path(f, mechanism, def, label);
  case BAUM_I_FIELD_POINTS: return check_points(f, def, label);
  case BAUM_I_FIELD_JOINT:
    return baum_i_check_joint(mechanism, *(const baum_joint_id *)at, label, f->name);
  case BAUM_I_FIELD_INPUT: return check_input(mechanism, at, label, f->name);
  case BAUM_I_FIELD_FUNCTION: return check_function(f, def, label);
  /* every value of this field is allowed, or the definition has its own check of the field */
  default: return BAUM_OK;
  }
}

baum_status baum_i_fields_check(const baum_i_definition *definition,
                                const baum_mechanism *mechanism, const void *def, const char *label)
{
  BAUM_I_TRY(check_counts(definition, def, label));
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    BAUM_I_TRY(check_field(f, mechanism, def, label));
  }
  BAUM_I_TRY(check_law(definition, def, label));
  return definition->check ? definition->check(mechanism, def, label) : BAUM_OK;
}

static bool is_kept(const baum_i_def_field *f, const void *present, const void *next)
{
  switch ((int)f->kind) {
  case BAUM_I_FIELD_COUNT:
  case BAUM_I_FIELD_OPTIONAL_COUNT:
  case BAUM_I_FIELD_JOINT:
    return memcmp(baum_i_field_at(f, present), baum_i_field_at(f, next), f->size) == 0;
  case BAUM_I_FIELD_KEPT_FUNCTION: return has_function(f, present) == has_function(f, next);
  default: return true;
  }
}

baum_status baum_i_fields_check_kept(const baum_i_definition *definition, const void *present,
                                     const void *next, const char *label)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    if (!is_kept(f, present, next)) {
      const int32_t *count = baum_i_field_at(f, present);
      return f->kind == BAUM_I_FIELD_COUNT
               ? baum_i_fail(BAUM_ERR_ARGUMENT, "%s: its %s is %d and cannot change", label,
                             f->name, (int)*count)
               : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: its %s cannot change", label, f->name);
    }
  }
  return BAUM_OK;
}

/* ---- copies ---- */

static size_t entry_size(const baum_i_def_field *f)
{
  switch ((int)f->kind) {
  case BAUM_I_FIELD_ARRAY:
  case BAUM_I_FIELD_POINTS: return sizeof(double);
  case BAUM_I_FIELD_BODIES:
  case BAUM_I_FIELD_PATH: return sizeof(baum_body_id);
  default: return 0;
  }
}

void baum_i_fields_release(const baum_i_definition *definition, void *def)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    if (entry_size(f) > 0) {
      baum_i_free(pointer_at(f, def));
      set_pointer(f, def, NULL);
    }
  }
  if (definition->release) {
    definition->release(def);
  }
}

/* Replace each array by a copy, or by NULL when out of memory. */
static bool own_arrays(const baum_i_definition *definition, void *def)
{
  bool complete = true;
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    const void *given = entry_size(f) > 0 ? pointer_at(f, def) : NULL;
    if (given) {
      void *copy = baum_i_copy(given, (size_t)count_of(f, def), entry_size(f));
      set_pointer(f, def, copy);
      complete = complete && copy;
    }
  }
  return complete;
}

baum_status baum_i_fields_own(const baum_i_definition *definition, void *def)
{
  /* own() is called before arrays are copied. If it fails, there are no copies that would have to
   * be freed. */
  if (definition->own) {
    BAUM_I_TRY(definition->own(def));
  }
  if (own_arrays(definition, def)) {
    return BAUM_OK;
  }
  baum_i_fields_release(definition, def);
  return BAUM_ERR_MEMORY;
}

/* ---- digest and bodies ---- */

void baum_i_fields_digest(const baum_i_definition *definition, const void *def, baum_i_digest *sum)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    const void *at = baum_i_field_at(f, def);
    if (f->kind == BAUM_I_FIELD_FLAG) {
      baum_i_digest_add_integer(sum, *(const bool *)at);
    } else if (f->kind == BAUM_I_FIELD_OWN_COUNT || f->kind == BAUM_I_FIELD_COORDINATE) {
      baum_i_digest_add_integer(sum, *(const int32_t *)at);
    } else if (f->kind == BAUM_I_FIELD_JOINT) {
      baum_i_digest_add_integer(sum, ((const baum_joint_id *)at)->index1);
    } else if (f->kind == BAUM_I_FIELD_INPUT) {
      baum_i_digest_add_integer(sum, ((const baum_input_id *)at)->index1);
    } else if (f->kind == BAUM_I_FIELD_OWN_ARRAY || f->kind == BAUM_I_FIELD_POINTS) {
      size_t count = (size_t)count_of(f, def);
      baum_i_digest_add(sum, pointer_at(f, def), count * sizeof(double));
    } else if (f->kind == BAUM_I_FIELD_PATH) {
      const baum_body_id *bodies = pointer_at(f, def);
      for (int32_t k = 0; k < count_of(f, def); k++) {
        baum_i_digest_add_integer(sum, bodies[k].index1);
      }
    }
  }
}

/* A list of bodies that grows. The ids of these bodies have been checked. */
typedef struct list {
  int count;
  int *bodies; /* if NULL, bodies are only counted, and a repeated body is counted again */
} list;

static void include(list *all, int body)
{
  for (int k = 0; all->bodies && k < all->count; k++) {
    if (all->bodies[k] == body) {
      return;
    }
  }
  if (all->bodies) {
    all->bodies[all->count] = body;
  }
  all->count++;
}

static void include_all(list *all, const baum_mechanism *mechanism, const baum_body_id *ids,
                        int count)
{
  for (int k = 0; k < count; k++) {
    include(all, baum_i_body_index(mechanism, ids[k]));
  }
}

int baum_i_fields_bodies(const baum_i_definition *definition, const baum_mechanism *mechanism,
                         const void *def, int *bodies)
{
  list all = {0, bodies};
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    if (f->kind == BAUM_I_FIELD_BODY || f->kind == BAUM_I_FIELD_CARRIER) {
      include_all(&all, mechanism, baum_i_field_at(f, def), 1);
    } else if (baum_i_field_has_bodies(f)) {
      include_all(&all, mechanism, pointer_at(f, def), count_of(f, def));
    } else if (f->kind == BAUM_I_FIELD_JOINT) {
      const baum_joint_id *id = baum_i_field_at(f, def);
      const baum_i_span *span = &mechanism->joints[id->index1 - 1]->span;
      for (int k = 0; k < span->body_count; k++) {
        include(&all, span->bodies[k]);
      }
    }
  }
  return all.count;
}
