/* SPDX-License-Identifier: BSD-3-Clause */
/* Operations on definitions: set defaults, check a definition, copy it into an element, read it
 * back, and replace it.
 *
 * Every function that adds or changes an element first prepares the new element. The mechanism is
 * changed only after everything that can fail has succeeded.
 */
#include "mechanism/definition.h"

#include <assert.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/sized.h"
#include "base/text.h"

/* ---- a caller's struct, which may have been compiled with an older version of the headers ---- */

/* Memory for a definition of any type. New versions only append fields to a struct. A caller's
 * struct that is smaller therefore comes from an older version, and the missing fields get their
 * defaults. */
typedef union whole_def {
  baum_i_def_head head;
  double numbers[128];
  unsigned char bytes[1024];
} whole_def;

/* Return the offset of the end of the last field in a caller's struct that has `size` bytes. The
 * bytes behind the last field are padding, in which a later version may have placed a field. */
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
  BAUM_I_TRY(baum_i_check_struct_size(size, definition->size, definition->kind, "",
                                      "the default definition"));
  assert(definition->size <= sizeof *out);
  baum_i_fields_set(definition, out);
  memcpy(out, def, fields_of(definition, size));
  out->head.struct_size = definition->size;
  return BAUM_OK;
}

void baum_i_definition_init(const baum_i_definition *definition, void *def, size_t caller_size)
{
  whole_def whole;
  assert(definition->size <= sizeof whole);
  baum_i_fields_set(definition, &whole);
  baum_i_give_sized(def, caller_size, &whole, definition->size);
}

/* ---- an element's own copy of its definition ---- */

static void release(baum_i_element *element)
{
  if (element->def) {
    baum_i_fields_release(element->definition, element->def);
  }
  baum_i_free(element->def);
  baum_i_free(element->name);
  element->def = NULL;
  element->name = NULL;
}

/* Fill an element from a checked definition. On failure the element owns no memory. */
static baum_status fill(baum_i_element *element, const void *def)
{
  const baum_i_definition *definition = element->definition;
  const char *given = ((const baum_i_def_head *)def)->name;
  element->name =
    baum_i_copy_text(given ? given : baum_i_text_of("%s%d", element->family, element->index).text);
  element->def = baum_i_copy(def, 1, definition->size);
  if (element->def && baum_i_fields_own(definition, element->def) != BAUM_OK) {
    /* the copy contains no memory of its own, because baum_i_fields_own() has failed */
    baum_i_free(element->def);
    element->def = NULL;
  }
  if (!element->name || !element->def) {
    release(element);
    return baum_i_fail_memory();
  }
  ((baum_i_def_head *)element->def)->name = given ? element->name : NULL;
  return BAUM_OK;
}

/* Find the bodies on which an element acts, and list them in the span. A body acts only on itself.
 * On failure the span owns no memory. */
static baum_status make_span(const baum_mechanism *mechanism, const baum_i_definition *definition,
                             const void *def, int number, baum_i_span *span)
{
  int most = baum_i_fields_bodies(definition, mechanism, def, NULL);
  *span = (baum_i_span){.bodies = baum_i_alloc((size_t)most + 1, sizeof *span->bodies)};
  BAUM_I_TRY(baum_i_check_memory(span->bodies));
  span->bodies[0] = number;
  span->body_count = most > 0 ? baum_i_fields_bodies(definition, mechanism, def, span->bodies) : 1;
  return BAUM_OK;
}

void baum_i_free_element(const baum_i_family *family, baum_i_element *element)
{
  baum_i_free(baum_i_family_span(family, element)->bodies);
  baum_i_free(baum_i_family_span(family, element)->columns);
  release(element);
  baum_i_free(element);
}

baum_status baum_i_append_element(baum_mechanism *mechanism, const baum_i_family *family,
                                  const baum_i_definition *definition, const void *def)
{
  baum_i_element *element = baum_i_alloc(1, family->size);
  BAUM_I_TRY(baum_i_check_memory(element));
  element->family = family->name;
  element->definition = definition;
  element->index = baum_i_family_count(family, mechanism) + 1;
  baum_i_span *span = baum_i_family_span(family, element);
  baum_status status = fill(element, def);
  if (status == BAUM_OK) {
    status = make_span(mechanism, definition, element->def, element->index, span);
  }
  if (status == BAUM_OK) {
    family->prepare(element);
    status = family->append(mechanism, element);
  }
  if (status != BAUM_OK) {
    baum_i_free_element(family, element);
  }
  return status;
}

/* ---- add ---- */

/* Complete a caller's definition with defaults, and check it as the definition of element `number`
 * of the family. */
static baum_status check(const baum_mechanism *mechanism, const baum_i_family *family,
                         const baum_i_definition *definition, const void *def, int number,
                         whole_def *out)
{
  BAUM_I_TRY(complete(definition, def, out));
  BAUM_I_TRY(baum_i_check_name(family->name, number, out->head.name));
  const char *name = out->head.name;
  const baum_i_text label =
    baum_i_text_of("%s %d \"%.80s\"", family->name, number,
                   name ? name : baum_i_text_of("%s%d", family->name, number).text);
  return baum_i_fields_check(definition, mechanism, out, label.text);
}

baum_status baum_i_add_element(baum_mechanism *mechanism, const baum_i_family *family,
                               const baum_i_definition *definition, const void *def)
{
  BAUM_I_TRY(baum_i_check_open(mechanism, definition->kind));
  whole_def whole = {.head = {0}};
  int number = baum_i_family_count(family, mechanism) + 1;
  BAUM_I_TRY(check(mechanism, family, definition, def, number, &whole));
  return baum_i_append_element(mechanism, family, definition, &whole);
}

/* ---- get and set ---- */

/* Find the element that has an id. */
static baum_status find(const baum_mechanism *mechanism, const baum_i_family *family,
                        const baum_i_definition *definition, baum_i_id id, baum_i_element **out)
{
  BAUM_I_TRY(baum_i_check_id(mechanism, family, id, definition->kind, "id"));
  int k = baum_i_index(mechanism, family, id);
  BAUM_I_TRY(k >= 0
               ? BAUM_OK
               : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: ground has no definition", definition->kind));
  *out = family->at(mechanism, k);
  return BAUM_OK;
}

static baum_status check_kind(const baum_i_element *element, const baum_i_definition *definition)
{
  return element->definition == definition
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s is a %s, not a %s", baum_i_label(element).text,
                         element->definition->kind, definition->kind);
}

baum_status baum_i_get_element(const baum_mechanism *mechanism, const baum_i_family *family,
                               const baum_i_definition *definition, baum_i_id id, void *out,
                               size_t caller_size)
{
  baum_i_element *element = NULL;
  BAUM_I_TRY(find(mechanism, family, definition, id, &element));
  BAUM_I_TRY(baum_i_check_sized(out, caller_size, definition->kind));
  BAUM_I_TRY(check_kind(element, definition));
  baum_i_give_sized(out, caller_size, element->def, definition->size);
  return BAUM_OK;
}

/* Check that a new definition has the same counts, joints and bodies as the present definition of
 * the element. */
static baum_status check_ties(const baum_mechanism *mechanism, const baum_i_family *family,
                              const void *def, baum_i_element *element)
{
  const baum_i_text label = baum_i_label(element);
  BAUM_I_TRY(baum_i_fields_check_kept(element->definition, element->def, def, label.text));
  const baum_i_span *span = baum_i_family_span(family, element);
  baum_i_span next;
  BAUM_I_TRY(make_span(mechanism, element->definition, def, element->index, &next));
  bool same = next.body_count == span->body_count;
  for (int i = 0; same && i < span->body_count; i++) {
    same = next.bodies[i] == span->bodies[i];
  }
  baum_i_free(next.bodies);
  return same ? BAUM_OK
              : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: its bodies cannot change", label.text);
}

baum_status baum_i_set_element(baum_mechanism *mechanism, const baum_i_family *family,
                               const baum_i_definition *definition, baum_i_id id, const void *def)
{
  baum_i_element *element = NULL;
  whole_def whole = {.head = {0}};
  BAUM_I_TRY(find(mechanism, family, definition, id, &element));
  BAUM_I_TRY(baum_i_check_open(mechanism, definition->kind));
  BAUM_I_TRY(check(mechanism, family, definition, def, element->index, &whole));
  BAUM_I_TRY(check_kind(element, definition));
  BAUM_I_TRY(check_ties(mechanism, family, &whole, element));
  baum_i_element next = *element;
  BAUM_I_TRY(fill(&next, &whole));
  release(element);
  *element = next;
  return BAUM_OK;
}
