/* SPDX-License-Identifier: BSD-3-Clause */
/* The life of a definition: defaults, check, copy into an element, read back, replace.
 *
 * Every add and set works on the side and changes the mechanism only when nothing can fail any
 * more.
 */
#include "mechanism/definition.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/sized.h"
#include "base/text.h"

/* ---- checks ---- */

baum_status baum_i_check_finite(const char *label, const char *field, const char *unit,
                                double value)
{
  if (isfinite(value)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %g %s, must be finite", label, field, value,
                     unit);
}

baum_status baum_i_check_positive(const char *label, const char *field, const char *unit,
                                  double value)
{
  if (isfinite(value) && value > 0.0) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %g %s, must be finite and > 0", label, field,
                     value, unit);
}

baum_status baum_i_check_not_negative(const char *label, const char *field, const char *unit,
                                      double value)
{
  if (isfinite(value) && value >= 0.0) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %g %s, must be finite and >= 0", label, field,
                     value, unit);
}

baum_status baum_i_check_not_zero(const char *label, const char *field, const char *unit,
                                  double value)
{
  if (isfinite(value) && value != 0.0) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %g %s, must be finite and not 0", label, field,
                     value, unit);
}

baum_status baum_i_check_optional(const char *label, const char *field, const char *unit,
                                  double value)
{
  if (isfinite(value) || isnan(value)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is %g %s, must be finite, or NaN for not given",
                     label, field, value, unit);
}

/* ---- a caller's struct, which may be of an older version ---- */

/* Fields are only ever appended, so that a smaller struct is one of an older version: what it lacks
 * has its default. */
typedef union whole_def {
  baum_i_def_head head;
  double numbers[32];
  unsigned char bytes[256];
} whole_def;

/* How much of a struct of that size are fields that its version had. A struct ends with padding,
 * where a later version may have put a field. */
static size_t fields_of(const baum_i_definition *definition, size_t size)
{
  const size_t word = sizeof(size_t);
  for (const size_t *end = definition->former; end && *end > 0; end++) {
    if ((*end + word - 1) / word * word == size) {
      return *end;
    }
  }
  return size;
}

static baum_status complete(const baum_i_definition *definition, const void *def, whole_def *out)
{
  if (!def) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the definition is NULL", definition->kind);
  }
  size_t size = ((const baum_i_def_head *)def)->struct_size;
  if (!baum_i_is_struct_size(size, definition->size)) {
    return baum_i_fail(BAUM_ERR_STRUCT,
                       "%s: struct_size is %zu, must be %zu, or that of an older version; start "
                       "from the default definition",
                       definition->kind, size, definition->size);
  }
  assert(definition->size <= sizeof *out);
  memcpy(out, definition->defaults, definition->size);
  memcpy(out, def, fields_of(definition, size));
  out->head.struct_size = definition->size;
  return BAUM_OK;
}

/* ---- the element's own copy ---- */

static void release(baum_i_element *element)
{
  if (element->def && element->definition->release) {
    element->definition->release(element->def);
  }
  baum_i_free(element->def);
  baum_i_free(element->name);
  element->def = NULL;
  element->name = NULL;
}

/* Fill an element from a definition whose fields are already checked; on failure it owns
 * nothing. */
static baum_status fill(baum_i_element *element, const char *family, const void *def)
{
  const baum_i_definition *definition = element->definition;
  const char *given = ((const baum_i_def_head *)def)->name;
  char default_name[BAUM_I_LABEL_SIZE];
  (void)snprintf(default_name, sizeof default_name, "%s%d", family, element->index);
  element->name = baum_i_copy_text(given ? given : default_name);
  element->def = baum_i_copy(def, 1, definition->size);
  if (element->def && definition->own && definition->own(element->def) != BAUM_OK) {
    baum_i_free(element->def); /* what it points to is still the caller's */
    element->def = NULL;
  }
  if (!element->name || !element->def) {
    release(element);
    return baum_i_fail_memory();
  }
  ((baum_i_def_head *)element->def)->name = given ? element->name : NULL;
  return BAUM_OK;
}

/* ---- one element of any family ---- */

/* What the three families differ in, drawn from a type. */
typedef struct kind {
  const char *family; /* "body", "joint", "force" */
  size_t size;        /* of the element's struct, which begins with its baum_i_element */
  size_t span;        /* offset of its baum_i_span */
  const baum_i_definition *definition;
  void (*bodies)(const baum_mechanism *mechanism, const void *def, baum_i_span *span); /* or NULL */
  int (*count)(const void *def); /* velocities or rows; NULL: all of the type have as many */
} kind;

static kind body_kind(const baum_i_body_type *type)
{
  return (kind){"body", sizeof(baum_i_body), offsetof(baum_i_body, span), &type->definition,
                NULL,   type->size};
}

static kind joint_kind(const baum_i_joint_type *type)
{
  return (kind){"joint",           sizeof(baum_i_joint), offsetof(baum_i_joint, span),
                &type->definition, type->bodies,         type->rows};
}

static kind force_kind(const baum_i_force_type *type)
{
  return (kind){"force",           sizeof(baum_i_force), offsetof(baum_i_force, span),
                &type->definition, type->bodies,         NULL};
}

static baum_i_span *span_of(const kind *k, void *item)
{
  return (baum_i_span *)(void *)((char *)item + k->span);
}

static baum_status fail_no_mechanism(const kind *k)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the mechanism is NULL", k->definition->kind);
}

/* Complete a definition and check it for the number-th element of its family. */
static baum_status check(const baum_mechanism *mechanism, const kind *k, const void *def,
                         int number, whole_def *out)
{
  const baum_i_definition *definition = k->definition;
  if (mechanism->frozen) {
    return baum_i_fail(BAUM_ERR_STATE, "%s: the mechanism is frozen; change a copy of it",
                       definition->kind);
  }
  baum_status status = complete(definition, def, out);
  if (status != BAUM_OK) {
    return status;
  }
  const char *name = out->head.name;
  status = baum_i_check_name(k->family, number, name);
  if (status != BAUM_OK) {
    return status;
  }
  char label[BAUM_I_LABEL_SIZE];
  if (name) {
    (void)snprintf(label, sizeof label, "%s %d \"%.80s\"", k->family, number, name);
  } else {
    (void)snprintf(label, sizeof label, "%s %d \"%s%d\"", k->family, number, k->family, number);
  }
  return definition->check(mechanism, out, label);
}

static void free_span(baum_i_span *span)
{
  baum_i_free(span->bodies);
  baum_i_free(span->columns);
}

static baum_status make_span(const baum_mechanism *mechanism, const kind *k, const void *def,
                             baum_i_span *span)
{
  *span = (baum_i_span){0};
  if (!k->bodies) {
    return BAUM_OK;
  }
  k->bodies(mechanism, def, span);
  span->bodies = baum_i_alloc((size_t)span->body_count, sizeof *span->bodies);
  if (!span->bodies) {
    return baum_i_fail_memory();
  }
  k->bodies(mechanism, def, span);
  return BAUM_OK;
}

static void item_free(void *item, size_t span)
{
  if (item) {
    free_span((baum_i_span *)(void *)((char *)item + span));
    release(item);
    baum_i_free(item);
  }
}

/* A new element from a checked definition; NULL when out of memory, with the sentence. */
static void *item_new(const baum_mechanism *mechanism, const kind *k, const void *def, int number)
{
  baum_i_element *element = baum_i_alloc(1, k->size);
  if (!element) {
    (void)baum_i_fail_memory();
    return NULL;
  }
  element->definition = k->definition;
  element->index = number;
  if (fill(element, k->family, def) != BAUM_OK ||
      make_span(mechanism, k, element->def, span_of(k, element)) != BAUM_OK) {
    item_free(element, k->span);
    return NULL;
  }
  return element;
}

/* Grow an array of pointers to hold one more, count; NULL when out of memory, with the sentence. */
static void *grow(void *list, int count)
{
  void *grown = baum_i_grow_by_one(list, (size_t)count, sizeof(void *));
  if (!grown) {
    (void)baum_i_fail_memory();
  }
  return grown;
}

/* Whether a new definition keeps what the element is tied to:
 * kind, number of velocities or rows, bodies. */
static baum_status check_ties(const baum_mechanism *mechanism, const kind *k, const void *def,
                              baum_i_element *element)
{
  if (element->definition != k->definition) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d \"%s\" is a %s, not a %s", k->family,
                       element->index, element->name, element->definition->kind,
                       k->definition->kind);
  }
  if (k->count && k->count(def) != k->count(element->def)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d \"%s\": its size is %d and must stay", k->family,
                       element->index, element->name, k->count(element->def));
  }
  const char *tied = k->definition->tied ? k->definition->tied(element->def, def) : NULL;
  if (tied) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d \"%s\": its %s must stay", k->family,
                       element->index, element->name, tied);
  }
  baum_i_span next;
  baum_i_span *span = span_of(k, element);
  if (make_span(mechanism, k, def, &next) != BAUM_OK) {
    return BAUM_ERR_MEMORY;
  }
  bool same = next.body_count == span->body_count;
  for (int i = 0; same && i < span->body_count; i++) {
    same = next.bodies[i] == span->bodies[i];
  }
  free_span(&next);
  return same ? BAUM_OK
              : baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d \"%s\": its bodies must stay", k->family,
                            element->index, element->name);
}

static baum_status set(baum_mechanism *mechanism, const kind *k, baum_i_element *element,
                       const void *def)
{
  whole_def whole = {.head = {0}};
  baum_status status = check(mechanism, k, def, element->index, &whole);
  if (status == BAUM_OK) {
    status = check_ties(mechanism, k, &whole, element);
  }
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_element next = *element;
  status = fill(&next, k->family, &whole);
  if (status == BAUM_OK) {
    release(element);
    *element = next;
  }
  return status;
}

static baum_status get(const kind *k, const baum_i_element *element, void *out, size_t caller_size)
{
  const baum_i_definition *definition = k->definition;
  baum_status status = baum_i_check_sized(out, caller_size, definition->kind);
  if (status != BAUM_OK) {
    return status;
  }
  if (element->definition != definition) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d \"%s\" is a %s, not a %s", k->family,
                       element->index, element->name, element->definition->kind, definition->kind);
  }
  baum_i_give_sized(out, caller_size, element->def, definition->size);
  return BAUM_OK;
}

void baum_i_definition_init(const baum_i_definition *definition, void *def, size_t caller_size)
{
  if (baum_i_takes_sized(def, caller_size)) {
    baum_i_give_sized(def, caller_size, definition->defaults, definition->size);
  }
}

/* ---- bodies ---- */

void *baum_i_body_new(const baum_mechanism *mechanism, const baum_i_body_type *type,
                      const void *def, int number)
{
  kind k = body_kind(type);
  baum_i_body *body = item_new(mechanism, &k, def, number);
  if (body) {
    body->type = type;
    body->nq = type->positions ? type->positions(body->element.def) : type->nq;
    body->nv = type->size ? type->size(body->element.def) : type->nv;
    body->manifold = type->manifold ? type->manifold(body->element.def) : NULL;
  }
  return body;
}

void baum_i_body_free(baum_i_body *body)
{
  item_free(body, offsetof(baum_i_body, span));
}

baum_status baum_i_add_body(baum_mechanism *mechanism, const baum_i_body_type *type,
                            const void *def, baum_body_id *id)
{
  kind k = body_kind(type);
  if (!mechanism) {
    return fail_no_mechanism(&k);
  }
  int number = mechanism->body_count + 1;
  whole_def whole = {.head = {0}};
  baum_status status = check(mechanism, &k, def, number, &whole);
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_body **list = grow(mechanism->bodies, number + 1);
  if (!list) {
    return BAUM_ERR_MEMORY;
  }
  mechanism->bodies = list;
  list[number] = baum_i_body_new(mechanism, type, &whole, number);
  if (!list[number]) {
    return BAUM_ERR_MEMORY;
  }
  mechanism->body_count = number;
  if (id) {
    *id = (baum_body_id){number, mechanism->tag};
  }
  return BAUM_OK;
}

/* The element of an id, or NULL with the sentence. */
static baum_i_element *body_element(const baum_mechanism *mechanism, const char *what,
                                    baum_body_id id)
{
  if (baum_i_check_body(mechanism, id, what, "id") != BAUM_OK) {
    return NULL;
  }
  if (id.index1 == BAUM_GROUND.index1) {
    (void)baum_i_fail(BAUM_ERR_ARGUMENT, "%s: ground has no definition", what);
    return NULL;
  }
  return &mechanism->bodies[id.index1]->element;
}

baum_status baum_i_get_body(const baum_mechanism *mechanism, const baum_i_body_type *type,
                            baum_body_id id, void *out, size_t caller_size)
{
  kind k = body_kind(type);
  baum_i_element *element = body_element(mechanism, type->definition.kind, id);
  return element ? get(&k, element, out, caller_size) : BAUM_ERR_ARGUMENT;
}

baum_status baum_i_set_body(baum_mechanism *mechanism, const baum_i_body_type *type,
                            baum_body_id id, const void *def)
{
  kind k = body_kind(type);
  baum_i_element *element = body_element(mechanism, type->definition.kind, id);
  return element ? set(mechanism, &k, element, def) : BAUM_ERR_ARGUMENT;
}

/* ---- joints ---- */

void *baum_i_joint_new(const baum_mechanism *mechanism, const baum_i_joint_type *type,
                       const void *def, int number)
{
  kind k = joint_kind(type);
  baum_i_joint *joint = item_new(mechanism, &k, def, number);
  if (joint) {
    joint->type = type;
    joint->rows = type->rows ? type->rows(joint->element.def) : type->row_count;
  }
  return joint;
}

void baum_i_joint_free(baum_i_joint *joint)
{
  item_free(joint, offsetof(baum_i_joint, span));
}

baum_status baum_i_add_joint(baum_mechanism *mechanism, const baum_i_joint_type *type,
                             const void *def, baum_joint_id *id)
{
  kind k = joint_kind(type);
  if (!mechanism) {
    return fail_no_mechanism(&k);
  }
  int number = mechanism->joint_count + 1;
  whole_def whole = {.head = {0}};
  baum_status status = check(mechanism, &k, def, number, &whole);
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_joint **list = grow(mechanism->joints, number);
  if (!list) {
    return BAUM_ERR_MEMORY;
  }
  mechanism->joints = list;
  list[number - 1] = baum_i_joint_new(mechanism, type, &whole, number);
  if (!list[number - 1]) {
    return BAUM_ERR_MEMORY;
  }
  mechanism->joint_count = number;
  if (id) {
    *id = (baum_joint_id){number, mechanism->tag};
  }
  return BAUM_OK;
}

baum_status baum_i_get_joint(const baum_mechanism *mechanism, const baum_i_joint_type *type,
                             baum_joint_id id, void *out, size_t caller_size)
{
  kind k = joint_kind(type);
  baum_status status = baum_i_check_joint(mechanism, id, type->definition.kind, "id");
  return status == BAUM_OK ? get(&k, &mechanism->joints[id.index1 - 1]->element, out, caller_size)
                           : status;
}

baum_status baum_i_set_joint(baum_mechanism *mechanism, const baum_i_joint_type *type,
                             baum_joint_id id, const void *def)
{
  kind k = joint_kind(type);
  baum_status status = baum_i_check_joint(mechanism, id, type->definition.kind, "id");
  return status == BAUM_OK ? set(mechanism, &k, &mechanism->joints[id.index1 - 1]->element, def)
                           : status;
}

/* ---- forces ---- */

void *baum_i_force_new(const baum_mechanism *mechanism, const baum_i_force_type *type,
                       const void *def, int number)
{
  kind k = force_kind(type);
  baum_i_force *force = item_new(mechanism, &k, def, number);
  if (force) {
    force->type = type;
  }
  return force;
}

void baum_i_force_free(baum_i_force *force)
{
  item_free(force, offsetof(baum_i_force, span));
}

baum_status baum_i_add_force(baum_mechanism *mechanism, const baum_i_force_type *type,
                             const void *def, baum_force_id *id)
{
  kind k = force_kind(type);
  if (!mechanism) {
    return fail_no_mechanism(&k);
  }
  int number = mechanism->force_count + 1;
  whole_def whole = {.head = {0}};
  baum_status status = check(mechanism, &k, def, number, &whole);
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_force **list = grow(mechanism->forces, number);
  if (!list) {
    return BAUM_ERR_MEMORY;
  }
  mechanism->forces = list;
  list[number - 1] = baum_i_force_new(mechanism, type, &whole, number);
  if (!list[number - 1]) {
    return BAUM_ERR_MEMORY;
  }
  mechanism->force_count = number;
  if (id) {
    *id = (baum_force_id){number, mechanism->tag};
  }
  return BAUM_OK;
}

baum_status baum_i_get_force(const baum_mechanism *mechanism, const baum_i_force_type *type,
                             baum_force_id id, void *out, size_t caller_size)
{
  kind k = force_kind(type);
  baum_status status = baum_i_check_force(mechanism, id, type->definition.kind, "id");
  return status == BAUM_OK ? get(&k, &mechanism->forces[id.index1 - 1]->element, out, caller_size)
                           : status;
}

baum_status baum_i_set_force(baum_mechanism *mechanism, const baum_i_force_type *type,
                             baum_force_id id, const void *def)
{
  kind k = force_kind(type);
  baum_status status = baum_i_check_force(mechanism, id, type->definition.kind, "id");
  return status == BAUM_OK ? set(mechanism, &k, &mechanism->forces[id.index1 - 1]->element, def)
                           : status;
}
