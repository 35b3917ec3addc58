/* SPDX-License-Identifier: BSD-3-Clause */
/* The fields of a definition as a table, which is all that defaults, checks of single fields,
 * copies, digests, bodies of an element and tests of the headers need to know of it. */
#ifndef BAUM_I_MECHANISM_FIELDS_H
#define BAUM_I_MECHANISM_FIELDS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <baum/mechanism.h>

#include "base/digest.h"

/* What an optional number is by default; NAN itself is a float. */
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

/* An "own" field is checked, copied and released by the functions of its definition. */
typedef enum baum_i_field_kind {
  BAUM_I_FIELD_NUMBERS, /* double or double[] */
  BAUM_I_FIELD_ARRAY,   /* of doubles, which counter counts; or NULL. Of the start only */
  BAUM_I_FIELD_OWN_ARRAY,
  BAUM_I_FIELD_COUNT,          /* int32_t > 0 that must stay */
  BAUM_I_FIELD_OPTIONAL_COUNT, /* likewise, or 0 */
  BAUM_I_FIELD_OWN_COUNT,
  BAUM_I_FIELD_FLAG,
  BAUM_I_FIELD_START_FLAG, /* of the start only */
  BAUM_I_FIELD_CLAIM,      /* flag of what functions do, true by default */
  BAUM_I_FIELD_BODY,       /* that must be given; ground is allowed */
  BAUM_I_FIELD_CARRIER,    /* a body, ground by default */
  BAUM_I_FIELD_BODIES,     /* array of ids, which counter counts: neither ground nor one twice */
  BAUM_I_FIELD_JOINT,      /* that must be given and stay; the element acts on its bodies */
  BAUM_I_FIELD_INPUT,      /* or none */
  BAUM_I_FIELD_FUNCTION,   /* that must be given */
  BAUM_I_FIELD_OPTIONAL_FUNCTION,
  BAUM_I_FIELD_KEPT_FUNCTION, /* one that is there or not, which must stay */
  BAUM_I_FIELD_USER           /* pointer that is handed on */
} baum_i_field_kind;

enum { BAUM_I_FIELD_SIZE_MAX = 6 }; /* of numbers */

/* One field behind struct_size and name. */
typedef struct baum_i_def_field {
  const char *name;
  const char *unit; /* of numbers; "": the user's own */
  size_t offset;
  size_t size;
  baum_i_field_kind kind;
  baum_i_rule rule;                    /* of numbers and arrays of them */
  double value[BAUM_I_FIELD_SIZE_MAX]; /* default of numbers */
  size_t counter;                      /* offset of the count of an array, */
  size_t instead;                      /* and of that which holds where this is 0 */
} baum_i_def_field;

#define BAUM_I_FIELD_OF(DEF, FIELD) \
  .name = #FIELD, .offset = offsetof(DEF, FIELD), .size = sizeof(((DEF *)0)->FIELD)

#define BAUM_I_FIELD(DEF, FIELD, KIND)                                   \
  {                                                                      \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = "", .kind = BAUM_I_FIELD_##KIND \
  }

/* With the defaults of all numbers at the end. */
#define BAUM_I_NUMBERS(DEF, FIELD, RULE, UNIT, ...)                                     \
  {                                                                                     \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = (UNIT), .rule = BAUM_I_RULE_##RULE, .value = { \
      __VA_ARGS__                                                                       \
    }                                                                                   \
  }

/* Numbers that need not be given. */
#define BAUM_I_OPTIONAL(DEF, FIELD, RULE, UNIT)                                                \
  BAUM_I_NUMBERS(DEF, FIELD, RULE, UNIT, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, \
                 BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN)

/* INSTEAD counts where COUNTER is 0. */
#define BAUM_I_ARRAY(DEF, FIELD, KIND, RULE, COUNTER, INSTEAD)                                  \
  {                                                                                             \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = "", .kind = BAUM_I_FIELD_##KIND,                       \
                                 .rule = BAUM_I_RULE_##RULE, .counter = offsetof(DEF, COUNTER), \
                                 .instead = offsetof(DEF, INSTEAD)                              \
  }

/* Every definition struct begins with these two. */
typedef struct baum_i_def_head {
  size_t struct_size;
  const char *name;
} baum_i_def_head;

struct baum_i_point;

/* How a definition struct is filled, checked and owned. Functions may be NULL. */
typedef struct baum_i_definition {
  const char *kind;               /* "planar body", for messages */
  size_t size;                    /* of the struct */
  const baum_i_def_field *fields; /* all of them in their order; one without a name ends them */
  /* Where the fields of former versions ended that had padding in which a later field lies;
   * 0 ends the list. NULL: none. */
  const size_t *former;
  int parameter_count; /* of an element in the parameter array */
  /* Check what the table cannot say, when it holds; messages start with label, such as:
   * joint 2 "B". */
  baum_status (*check)(const baum_mechanism *mechanism, const void *def, const char *label);
  /* Replace what own fields point to by own copies: BAUM_OK or BAUM_ERR_MEMORY, then of these
   * nothing is owned. */
  baum_status (*own)(void *def);
  void (*release)(void *def); /* free what own() made */
  /* Compare the derivatives that an element gives with differences; NULL: it gives none. */
  baum_status (*check_derivatives)(const void *element, struct baum_i_point *point);
} baum_i_definition;

static inline const void *baum_i_field_at(const baum_i_def_field *field, const void *def)
{
  return (const char *)def + field->offset;
}

/* Set a whole definition to its defaults. */
void baum_i_fields_set(const baum_i_definition *definition, void *def);

/* Check all fields, and then what the definition itself checks: BAUM_OK, or BAUM_ERR_ARGUMENT with
 * its message. */
baum_status baum_i_fields_check(const baum_i_definition *definition,
                                const baum_mechanism *mechanism, const void *def,
                                const char *label);

/* Check that a definition that shall replace another one keeps what must stay: counts and
 * joints. */
baum_status baum_i_fields_check_kept(const baum_i_definition *definition, const void *present,
                                     const void *next, const char *label);

/* Replace arrays by own copies: BAUM_OK or BAUM_ERR_MEMORY, then nothing is owned. */
baum_status baum_i_fields_own(const baum_i_definition *definition, void *def);
void baum_i_fields_release(const baum_i_definition *definition, void *def);

/* Add what tells this one from others beside its bodies and numbers: flags, arrays, inputs. Not
 * what only the start knows. */
void baum_i_fields_digest(const baum_i_definition *definition, const void *def, baum_i_digest *sum);

/* The bodies that an element acts on, each once: those that it names, and those of the joints that
 * it names. Their number; bodies may be NULL, then at most as many. */
int baum_i_fields_bodies(const baum_i_definition *definition, const baum_mechanism *mechanism,
                         const void *def, int *bodies);

/* ---- checks of single values, by which the table's are made ---- */

baum_status baum_i_check_number(const char *label, const char *field, const char *unit,
                                baum_i_rule rule, double value);

/* At the start of evaluations, too: without a call where all is well. */
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

/* A required function or array: given is `def->mass != NULL`, field "mass()". */
baum_status baum_i_check_given(const char *label, const char *field, bool given);

#endif
