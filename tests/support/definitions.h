/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions that are refused, and definitions that come back as they were given. */
#ifndef BAUM_TEST_DEFINITIONS_H
#define BAUM_TEST_DEFINITIONS_H

#include <math.h>
#include <stddef.h>

#include <baum/mechanism.h>

/* The C library's are floats, which clang says aloud. */
#define TEST_NAN      ((double)NAN)
#define TEST_INFINITY ((double)INFINITY)

/* One kind's add function, without its id. */
typedef baum_status add_fn(baum_mechanism *mechanism, const void *def);

/* The definition is refused with BAUM_ERR_ARGUMENT and this message, and nothing is added. */
void check_refused(baum_mechanism *mechanism, add_fn *add, const void *def, const char *message);

/* A good definition with one number replaced. */
typedef struct bad_number {
  size_t offset;
  double value;
  const char *message;
} bad_number;

void check_bad_numbers(baum_mechanism *mechanism, add_fn *add, const void *good, size_t size,
                       const bad_number *numbers, int count);

/* Both definitions say the same; names are compared as text. */
void check_same_definition(const void *got, const void *want, size_t size);

/* Size of a definition up to its last member: what pads its end has no value. */
#define FILLED_SIZE(NAME, LAST) \
  (offsetof(baum_##NAME##_def, LAST) + sizeof(((baum_##NAME##_def *)0)->LAST))

/* Add first, read it back, replace it by second, read that back. FAMILY: body, joint, force; NAME
 * as in baum_NAME_def, LAST its last member. */
#define CHECK_ROUND_TRIP(FAMILY, NAME, LAST, mechanism, first, second)                          \
  do {                                                                                          \
    baum_##FAMILY##_id id_;                                                                     \
    baum_##NAME##_def got_;                                                                     \
    assert_int_equal(baum_mechanism_add_##NAME((mechanism), (first), &id_), BAUM_OK);           \
    assert_int_equal(baum_mechanism_get_##NAME((mechanism), id_, &got_, sizeof got_), BAUM_OK); \
    check_same_definition(&got_, (first), FILLED_SIZE(NAME, LAST));                             \
    assert_int_equal(baum_mechanism_set_##NAME((mechanism), id_, (second)), BAUM_OK);           \
    assert_int_equal(baum_mechanism_get_##NAME((mechanism), id_, &got_, sizeof got_), BAUM_OK); \
    check_same_definition(&got_, (second), FILLED_SIZE(NAME, LAST));                            \
  } while (0)

#endif
