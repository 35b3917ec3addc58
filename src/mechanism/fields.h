/* SPDX-License-Identifier: BSD-3-Clause */
/* Each definition has a table of its fields. The table determines defaults, checks of single
 * fields, copies, digests and the bodies on which an element acts. Tests of the headers use it
 * too. */
#ifndef BAUM_I_MECHANISM_FIELDS_H
#define BAUM_I_MECHANISM_FIELDS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <baum/mechanism.h>

#include "base/digest.h"

/* Default of optional numbers. NAN is a float, hence the cast. */
#define BAUM_I_NOT_GIVEN ((double)NAN)

/* The values that a number may have. */
typedef enum baum_i_rule {
  BAUM_I_RULE_FINITE,
  BAUM_I_RULE_POSITIVE,
  BAUM_I_RULE_NOT_NEGATIVE,
  BAUM_I_RULE_NOT_ZERO,
  BAUM_I_RULE_OPTIONAL, /* finite; NaN: not given */
  BAUM_I_RULE_FREE,     /* finite; NaN: a free velocity */
  BAUM_I_RULE_OPTIONAL_POSITIVE,
  BAUM_I_RULE_OPTIONAL_NOT_NEGATIVE,
  BAUM_I_RULE_POINT,    /* all numbers of a field are finite, or all are NaN */
  BAUM_I_RULE_DIRECTION /* all numbers of a field are finite, and not all are zero */
} baum_i_rule;

/* Fields whose kind contains OWN are checked, copied and released by functions of the
 * definition. Scenes rely on the order of the groups: numbers and counts, flags, references,
 * functions. */
typedef enum baum_i_field_kind {
  BAUM_I_FIELD_NUMBERS, /* double or double[] */
  BAUM_I_FIELD_ARRAY,   /* array of `counter` doubles or NULL, used only at the start of a run */
  BAUM_I_FIELD_OWN_ARRAY,
  BAUM_I_FIELD_COUNT,          /* int32_t > 0 that cannot change */
  BAUM_I_FIELD_OPTIONAL_COUNT, /* the same, or 0 */
  BAUM_I_FIELD_OWN_COUNT,
  BAUM_I_FIELD_FLAG,
  BAUM_I_FIELD_START_FLAG, /* used only at the start of a run */
  BAUM_I_FIELD_CLAIM,      /* whether user functions depend on velocities; default: true */
  BAUM_I_FIELD_BODY,       /* required; ground is allowed */
  BAUM_I_FIELD_CARRIER,    /* a body, ground by default */
  BAUM_I_FIELD_BODIES,     /* array of ids of length `counter`, without ground or repetition */
  BAUM_I_FIELD_JOINT,      /* required, cannot change; the element acts on the joint's bodies */
  BAUM_I_FIELD_COORDINATE, /* a baum_joint_coordinate; the definition checks it */
  BAUM_I_FIELD_INPUT,      /* optional */
  BAUM_I_FIELD_FUNCTION,   /* must be given */
  BAUM_I_FIELD_OPTIONAL_FUNCTION,
  BAUM_I_FIELD_KEPT_FUNCTION, /* optional; cannot be added or removed later */
  BAUM_I_FIELD_USER           /* pointer for user functions */
} baum_i_field_kind;

enum { BAUM_I_FIELD_SIZE_MAX = 6 }; /* largest count of numbers in a field */

/* A field of a definition, except struct_size and name. */
typedef struct baum_i_def_field {
  const char *name;
  const char *unit; /* of numbers; "": the user chooses it */
  size_t offset;
  size_t size;
  baum_i_field_kind kind;
  baum_i_rule rule;                    /* of numbers and arrays of numbers */
  double value[BAUM_I_FIELD_SIZE_MAX]; /* default of numbers */
  size_t counter;                      /* array: offset of its count */
  size_t instead;                      /* array: offset of the count to use if the first one is 0 */
} baum_i_def_field;

#define BAUM_I_FIELD_OF(DEF, FIELD) \
  .name = #FIELD, .offset = offsetof(DEF, FIELD), .size = sizeof(((DEF *)0)->FIELD)

#define BAUM_I_FIELD(DEF, FIELD, KIND)                                   \
  {                                                                      \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = "", .kind = BAUM_I_FIELD_##KIND \
  }

/* A field of numbers. The last arguments are the defaults of all numbers. */
#define BAUM_I_NUMBERS(DEF, FIELD, RULE, UNIT, ...)                                     \
  {                                                                                     \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = (UNIT), .rule = BAUM_I_RULE_##RULE, .value = { \
      __VA_ARGS__                                                                       \
    }                                                                                   \
  }

/* A field of optional numbers. */
#define BAUM_I_OPTIONAL(DEF, FIELD, RULE, UNIT)                                                \
  BAUM_I_NUMBERS(DEF, FIELD, RULE, UNIT, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, \
                 BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN)

/* An array of length COUNTER, or INSTEAD if COUNTER is 0. */
#define BAUM_I_ARRAY(DEF, FIELD, KIND, RULE, COUNTER, INSTEAD)                                  \
  {                                                                                             \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = "", .kind = BAUM_I_FIELD_##KIND,                       \
                                 .rule = BAUM_I_RULE_##RULE, .counter = offsetof(DEF, COUNTER), \
                                 .instead = offsetof(DEF, INSTEAD)                              \
  }

/* Every definition struct begins with these two fields. */
typedef struct baum_i_def_head {
  size_t struct_size;
  const char *name;
} baum_i_def_head;

struct baum_i_point;

/* Describes how a definition struct is filled, checked and copied. Functions may be NULL. */
typedef struct baum_i_definition {
  const char *kind;               /* "planar body", for messages */
  size_t size;                    /* of the struct */
  const baum_i_def_field *fields; /* all fields in order; one without a name ends the table */
  /* Some older versions of a struct ended with padding, which a later field now uses. This list has
   * the offset of the end of the last field of each such version, and ends with 0. NULL: there are
   * none. */
  const size_t *former;
  int parameter_count; /* how many numbers of an element are in the parameter array */
  /* Check what the table cannot express. Called after the checks of the table. Messages start with
   * the label, such as: joint 2 "B". */
  baum_status (*check)(const baum_mechanism *mechanism, const void *def, const char *label);
  /* Copy the data of OWN fields. Returns BAUM_OK, or BAUM_ERR_MEMORY, after which these fields own
   * no memory. */
  baum_status (*own)(void *def);
  void (*release)(void *def); /* free the memory of own() */
  /* Compare the derivatives that user functions of an element return with finite differences. NULL:
   * the element has no such functions. */
  baum_status (*check_derivatives)(const void *element, struct baum_i_point *point);
} baum_i_definition;

/* The first members of the baum_i_definition of baum_NAME_def. */
#define BAUM_I_DEFINITION(NAME, KIND, FIELDS) \
  .kind = (KIND), .size = sizeof(baum_##NAME##_def), .fields = (FIELDS)

static inline const void *baum_i_field_at(const baum_i_def_field *field, const void *def)
{
  return (const char *)def + field->offset;
}

/* Set all fields of a definition to their defaults. */
void baum_i_fields_set(const baum_i_definition *definition, void *def);

/* Check all fields, then call the check of the definition. Returns BAUM_OK, or BAUM_ERR_ARGUMENT
 * and sets its message. */
baum_status baum_i_fields_check(const baum_i_definition *definition,
                                const baum_mechanism *mechanism, const void *def,
                                const char *label);

/* Check that a new definition does not change what cannot change: counts, joints, and whether
 * functions of kind KEPT_FUNCTION are given. */
baum_status baum_i_fields_check_kept(const baum_i_definition *definition, const void *present,
                                     const void *next, const char *label);

/* Replace arrays by copies. Returns BAUM_OK, or BAUM_ERR_MEMORY, after which the definition owns no
 * memory. */
baum_status baum_i_fields_own(const baum_i_definition *definition, void *def);
void baum_i_fields_release(const baum_i_definition *definition, void *def);

/* Add flags, OWN arrays and inputs to a digest. fingerprint.c adds bodies and parameters. Fields
 * that are used only at the start of a run are not added. */
void baum_i_fields_digest(const baum_i_definition *definition, const void *def, baum_i_digest *sum);

/* Find the bodies on which an element acts: those that its definition names, and those of the
 * joints that it names. Each body is listed once. Returns the number of bodies, or an upper bound
 * of it if `bodies` is NULL. */
int baum_i_fields_bodies(const baum_i_definition *definition, const baum_mechanism *mechanism,
                         const void *def, int *bodies);

/* ---- checks of single values ---- */

baum_status baum_i_check_number(const char *label, const char *field, const char *unit,
                                baum_i_rule rule, double value);

/* Inline, because evaluations begin with this check. */
static inline baum_status baum_i_check_finite(const char *label, const char *field,
                                              const char *unit, double value)
{
  return isfinite(value) ? BAUM_OK
                         : baum_i_check_number(label, field, unit, BAUM_I_RULE_FINITE, value);
}

static inline baum_status baum_i_check_positive(const char *label, const char *field,
                                                const char *unit, double value)
{
  return baum_i_check_number(label, field, unit, BAUM_I_RULE_POSITIVE, value);
}

/* Check that the points of an element are given in exactly one way: `point`, or point_a and
 * point_b. The arguments tell which are given. Unless point_allowed, the message does not offer
 * `point`. */
baum_status baum_i_check_points_given(const char *label, bool point, bool a, bool b,
                                      bool point_allowed);

/* Check that a required function or array is given. For the field "mass()", `given` is `def->mass
 * != NULL`. */
baum_status baum_i_check_given(const char *label, const char *field, bool given);

#endif
