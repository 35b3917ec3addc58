/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads the values of fields: numbers, references to other elements, and names of hooks (functions
 * and pointers of the user). */
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/nearest.h"
#include "base/platform.h"
#include "base/text.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/identify.h"
#include "scene/reader.h"

/* ---- messages ---- */

/* Put the line number of a node before the message of a call that failed. */
baum_status baum_i_scene_add_line(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                  baum_status status)
{
  if (status == BAUM_OK || status == BAUM_ERR_MEMORY) {
    return status;
  }
  const baum_i_kept_message kept = baum_i_message_keep();
  return baum_i_fail(status, "%s: line %d: %.900s", r->label, node->line, kept.text);
}

baum_status baum_i_scene_fail_kind(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                   const char *wanted)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: \"%.60s\" is %s, must be %s", r->label,
                     node->line, node->key ? node->key : "", baum_i_json_name(node), wanted);
}

/* ---- values ---- */

static bool is_number(const baum_i_json_node *node)
{
  return node->kind == BAUM_I_JSON_NUMBER || node->kind == BAUM_I_JSON_NULL;
}

static double number_of(const baum_i_json_node *node)
{
  return node->kind == BAUM_I_JSON_NULL ? (double)NAN : node->number;
}

baum_status baum_i_scene_read_numbers(const baum_i_scene_reader *r, const baum_i_json_node *list,
                                      int count, double *out)
{
  if (count == 1 && is_number(list)) {
    *out = number_of(list);
    return BAUM_OK;
  }
  if (list->kind != BAUM_I_JSON_LIST) {
    return baum_i_scene_fail_kind(r, list, count == 1 ? "a number" : "a list of numbers");
  }
  if (list->count != count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: \"%.60s\" has %d entries, must have %d",
                       r->label, list->line, list->key ? list->key : "", (int)list->count, count);
  }
  const baum_i_json_node *node = baum_i_json_first(r->json, list);
  for (int k = 0; k < count; k++, node = baum_i_json_next(r->json, node)) {
    if (!is_number(node)) {
      return baum_i_scene_fail_kind(r, list, "a list of numbers");
    }
    out[k] = number_of(node);
  }
  return BAUM_OK;
}

baum_status baum_i_scene_read_integer(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                      int32_t *out)
{
  if (node->kind != BAUM_I_JSON_NUMBER || node->number != floor(node->number) ||
      fabs(node->number) > INT32_MAX) {
    return baum_i_scene_fail_kind(r, node, "a whole number");
  }
  *out = (int32_t)node->number;
  return BAUM_OK;
}

baum_status baum_i_scene_read_text(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                   const char **out)
{
  *out = node->text;
  return node->kind == BAUM_I_JSON_TEXT ? BAUM_OK : baum_i_scene_fail_kind(r, node, "a text");
}

/* Read the number of an element, counted from 0. `count` is the number of elements of this kind
 * that have been read so far. */
static baum_status read_place(const baum_i_scene_reader *r, const baum_i_json_node *node, int count,
                              const char *what, int32_t *out)
{
  BAUM_I_TRY(baum_i_scene_read_integer(r, node, out));
  return *out >= 0 && *out < count
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: %s %d does not exist before this element",
                         r->label, node->line, what, (int)*out);
}

static baum_status fail_name(const baum_i_scene_reader *r, const baum_i_json_node *node,
                             const baum_i_family *family, const char *where)
{
  baum_i_nearest near = baum_i_nearest_to(node->text);
  for (int k = 0; k < baum_i_family_count(family, r->mechanism); k++) {
    baum_i_nearest_offer(&near, family->at(r->mechanism, k)->name);
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: there is no %s \"%.80s\"%s%s", r->label,
                     node->line, family->name, node->text, where, baum_i_nearest_note(&near).text);
}

static baum_status fail_several(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                const char *several, const char *one)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: line %d: there are several %s \"%.80s\"; give the number of the %s, "
                     "counted from 0",
                     r->label, node->line, several, node->text, one);
}

baum_status baum_i_scene_read_body(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                   baum_body_id *out)
{
  int32_t index = 0;
  if (node->kind == BAUM_I_JSON_TEXT) {
    index = baum_i_scene_find_body(&r->names, node->text);
    if (index < -1) {
      return fail_several(r, node, "bodies", "body");
    }
    if (index < 0) {
      return fail_name(r, node, &baum_i_body_family, "");
    }
  } else if (is_number(node)) {
    BAUM_I_TRY(read_place(r, node, r->mechanism->body_count, "body", &index));
    index++;
  } else {
    return baum_i_scene_fail_kind(r, node, "the name of a body");
  }
  *out = index == 0 ? BAUM_GROUND : (baum_body_id){index, r->mechanism->tag};
  return BAUM_OK;
}

/* Tell whether another joint of the scene has the name of joint k. The other joint may be before or
 * after the element that refers to this name. */
static bool is_shared(const baum_i_scene_reader *r, const char *name, int32_t k)
{
  const baum_i_json_node *list = baum_i_json_find(r->json, r->json->nodes, "joints");
  int32_t place = 0;
  for (const baum_i_json_node *node = baum_i_json_first(r->json, list); node;
       node = baum_i_json_next(r->json, node), place++) {
    const baum_i_json_node *own = baum_i_json_find(r->json, node, "name");
    if (place != k && own && own->kind == BAUM_I_JSON_TEXT && strcmp(own->text, name) == 0) {
      return true;
    }
  }
  return false;
}

static baum_status read_joint(const baum_i_scene_reader *r, const baum_i_json_node *node,
                              baum_joint_id *out)
{
  int32_t k = 0;
  if (node->kind == BAUM_I_JSON_TEXT) {
    k = baum_i_index_of_name(r->mechanism, &baum_i_joint_family, node->text);
    if (k < 0) {
      return fail_name(r, node, &baum_i_joint_family, " before this element");
    }
    if (is_shared(r, node->text, k)) {
      return fail_several(r, node, "joints", "joint");
    }
  } else {
    BAUM_I_TRY(read_place(r, node, r->mechanism->joint_count, "joint", &k));
  }
  *out = (baum_joint_id){k + 1, r->mechanism->tag};
  return BAUM_OK;
}

static baum_status read_input(const baum_i_scene_reader *r, const baum_i_json_node *node,
                              baum_input_id *out)
{
  int32_t k = 0;
  BAUM_I_TRY(read_place(r, node, r->mechanism->input_count, "input", &k));
  *out = (baum_input_id){k + 1, r->mechanism->tag};
  return BAUM_OK;
}

static baum_status read_flag(const baum_i_scene_reader *r, const baum_i_json_node *node, bool *out)
{
  *out = node->kind == BAUM_I_JSON_TRUE;
  return *out || node->kind == BAUM_I_JSON_FALSE ? BAUM_OK
                                                 : baum_i_scene_fail_kind(r, node, "true or false");
}

static baum_status read_coordinate(const baum_i_scene_reader *r, const baum_i_json_node *node,
                                   baum_joint_coordinate *out)
{
  const char *text = NULL;
  BAUM_I_TRY(baum_i_scene_read_text(r, node, &text));
  for (int k = BAUM_COORDINATE_DISPLACEMENT; k <= BAUM_COORDINATE_Y; k++) {
    if (strcmp(baum_i_coordinate_name((baum_joint_coordinate)k), text) == 0) {
      *out = (baum_joint_coordinate)k;
      return BAUM_OK;
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: line %d: \"%.60s\" is \"%.60s\", which is not the name of a coordinate",
                     r->label, node->line, node->key, text);
}

/* Find the hook that the scene names, and write its function or pointer into the definition. */
static baum_status read_hook(const baum_i_scene_reader *r, const baum_i_json_node *node,
                             bool is_user, void *out)
{
  const char *name = NULL;
  const baum_hook *found = NULL;
  bool several = false;
  BAUM_I_TRY(baum_i_scene_read_text(r, node, &name));
  for (int k = 0; k < r->hook_count; k++) {
    const baum_hook *hook = &r->hooks[k];
    if (strcmp(hook->name, name) == 0 && is_user == (hook->user != NULL)) {
      several =
        several || (found && (found->user != hook->user || found->function != hook->function));
      found = hook;
    }
  }
  if (found && !several) {
    memcpy(out, is_user ? (const void *)&found->user : (const void *)&found->function,
           sizeof found->function);
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "%s: line %d: \"%.60s\" is the %s \"%.80s\", for which there %s", r->label,
                     node->line, node->key, is_user ? "pointer" : "function", name,
                     several ? "are several hooks" : "is no hook");
}

/* ---- fields ---- */

static baum_status read_reference(const baum_i_scene_reader *r, const baum_i_def_field *f,
                                  const baum_i_json_node *node, void *at)
{
  switch ((int)f->kind) {
  case BAUM_I_FIELD_JOINT: return read_joint(r, node, at);
  case BAUM_I_FIELD_COORDINATE: return read_coordinate(r, node, at);
  case BAUM_I_FIELD_INPUT: return read_input(r, node, at);
  default: return baum_i_scene_read_body(r, node, at);
  }
}

baum_status baum_i_scene_read_field(const baum_i_scene_reader *r, const baum_i_def_field *f,
                                    const baum_i_json_node *node, void *at)
{
  if (f->kind >= BAUM_I_FIELD_FUNCTION) {
    return read_hook(r, node, f->kind == BAUM_I_FIELD_USER, at);
  }
  if (f->kind >= BAUM_I_FIELD_BODY) {
    return read_reference(r, f, node, at);
  }
  if (f->kind >= BAUM_I_FIELD_FLAG) {
    return read_flag(r, node, at);
  }
  if (f->kind != BAUM_I_FIELD_NUMBERS) {
    return baum_i_scene_read_integer(r, node, at);
  }
  const int count = (int)(f->size / sizeof(double));
  BAUM_I_TRY(baum_i_scene_read_numbers(r, node, count, at));
  /* a later check would report NaN, but the scene contains null */
  bool is_null = count == 1 && isnan(*(const double *)at);
  return is_null && baum_i_check_number("", f->name, "", f->rule, NAN) != BAUM_OK
           ? baum_i_scene_fail_kind(r, node, "a number")
           : BAUM_OK;
}
