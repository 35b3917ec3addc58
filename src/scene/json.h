/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads JSON (RFC 8259) into a tree of nodes. Texts that are not valid JSON are refused. Objects
 * with two equal keys or with more than BAUM_I_JSON_KEYS keys are refused, too, and so is nesting
 * deeper than BAUM_I_JSON_DEPTH. */
#ifndef BAUM_I_SCENE_JSON_H
#define BAUM_I_SCENE_JSON_H

#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

enum { BAUM_I_JSON_DEPTH = 32, BAUM_I_JSON_KEYS = 64 };

typedef enum baum_i_json_kind {
  BAUM_I_JSON_NULL,
  BAUM_I_JSON_FALSE,
  BAUM_I_JSON_TRUE,
  BAUM_I_JSON_NUMBER,
  BAUM_I_JSON_TEXT,
  BAUM_I_JSON_LIST,
  BAUM_I_JSON_OBJECT
} baum_i_json_kind;

typedef struct baum_i_json_node {
  baum_i_json_kind kind;
  int line;         /* line in the text, counted from 1 */
  int32_t next;     /* index of the next node in the list or object; 0: none */
  int32_t first;    /* lists and objects: index of the first node; 0: none */
  int32_t count;    /* lists and objects: how many nodes they contain */
  const char *key;  /* key of the node in an object, else NULL */
  const char *text; /* UTF-8, zero-terminated */
  double number;    /* finite */
} baum_i_json_node;

typedef struct baum_i_json {
  baum_i_json_node *nodes; /* (count); the first node is the root of the tree */
  int32_t count;
  char *texts; /* memory of all keys and texts */
} baum_i_json;

/* Parse a text, which need not end with a zero. Returns BAUM_OK, BAUM_ERR_ARGUMENT or
 * BAUM_ERR_MEMORY. The message of a failure begins with `label`. After a failure nothing needs to
 * be released. */
baum_status baum_i_json_parse(const char *text, size_t size, const char *label, baum_i_json *out);
void baum_i_json_release(baum_i_json *json);

/* The first function returns the first node in a list or object, and the second returns the node
 * that follows a node. Both return NULL if there is no such node. */
const baum_i_json_node *baum_i_json_first(const baum_i_json *json, const baum_i_json_node *node);
const baum_i_json_node *baum_i_json_next(const baum_i_json *json, const baum_i_json_node *node);

/* Find the node with this key in an object. Returns NULL if there is none. */
const baum_i_json_node *baum_i_json_find(const baum_i_json *json, const baum_i_json_node *object,
                                         const char *key);

/* Return what a node is, for messages, such as "a number" or "a text". */
const char *baum_i_json_name(const baum_i_json_node *node);

#endif
