/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions of elements. In the file of every element type, the macro BAUM_I_DEFINE defines the
 * four public functions of the type.
 */
#ifndef BAUM_I_MECHANISM_DEFINITION_H
#define BAUM_I_MECHANISM_DEFINITION_H

#include "base/message.h"
#include "mechanism/family.h"
#include "mechanism/identify.h"
#include "mechanism/kinds.h"

/* Append an element to the mechanism. Its definition has already been checked. Returns BAUM_OK, or
 * BAUM_ERR_MEMORY after setting the message. */
baum_status baum_i_append_element(baum_mechanism *mechanism, const baum_i_family *family,
                                  const baum_i_definition *definition, const void *def);
void baum_i_free_element(const baum_i_family *family, baum_i_element *element);

void baum_i_definition_init(const baum_i_definition *definition, void *def, size_t caller_size);

baum_status baum_i_add_element(baum_mechanism *mechanism, const baum_i_family *family,
                               const baum_i_definition *definition, const void *def);
baum_status baum_i_get_element(const baum_mechanism *mechanism, const baum_i_family *family,
                               const baum_i_definition *definition, baum_i_id id, void *out,
                               size_t caller_size);
baum_status baum_i_set_element(baum_mechanism *mechanism, const baum_i_family *family,
                               const baum_i_definition *definition, baum_i_id id, const void *def);

/* Defines the public functions of one element type. FAMILY is body, joint or force. NAME is the
 * name of the type, as in baum_NAME_def. TYPE is the struct of the type: a baum_i_body_type,
 * baum_i_joint_type or baum_i_force_type. */
#define BAUM_I_DEFINE(FAMILY, NAME, TYPE)                                                          \
  const baum_i_definition *const baum_i_##NAME##_definition = &(TYPE).definition;                  \
  void baum_##NAME##_def_init(baum_##NAME##_def *def, size_t caller_size)                          \
  {                                                                                                \
    baum_i_definition_init(&(TYPE).definition, def, caller_size);                                  \
  }                                                                                                \
  baum_status baum_mechanism_add_##NAME(baum_mechanism *mechanism, const baum_##NAME##_def *def,   \
                                        baum_##FAMILY##_id *id)                                    \
  {                                                                                                \
    BAUM_I_TRY(baum_i_add_element(mechanism, &baum_i_##FAMILY##_family, &(TYPE).definition, def)); \
    if (id) {                                                                                      \
      *id = (baum_##FAMILY##_id){mechanism->FAMILY##_count, mechanism->tag};                       \
    }                                                                                              \
    return BAUM_OK;                                                                                \
  }                                                                                                \
  baum_status baum_mechanism_get_##NAME(const baum_mechanism *mechanism, baum_##FAMILY##_id id,    \
                                        baum_##NAME##_def *out, size_t caller_size)                \
  {                                                                                                \
    return baum_i_get_element(mechanism, &baum_i_##FAMILY##_family, &(TYPE).definition,            \
                              (baum_i_id){id.index1, id.tag}, out, caller_size);                   \
  }                                                                                                \
  baum_status baum_mechanism_set_##NAME(baum_mechanism *mechanism, baum_##FAMILY##_id id,          \
                                        const baum_##NAME##_def *def)                              \
  {                                                                                                \
    return baum_i_set_element(mechanism, &baum_i_##FAMILY##_family, &(TYPE).definition,            \
                              (baum_i_id){id.index1, id.tag}, def);                                \
  }

#endif
