/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial_oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle_motion.h"
#include "random_mechanism.h"

/* If all entries of a row are smaller than this, the row is zero except for rounding errors. An
 * example is a row that holds a planar body in its plane. All other rows have entries of about
 * 1. */
static const double NO_ROW = 1e-13;

/* If rows are dependent, some linear combinations of rows are zero. The coefficients of such a
 * combination can be added to the multipliers without any effect on the motion. The reaction of a
 * joint is considered unique if it changes by less than NO_PART for every combination. */
static const double NO_PART = 1e-8;

static wide largest(const wide *x, int count)
{
  wide most = 0;
  for (int i = 0; i < count; i++) {
    most = wide_size(x[i]) > most ? wide_size(x[i]) : most;
  }
  return most;
}

/* ---- equations ---- */

/* The rows of all joints, with six columns for each body. */
typedef struct row_list {
  int first[ORACLE_JOINTS + 1];
  wide (*j)[ORACLE_COLUMNS];
} row_list;

static void find_columns(instant *still, const oracle_joint *joint, wide (*j)[ORACLE_COLUMNS])
{
  int members[ORACLE_MEMBERS];
  int member_count = oracle_members_of(still->o, joint, members);
  for (int n = 0; n < member_count; n++) {
    int body = members[n];
    const motion kept = still->bodies[body];
    for (int k = 0; k < 6; k++) {
      wide six[6] = {0};
      jet rows[ORACLE_ROWS];
      six[k] = 1;
      oracle_set_velocities(still, body, six);
      int row_count = oracle_rows_of(still->o, joint, still->bodies, still->t, 0, rows);
      for (int i = 0; i < row_count; i++) {
        j[i][6 * body + k] = rows[i].d[1];
      }
    }
    still->bodies[body] = kept;
  }
}

static void find_rows(const instant *now, row_list *list, wide *gamma, oracle_answer *out)
{
  instant still = oracle_stop(now);
  int row = 0;
  out->phi = 0.0;
  out->rate = 0.0;
  for (int n = 0; n < now->o->joint_count; n++) {
    const oracle_joint *joint = &now->o->joints[n];
    jet rows[ORACLE_ROWS];
    int count = oracle_rows_of(now->o, joint, now->bodies, now->t, 1, rows);
    list->first[n] = row;
    find_columns(&still, joint, list->j + row);
    for (int i = 0; i < count; i++) {
      gamma[row + i] = -rows[i].d[2];
      out->phi = fmax(out->phi, fabs((double)rows[i].d[0]));
      out->rate = fmax(out->rate, fabs((double)rows[i].d[1]));
    }
    row += count;
  }
  list->first[now->o->joint_count] = row;
}

static void fill_bodies(const instant *now, quad_equations *s)
{
  const spatial_oracle *o = now->o;
  wide six[ORACLE_BODIES][6];
  oracle_forces_at(now, six);
  for (int k = 1; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    for (int i = 0; i < body->nv; i++) {
      wide *row = s->mass + (ptrdiff_t)(body->first_v + i) * s->nv + body->first_v;
      s->force[body->first_v + i] = six[k][oracle_six_of(body, i)];
      for (int j = 0; j < body->nv; j++) {
        const wide e[3] = {oracle_six_of(body, j) == 3, oracle_six_of(body, j) == 4,
                           oracle_six_of(body, j) == 5};
        wide turned_by[3];
        oracle_inertia_times(body, e, turned_by);
        int at = oracle_six_of(body, i);
        row[j] = at < 3 ? (i == j ? body->mass : 0) : turned_by[at - 3];
      }
    }
  }
}

static void fill_rows(const spatial_oracle *o, const row_list *list, const wide *gamma,
                      quad_equations *s)
{
  chance c = chance_of(o->rounding);
  for (int r = 0; r < s->nc; r++) {
    wide *row = s->jacobian + (ptrdiff_t)r * s->nv;
    for (int k = 1; k < o->body_count; k++) {
      const oracle_body *body = &o->bodies[k];
      for (int i = 0; i < body->nv; i++) {
        double error = o->rounding ? chance_number(&c, -0x1p-53, 0x1p-53) : 0.0;
        row[body->first_v + i] = list->j[r][6 * k + oracle_six_of(body, i)] * (1 + (wide)error);
      }
    }
    bool counts = largest(row, s->nv) > NO_ROW;
    s->gamma[r] = counts ? gamma[r] : 0;
    if (!counts) {
      memset(row, 0, (size_t)s->nv * sizeof *row);
    }
  }
}

/* ---- reactions ---- */

/* Returns the element of -J^T lambda that belongs to one column of J. Only the rows of one joint
 * contribute. */
static wide column_force(const row_list *list, int joint, const wide *lambda, int column)
{
  wide sum = 0;
  for (int r = list->first[joint]; r < list->first[joint + 1]; r++) {
    sum -= list->j[r][column] * lambda[r];
  }
  return sum;
}

/* Computes the reaction -J^T lambda of a joint on body_b, as a force and a moment at the point of
 * body_b. */
static void wrench_of(const instant *now, const row_list *list, int n, const wide *lambda,
                      wide out[6])
{
  const oracle_joint *of = oracle_pair_of(now->o, &now->o->joints[n]);
  const motion *body = &now->bodies[of->b];
  wide six[6];
  wide arm[3];
  wide shift[3];
  for (int k = 0; k < 6; k++) {
    six[k] = column_force(list, n, lambda, 6 * of->b + k);
  }
  oracle_reaction_arm(of, now->bodies, arm);
  cross3(arm, six, shift);
  for (int i = 0; i < 3; i++) {
    out[i] = six[i];
    out[3 + i] = -shift[i];
    for (int j = 0; j < 3; j++) {
      out[3 + i] += body->axes[j][i].d[0] * six[3 + j];
    }
  }
}

/* Returns whether the reaction of a joint is a generalized force on all its bodies. */
static bool is_generalized(const oracle_joint *joint)
{
  return joint->kind == ORACLE_COUPLING || joint->kind == ORACLE_USER;
}

static void reaction_of(const instant *now, const row_list *list, int n, const wide *lambda,
                        wide out[ORACLE_REACTION])
{
  const oracle_joint *joint = &now->o->joints[n];
  int members[ORACLE_MEMBERS];
  memset(out, 0, ORACLE_REACTION * sizeof *out);
  if (!is_generalized(joint)) {
    wrench_of(now, list, n, lambda, out);
    return;
  }
  int member_count = oracle_members_of(now->o, joint, members);
  for (int k = 0; k < member_count; k++) {
    const oracle_body *body = &now->o->bodies[members[k]];
    for (int i = 0; i < body->nv; i++) {
      *out++ = column_force(list, n, lambda, 6 * members[k] + oracle_six_of(body, i));
    }
  }
}

static void find_reactions(const instant *now, const row_list *list, const quad_equations *s,
                           oracle_answer *out)
{
  int joints = now->o->joint_count;
  wide *lambda = calloc((size_t)s->nc + 1, sizeof *lambda);
  quad_equations_multipliers(s, lambda);
  for (int n = 0; n < joints && lambda; n++) {
    reaction_of(now, list, n, lambda, out->reaction[n]);
    out->unique[n] = true;
  }
  for (int k = 0; k < s->nc - s->rank && lambda; k++) {
    quad_equations_null(s, k, lambda);
    wide size = largest(lambda, s->nc);
    for (int n = 0; n < joints; n++) {
      wide part[ORACLE_REACTION];
      reaction_of(now, list, n, lambda, part);
      out->unique[n] = out->unique[n] && largest(part, ORACLE_REACTION) <= NO_PART * size;
    }
  }
  free(lambda);
}

/* ---- the whole evaluation ---- */

/* Computes the rank of the rows that are not of velocity level. */
static bool find_position_rank(const instant *now, const row_list *list, oracle_answer *out)
{
  const spatial_oracle *o = now->o;
  const int nc = list->first[o->joint_count];
  quad_equations s;
  wide a[ORACLE_COLUMNS];
  bool done = quad_equations_create(&s, o->nv, nc);
  out->velocity_rows = 0;
  if (done) {
    fill_bodies(now, &s);
    fill_rows(o, list, s.gamma, &s);
  }
  for (int n = 0; n < o->joint_count && done; n++) {
    for (int r = list->first[n]; r < list->first[n + 1]; r++) {
      if (oracle_is_velocity_row(&o->joints[n], r - list->first[n])) {
        memset(s.jacobian + (ptrdiff_t)r * s.nv, 0, (size_t)s.nv * sizeof *s.jacobian);
        out->velocity_rows++;
      }
    }
  }
  out->position_rows = out->rows;
  done = done && (out->velocity_rows == 0 || quad_equations_solve(&s, a, &out->position_rows));
  quad_equations_destroy(&s);
  return done;
}

bool oracle_answer_at(const spatial_oracle *o, double t, const wide *q, const double *v,
                      oracle_answer *out)
{
  quad_equations s;
  row_list list = {.j = calloc(ORACLE_JOINTS * ORACLE_ROWS, sizeof *list.j)};
  wide *gamma = calloc(ORACLE_JOINTS * ORACLE_ROWS, sizeof *gamma);
  const instant now = oracle_instant_at(o, t, q, v);
  if (list.j && gamma) {
    find_rows(&now, &list, gamma, out);
  }
  bool done = quad_equations_create(&s, o->nv, list.first[o->joint_count]) && list.j && gamma;
  if (done) {
    fill_bodies(&now, &s);
    fill_rows(o, &list, gamma, &s);
    done = quad_equations_solve(&s, out->a, &out->rows);
  }
  if (done) {
    find_reactions(&now, &list, &s, out);
    done = find_position_rank(&now, &list, out);
  }
  quad_equations_destroy(&s);
  free(list.j);
  free(gamma);
  return done;
}

/* ---- balance ---- */

/* Adds the reaction of a joint to the forces on body_b, and its opposite, at the same point, to
 * those on body_a. A generalized force is added to the forces on all its bodies. */
static void add_reaction(const instant *now, const oracle_joint *joint, const double *reaction,
                         wide six[][6])
{
  const oracle_joint *of = oracle_pair_of(now->o, joint);
  int members[ORACLE_MEMBERS];
  wide point[3];
  for (int k = 0; is_generalized(joint) && k < oracle_members_of(now->o, joint, members); k++) {
    const oracle_body *body = &now->o->bodies[members[k]];
    for (int i = 0; i < body->nv; i++) {
      six[members[k]][oracle_six_of(body, i)] += *reaction++;
    }
  }
  if (is_generalized(joint)) {
    return;
  }
  oracle_reaction_arm(of, now->bodies, point);
  for (int i = 0; i < 3; i++) {
    point[i] += now->bodies[of->b].r[i].d[0];
  }
  for (int side = 0; side < 2; side++) {
    int body = side == 0 ? of->a : of->b;
    wide wrench[6];
    for (int i = 0; i < 6; i++) {
      wrench[i] = side == 0 ? -reaction[i] : reaction[i];
    }
    oracle_add_wrench(&now->bodies[body], point, wrench, wrench + 3, six[body]);
  }
}

double oracle_imbalance(const spatial_oracle *o, const wide *q, const double *v, const double *a,
                        double (*reactions)[ORACLE_REACTION])
{
  const instant now = oracle_instant_at(o, 0.0, q, v);
  wide accelerations[ORACLE_BODIES][6];
  wide total[ORACLE_BODIES][6];
  oracle_forces_at(&now, total);
  oracle_spread(o, a, accelerations);
  double size = (double)largest(total[0], ORACLE_COLUMNS);
  for (int n = 0; n < o->joint_count; n++) {
    for (int i = 0; i < ORACLE_REACTION; i++) {
      size = fmax(size, fabs(reactions[n][i]));
    }
    add_reaction(&now, &o->joints[n], reactions[n], total);
  }
  double worst = 0.0;
  for (int k = 1; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    wide momentum[3];
    oracle_inertia_times(body, accelerations[k] + 3, momentum);
    for (int i = 0; i < body->nv; i++) {
      int at = oracle_six_of(body, i);
      wide want = at < 3 ? body->mass * accelerations[k][at] : momentum[at - 3];
      double apart = fabs((double)(want - total[k][at]));
      worst = apart <= worst ? worst : apart; /* keeps NaN */
      size = fmax(size, fabs((double)want));
    }
  }
  return size > 0.0 ? worst / size : worst;
}
