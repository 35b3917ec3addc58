/* SPDX-License-Identifier: BSD-3-Clause */
/* The state while a scene is being read, and functions that read its values and outlines. */
#ifndef BAUM_I_SCENE_READER_H
#define BAUM_I_SCENE_READER_H

#include "base/message.h"
#include "scene/json.h"
#include "scene/scene.h"

typedef struct baum_i_scene_reader {
  const baum_i_json *json;
  const char *label; /* text with which messages begin */
  const baum_hook *hooks;
  int hook_count;
  baum_mechanism *mechanism; /* contains the elements that have been read */
  baum_i_scene_names names;  /* names of bodies; set when all bodies have been read */
} baum_i_scene_reader;

/* Fail with the message that a node must be `wanted`, which is a text such as "a number". */
baum_status baum_i_scene_fail_kind(const baum_i_scene_reader *reader, const baum_i_json_node *node,
                                   const char *wanted);

/* Put the line number of a node before the message of a call that failed with this status. */
baum_status baum_i_scene_add_line(const baum_i_scene_reader *reader, const baum_i_json_node *node,
                                  baum_status status);

/* These functions read `count` numbers, a whole number, or a text. Among numbers, null is read as
 * NaN. The text stays in the memory of the tree. The functions fail if a value has the wrong
 * kind. */
baum_status baum_i_scene_read_numbers(const baum_i_scene_reader *reader,
                                      const baum_i_json_node *list, int count, double *out);
baum_status baum_i_scene_read_integer(const baum_i_scene_reader *reader,
                                      const baum_i_json_node *node, int32_t *out);
baum_status baum_i_scene_read_text(const baum_i_scene_reader *reader, const baum_i_json_node *node,
                                   const char **out);

baum_status baum_i_scene_read_body(const baum_i_scene_reader *reader, const baum_i_json_node *node,
                                   baum_body_id *out);

/* Read a field that is not an array. `at` points to this field in the definition. */
baum_status baum_i_scene_read_field(const baum_i_scene_reader *reader,
                                    const baum_i_def_field *field, const baum_i_json_node *node,
                                    void *at);

/* Read a list of outlines. Colors stay in the memory of the tree; the other members must be freed.
 * After a failure nothing needs to be freed. */
baum_status baum_i_scene_read_outlines(const baum_i_scene_reader *reader,
                                       const baum_i_json_node *list, baum_outline **out);
void baum_i_scene_free_outlines(baum_outline *outlines, int count);

#endif
