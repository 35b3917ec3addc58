/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Scenes: mechanisms as text, to save, send and compare them.
 *
 *  A scene is a JSON text (RFC 8259). It contains everything that was given to build the mechanism:
 *  gravity, characteristic length, break times, inputs, bodies with their outlines, joints and
 *  forces. docs/scenes.md describes the format. Numbers are exact: a mechanism that is read back
 *  moves bit for bit like the original.
 *
 *  A text cannot contain functions. Callbacks and `user` pointers are therefore written as names,
 *  and hooks tell which function or pointer has which name. */
#ifndef BAUM_SCENE_H
#define BAUM_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Any callback of a definition, cast to this type. */
typedef void baum_hook_fn(void);

/** The name of a function, or of what a field `user` points to. Either `function` or `user` is
 *  NULL. */
typedef struct baum_hook {
  const char *name;       /**< Not empty. */
  baum_hook_fn *function; /**< A callback of a definition. */
  void *user;             /**< Not owned. */
} baum_hook;

/** Write a mechanism as a scene.
 *  @param      mechanism   frozen or not
 *  @param[in]  hooks       (hook_count) names of functions and `user` pointers; NULL if there are
 *                          none
 *  @param      hook_count  [-] >= 0
 *  @param[out] text        (capacity) zero-terminated, truncated if too long. NULL if capacity is
 *                          0.
 *  @param      capacity    [byte]
 *  @param[out] size        [byte] length of the whole scene without the final zero. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also: a function without a hook), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_print(const baum_mechanism *mechanism, const baum_hook *hooks,
                                          int32_t hook_count, char *text, size_t capacity,
                                          size_t *size);

/** Write the scene of baum_mechanism_print() into a file.
 *  @param     mechanism   frozen or not
 *  @param[in] hooks       (hook_count) as in baum_mechanism_print()
 *  @param     hook_count  [-] >= 0
 *  @param[in] path        of the file, which is replaced as a whole or not at all
 *  @return  as baum_mechanism_print(), and BAUM_ERR_FILE */
BAUM_API baum_status baum_mechanism_write(const baum_mechanism *mechanism, const baum_hook *hooks,
                                          int32_t hook_count, const char *path);

/** Create a mechanism from a scene. Unknown fields and kinds of elements, and everything that the
 *  add functions refuse, are refused; the message names the line.
 *  @param[in]  text        (size) need not end with a zero
 *  @param      size        [byte]
 *  @param[in]  hooks       (hook_count) functions and `user` pointers that the scene names
 *  @param      hook_count  [-] >= 0
 *  @param[out] out         receives the mechanism, which is not frozen; NULL on failure
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_parse(const char *text, size_t size, const baum_hook *hooks,
                                          int32_t hook_count, baum_mechanism **out);

/** Create a mechanism from a file.
 *  @param[in]  path        of the file
 *  @param[in]  hooks       (hook_count) functions and `user` pointers that the scene names
 *  @param      hook_count  [-] >= 0
 *  @param[out] out         receives the mechanism, which is not frozen; NULL on failure
 *  @return  as baum_mechanism_parse(), and BAUM_ERR_FILE */
BAUM_API baum_status baum_mechanism_read(const char *path, const baum_hook *hooks,
                                         int32_t hook_count, baum_mechanism **out);

/** Compare what was given to build two mechanisms, including names, outlines, functions and `user`
 *  pointers. Whether a mechanism is frozen makes no difference.
 *  @param      a      a mechanism
 *  @param      b      a mechanism
 *  @param[out] equal  whether their scenes are equal
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_compare(const baum_mechanism *a, const baum_mechanism *b,
                                            bool *equal);

#ifdef __cplusplus
}
#endif
#endif
