/* SPDX-License-Identifier: BSD-3-Clause */
/* Public functions that return elements by number and by name. */
#include <baum/elements.h>

#include <string.h>

#include "mechanism/identify.h"

/* Expands to the id of element K of a family, where K counts from 0. If there is no such element,
 * expands to the empty id. */
#define ID_AT(FAMILY, MECHANISM, K)                             \
  ((K) >= 0 && (K) < baum_mechanism_##FAMILY##_count(MECHANISM) \
     ? (baum_##FAMILY##_id){(K) + 1, (MECHANISM)->tag}          \
     : (baum_##FAMILY##_id){0})

#define COUNT_AND_AT(FAMILY)                                                                  \
  int32_t baum_mechanism_##FAMILY##_count(const baum_mechanism *mechanism)                    \
  {                                                                                           \
    return mechanism ? mechanism->FAMILY##_count : 0;                                         \
  }                                                                                           \
  baum_##FAMILY##_id baum_mechanism_##FAMILY##_at(const baum_mechanism *mechanism, int32_t k) \
  {                                                                                           \
    return ID_AT(FAMILY, mechanism, k);                                                       \
  }

#define FIND_AND_NAME(FAMILY)                                                                   \
  baum_##FAMILY##_id baum_mechanism_find_##FAMILY(const baum_mechanism *mechanism,              \
                                                  const char *name)                             \
  {                                                                                             \
    int k = baum_i_index_of_name(mechanism, &baum_i_##FAMILY##_family, name);                   \
    return ID_AT(FAMILY, mechanism, k);                                                         \
  }                                                                                             \
  const char *baum_mechanism_##FAMILY##_name(const baum_mechanism *mechanism,                   \
                                             baum_##FAMILY##_id id)                             \
  {                                                                                             \
    int k = baum_i_index(mechanism, &baum_i_##FAMILY##_family, (baum_i_id){id.index1, id.tag}); \
    return k < 0 ? NULL : baum_i_##FAMILY##_family.at(mechanism, k)->name;                      \
  }

/* ---- bodies and ground ---- */

COUNT_AND_AT(body)

baum_body_id baum_mechanism_find_body(const baum_mechanism *mechanism, const char *name)
{
  int k = baum_i_index_of_name(mechanism, &baum_i_body_family, name);
  bool ground = k < 0 && mechanism && name && strcmp(name, "ground") == 0;
  return ground ? BAUM_GROUND : ID_AT(body, mechanism, k);
}

const char *baum_mechanism_body_name(const baum_mechanism *mechanism, baum_body_id body)
{
  int index = baum_i_body_index(mechanism, body);
  return index < 0 ? NULL : mechanism->bodies[index]->element.name;
}

/* ---- joints, forces, inputs ---- */

COUNT_AND_AT(joint)
FIND_AND_NAME(joint)

COUNT_AND_AT(force)
FIND_AND_NAME(force)

baum_input_id baum_mechanism_input_at(const baum_mechanism *mechanism, int32_t k)
{
  return ID_AT(input, mechanism, k);
}

baum_input_id baum_mechanism_find_input(const baum_mechanism *mechanism, const char *name)
{
  int k = 0;
  while (name && k < baum_mechanism_input_count(mechanism) &&
         strcmp(mechanism->input_names[k], name) != 0) {
    k++;
  }
  return ID_AT(input, mechanism, name ? k : -1);
}
