/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads a scene, which is a mechanism as a JSON text. Elements and settings pass the same checks as
 * those that a program adds. */
#include <string.h>

#include <baum/breaks.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/nearest.h"
#include "base/text.h"
#include "mechanism/definition.h"
#include "scene/reader.h"

/* ---- arrays ---- */

static baum_status fill_array(const baum_i_scene_reader *r, const baum_i_def_field *f,
                              const baum_i_json_node *list, void *array)
{
  if (!baum_i_field_has_bodies(f)) {
    return baum_i_scene_read_numbers(r, list, (int)list->count, array);
  }
  baum_body_id *ids = array;
  const baum_i_json_node *node = baum_i_json_first(r->json, list);
  for (int k = 0; k < list->count; k++, node = baum_i_json_next(r->json, node)) {
    BAUM_I_TRY(baum_i_scene_read_body(r, node, &ids[k]));
  }
  return BAUM_OK;
}

/* Read an array into memory that free_arrays() frees. The length of the array must agree with the
 * field that gives its count. If the scene does not contain this field, set the field according to
 * the length. */
static baum_status read_array(const baum_i_scene_reader *r, const baum_i_definition *definition,
                              const baum_i_def_field *f, const baum_i_json_node *list, void *def)
{
  if (list->kind != BAUM_I_JSON_LIST || list->count == 0) {
    return baum_i_scene_fail_kind(r, list, "a list that is not empty");
  }
  int32_t *count = baum_i_scene_counter(f, def);
  const int64_t stride = baum_i_field_stride(f);
  if (*count == 0 && baum_i_scene_derives(definition, f)) {
    *count = (int32_t)(list->count / stride);
  }
  if (*count * stride != list->count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: \"%.60s\" has %d entries, must have %lld",
                       r->label, list->line, list->key, (int)list->count,
                       (long long)(*count * stride));
  }
  void *array = baum_i_alloc((size_t)list->count, sizeof(double));
  BAUM_I_TRY(baum_i_check_memory(array));
  memcpy((char *)def + f->offset, &array, sizeof array);
  return fill_array(r, f, list, array);
}

static void free_arrays(const baum_i_definition *definition, void *def)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    if (baum_i_scene_is_array(f)) {
      void *array;
      memcpy(&array, (char *)def + f->offset, sizeof array);
      baum_i_free(array);
    }
  }
}

/* ---- elements ---- */

/* Name an element in the message of a failure, after the number of the line: a text may have all
 * elements in one line. */
static baum_status add_element_name(const baum_i_scene_reader *r, const char *family, int number,
                                    const baum_i_json_node *object, baum_status status)
{
  if (status == BAUM_OK || status == BAUM_ERR_MEMORY) {
    return status;
  }
  const baum_i_json_node *name = baum_i_json_find(r->json, object, "name");
  const char *text = name && name->text ? name->text : "";
  const char *quote = text[0] ? "\"" : "";
  const baum_i_kept_message kept = baum_i_message_keep();
  const char *rest = strstr(kept.text + strlen(r->label) + 2, ": ") + 2;
  return baum_i_fail(status, "%.*s%s %d%s%s%.80s%s: %.600s", (int)(rest - kept.text), kept.text,
                     family, number, text[0] ? " " : "", quote, text, quote, rest);
}

/* If `arrays` is set, read all fields that are arrays, otherwise read all other fields. */
static baum_status read_fields(const baum_i_scene_reader *r, const baum_i_definition *definition,
                               const baum_i_json_node *object, bool arrays, void *def)
{
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    const baum_i_json_node *node = baum_i_json_find(r->json, object, f->name);
    if (node && baum_i_scene_is_array(f) == arrays) {
      BAUM_I_TRY(arrays ? read_array(r, definition, f, node, def)
                        : baum_i_scene_read_field(r, f, node, (char *)def + f->offset));
    }
  }
  return BAUM_OK;
}

static bool has_field(const baum_i_definition *definition, const char *key)
{
  const baum_i_def_field *f = definition->fields;
  while (f->name && strcmp(f->name, key) != 0) {
    f++;
  }
  return f->name != NULL;
}

static baum_status check_keys(const baum_i_scene_reader *r, const baum_i_scene_kind *kind,
                              const baum_i_json_node *object)
{
  const bool is_body = kind->family == &baum_i_body_family;
  for (const baum_i_json_node *node = baum_i_json_first(r->json, object); node;
       node = baum_i_json_next(r->json, node)) {
    bool common = strcmp(node->key, "kind") == 0 || strcmp(node->key, "name") == 0 ||
                  (is_body && strcmp(node->key, "outlines") == 0);
    if (!common && !has_field(*kind->definition, node->key)) {
      baum_i_nearest near = baum_i_nearest_to(node->key);
      for (const baum_i_def_field *f = (*kind->definition)->fields; f->name; f++) {
        baum_i_nearest_offer(&near, f->name);
      }
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: a %s has no field \"%.80s\"%s", r->label,
                         node->line, kind->name, node->key, baum_i_nearest_note(&near).text);
    }
  }
  return BAUM_OK;
}

static baum_status fail_kind(const baum_i_scene_reader *r, const baum_i_family *family, int line,
                             const char *name)
{
  baum_i_nearest near = baum_i_nearest_to(name);
  for (const baum_i_scene_kind *kind = baum_i_scene_kinds; kind->name; kind++) {
    if (kind->family == family) {
      baum_i_nearest_offer(&near, kind->name);
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: there is no %s of the kind \"%.80s\"%s",
                     r->label, line, family->name, name, baum_i_nearest_note(&near).text);
}

static baum_status find_kind(const baum_i_scene_reader *r, const baum_i_family *family,
                             const baum_i_json_node *object, const baum_i_scene_kind **out)
{
  const baum_i_json_node *node = baum_i_json_find(r->json, object, "kind");
  const char *name = NULL;
  if (object->kind != BAUM_I_JSON_OBJECT || !node) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: line %d: a %s must be an object with the field \"kind\"", r->label,
                       object->line, family->name);
  }
  BAUM_I_TRY(baum_i_scene_read_text(r, node, &name));
  const baum_i_scene_kind *kind = baum_i_scene_kinds;
  while (kind->name && !(kind->family == family && strcmp(kind->name, name) == 0)) {
    kind++;
  }
  *out = kind;
  return kind->name ? BAUM_OK : fail_kind(r, family, node->line, name);
}

static baum_status fill_definition(const baum_i_scene_reader *r,
                                   const baum_i_definition *definition,
                                   const baum_i_json_node *object, void *def)
{
  const baum_i_json_node *name = baum_i_json_find(r->json, object, "name");
  if (name) {
    BAUM_I_TRY(baum_i_scene_read_text(r, name, &((baum_i_def_head *)def)->name));
  }
  BAUM_I_TRY(read_fields(r, definition, object, false, def));
  return read_fields(r, definition, object, true, def);
}

static baum_status read_element(const baum_i_scene_reader *r, const baum_i_family *family,
                                const baum_i_json_node *object)
{
  const baum_i_scene_kind *kind = NULL;
  BAUM_I_TRY(find_kind(r, family, object, &kind));
  BAUM_I_TRY(check_keys(r, kind, object));
  const baum_i_definition *definition = *kind->definition;
  const int number = baum_i_family_count(family, r->mechanism) + 1;
  void *def = baum_i_alloc(1, definition->size);
  BAUM_I_TRY(baum_i_check_memory(def));
  baum_i_fields_set(definition, def);
  baum_status status = fill_definition(r, definition, object, def);
  status = add_element_name(r, family->name, number, object, status);
  if (status == BAUM_OK) {
    status = baum_i_add_element(r->mechanism, family, definition, def);
    status = baum_i_scene_add_line(r, object, status);
  }
  free_arrays(definition, def);
  baum_i_free(def);
  return status;
}

static baum_status read_family(const baum_i_scene_reader *r, const baum_i_family *family)
{
  const baum_i_json_node *list =
    baum_i_json_find(r->json, r->json->nodes, baum_i_scene_list(family));
  if (list && list->kind != BAUM_I_JSON_LIST) {
    return baum_i_scene_fail_kind(r, list, "a list");
  }
  for (const baum_i_json_node *node = baum_i_json_first(r->json, list); node;
       node = baum_i_json_next(r->json, node)) {
    BAUM_I_TRY(read_element(r, family, node));
  }
  return BAUM_OK;
}

/* ---- outlines ---- */

static baum_status read_outlines_of(const baum_i_scene_reader *r, const baum_i_json_node *list,
                                    baum_body_id body)
{
  baum_outline *outlines = NULL;
  BAUM_I_TRY(baum_i_scene_read_outlines(r, list, &outlines));
  baum_status status = baum_mechanism_set_outlines(r->mechanism, body, outlines, list->count);
  status = baum_i_scene_add_line(r, list, status);
  baum_i_scene_free_outlines(outlines, list->count);
  return status;
}

static baum_status read_all_outlines(const baum_i_scene_reader *r)
{
  const baum_i_json_node *whole = r->json->nodes;
  const baum_i_json_node *of_ground = baum_i_json_find(r->json, whole, "ground_outlines");
  if (of_ground) {
    BAUM_I_TRY(read_outlines_of(r, of_ground, BAUM_GROUND));
  }
  baum_body_id body = {1, r->mechanism->tag};
  const baum_i_json_node *list = baum_i_json_find(r->json, whole, "bodies");
  for (const baum_i_json_node *node = baum_i_json_first(r->json, list); node;
       node = baum_i_json_next(r->json, node), body.index1++) {
    const baum_i_json_node *outlines = baum_i_json_find(r->json, node, "outlines");
    if (outlines) {
      baum_status status = read_outlines_of(r, outlines, body);
      BAUM_I_TRY(add_element_name(r, "body", (int)body.index1, node, status));
    }
  }
  return BAUM_OK;
}

/* ---- settings and inputs ---- */

static baum_status check_version(const baum_i_scene_reader *r)
{
  const baum_i_json_node *whole = r->json->nodes;
  const baum_i_json_node *node = baum_i_json_find(r->json, whole, BAUM_I_SCENE_KEY);
  int32_t version = 0;
  if (whole->kind != BAUM_I_JSON_OBJECT || !node) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: line %d: this is not a scene: the key \"%s\" is missing", r->label,
                       whole->line, BAUM_I_SCENE_KEY);
  }
  BAUM_I_TRY(baum_i_scene_read_integer(r, node, &version));
  return version == BAUM_I_SCENE_VERSION
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: line %d: the scene has version %d, but this library reads %d",
                         r->label, node->line, (int)version, (int)BAUM_I_SCENE_VERSION);
}

static baum_status check_top(const baum_i_scene_reader *r)
{
  static const char *const keys[] = {BAUM_I_SCENE_KEY, "gravity",         "characteristic_length",
                                     "break_times",    "ground_outlines", "inputs",
                                     "bodies",         "joints",          "forces",
                                     "units"};
  const size_t count = sizeof keys / sizeof *keys;
  BAUM_I_TRY(check_version(r));
  for (const baum_i_json_node *node = baum_i_json_first(r->json, r->json->nodes); node;
       node = baum_i_json_next(r->json, node)) {
    baum_i_nearest near = baum_i_nearest_to(node->key);
    size_t k = 0;
    while (k < count && strcmp(keys[k], node->key) != 0) {
      baum_i_nearest_offer(&near, keys[k++]);
    }
    if (k == count) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: a scene has no field \"%.80s\"%s",
                         r->label, node->line, node->key, baum_i_nearest_note(&near).text);
    }
  }
  return BAUM_OK;
}

static baum_status read_breaks(const baum_i_scene_reader *r, const baum_i_json_node *list)
{
  double *times = baum_i_alloc((size_t)list->count, sizeof *times);
  BAUM_I_TRY(baum_i_check_memory(times));
  baum_status status = baum_i_scene_read_numbers(r, list, (int)list->count, times);
  if (status == BAUM_OK) {
    status = baum_i_scene_add_line(
      r, list, baum_mechanism_add_break_times(r->mechanism, times, list->count));
  }
  baum_i_free(times);
  return status;
}

static baum_status read_settings(const baum_i_scene_reader *r)
{
  const baum_i_json_node *whole = r->json->nodes;
  const baum_i_json_node *node = baum_i_json_find(r->json, whole, "units");
  const char *note = NULL; /* for people who read the scene; not used here */
  double g[3];
  if (node) {
    BAUM_I_TRY(baum_i_scene_read_text(r, node, &note));
  }
  node = baum_i_json_find(r->json, whole, "gravity");
  if (node) {
    BAUM_I_TRY(baum_i_scene_read_numbers(r, node, 3, g));
    BAUM_I_TRY(
      baum_i_scene_add_line(r, node, baum_mechanism_set_gravity(r->mechanism, g[0], g[1], g[2])));
  }
  node = baum_i_json_find(r->json, whole, "characteristic_length");
  if (node) {
    BAUM_I_TRY(baum_i_scene_read_numbers(r, node, 1, g));
    BAUM_I_TRY(
      baum_i_scene_add_line(r, node, baum_mechanism_set_characteristic_length(r->mechanism, g[0])));
  }
  node = baum_i_json_find(r->json, whole, "break_times");
  return node ? read_breaks(r, node) : BAUM_OK;
}

static baum_status read_one_input(const baum_i_scene_reader *r, const baum_i_json_node *object)
{
  const baum_i_json_node *name = baum_i_json_find(r->json, object, "name");
  const baum_i_json_node *initial = baum_i_json_find(r->json, object, "initial");
  const char *text = NULL;
  double value = 0.0;
  if (object->kind != BAUM_I_JSON_OBJECT || !name || !initial || object->count != 2) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: line %d: an input must be an object with \"name\" and \"initial\"",
                       r->label, object->line);
  }
  BAUM_I_TRY(baum_i_scene_read_text(r, name, &text));
  BAUM_I_TRY(baum_i_scene_read_numbers(r, initial, 1, &value));
  return baum_i_scene_add_line(r, object,
                               baum_mechanism_add_input(r->mechanism, text, value, NULL));
}

static baum_status read_inputs(const baum_i_scene_reader *r)
{
  const baum_i_json_node *list = baum_i_json_find(r->json, r->json->nodes, "inputs");
  if (list && list->kind != BAUM_I_JSON_LIST) {
    return baum_i_scene_fail_kind(r, list, "a list");
  }
  for (const baum_i_json_node *node = baum_i_json_first(r->json, list); node;
       node = baum_i_json_next(r->json, node)) {
    BAUM_I_TRY(read_one_input(r, node));
  }
  return BAUM_OK;
}

/* ---- the mechanism ---- */

static baum_status build(baum_i_scene_reader *r)
{
  BAUM_I_TRY(check_top(r));
  BAUM_I_TRY(read_settings(r));
  BAUM_I_TRY(read_inputs(r));
  BAUM_I_TRY(read_family(r, &baum_i_body_family));
  BAUM_I_TRY(baum_i_scene_names_create(r->mechanism, &r->names));
  BAUM_I_TRY(read_all_outlines(r));
  BAUM_I_TRY(read_family(r, &baum_i_joint_family));
  return read_family(r, &baum_i_force_family);
}

static baum_status parse(baum_i_scene_reader *r, const char *text, size_t size,
                         baum_mechanism **out)
{
  baum_i_json json;
  BAUM_I_TRY(baum_i_json_parse(text, size, r->label, &json));
  r->json = &json;
  baum_status status = baum_mechanism_create(&r->mechanism);
  if (status == BAUM_OK) {
    status = build(r);
  }
  if (status != BAUM_OK) {
    baum_mechanism_destroy(r->mechanism);
    r->mechanism = NULL;
  }
  *out = r->mechanism;
  baum_i_scene_names_release(&r->names);
  baum_i_json_release(&json);
  return status;
}

static baum_status check_out(const char *call, baum_mechanism **out)
{
  if (!out) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: out is NULL", call);
  }
  *out = NULL;
  return BAUM_OK;
}

baum_status baum_mechanism_parse(const char *text, size_t size, const baum_hook *hooks,
                                 int32_t hook_count, baum_mechanism **out)
{
  const char *call = "baum_mechanism_parse";
  baum_i_scene_reader r = {.label = "scene", .hooks = hooks, .hook_count = hook_count};
  BAUM_I_TRY(check_out(call, out));
  BAUM_I_TRY(baum_i_scene_check_call(call, true, hooks, hook_count));
  if (!text) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: text is NULL", call);
  }
  return parse(&r, text, size, out);
}

baum_status baum_mechanism_read(const char *path, const baum_hook *hooks, int32_t hook_count,
                                baum_mechanism **out)
{
  const char *call = "baum_mechanism_read";
  BAUM_I_TRY(check_out(call, out));
  BAUM_I_TRY(baum_i_scene_check_call(call, true, hooks, hook_count));
  baum_i_buffer whole = {0};
  BAUM_I_TRY(baum_i_read_file(path, call, &whole));
  const baum_i_text label = baum_i_text_of("%.200s", path);
  baum_i_scene_reader r = {.label = label.text, .hooks = hooks, .hook_count = hook_count};
  baum_status status = parse(&r, whole.text, whole.used, out);
  baum_i_buffer_clear(&whole);
  return status;
}
