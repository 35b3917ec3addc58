/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests whether the forces that a joint exerts on its bodies are in balance. The force of one row
 * of J on a body is -lambda times the entries of this row in the columns of the body. The forces
 * and moments on all bodies of a joint therefore add up to zero if the following sums over these
 * bodies are zero for every row:
 *
 *   force x: J [1 0 0 ...],   force y: J [0 1 0 ...],   moment about the origin: J [-y x 1 ...]
 *
 * Each body contributes its three columns, and a particle contributes two.
 */
#include "balance.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "assert_near.h"

enum { FORCE_X, FORCE_Y, MOMENT, SUMS, BLOCK = TEST_SIZE_MAX * TEST_SIZE_MAX };

/* The tolerance is the rounding error of sums of a dozen terms. */
static const double TOLERANCE = 1e-13;

static bool has_ground(const baum_i_joint *joint)
{
  for (int k = 0; k < joint->span.body_count; k++) {
    if (joint->span.bodies[k] == 0) {
      return true;
    }
  }
  return false;
}

/* Adds the contribution of one column to the three sums, and its absolute value to *size. */
static void add_column(const baum_i_frame *frame, int coordinate, double value, double sums[SUMS],
                       double *size)
{
  const double shares[3][SUMS] = {{1.0, 0.0, -frame->y}, {0.0, 1.0, frame->x}, {0.0, 0.0, 1.0}};
  for (int i = 0; i < SUMS; i++) {
    sums[i] += value * shares[coordinate][i];
    *size += fabs(value * shares[coordinate][i]);
  }
}

static void check_row(const test_point *p, const baum_i_joint *joint, const double *row)
{
  double sums[SUMS] = {0.0};
  double size = 0.0;
  for (int k = 0; k < joint->span.body_count; k++) {
    int body = joint->span.bodies[k];
    for (int i = 0; i < p->mechanism->bodies[body]->nv; i++) {
      add_column(&p->point.frames[body], i, *row++, sums, &size);
    }
  }
  assert_true(size > 0.0);
  for (int i = 0; i < SUMS; i++) {
    ASSERT_NEAR(sums[i], 0.0, 0.0, TOLERANCE * size);
  }
}

void check_rows_balance(test_point *p)
{
  double blocks[BLOCK];
  assert_int_equal(baum_i_mechanism_jacobian(&p->point, blocks), BAUM_OK);
  for (int j = 0; j < p->mechanism->joint_count; j++) {
    const baum_i_joint *joint = p->mechanism->joints[j];
    if (joint->rows == 1 && !has_ground(joint)) {
      check_row(p, joint, blocks + joint->jacobian);
    }
  }
}
