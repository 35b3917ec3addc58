/* SPDX-License-Identifier: BSD-3-Clause */
/* Common parts of writing and reading scenes. A scene is a mechanism as a JSON text. */
#ifndef BAUM_I_SCENE_SCENE_H
#define BAUM_I_SCENE_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include <baum/draw.h>
#include <baum/scene.h>

#include "mechanism/family.h"

/* The version of the format. A reader refuses all other versions. */
#define BAUM_I_SCENE_KEY "baum_scene"
enum { BAUM_I_SCENE_VERSION = 1 };

/* A kind of elements, such as "planar_body". */
typedef struct baum_i_scene_kind {
  const char *name;
  const baum_i_family *family;
  const baum_i_definition *const *definition;
} baum_i_scene_kind;

extern const baum_i_scene_kind baum_i_scene_kinds[]; /* the last one has no name */

/* The key of the list of a family, such as "bodies". */
const char *baum_i_scene_list(const baum_i_family *family);

/* Check the arguments that all public functions for scenes have in common. Returns BAUM_OK or
 * BAUM_ERR_ARGUMENT. */
baum_status baum_i_scene_check_call(const char *call, bool has_mechanism, const baum_hook *hooks,
                                    int32_t hook_count);

/* ---- fields ---- */

/* Tell whether the field is an array of numbers or ids. */
bool baum_i_scene_is_array(const baum_i_def_field *field);
/* Return a pointer to the count that gives the length of an array. */
int32_t *baum_i_scene_counter(const baum_i_def_field *field, void *def);
/* Tell whether a count is omitted in scenes, because it is equal to the length of an array of the
 * same definition. */
bool baum_i_scene_is_derived(const baum_i_definition *definition, const baum_i_def_field *field);
/* Tell whether the count of an array follows from its length in the scene. */
bool baum_i_scene_derives(const baum_i_definition *definition, const baum_i_def_field *array);

/* ---- names of bodies ---- */

/* The bodies of a mechanism except ground, sorted by name. */
typedef struct baum_i_scene_names {
  int count;
  const baum_i_element **sorted; /* (count) */
} baum_i_scene_names;

/* Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_scene_names_create(const baum_mechanism *mechanism, baum_i_scene_names *out);
void baum_i_scene_names_release(baum_i_scene_names *names);
/* Find the index, from 1, of the body with that name, or 0 for ground. Returns -1 if there is no
 * such body, and -2 if there are several. "ground" always means ground. */
int baum_i_scene_find_body(const baum_i_scene_names *names, const char *name);

/* ---- outlines ---- */

/* Names of the forms, in the order of baum_outline_form. */
enum { BAUM_I_SCENE_FORMS = BAUM_OUTLINE_MESH + 1 };
extern const char *const baum_i_scene_forms[BAUM_I_SCENE_FORMS];

/* The fields of an outline that contain numbers. */
extern const baum_i_def_field baum_i_scene_outline_fields[];

#endif
