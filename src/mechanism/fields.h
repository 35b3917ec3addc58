/* SPDX-License-Identifier: BSD-3-Clause */
/* The fields of a definition as a table. Defaults, checks of single fields, copies, digests, the
 * bodies of an element and tests of the headers use this table. */
#ifndef BAUM_I_MECHANISM_FIELDS_H
#define BAUM_I_MECHANISM_FIELDS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <baum/mechanism.h>

#include "base/digest.h"

/* Default of optional numbers. NAN itself is a float. */
#define BAUM_I_NOT_GIVEN ((double)NAN)

/* What a number must be. */
typedef enum baum_i_rule {
  BAUM_I_RULE_FINITE,
  BAUM_I_RULE_POSITIVE,
  BAUM_I_RULE_NOT_NEGATIVE,
  BAUM_I_RULE_NOT_ZERO,
  BAUM_I_RULE_OPTIONAL, /* finite, or NaN: not given */
  BAUM_I_RULE_FREE,     /* finite, or NaN: a free velocity */
  BAUM_I_RULE_OPTIONAL_POSITIVE,
  BAUM_I_RULE_OPTIONAL_NOT_NEGATIVE,
  BAUM_I_RULE_POINT,    /* all numbers of a field are finite, or none is given */
  BAUM_I_RULE_DIRECTION /* finite, and not all of a field are zero */
} baum_i_rule;

/* The functions of the definition check, copy and release an "own" field. */
typedef enum baum_i_field_kind {
  BAUM_I_FIELD_NUMBERS, /* double or double[] */
  BAUM_I_FIELD_ARRAY,   /* array of doubles, counted by `counter`, or NULL; only for the start */
  BAUM_I_FIELD_OWN_ARRAY,
  BAUM_I_FIELD_COUNT,          /* int32_t > 0 that cannot change */
  BAUM_I_FIELD_OPTIONAL_COUNT, /* likewise, or 0 */
  BAUM_I_FIELD_OWN_COUNT,
  BAUM_I_FIELD_FLAG,
  BAUM_I_FIELD_START_FLAG, /* only for the start */
  BAUM_I_FIELD_CLAIM,      /* flag that describes user functions, true by default */
  BAUM_I_FIELD_BODY,       /* must be given; ground is allowed */
  BAUM_I_FIELD_CARRIER,    /* a body, ground by default */
  BAUM_I_FIELD_BODIES,     /* array of ids, counted by `counter`: no ground, no repetition */
  BAUM_I_FIELD_JOINT,      /* must be given and cannot change; the element acts on its bodies */
  BAUM_I_FIELD_INPUT,      /* or none */
  BAUM_I_FIELD_FUNCTION,   /* must be given */
  BAUM_I_FIELD_OPTIONAL_FUNCTION,
  BAUM_I_FIELD_KEPT_FUNCTION, /* given or not; this cannot change */
  BAUM_I_FIELD_USER           /* pointer that user functions receive */
} baum_i_field_kind;

enum { BAUM_I_FIELD_SIZE_MAX = 6 }; /* of numbers */

/* One field behind struct_size and name. */
typedef struct baum_i_def_field {
  const char *name;
  const char *unit; /* of numbers; "": chosen by the user */
  size_t offset;
  size_t size;
  baum_i_field_kind kind;
  baum_i_rule rule;                    /* of numbers and arrays of them */
  double value[BAUM_I_FIELD_SIZE_MAX]; /* default of numbers */
  size_t counter;                      /* offset of the count of an array */
  size_t instead;                      /* offset of the count to use where that is 0 */
} baum_i_def_field;

#define BAUM_I_FIELD_OF(DEF, FIELD) \
  .name = #FIELD, .offset = offsetof(DEF, FIELD), .size = sizeof(((DEF *)0)->FIELD)

#define BAUM_I_FIELD(DEF, FIELD, KIND)                                   \
  {                                                                      \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = "", .kind = BAUM_I_FIELD_##KIND \
  }

/* The defaults of all numbers come last. */
#define BAUM_I_NUMBERS(DEF, FIELD, RULE, UNIT, ...)                                     \
  {                                                                                     \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = (UNIT), .rule = BAUM_I_RULE_##RULE, .value = { \
      __VA_ARGS__                                                                       \
    }                                                                                   \
  }

/* Numbers that are optional. */
#define BAUM_I_OPTIONAL(DEF, FIELD, RULE, UNIT)                                                \
  BAUM_I_NUMBERS(DEF, FIELD, RULE, UNIT, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, \
                 BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN)

/* INSTEAD is the count if COUNTER is 0. */
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

/* How a definition struct is filled, checked and owned. Functions may be NULL. */
typedef struct baum_i_definition {
  const char *kind;               /* "planar body", for messages */
  size_t size;                    /* of the struct */
  const baum_i_def_field *fields; /* all in their order; a field without a name ends the table */
  /* Offsets where the fields of former versions ended, if a later field uses their padding; 0 ends
   * the list. NULL: none. */
  const size_t *former;
  int parameter_count; /* of an element in the parameter array */
  /* Check what the table cannot express, after the table's checks. Messages start with the label,
   * such as: joint 2 "B". */
  baum_status (*check)(const baum_mechanism *mechanism, const void *def, const char *label);
  /* Copy the data that "own" fields point to. BAUM_OK, or BAUM_ERR_MEMORY; then these fields own
   * nothing. */
  baum_status (*own)(void *def);
  void (*release)(void *def); /* free what own() made */
  /* Compare the derivatives that an element gives with differences; NULL: it gives none. */
  baum_status (*check_derivatives)(const void *element, struct baum_i_point *point);
} baum_i_definition;

static inline const void *baum_i_field_at(const baum_i_def_field *field, const void *def)
{
  return (const char *)def + field->offset;
}

/* Set all fields of a definition to their defaults. */
void baum_i_fields_set(const baum_i_definition *definition, void *def);

/* Check all fields, then call the check of the definition. BAUM_OK, or BAUM_ERR_ARGUMENT with its
 * message. */
baum_status baum_i_fields_check(const baum_i_definition *definition,
                                const baum_mechanism *mechanism, const void *def,
                                const char *label);

/* Check that a replacing definition keeps what cannot change: counts, joints, kept functions. */
baum_status baum_i_fields_check_kept(const baum_i_definition *definition, const void *present,
                                     const void *next, const char *label);

/* Replace arrays by copies. BAUM_OK, or BAUM_ERR_MEMORY; then the definition owns nothing. */
baum_status baum_i_fields_own(const baum_i_definition *definition, void *def);
void baum_i_fields_release(const baum_i_definition *definition, void *def);

/* Add flags, own arrays and inputs to a digest. Bodies and lowered numbers are added elsewhere, and
 * fields that matter only for the start are skipped. */
void baum_i_fields_digest(const baum_i_definition *definition, const void *def, baum_i_digest *sum);

/* Find the bodies that an element acts on, each once: the bodies and the bodies of the joints that
 * its definition names. Returns their number, or with NULL for bodies an upper bound of it. */
int baum_i_fields_bodies(const baum_i_definition *definition, const baum_mechanism *mechanism,
                         const void *def, int *bodies);

/* ---- checks of single values ---- */

baum_status baum_i_check_number(const char *label, const char *field, const char *unit,
                                baum_i_rule rule, double value);

/* Inline, because evaluations begin with it. */
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

/* Check that a required function or array is given: `def->mass != NULL` for the field "mass()". */
baum_status baum_i_check_given(const char *label, const char *field, bool given);

#endif
