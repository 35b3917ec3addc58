/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_velocity_rows.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"

enum { KNIFE_EDGE = 'e', USER_ROWS = 'w' };

static void keep(random_mechanism *r, char kind, baum_joint_id id)
{
  r->joint_kind[r->joint_count] = kind;
  r->joints[r->joint_count++] = id;
}

/* ---- knife edges ---- */

static void add_edge(random_mechanism *r, const random_body *a, const random_body *b)
{
  chance *c = &r->chance;
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  baum_joint_id id;
  double *point = chance_below(c, 2) == 0 ? def.point : def.point_a;
  const double angle = chance_number(c, 0.0, 6.0);
  def.body_a = a->id;
  def.body_b = b->id;
  def.axis[0] = cos(angle);
  def.axis[1] = sin(angle);
  for (int i = 0; i < 2; i++) {
    point[i] = chance_number(c, -1.0, 1.0) + (point == def.point ? a->q[i] : 0.0);
  }
  for (int count = chance_below(c, 12) == 0 ? 2 : 1; count > 0; count--) {
    check(baum_mechanism_add_planar_knife_edge(r->mechanism, &def, &id));
    keep(r, KNIFE_EDGE, id);
  }
}

/* ---- user constraints ---- */

/* J_ij = linear_ij + square_ij (q_k - at_k), where k is the coordinate after j. */
static int next_of(const random_rows *r, int j)
{
  return (j + 1) % r->columns;
}

static int rows_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  const random_rows *r = user;
  for (int i = 0; i < r->rows; i++) {
    for (int j = 0; j < r->columns; j++) {
      int k = next_of(r, j);
      out[i * r->columns + j] = r->linear[i][j] + r->square[i][j] * (q[k] - r->at[k]);
    }
  }
  return 0;
}

static int rows_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  const random_rows *r = user;
  for (int i = 0; i < r->rows; i++) {
    out[i] = 0.0;
    for (int j = 0; j < r->columns; j++) {
      out[i] -= r->square[i][j] * v[j] * v[next_of(r, j)];
    }
  }
  return 0;
}

static void add_user_rows(random_mechanism *r, const random_body *a, const random_body *b)
{
  chance *c = &r->chance;
  const random_body *members[2] = {a, b};
  baum_body_id ids[2];
  baum_user_constraint_def def = baum_user_constraint_def_default();
  random_rows *rows = &r->rows[r->rows_count++];
  baum_joint_id id;
  for (int k = 0; k < 2; k++) {
    if (members[k]->kind != 'g' && (k == 0 || a != b)) {
      memcpy(rows->at + rows->columns, members[k]->q, (size_t)members[k]->size * sizeof(double));
      rows->columns += members[k]->size;
      ids[def.body_count++] = members[k]->id;
    }
  }
  rows->rows = rows->columns > 1 ? 1 + chance_below(c, 2) : 1;
  for (int i = 0; i < rows->rows; i++) {
    for (int j = 0; j < rows->columns; j++) {
      rows->linear[i][j] = chance_below(c, 4) == 0 ? 0.0 : chance_number(c, -1.0, 1.0);
      rows->square[i][j] = chance_below(c, 2) == 0 ? 0.0 : chance_number(c, -0.5, 0.5);
    }
  }
  def.bodies = ids;
  def.row_count = rows->rows;
  def.jacobian = rows_jacobian;
  def.gamma = rows_gamma;
  def.velocity_level = true;
  def.user = rows;
  check(baum_mechanism_add_user_constraint(r->mechanism, &def, &id));
  keep(r, USER_ROWS, id);
}

/* ---- both ---- */

static bool turns(const random_body *b)
{
  return b->kind == 'b' || b->kind == 'g';
}

void random_mechanism_add_velocity_rows(random_mechanism *r)
{
  chance *c = &r->chance;
  const random_body *a = &r->bodies[chance_below(c, r->body_count)];
  const random_body *b = &r->bodies[chance_below(c, 3) == 0 ? 0 : chance_below(c, r->body_count)];
  if (a != b && turns(a) && turns(b) && chance_below(c, 3) > 0) {
    add_edge(r, a, b);
  } else if (a->kind != 'g' || b->kind != 'g') {
    add_user_rows(r, a, b);
  }
}

bool random_mechanism_is_velocity_row(const random_mechanism *r, int row)
{
  for (int k = 0; k < r->joint_count; k++) {
    int32_t first = 0;
    int32_t count = 0;
    bool of_velocity = r->joint_kind[k] == KNIFE_EDGE || r->joint_kind[k] == USER_ROWS;
    if (of_velocity) {
      check(baum_mechanism_rows(r->mechanism, r->joints[k], &first, &count));
    }
    if (row >= first && row < first + count) {
      return true;
    }
  }
  return false;
}
