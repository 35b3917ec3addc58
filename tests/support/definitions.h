/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks that wrong definitions are refused, and that definitions are read back unchanged. */
#ifndef BAUM_TEST_DEFINITIONS_H
#define BAUM_TEST_DEFINITIONS_H

#include <math.h>
#include <stddef.h>

#include <baum/mechanism.h>

/* These are doubles, because the macros of math.h are floats and clang warns about the
 * conversion. */
#define TEST_NAN      ((double)NAN)
#define TEST_INFINITY ((double)INFINITY)

/* Adds an element of one kind without returning its id. */
typedef baum_status add_fn(baum_mechanism *mechanism, const void *def);

/* Checks that an attempt to add the definition fails with BAUM_ERR_ARGUMENT and this message, and
 * that nothing is added. */
void check_refused(baum_mechanism *mechanism, add_fn *add, const void *def, const char *message);

/* A bad value that replaces one number of a good definition. */
typedef struct bad_number {
  size_t offset;
  double value;
  const char *message;
} bad_number;

void check_bad_numbers(baum_mechanism *mechanism, add_fn *add, const void *good, size_t size,
                       const bad_number *numbers, int count);

/* Checks that two definitions are equal. Their names are compared as texts, and everything else
 * byte by byte. */
void check_same_definition(const void *got, const void *want, size_t size);

/* Returns the size of a definition up to its last member. Padding bytes at the end are not
 * included. */
#define FILLED_SIZE(NAME, LAST) \
  (offsetof(baum_##NAME##_def, LAST) + sizeof(((baum_##NAME##_def *)0)->LAST))

/* Adds `first` and reads it back, then sets `second` and reads it back. FAMILY is body, joint or
 * force. NAME is the name in baum_NAME_def, and LAST is the last member of this struct. */
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
