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

/* Some linear combinations of rows are zero. In each of them, the rows of one joint cause a
 * reaction of this joint. The reaction of the joint is considered unique if all these reactions are
 * smaller than NO_PART. */
static const double NO_PART = 1e-8;

static wide largest(const wide *x, int count)
{
  wide most = 0;
  for (int i = 0; i < count; i++) {
    most = wide_size(x[i]) > most ? wide_size(x[i]) : most;
  }
  return most;
}

/* ---- one instant ---- */

typedef struct instant {
  const spatial_oracle *o;
  double t;
  const wide *q;
  wide six[ORACLE_BODIES][6]; /* velocities */
  motion bodies[ORACLE_BODIES];
} instant;

static void spread(const spatial_oracle *o, const double *v, wide six[][6])
{
  memset(six, 0, ORACLE_BODIES * sizeof *six);
  for (int k = 0; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    for (int i = 0; i < body->nv; i++) {
      six[k][oracle_six_of(body, i)] = v[body->first_v + i];
    }
  }
}

static motion motion_at(const instant *now, int k, const wide six[6])
{
  const oracle_body *body = &now->o->bodies[k];
  return oracle_motion_of(body, now->q + body->first_q, six);
}

static instant instant_at(const spatial_oracle *o, double t, const wide *q, const double *v)
{
  instant now = {.o = o, .t = t, .q = q};
  spread(o, v, now.six);
  for (int k = 0; k < o->body_count; k++) {
    now.bodies[k] = motion_at(&now, k, now.six[k]);
  }
  return now;
}

/* ---- forces ---- */

static void inertia_times(const oracle_body *body, const wide x[3], wide out[3])
{
  const double *i = body->inertia;
  out[0] = i[0] * x[0] + i[3] * x[1] + i[4] * x[2];
  out[1] = i[3] * x[0] + i[1] * x[1] + i[5] * x[2];
  out[2] = i[4] * x[0] + i[5] * x[1] + i[2] * x[2];
}

/* Adds a force at a point, and a moment, to the six generalized forces of a body. All arguments are
 * in ground axes. */
static void add_wrench(const motion *body, const wide point[3], const wide force[3],
                       const wide moment[3], wide six[6])
{
  wide arm[3];
  wide about[3];
  for (int i = 0; i < 3; i++) {
    arm[i] = point[i] - body->r[i].d[0];
  }
  cross3(arm, force, about);
  for (int i = 0; i < 3; i++) {
    six[i] += force[i];
    for (int j = 0; j < 3; j++) {
      six[3 + i] += body->axes[i][j].d[0] * (about[j] + moment[j]);
    }
  }
}

static void place_at(const motion *body, const double s[3], jet out[3])
{
  const wide point[3] = {s[0], s[1], s[2]};
  oracle_turned(body, point, out);
  for (int i = 0; i < 3; i++) {
    out[i] = jet_add(out[i], body->r[i]);
  }
}

static void add_spring(const oracle_force *f, const motion *bodies, wide six[][6])
{
  static const wide none[3] = {0};
  jet ends[2][3];
  jet apart[3];
  place_at(&bodies[f->a], f->s[0], ends[0]);
  place_at(&bodies[f->b], f->s[1], ends[1]);
  for (int i = 0; i < 3; i++) {
    apart[i] = jet_less(ends[1][i], ends[0][i]);
  }
  const jet length = jet_root(jet_dot(apart, apart));
  wide tension = f->stiffness * (length.d[0] - f->free_length) + f->damping * length.d[1];
  for (int side = 0; side < 2; side++) {
    wide force[3];
    wide point[3];
    for (int i = 0; i < 3; i++) {
      force[i] = (side == 0 ? tension : -tension) * apart[i].d[0] / length.d[0];
      point[i] = ends[side][i].d[0];
    }
    int body = side == 0 ? f->a : f->b;
    add_wrench(&bodies[body], point, force, none, six[body]);
  }
}

static void add_load(const oracle_force *f, const motion *bodies, wide six[][6])
{
  const motion *body = &bodies[f->b];
  jet at[3];
  wide given[2][3];
  wide point[3];
  place_at(body, f->s[1], at);
  for (int i = 0; i < 3; i++) {
    point[i] = at[i].d[0];
    given[0][i] = f->force[i];
    given[1][i] = f->moment[i];
  }
  for (int k = 0; k < 2 && f->follows_body; k++) {
    jet out[3];
    oracle_turned(body, given[k], out);
    for (int i = 0; i < 3; i++) {
      given[k][i] = out[i].d[0];
    }
  }
  add_wrench(body, point, given[0], given[1], six[f->b]);
}

static instant stop(const instant *now)
{
  instant still = *now;
  memset(still.six, 0, sizeof still.six);
  for (int k = 0; k < now->o->body_count; k++) {
    still.bodies[k] = motion_at(&still, k, still.six[k]);
  }
  return still;
}

static void add_joint_spring(const oracle_force *f, const instant *now, wide six[][6])
{
  const oracle_joint *joint = &now->o->joints[f->of];
  const jet c = oracle_coordinate_of(joint, f->coordinate, now->bodies);
  wide force = f->stiffness * (c.d[0] - f->free_length) + f->damping * c.d[1];
  instant still = stop(now);
  for (int side = 0; side < 2; side++) {
    int body = side == 0 ? joint->a : joint->b;
    const motion kept = still.bodies[body];
    for (int k = 0; k < 6; k++) {
      wide unit[6] = {0};
      unit[k] = 1;
      still.bodies[body] = motion_at(&still, body, unit);
      six[body][k] -= force * oracle_coordinate_of(joint, f->coordinate, still.bodies).d[1];
    }
    still.bodies[body] = kept;
  }
}

static void forces_at(const instant *now, wide six[][6])
{
  const spatial_oracle *o = now->o;
  memset(six, 0, ORACLE_BODIES * sizeof *six);
  for (int k = 1; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    wide momentum[3];
    wide moment[3];
    inertia_times(body, now->six[k] + 3, momentum);
    cross3(momentum, now->six[k] + 3, moment);
    for (int i = 0; i < 3; i++) {
      six[k][i] = (wide)body->mass * o->gravity[i];
      six[k][3 + i] = moment[i];
    }
  }
  for (int n = 0; n < o->force_count; n++) {
    const oracle_force *f = &o->forces[n];
    if (f->kind == ORACLE_JOINT_SPRING) {
      add_joint_spring(f, now, six);
    } else {
      (f->kind == ORACLE_SPRING ? add_spring : add_load)(f, now->bodies, six);
    }
  }
}

/* ---- equations ---- */

/* The rows of all joints, with six columns for each body. */
typedef struct row_list {
  int first[ORACLE_JOINTS + 1];
  wide (*j)[ORACLE_COLUMNS];
} row_list;

/* Returns the joint itself. For a driver, returns the driven joint. */
static const oracle_joint *pair_of(const spatial_oracle *o, const oracle_joint *joint)
{
  return joint->kind == ORACLE_DRIVER ? &o->joints[joint->of] : joint;
}

static void find_columns(instant *still, const oracle_joint *joint, wide (*j)[ORACLE_COLUMNS])
{
  const oracle_joint *pair = pair_of(still->o, joint);
  for (int side = 0; side < 2; side++) {
    int body = side == 0 ? pair->a : pair->b;
    const motion kept = still->bodies[body];
    for (int k = 0; k < 6; k++) {
      wide six[6] = {0};
      jet rows[ORACLE_ROWS];
      six[k] = 1;
      still->bodies[body] = motion_at(still, body, six);
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
  instant still = stop(now);
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
  forces_at(now, six);
  for (int k = 1; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    for (int i = 0; i < body->nv; i++) {
      wide *row = s->mass + (ptrdiff_t)(body->first_v + i) * s->nv + body->first_v;
      s->force[body->first_v + i] = six[k][oracle_six_of(body, i)];
      for (int j = 0; j < body->nv; j++) {
        const wide e[3] = {oracle_six_of(body, j) == 3, oracle_six_of(body, j) == 4,
                           oracle_six_of(body, j) == 5};
        wide turned_by[3];
        inertia_times(body, e, turned_by);
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

/* Computes the reaction -J^T lambda of a joint on body_b, as a force and a moment at the point of
 * body_b. */
static void reaction_of(const instant *now, const row_list *list, int n, const wide *lambda,
                        wide out[6])
{
  const oracle_joint *joint = &now->o->joints[n];
  const oracle_joint *of = pair_of(now->o, joint);
  const motion *body = &now->bodies[of->b];
  wide six[6] = {0};
  jet arm[3];
  wide shift[3];
  for (int r = list->first[n]; r < list->first[n + 1]; r++) {
    for (int k = 0; k < 6; k++) {
      six[k] -= list->j[r][6 * of->b + k] * lambda[r];
    }
  }
  oracle_turned(body, of->s[1], arm);
  const wide to_point[3] = {arm[0].d[0], arm[1].d[0], arm[2].d[0]};
  cross3(to_point, six, shift);
  for (int i = 0; i < 3; i++) {
    out[i] = six[i];
    out[3 + i] = -shift[i];
    for (int j = 0; j < 3; j++) {
      out[3 + i] += body->axes[j][i].d[0] * six[3 + j];
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
      wide part[6];
      reaction_of(now, list, n, lambda, part);
      out->unique[n] = out->unique[n] && largest(part, 6) <= NO_PART * size;
    }
  }
  free(lambda);
}

/* ---- the whole evaluation ---- */

bool oracle_answer_at(const spatial_oracle *o, double t, const wide *q, const double *v,
                      oracle_answer *out)
{
  quad_equations s;
  row_list list = {.j = calloc(ORACLE_JOINTS * ORACLE_ROWS, sizeof *list.j)};
  wide *gamma = calloc(ORACLE_JOINTS * ORACLE_ROWS, sizeof *gamma);
  const instant now = instant_at(o, t, q, v);
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
  }
  quad_equations_destroy(&s);
  free(list.j);
  free(gamma);
  return done;
}

/* ---- balance ---- */

/* Adds the reaction of a joint to the forces on body_b, and its opposite, at the same point, to
 * those on body_a. */
static void add_reaction(const instant *now, const oracle_joint *joint, const double *reaction,
                         wide six[][6])
{
  const oracle_joint *of = pair_of(now->o, joint);
  jet arm[3];
  oracle_turned(&now->bodies[of->b], of->s[1], arm);
  wide point[3];
  for (int i = 0; i < 3; i++) {
    point[i] = arm[i].d[0] + now->bodies[of->b].r[i].d[0];
  }
  for (int side = 0; side < 2; side++) {
    int body = side == 0 ? of->a : of->b;
    wide wrench[6];
    for (int i = 0; i < 6; i++) {
      wrench[i] = side == 0 ? -reaction[i] : reaction[i];
    }
    add_wrench(&now->bodies[body], point, wrench, wrench + 3, six[body]);
  }
}

double oracle_imbalance(const spatial_oracle *o, const wide *q, const double *v, const double *a,
                        double (*reactions)[6])
{
  const instant now = instant_at(o, 0.0, q, v);
  wide accelerations[ORACLE_BODIES][6];
  wide total[ORACLE_BODIES][6];
  forces_at(&now, total);
  spread(o, a, accelerations);
  double size = (double)largest(total[0], ORACLE_COLUMNS);
  for (int n = 0; n < o->joint_count; n++) {
    for (int i = 0; i < 6; i++) {
      size = fmax(size, fabs(reactions[n][i]));
    }
    add_reaction(&now, &o->joints[n], reactions[n], total);
  }
  double worst = 0.0;
  for (int k = 1; k < o->body_count; k++) {
    const oracle_body *body = &o->bodies[k];
    wide momentum[3];
    inertia_times(body, accelerations[k] + 3, momentum);
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
