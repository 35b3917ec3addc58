/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  A scene is a mechanism written as text, which can be saved, sent and compared.
 *
 *  The text is in JSON (RFC 8259). It contains everything that was given to build the mechanism:
 *  gravity, characteristic length, break times, inputs, bodies with their outlines, joints and
 *  forces. The page "docs/scenes.md" describes the format. Numbers are exact: a mechanism that is
 *  read back moves bit for bit like the original.
 *
 *  A text cannot contain functions. A scene therefore contains names in place of callbacks and
 *  `user` pointers. An array of hooks states which function or pointer each of these names stands
 *  for. */
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

/** A hook: the name of a function, or the name of the data to which a field `user` points. Exactly
 *  one of the two members `function` and `user` is NULL. */
typedef struct baum_hook {
  const char *name; /**< The name, which must not be empty. */
  /** A callback of a definition; NULL if the hook names a pointer `user`. */
  baum_hook_fn *function;
  /** A pointer `user` of a definition. Not owned. NULL if the hook names a callback. */
  void *user;
} baum_hook;

/** Write a mechanism as a scene.
 *  @param      mechanism   frozen or not
 *  @param[in]  hooks       (hook_count) names of functions and `user` pointers. May be NULL if
 *                          hook_count is 0.
 *  @param      hook_count  [-] >= 0
 *  @param[out] text        (capacity) the scene, zero-terminated, truncated if too long. May be
 *                          NULL if capacity is 0.
 *  @param      capacity    [byte]
 *  @param[out] size        [byte] length of the whole scene without the final zero. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT (also if a function has no hook), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_print(const baum_mechanism *mechanism, const baum_hook *hooks,
                                          int32_t hook_count, char *text, size_t capacity,
                                          size_t *size);

/** Write the scene of baum_mechanism_print() into a file.
 *  @param     mechanism   frozen or not
 *  @param[in] hooks       (hook_count) as in baum_mechanism_print()
 *  @param     hook_count  [-] >= 0
 *  @param[in] path        path of the file. An existing file is replaced when the new file is
 *                         complete
 *  @return  as baum_mechanism_print(), and BAUM_ERR_FILE */
BAUM_API baum_status baum_mechanism_write(const baum_mechanism *mechanism, const baum_hook *hooks,
                                          int32_t hook_count, const char *path);

/** Create a mechanism from a scene. The call fails if the scene contains an unknown field, an
 *  unknown kind of element, or values that the functions baum_mechanism_add_... refuse. The message
 *  names the line of the text.
 *  @param[in]  text        (size) need not end with a zero
 *  @param      size        [byte]
 *  @param[in]  hooks       (hook_count) functions and `user` pointers that the scene names
 *  @param      hook_count  [-] >= 0
 *  @param[out] out         receives the mechanism, which is not frozen; NULL on failure
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_parse(const char *text, size_t size, const baum_hook *hooks,
                                          int32_t hook_count, baum_mechanism **out);

/** Create a mechanism from a file.
 *  @param[in]  path        path of the file
 *  @param[in]  hooks       (hook_count) functions and `user` pointers that the scene names
 *  @param      hook_count  [-] >= 0
 *  @param[out] out         receives the mechanism, which is not frozen; NULL on failure
 *  @return  as baum_mechanism_parse(), and BAUM_ERR_FILE */
BAUM_API baum_status baum_mechanism_read(const char *path, const baum_hook *hooks,
                                         int32_t hook_count, baum_mechanism **out);

/** Compare two mechanisms. They are equal if they were built from the same data, including names,
 *  outlines, functions and `user` pointers. It does not matter whether they are frozen.
 *  @param      a      a mechanism
 *  @param      b      a mechanism
 *  @param[out] equal  true if the mechanisms are equal
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_compare(const baum_mechanism *a, const baum_mechanism *b,
                                            bool *equal);

#ifdef __cplusplus
}
#endif
#endif
