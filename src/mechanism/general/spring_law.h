/* SPDX-License-Identifier: BSD-3-Clause */
/* The part that all springs have in common: the tension T as a function of a length l and its rate
 * l'. For a torsion spring, l is an angle; for a joint spring, it is a coordinate of a joint. k is
 * the stiffness, c the damping, and l_0 the free length.
 *
 *   T = k (l - l_0) + c l' with the potential V = k (l - l_0)^2 / 2,
 *   or a user's law T(l, l'), which has no potential
 */
#ifndef BAUM_I_MECHANISM_GENERAL_SPRING_LAW_H
#define BAUM_I_MECHANISM_GENERAL_SPRING_LAW_H

#include <baum/mechanism.h>

#include "mechanism/identify.h"

/* Parameters of a linear spring, in this order. */
enum { BAUM_I_STIFFNESS, BAUM_I_DAMPING, BAUM_I_FREE_LENGTH, BAUM_I_SPRING_NUMBERS };

/* The fields that the definitions of all springs contain, in this order. */
typedef struct baum_i_spring_def {
  double stiffness;
  double damping;
  double free_length;
  baum_spring_fn *law;
  void *user;
  bool depends_on_velocity;
} baum_i_spring_def;

#define BAUM_I_SPRING_OFFSET(DEF, field) (offsetof(DEF, field) - offsetof(DEF, stiffness))
#define BAUM_I_HAS_SPRING_FIELD(DEF, field) \
  (BAUM_I_SPRING_OFFSET(DEF, field) == offsetof(baum_i_spring_def, field))
/* Check, when this code is compiled, that a public definition has these fields in this order. */
#define BAUM_I_CHECK_SPRING_DEF(DEF)                                                           \
  _Static_assert(BAUM_I_HAS_SPRING_FIELD(DEF, damping) && BAUM_I_HAS_SPRING_FIELD(DEF, law) && \
                   BAUM_I_HAS_SPRING_FIELD(DEF, user) &&                                       \
                   BAUM_I_HAS_SPRING_FIELD(DEF, depends_on_velocity),                          \
                 #DEF " has the fields of baum_i_spring_def in another order")

#define BAUM_I_SPRING_FIELDS(DEF, PER_LENGTH, PER_RATE, FREE, RULE, UNIT) \
  BAUM_I_NUMBERS(DEF, stiffness, NOT_NEGATIVE, PER_LENGTH, 0.0),          \
    BAUM_I_NUMBERS(DEF, damping, NOT_NEGATIVE, PER_RATE, 0.0),            \
    BAUM_I_OPTIONAL(DEF, FREE, RULE, UNIT), BAUM_I_LAW(DEF, stiffness),   \
    BAUM_I_FIELD(DEF, user, USER), BAUM_I_FIELD(DEF, depends_on_velocity, CLAIM)

typedef struct baum_i_spring_law {
  const baum_i_element *element;
  const double *numbers; /* (BAUM_I_SPRING_NUMBERS) */
  baum_spring_fn *law;   /* user function that is used instead of `numbers`, or NULL */
  void *user;
  bool depends_on_rate; /* whether the law depends on l' */
} baum_i_spring_law;

/* The tension T and its derivatives with respect to l and l'. */
typedef struct baum_i_tension {
  double value;
  double by_length;
  double by_rate;
} baum_i_tension;

/* Call the law of a spring, which is a user function. Returns BAUM_OK, BAUM_ERR_CALLBACK or
 * BAUM_ERR_NOT_FINITE. */
baum_status baum_i_call_spring_law(const baum_i_spring_law *spring, baum_i_point *point,
                                   double length, double rate, baum_i_tension *out);

static inline baum_status baum_i_tension_at(const baum_i_spring_law *spring, baum_i_point *point,
                                            double length, double rate, baum_i_tension *out)
{
  if (spring->law) {
    return baum_i_call_spring_law(spring, point, length, rate, out);
  }
  const double *n = spring->numbers;
  out->value = n[BAUM_I_STIFFNESS] * (length - n[BAUM_I_FREE_LENGTH]) + n[BAUM_I_DAMPING] * rate;
  out->by_length = n[BAUM_I_STIFFNESS];
  out->by_rate = n[BAUM_I_DAMPING];
  return BAUM_OK;
}

static inline const baum_i_spring_def *baum_i_spring_def_of(const baum_i_force *force)
{
  const char *bytes = force->element.def;
  return (const baum_i_spring_def *)(const void *)(bytes + force->type->spring_fields);
}

/* Return the law of a spring. The numbers of the linear spring are the last BAUM_I_SPRING_NUMBERS
 * parameters of the element. */
static inline baum_i_spring_law baum_i_spring_law_of(const baum_i_force *force,
                                                     const baum_i_point *point)
{
  const baum_i_spring_def *def = baum_i_spring_def_of(force);
  int first = force->type->definition.parameter_count - BAUM_I_SPRING_NUMBERS;
  return (baum_i_spring_law){.element = &force->element,
                             .numbers = point->parameters + force->element.parameter + first,
                             .law = def->law,
                             .user = def->user,
                             .depends_on_rate = def->depends_on_velocity};
}

/* Set `numbers` from the definition of a spring. `design` is the length in the design
 * configuration. If the definition gives no free length, l_0 is set to `design`. */
void baum_i_spring_lower(const baum_i_force *force, double design, double *numbers);

/* ---- members of the types of springs ---- */

#define BAUM_I_SPRING_MEMBERS(DEF)                                                         \
  .spring_fields = offsetof(DEF, stiffness), .depends_on_velocity = baum_i_spring_depends, \
  .potential = baum_i_spring_potential, .power = baum_i_spring_power

bool baum_i_spring_depends(const baum_i_force *force);
/* Adds the potential V to *sum. A spring with a user's law adds nothing. */
baum_status baum_i_spring_potential(const baum_i_force *force, baum_i_point *point, double *sum);
/* Adds the power of the part of the tension that does not derive from V. For a user's law, this is
 * the whole tension. */
baum_status baum_i_spring_power(const baum_i_force *force, baum_i_point *point,
                                double sum[BAUM_I_POWERS]);
/* Checks the derivatives that a user's law returns, by finite differences. */
baum_status baum_i_spring_check(const void *force, baum_i_point *point);

#endif
