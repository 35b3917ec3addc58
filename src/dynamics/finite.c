/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds numbers that are not finite, and names them in a message. Large masses, forces and
 * coordinates are each valid in definitions, but their products in the equations may overflow. M is
 * always finite, because definitions and results of user functions are checked.
 */
#include <math.h>

#include "base/message.h"
#include "dynamics/dynamics.h"

/* Return the index of the first number that is not finite, or -1. */
static int first_not_finite(const double *values, int count)
{
  for (int i = 0; i < count; i++) {
    if (!isfinite(values[i])) {
      return i;
    }
  }
  return -1;
}

static baum_status fail(const baum_workspace *w, const char *what, const char *label, double value)
{
  return baum_i_fail(BAUM_ERR_NOT_FINITE, "t = %.9g s: the %s of %s is %g", w->point.t, what, label,
                     value);
}

static baum_status fail_row(const baum_workspace *w, const char *what, int row, double value)
{
  return fail(w, what, baum_i_row_label(w->mechanism, row).text, value);
}

static baum_status fail_velocity(const baum_workspace *w, const char *what, int column,
                                 double value)
{
  const baum_i_body *body = baum_i_velocity_body(w->mechanism, column);
  return fail(w, what, baum_i_label(&body->element).text, value);
}

baum_status baum_i_check_rows(const baum_workspace *w, const char *what, const double *values)
{
  int i = first_not_finite(values, w->mechanism->nc);
  return i < 0 ? BAUM_OK : fail_row(w, what, i, values[i]);
}

baum_status baum_i_check_velocities(const baum_workspace *w, const char *what, const double *values)
{
  int i = first_not_finite(values, w->mechanism->nv);
  return i < 0 ? BAUM_OK : fail_velocity(w, what, i, values[i]);
}

baum_status baum_i_check_positions(const baum_workspace *w, const char *what, const double *values)
{
  for (int k = 1; k <= w->mechanism->body_count; k++) {
    const baum_i_body *body = w->mechanism->bodies[k];
    int i = first_not_finite(values + body->q, body->nq);
    if (i >= 0) {
      return fail_velocity(w, what, body->v, values[body->q + i]);
    }
  }
  return BAUM_OK;
}

baum_status baum_i_check_sizes(const baum_workspace *w, const char *what, const double *values)
{
  const baum_mechanism *m = w->mechanism;
  BAUM_I_TRY(baum_i_check_velocities(w, what, values));
  for (int i = 0; i < m->nv; i++) {
    if (!isfinite(values[i] / m->scale[i])) {
      const baum_i_body *body = baum_i_velocity_body(m, i);
      return baum_i_fail(BAUM_ERR_NOT_FINITE,
                         "t = %.9g s: the %s of %s is %g, too large for double precision relative "
                         "to its scale of %g",
                         w->point.t, what, baum_i_label(&body->element).text, values[i],
                         m->scale[i]);
    }
  }
  return BAUM_OK;
}

baum_status baum_i_check_jacobian(const baum_workspace *w)
{
  for (int k = 0; k < w->structure.row_block_count; k++) {
    const baum_i_row_block *block = &w->structure.row_blocks[k];
    const double *values = w->jacobian + block->value;
    int i = first_not_finite(values, block->rows * block->cols);
    if (i >= 0) {
      return fail_row(w, "Jacobian", block->row, values[i]);
    }
  }
  return BAUM_OK;
}

baum_status baum_i_fail_not_finite(const baum_workspace *w)
{
  BAUM_I_TRY(baum_i_check_jacobian(w));
  BAUM_I_TRY(baum_i_check_velocities(w, "force", w->force));
  BAUM_I_TRY(baum_i_check_rows(w, "right-hand side of the constraints", w->rhs));
  return baum_i_fail(
    BAUM_ERR_NOT_FINITE,
    "t = %.9g s: numbers in the equations of motion are too large for double precision",
    w->point.t);
}
