/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions: the same life for every kind of element. A type's file calls one of the macros at
 * its end, which spells out its four public functions.
 */
#ifndef BAUM_I_MECHANISM_DEFINITION_H
#define BAUM_I_MECHANISM_DEFINITION_H

#include <math.h>

#include "mechanism/identify.h"

/* What an optional number is by default; NAN itself is a float. */
#define BAUM_I_NOT_GIVEN ((double)NAN)

/* Whether a caller's struct_size may be that of this struct or of a version before it had all of
 * its fields: whole words, from the first two fields on. */
static inline bool baum_i_is_struct_size(size_t size, size_t present)
{
  return size >= sizeof(baum_i_def_head) && size <= present && size % sizeof(size_t) == 0;
}

void baum_i_definition_init(const baum_i_definition *definition, void *def, size_t caller_size);

baum_status baum_i_add_body(baum_mechanism *mechanism, const baum_i_body_type *type,
                            const void *def, baum_body_id *id);
baum_status baum_i_add_joint(baum_mechanism *mechanism, const baum_i_joint_type *type,
                             const void *def, baum_joint_id *id);
baum_status baum_i_add_force(baum_mechanism *mechanism, const baum_i_force_type *type,
                             const void *def, baum_force_id *id);

baum_status baum_i_get_body(const baum_mechanism *mechanism, const baum_i_body_type *type,
                            baum_body_id id, void *out, size_t caller_size);
baum_status baum_i_get_joint(const baum_mechanism *mechanism, const baum_i_joint_type *type,
                             baum_joint_id id, void *out, size_t caller_size);
baum_status baum_i_get_force(const baum_mechanism *mechanism, const baum_i_force_type *type,
                             baum_force_id id, void *out, size_t caller_size);

baum_status baum_i_set_body(baum_mechanism *mechanism, const baum_i_body_type *type,
                            baum_body_id id, const void *def);
baum_status baum_i_set_joint(baum_mechanism *mechanism, const baum_i_joint_type *type,
                             baum_joint_id id, const void *def);
baum_status baum_i_set_force(baum_mechanism *mechanism, const baum_i_force_type *type,
                             baum_force_id id, const void *def);

/* Elements from checked definitions, for add and copy;
 * NULL when out of memory, with the sentence. Free takes NULL. */
void *baum_i_body_new(const baum_mechanism *mechanism, const baum_i_body_type *type,
                      const void *def, int number);
void *baum_i_joint_new(const baum_mechanism *mechanism, const baum_i_joint_type *type,
                       const void *def, int number);
void *baum_i_force_new(const baum_mechanism *mechanism, const baum_i_force_type *type,
                       const void *def, int number);
void baum_i_body_free(baum_i_body *body);
void baum_i_joint_free(baum_i_joint *joint);
void baum_i_force_free(baum_i_force *force);

/* FAMILY is body, joint or force; NAME as in baum_NAME_def; TYPE the type struct. */
#define BAUM_I_DEFINE(FAMILY, NAME, TYPE)                                                        \
  void baum_##NAME##_def_init(baum_##NAME##_def *def, size_t caller_size)                        \
  {                                                                                              \
    baum_i_definition_init(&(TYPE).definition, def, caller_size);                                \
  }                                                                                              \
  baum_status baum_mechanism_add_##NAME(baum_mechanism *mechanism, const baum_##NAME##_def *def, \
                                        baum_##FAMILY##_id *id)                                  \
  {                                                                                              \
    return baum_i_add_##FAMILY(mechanism, &(TYPE), def, id);                                     \
  }                                                                                              \
  baum_status baum_mechanism_get_##NAME(const baum_mechanism *mechanism, baum_##FAMILY##_id id,  \
                                        baum_##NAME##_def *out, size_t caller_size)              \
  {                                                                                              \
    return baum_i_get_##FAMILY(mechanism, &(TYPE), id, out, caller_size);                        \
  }                                                                                              \
  baum_status baum_mechanism_set_##NAME(baum_mechanism *mechanism, baum_##FAMILY##_id id,        \
                                        const baum_##NAME##_def *def)                            \
  {                                                                                              \
    return baum_i_set_##FAMILY(mechanism, &(TYPE), id, def);                                     \
  }

/* ---- checks that definitions share: BAUM_OK, or BAUM_ERR_ARGUMENT with its sentence ---- */

baum_status baum_i_check_finite(const char *label, const char *field, const char *unit,
                                double value);
baum_status baum_i_check_positive(const char *label, const char *field, const char *unit,
                                  double value);
baum_status baum_i_check_not_negative(const char *label, const char *field, const char *unit,
                                      double value);
baum_status baum_i_check_not_zero(const char *label, const char *field, const char *unit,
                                  double value);
/* Finite, or NaN for "not given". */
baum_status baum_i_check_optional(const char *label, const char *field, const char *unit,
                                  double value);

#endif
