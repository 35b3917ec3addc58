/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes a mechanism as a scene: one line for each element, without the fields that have their
 * default values. */
#include <math.h>
#include <string.h>

#include <baum/version.h>

#include "base/buffer.h"
#include "base/file.h"
#include "base/message.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/identify.h"
#include "scene/scene.h"

typedef struct writer {
  const baum_mechanism *mechanism;
  const baum_hook *hooks;
  int hook_count;
  bool addresses; /* write addresses of functions in place of names */
  baum_i_scene_names names;
  baum_i_buffer *out;
  const baum_i_element *element; /* the element that is being written */
} writer;

/* ---- values ---- */

static void put_text(writer *w, const char *text)
{
  baum_i_put(w->out, "\"");
  baum_i_put_user_text(w->out, text, BAUM_I_JSON);
  baum_i_put(w->out, "\"");
}

static void put_key(writer *w, const char *key)
{
  baum_i_putf(w->out, ", \"%s\": ", key);
}

static void put_number(writer *w, double x)
{
  baum_i_put(w->out, baum_i_exact(x, "null").text);
}

/* Write numbers as a list, or as a list of rows if `width` is not 0. */
static void put_numbers(writer *w, const double *x, int count, int width)
{
  baum_i_put(w->out, "[");
  for (int k = 0; k < count; k++) {
    bool begins = width > 0 && k % width == 0;
    baum_i_putf(w->out, "%s%s", k > 0 ? ", " : "", begins ? "[" : "");
    put_number(w, x[k]);
    baum_i_put(w->out, width > 0 && k % width == width - 1 ? "]" : "");
  }
  baum_i_put(w->out, "]");
}

/* Write a reference to a body: its name, or its number (from 0) if another body or ground has the
 * same name. */
static void put_body(writer *w, baum_body_id id)
{
  int index = baum_i_body_index(w->mechanism, id);
  const char *name = w->mechanism->bodies[index]->element.name;
  if (baum_i_scene_find_body(&w->names, name) == index) {
    put_text(w, name);
  } else {
    baum_i_putf(w->out, "%d", index - 1);
  }
}

static void put_joint(writer *w, baum_joint_id id)
{
  const baum_mechanism *m = w->mechanism;
  int k = baum_i_joint_index(m, id);
  const char *name = m->joints[k]->element.name;
  int same = 0;
  for (int i = 0; i < m->joint_count; i++) {
    same += strcmp(m->joints[i]->element.name, name) == 0;
  }
  if (same == 1) {
    put_text(w, name);
  } else {
    baum_i_putf(w->out, "%d", k);
  }
}

/* ---- functions ---- */

static baum_hook_fn *function_at(const baum_i_def_field *f, const void *def)
{
  baum_hook_fn *function;
  memcpy(&function, baum_i_field_at(f, def), sizeof function);
  return function;
}

static void *pointer_at(const baum_i_def_field *f, const void *def)
{
  void *pointer;
  memcpy(&pointer, baum_i_field_at(f, def), sizeof pointer);
  return pointer;
}

static baum_status put_hook(writer *w, const baum_i_def_field *f, const void *def)
{
  const bool is_user = f->kind == BAUM_I_FIELD_USER;
  baum_hook_fn *function = is_user ? NULL : function_at(f, def);
  void *user = is_user ? pointer_at(f, def) : NULL;
  if (!function && !user) {
    return BAUM_OK;
  }
  if (w->addresses) {
    unsigned char bytes[sizeof(function)];
    memcpy(bytes, baum_i_field_at(f, def), sizeof bytes);
    put_key(w, f->name);
    for (size_t k = 0; k < sizeof bytes; k++) {
      baum_i_putf(w->out, "%02x", bytes[k]);
    }
    return BAUM_OK;
  }
  for (int k = 0; k < w->hook_count; k++) {
    const baum_hook *hook = &w->hooks[k];
    if (hook->function == function && hook->user == user) {
      put_key(w, f->name);
      put_text(w, hook->name);
      return BAUM_OK;
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: %s is a %s, which a scene can contain only by name; give a hook for it",
                     baum_i_label(w->element).text, f->name, is_user ? "pointer" : "function");
}

/* ---- fields ---- */

static bool equals_default(const baum_i_def_field *f, const double *x)
{
  bool equal = true;
  for (size_t k = 0; k < f->size / sizeof *x; k++) {
    const double value = baum_i_field_default(f, k);
    equal = equal &&
            ((isnan(x[k]) && isnan(value)) || (x[k] == value && signbit(x[k]) == signbit(value)));
  }
  return equal;
}

static void put_number_field(writer *w, const baum_i_def_field *f, const double *x)
{
  if (equals_default(f, x)) {
    return;
  }
  put_key(w, f->name);
  if (f->size == sizeof *x) {
    put_number(w, *x);
  } else {
    put_numbers(w, x, (int)(f->size / sizeof *x), 0);
  }
}

static void put_bodies(writer *w, const baum_body_id *ids, int count)
{
  for (int k = 0; k < count; k++) {
    baum_i_put(w->out, k > 0 ? ", " : "[");
    put_body(w, ids[k]);
  }
  baum_i_put(w->out, "]");
}

static void put_array(writer *w, const baum_i_def_field *f, void *def)
{
  const void *values = pointer_at(f, def);
  if (values) {
    put_key(w, f->name);
    const int count = *baum_i_scene_counter(f, def) * baum_i_field_stride(f);
    if (baum_i_field_has_bodies(f)) {
      put_bodies(w, values, count);
    } else {
      put_numbers(w, values, count, 0);
    }
  }
}

static void put_flag(writer *w, const baum_i_def_field *f, bool value, bool usual)
{
  if (value != usual) {
    put_key(w, f->name);
    baum_i_put(w->out, value ? "true" : "false");
  }
}

static void put_count(writer *w, const baum_i_def_field *f, int32_t value)
{
  if (value != 0 && !baum_i_scene_is_derived(w->element->definition, f)) {
    put_key(w, f->name);
    baum_i_putf(w->out, "%d", (int)value);
  }
}

static void put_coordinate(writer *w, const baum_i_def_field *f, baum_joint_coordinate which)
{
  if (which != BAUM_COORDINATE_FIRST) {
    put_key(w, f->name);
    put_text(w, baum_i_coordinate_name(which));
  }
}

static void put_input(writer *w, const baum_i_def_field *f, baum_input_id id)
{
  if (id.index1 != 0) {
    put_key(w, f->name);
    baum_i_putf(w->out, "%d", (int)id.index1 - 1);
  }
}

static void put_reference(writer *w, const baum_i_def_field *f, const void *at)
{
  if (f->kind == BAUM_I_FIELD_COORDINATE) {
    put_coordinate(w, f, *(const baum_joint_coordinate *)at);
  } else if (f->kind == BAUM_I_FIELD_INPUT) {
    put_input(w, f, *(const baum_input_id *)at);
  } else {
    put_key(w, f->name);
    if (f->kind == BAUM_I_FIELD_JOINT) {
      put_joint(w, *(const baum_joint_id *)at);
    } else {
      put_body(w, *(const baum_body_id *)at);
    }
  }
}

static baum_status put_field(writer *w, const baum_i_def_field *f, void *def)
{
  const void *at = baum_i_field_at(f, def);
  if (f->kind >= BAUM_I_FIELD_FUNCTION) {
    return put_hook(w, f, def);
  }
  if (baum_i_scene_is_array(f)) {
    put_array(w, f, def);
  } else if (f->kind >= BAUM_I_FIELD_BODY) {
    put_reference(w, f, at);
  } else if (f->kind >= BAUM_I_FIELD_FLAG) {
    put_flag(w, f, *(const bool *)at, f->kind == BAUM_I_FIELD_CLAIM);
  } else if (f->kind == BAUM_I_FIELD_NUMBERS) {
    put_number_field(w, f, at);
  } else {
    put_count(w, f, *(const int32_t *)at);
  }
  return BAUM_OK;
}

/* ---- outlines ---- */

static void put_triangles(writer *w, const baum_outline *o)
{
  put_key(w, "triangles");
  for (int k = 0; k < o->triangle_count; k++) {
    const int32_t *t = o->triangles + 3 * (size_t)k;
    baum_i_putf(w->out, "%s[%d, %d, %d]", k > 0 ? ", " : "[", (int)t[0], (int)t[1], (int)t[2]);
  }
  baum_i_put(w->out, "]");
}

static void put_outline(writer *w, const baum_outline *o)
{
  baum_i_put(w->out, "{\"form\": ");
  put_text(w, baum_i_scene_forms[o->form]);
  if (o->points) {
    put_key(w, "points");
    put_numbers(w, o->points, 3 * o->point_count, 3);
  }
  if (o->triangles) {
    put_triangles(w, o);
  }
  for (const baum_i_def_field *f = baum_i_scene_outline_fields; f->name; f++) {
    put_number_field(w, f, baum_i_field_at(f, o));
  }
  if (o->color) {
    put_key(w, "color");
    put_text(w, o->color);
  }
  baum_i_put(w->out, "}");
}

static void put_outlines(writer *w, const baum_i_body *body)
{
  for (int k = 0; k < body->outline_count; k++) {
    baum_i_put(w->out, k > 0 ? ", " : "[");
    put_outline(w, &body->outlines[k]);
  }
  baum_i_put(w->out, "]");
}

/* ---- elements ---- */

static const char *kind_name(const baum_i_definition *definition)
{
  const baum_i_scene_kind *kind = baum_i_scene_kinds;
  while (*kind->definition != definition) {
    kind++;
  }
  return kind->name;
}

static baum_status put_element(writer *w, const baum_i_element *element)
{
  w->element = element;
  baum_i_putf(w->out, "{\"kind\": \"%s\"", kind_name(element->definition));
  if (((const baum_i_def_head *)element->def)->name) {
    put_key(w, "name");
    put_text(w, element->name);
  }
  for (const baum_i_def_field *f = element->definition->fields; f->name; f++) {
    BAUM_I_TRY(put_field(w, f, element->def));
  }
  if (strcmp(element->family, "body") == 0) {
    const baum_i_body *body = (const baum_i_body *)(const void *)element;
    if (body->outline_count > 0) {
      put_key(w, "outlines");
      put_outlines(w, body);
    }
  }
  baum_i_put(w->out, "}");
  return BAUM_OK;
}

static baum_status put_family(writer *w, const baum_i_family *family)
{
  const int count = baum_i_family_count(family, w->mechanism);
  baum_i_putf(w->out, ",\n  \"%s\": [", baum_i_scene_list(family));
  for (int k = 0; k < count; k++) {
    baum_i_put(w->out, k > 0 ? ",\n    " : "\n    ");
    BAUM_I_TRY(put_element(w, family->at(w->mechanism, k)));
  }
  baum_i_put(w->out, count > 0 ? "\n  ]" : "]");
  return BAUM_OK;
}

/* ---- the mechanism ---- */

static void put_inputs(writer *w)
{
  const baum_mechanism *m = w->mechanism;
  baum_i_put(w->out, ",\n  \"inputs\": [");
  for (int k = 0; k < m->input_count; k++) {
    baum_i_put(w->out, k > 0 ? ",\n    {\"name\": " : "\n    {\"name\": ");
    put_text(w, m->input_names[k]);
    put_key(w, "initial");
    put_number(w, m->inputs[k]);
    baum_i_put(w->out, "}");
  }
  baum_i_put(w->out, m->input_count > 0 ? "\n  ]" : "]");
}

static void put_settings(writer *w)
{
  const baum_mechanism *m = w->mechanism;
  baum_i_putf(w->out, "{\n  \"" BAUM_I_SCENE_KEY "\": %d,\n  \"gravity\": ", BAUM_I_SCENE_VERSION);
  put_numbers(w, m->gravity, 3, 0);
  if (!isnan(m->given_length)) {
    baum_i_put(w->out, ",\n  \"characteristic_length\": ");
    put_number(w, m->given_length);
  }
  if (m->break_count > 0) {
    baum_i_put(w->out, ",\n  \"break_times\": ");
    put_numbers(w, m->breaks, m->break_count, 0);
  }
  if (m->bodies[0]->outline_count > 0) {
    baum_i_put(w->out, ",\n  \"ground_outlines\": ");
    put_outlines(w, m->bodies[0]);
  }
  if (m->input_count > 0) {
    put_inputs(w);
  }
}

static baum_status put_mechanism(writer *w)
{
  put_settings(w);
  for (int i = 0; i < BAUM_I_FAMILIES; i++) {
    BAUM_I_TRY(put_family(w, baum_i_families[i]));
  }
  baum_i_put(w->out, "\n}\n");
  return w->out->failed ? baum_i_fail_memory() : BAUM_OK;
}

/* Write the whole scene into a zeroed buffer. After a failure the buffer is empty. */
static baum_status print(writer *w, baum_i_buffer *out)
{
  w->out = out;
  baum_status status = baum_i_scene_names_create(w->mechanism, &w->names);
  if (status == BAUM_OK) {
    status = put_mechanism(w);
  }
  baum_i_scene_names_release(&w->names);
  if (status != BAUM_OK) {
    baum_i_buffer_clear(out);
  }
  return status;
}

/* ---- public ---- */

baum_status baum_mechanism_print(const baum_mechanism *mechanism, const baum_hook *hooks,
                                 int32_t hook_count, char *text, size_t capacity, size_t *size)
{
  const char *call = "baum_mechanism_print";
  writer w = {.mechanism = mechanism, .hooks = hooks, .hook_count = hook_count};
  baum_i_buffer whole = {0};
  BAUM_I_TRY(baum_i_scene_check_call(call, mechanism != NULL, hooks, hook_count));
  BAUM_I_TRY(print(&w, &whole));
  baum_status status = baum_i_give_text(&whole, call, text, capacity, size);
  baum_i_buffer_clear(&whole);
  return status;
}

baum_status baum_mechanism_write(const baum_mechanism *mechanism, const baum_hook *hooks,
                                 int32_t hook_count, const char *path)
{
  const char *call = "baum_mechanism_write";
  writer w = {.mechanism = mechanism, .hooks = hooks, .hook_count = hook_count};
  baum_i_buffer whole = {0};
  BAUM_I_TRY(baum_i_scene_check_call(call, mechanism != NULL, hooks, hook_count));
  BAUM_I_TRY(print(&w, &whole));
  baum_status status = baum_i_give_file(&whole, call, path);
  baum_i_buffer_clear(&whole);
  return status;
}

baum_status baum_mechanism_compare(const baum_mechanism *a, const baum_mechanism *b, bool *equal)
{
  const char *call = "baum_mechanism_compare";
  BAUM_I_TRY(baum_i_scene_check_call(call, a && b, NULL, 0));
  if (!equal) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: equal is NULL", call);
  }
  writer left = {.mechanism = a, .addresses = true};
  writer right = {.mechanism = b, .addresses = true};
  baum_i_buffer texts[2] = {{0}, {0}};
  baum_status status = print(&left, &texts[0]);
  if (status == BAUM_OK) {
    status = print(&right, &texts[1]);
  }
  if (status == BAUM_OK) {
    *equal = strcmp(texts[0].text, texts[1].text) == 0;
  }
  baum_i_buffer_clear(&texts[0]);
  baum_i_buffer_clear(&texts[1]);
  return status;
}
