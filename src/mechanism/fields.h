/* SPDX-License-Identifier: BSD-3-Clause */
/* Each definition has a table of its fields. From this table, the library sets defaults, checks
 * single fields, copies definitions, adds them to digests (fingerprint.h), and finds the bodies on
 * which an element acts. Tests of the public headers also use the table. */
#ifndef BAUM_I_MECHANISM_FIELDS_H
#define BAUM_I_MECHANISM_FIELDS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <baum/mechanism.h>

#include "base/digest.h"

/* Default of optional numbers. The cast is needed because the macro NAN is of type float. */
#define BAUM_I_NOT_GIVEN ((double)NAN)

/* The rules for the value of a number. */
typedef enum baum_i_rule {
  BAUM_I_RULE_FINITE,
  BAUM_I_RULE_POSITIVE,
  BAUM_I_RULE_NOT_NEGATIVE,
  BAUM_I_RULE_NOT_ZERO,
  BAUM_I_RULE_OPTIONAL, /* finite, or NaN for a number that is not given */
  BAUM_I_RULE_FREE,     /* finite, or NaN for a velocity that is not prescribed */
  BAUM_I_RULE_OPTIONAL_POSITIVE,
  BAUM_I_RULE_OPTIONAL_NOT_NEGATIVE,
  BAUM_I_RULE_POINT,    /* either all numbers of the field are finite, or all are NaN */
  BAUM_I_RULE_DIRECTION /* all numbers of the field are finite, and at least one is not zero */
} baum_i_rule;

/* Fields whose kind contains OWN are not handled here, but by functions of the definition, which
 * check, copy and release them. Scenes (baum/scene.h) rely on the order of the groups in this list:
 * first numbers and counts, then flags, then references, then functions. */
typedef enum baum_i_field_kind {
  BAUM_I_FIELD_NUMBERS, /* double or double[] */
  /* array of doubles or NULL; `counter` gives its length; used only at the start of a run */
  BAUM_I_FIELD_ARRAY,
  BAUM_I_FIELD_OWN_ARRAY,
  /* array of points, each with three doubles; `counter` gives the number of points */
  BAUM_I_FIELD_POINTS,
  BAUM_I_FIELD_COUNT,          /* int32_t > 0 that cannot change after the element was added */
  BAUM_I_FIELD_OPTIONAL_COUNT, /* like COUNT, but may be 0 */
  BAUM_I_FIELD_OWN_COUNT,
  BAUM_I_FIELD_FLAG,
  BAUM_I_FIELD_START_FLAG, /* a flag that is used only at the start of a run */
  BAUM_I_FIELD_CLAIM,      /* states whether user functions depend on velocities; true by default */
  BAUM_I_FIELD_BODY,       /* a required body; ground is allowed */
  BAUM_I_FIELD_CARRIER,    /* a body; ground if it is not given */
  /* array of body ids; `counter` gives its length; ground and repeated bodies are not allowed */
  BAUM_I_FIELD_BODIES,
  /* array of at least two body ids; ground and repeated bodies are allowed */
  BAUM_I_FIELD_PATH,
  /* a required joint, which cannot be changed later; the element acts on the bodies of this
   * joint */
  BAUM_I_FIELD_JOINT,
  BAUM_I_FIELD_COORDINATE, /* a baum_joint_coordinate, which the definition itself checks */
  BAUM_I_FIELD_INPUT,      /* an input, or none */
  BAUM_I_FIELD_FUNCTION,   /* a user function that must be given */
  BAUM_I_FIELD_OPTIONAL_FUNCTION,
  /* an optional user function that replaces the numbers in the field at `counter` and in the fields
   * after it; these numbers must then have their defaults */
  BAUM_I_FIELD_LAW,
  /* an optional user function, which cannot be added or removed later */
  BAUM_I_FIELD_KEPT_FUNCTION,
  BAUM_I_FIELD_USER /* the pointer that user functions receive */
} baum_i_field_kind;

/* Largest count of numbers in a field, and largest count of default values that a table can give
 * for a field. */
enum { BAUM_I_FIELD_SIZE_MAX = 36, BAUM_I_FIELD_DEFAULTS = 6 };

/* One field of a definition. The tables do not contain the fields struct_size and name. */
typedef struct baum_i_def_field {
  const char *name;
  const char *unit; /* unit of numbers; "" if the user chooses the unit */
  size_t offset;
  size_t size;
  baum_i_field_kind kind;
  baum_i_rule rule; /* rule for numbers and arrays of numbers */
  /* defaults of the first numbers of the field; all other defaults are 0 */
  double value[BAUM_I_FIELD_DEFAULTS];
  /* for an array: the offset of the field that gives its length; for a law: see BAUM_I_FIELD_LAW */
  size_t counter;
  /* for an array: the offset of the count that is used if the field at `counter` is 0 */
  size_t instead;
} baum_i_def_field;

#define BAUM_I_FIELD_OF(DEF, FIELD) \
  .name = #FIELD, .offset = offsetof(DEF, FIELD), .size = sizeof(((DEF *)0)->FIELD)

#define BAUM_I_FIELD(DEF, FIELD, KIND)                                   \
  {                                                                      \
    BAUM_I_FIELD_OF(DEF, FIELD), .unit = "", .kind = BAUM_I_FIELD_##KIND \
  }

/* A field of numbers. The last arguments are the default values of the numbers. */
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

/* The function `law`, which replaces the numbers in the field FIRST and in the fields after it. */
#define BAUM_I_LAW(DEF, FIRST)                                       \
  {                                                                  \
    BAUM_I_FIELD_OF(DEF, law), .unit = "", .kind = BAUM_I_FIELD_LAW, \
                               .counter = offsetof(DEF, FIRST)       \
  }

/* An array whose length is the field COUNTER, or the field INSTEAD if COUNTER is 0. */
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

/* Describes how a definition struct is filled, checked and copied. Members that are functions may
 * be NULL. */
typedef struct baum_i_definition {
  const char *kind;               /* "planar body", for messages */
  size_t size;                    /* size of the struct */
  const baum_i_def_field *fields; /* all fields in order; an entry without a name ends the table */
  /* Some older versions of a struct ended with padding, which a later field now uses. For each such
   * version, this list has the offset of the end of its last field. The list ends with 0. NULL if
   * there are no such versions. */
  const size_t *former;
  int parameter_count; /* how many entries of the parameter array an element uses */
  /* Check what the table of fields cannot express. All fields have been checked by the table before
   * this call. Messages begin with the label, such as: joint 2 "B". */
  baum_status (*check)(const baum_mechanism *mechanism, const void *def, const char *label);
  /* Copy the data of OWN fields. Returns BAUM_OK, or BAUM_ERR_MEMORY. After a failure these fields
   * own no memory. */
  baum_status (*own)(void *def);
  void (*release)(void *def); /* free the memory that own() has allocated */
  /* Check the derivatives that user functions of an element return. Finite differences give the
   * values for comparison. NULL if the element has no such functions. */
  baum_status (*check_derivatives)(const void *element, struct baum_i_point *point);
} baum_i_definition;

/* Initializes the first members of the baum_i_definition that describes the struct
 * baum_NAME_def. */
#define BAUM_I_DEFINITION(NAME, KIND, FIELDS) \
  .kind = (KIND), .size = sizeof(baum_##NAME##_def), .fields = (FIELDS)

/* Return the default of number k of a field. */
static inline double baum_i_field_default(const baum_i_def_field *field, size_t k)
{
  return k < BAUM_I_FIELD_DEFAULTS ? field->value[k] : 0.0;
}

static inline const void *baum_i_field_at(const baum_i_def_field *field, const void *def)
{
  return (const char *)def + field->offset;
}

/* Return how many numbers an array has for each entry that its counter counts. */
static inline int baum_i_field_stride(const baum_i_def_field *field)
{
  return field->kind == BAUM_I_FIELD_POINTS ? 3 : 1;
}

static inline bool baum_i_field_has_bodies(const baum_i_def_field *field)
{
  return field->kind == BAUM_I_FIELD_BODIES || field->kind == BAUM_I_FIELD_PATH;
}

/* Set all fields of a definition to their defaults. */
void baum_i_fields_set(const baum_i_definition *definition, void *def);

/* Check all fields by the table, then call the check of the definition. Returns BAUM_OK, or
 * BAUM_ERR_ARGUMENT after setting the message. */
baum_status baum_i_fields_check(const baum_i_definition *definition,
                                const baum_mechanism *mechanism, const void *def,
                                const char *label);

/* Check that a new definition leaves unchanged what must not change: the counts, the joints, and
 * whether functions of kind KEPT_FUNCTION are given. */
baum_status baum_i_fields_check_kept(const baum_i_definition *definition, const void *present,
                                     const void *next, const char *label);

/* Tell whether a definition gives a user function. */
bool baum_i_fields_have_function(const baum_i_definition *definition, const void *def);

/* Replace the arrays of a definition by copies. Returns BAUM_OK, or BAUM_ERR_MEMORY. After a
 * failure the definition owns no memory. */
baum_status baum_i_fields_own(const baum_i_definition *definition, void *def);
void baum_i_fields_release(const baum_i_definition *definition, void *def);

/* Add the flags, the joints, the coordinates, the inputs, the arrays of numbers and the paths of
 * bodies of a definition to a digest. The function in fingerprint.c adds bodies and parameters.
 * Fields that are used only at the start of a run are not added. */
void baum_i_fields_digest(const baum_i_definition *definition, const void *def, baum_i_digest *sum);

/* Find the bodies on which an element acts. These are the bodies that its definition names, and the
 * bodies of the joints that the definition names. Each body is listed once. Returns the number of
 * bodies. If `bodies` is NULL, returns an upper bound of this number. */
int baum_i_fields_bodies(const baum_i_definition *definition, const baum_mechanism *mechanism,
                         const void *def, int *bodies);

/* ---- checks of single values ---- */

baum_status baum_i_check_number(const char *label, const char *field, const char *unit,
                                baum_i_rule rule, double value);

/* Check that a value is finite. The function is inline, because evaluations begin with this
 * check. */
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
 * point_b. The arguments tell which of them the definition gives. If `point_allowed` is false, the
 * message does not suggest `point`. */
baum_status baum_i_check_points_given(const char *label, bool point, bool a, bool b,
                                      bool point_allowed);

/* Check that a required function or array is given. For example, for the field "mass()" the
 * argument `given` is `def->mass != NULL`. */
baum_status baum_i_check_given(const char *label, const char *field, bool given);

#endif
