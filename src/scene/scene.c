/* SPDX-License-Identifier: BSD-3-Clause */
#include "scene/scene.h"

#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/kinds.h"

#define KIND_ENTRY(FAMILY, NAME) {#NAME, &baum_i_##FAMILY##_family, &baum_i_##NAME##_definition},

const baum_i_scene_kind baum_i_scene_kinds[] = {BAUM_I_KINDS(KIND_ENTRY){NULL, NULL, NULL}};

const char *const baum_i_scene_forms[] = {
  [BAUM_OUTLINE_POLYGON] = "polygon", [BAUM_OUTLINE_CIRCLE] = "circle",
  [BAUM_OUTLINE_BOX] = "box",         [BAUM_OUTLINE_CYLINDER] = "cylinder",
  [BAUM_OUTLINE_SPHERE] = "sphere",   [BAUM_OUTLINE_MESH] = "mesh",
};

#define OUTLINE_NUMBERS(FIELD) BAUM_I_NUMBERS(baum_outline, FIELD, FINITE, "m", 0.0)

const baum_i_def_field baum_i_scene_outline_fields[] = {
  OUTLINE_NUMBERS(center), OUTLINE_NUMBERS(size),   OUTLINE_NUMBERS(start),
  OUTLINE_NUMBERS(end),    OUTLINE_NUMBERS(radius), {.name = NULL}};

const char *baum_i_scene_list(const baum_i_family *family)
{
  return family == &baum_i_body_family    ? "bodies"
         : family == &baum_i_joint_family ? "joints"
                                          : "forces";
}

baum_status baum_i_scene_check_call(const char *call, bool has_mechanism, const baum_hook *hooks,
                                    int32_t hook_count)
{
  if (!has_mechanism) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", call);
  }
  if (hook_count < 0 || (hook_count > 0 && !hooks)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s", call,
                       hook_count < 0 ? "hook_count is negative" : "hooks are NULL");
  }
  for (int32_t k = 0; k < hook_count; k++) {
    if (!hooks[k].name || !hooks[k].name[0] || !hooks[k].function == !hooks[k].user) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: hooks[%d] must have a name, and either a function or a user pointer",
                         call, (int)k);
    }
  }
  return BAUM_OK;
}

/* ---- fields ---- */

bool baum_i_scene_is_array(const baum_i_def_field *field)
{
  return field->kind == BAUM_I_FIELD_ARRAY || field->kind == BAUM_I_FIELD_OWN_ARRAY ||
         field->kind == BAUM_I_FIELD_POINTS || baum_i_field_has_bodies(field);
}

int32_t *baum_i_scene_counter(const baum_i_def_field *field, void *def)
{
  char *bytes = def;
  int32_t *counter = (int32_t *)(void *)(bytes + field->counter);
  int32_t *instead = (int32_t *)(void *)(bytes + field->instead);
  return *counter != 0 ? counter : instead;
}

bool baum_i_scene_is_derived(const baum_i_definition *definition, const baum_i_def_field *field)
{
  bool found = false;
  for (const baum_i_def_field *f = definition->fields; f->name; f++) {
    found = found || (baum_i_scene_is_array(f) && f->counter == field->offset);
  }
  return found && field->kind == BAUM_I_FIELD_OWN_COUNT;
}

bool baum_i_scene_derives(const baum_i_definition *definition, const baum_i_def_field *array)
{
  const baum_i_def_field *count = definition->fields;
  while (count->name && count->offset != array->counter) {
    count++;
  }
  return count->name && baum_i_scene_is_derived(definition, count);
}

/* ---- names of bodies ---- */

static int compare(const void *a, const void *b)
{
  const baum_i_element *const *left = a;
  const baum_i_element *const *right = b;
  return strcmp((*left)->name, (*right)->name);
}

baum_status baum_i_scene_names_create(const baum_mechanism *mechanism, baum_i_scene_names *out)
{
  *out = (baum_i_scene_names){.count = mechanism->body_count};
  out->sorted = baum_i_alloc((size_t)out->count, sizeof(void *));
  BAUM_I_TRY(baum_i_check_memory(out->sorted));
  for (int k = 0; k < out->count; k++) {
    out->sorted[k] = &mechanism->bodies[k + 1]->element;
  }
  qsort(out->sorted, (size_t)out->count, sizeof(void *), compare);
  return BAUM_OK;
}

void baum_i_scene_names_release(baum_i_scene_names *names)
{
  baum_i_free(names->sorted);
  *names = (baum_i_scene_names){0};
}

int baum_i_scene_find_body(const baum_i_scene_names *names, const char *name)
{
  if (strcmp(name, "ground") == 0) {
    return 0;
  }
  int low = 0;
  int high = names->count;
  while (low < high) { /* search for the first name that does not sort before `name` */
    int middle = low + (high - low) / 2;
    if (strcmp(names->sorted[middle]->name, name) < 0) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low == names->count || strcmp(names->sorted[low]->name, name) != 0) {
    return -1;
  }
  bool unique = low + 1 == names->count || strcmp(names->sorted[low + 1]->name, name) != 0;
  return unique ? names->sorted[low]->index : -2;
}
