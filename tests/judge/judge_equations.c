/* SPDX-License-Identifier: BSD-3-Clause */
#include "judge_equations.h"

#include <math.h>
#include <string.h>

/* ---- points ---- */

typedef struct marker {
  int first; /* first column of the body of the point; -1 for ground */
  bool turns;
  double w;
  double angle;
  double arm[2]; /* vector from the centre of mass to the point, in ground axes */
  double p[2];
  double dp[2];
} marker;

static void rotate(double angle, const double in[2], double out[2])
{
  double c = cos(angle);
  double s = sin(angle);
  out[0] = c * in[0] - s * in[1];
  out[1] = s * in[0] + c * in[1];
}

static marker locate(const judge_scene *s, int body, const double local[2], const double *q,
                     const double *v)
{
  marker m = {.first = -1, .p = {local[0], local[1]}};
  if (body == JUDGE_GROUND) {
    return m;
  }
  const judge_body *b = &s->bodies[body];
  m.first = b->first;
  m.turns = !b->particle;
  if (m.turns) {
    m.angle = q[b->first + 2];
    m.w = v[b->first + 2];
    rotate(m.angle, local, m.arm);
  }
  for (int i = 0; i < 2; i++) {
    m.p[i] = q[b->first + i] + m.arm[i];
  }
  m.dp[0] = v[b->first] - m.w * m.arm[1];
  m.dp[1] = v[b->first + 1] + m.w * m.arm[0];
  return m;
}

static double dot(const double a[2], const double b[2])
{
  return a[0] * b[0] + a[1] * b[1];
}

static double cross(const double a[2], const double b[2])
{
  return a[0] * b[1] - a[1] * b[0];
}

/* Adds to a row `sign` times the derivative of (direction . p') with respect to the velocities. */
static void add_point(double *row, const marker *m, const double direction[2], double sign)
{
  if (m->first >= 0) {
    row[m->first] += sign * direction[0];
    row[m->first + 1] += sign * direction[1];
    if (m->turns) {
      row[m->first + 2] += sign * cross(m->arm, direction);
    }
  }
}

static void add_angle(double *row, const marker *m, double value)
{
  if (m->first >= 0) {
    row[m->first + 2] += value;
  }
}

typedef struct gap {
  marker a;
  marker b;
  double d[2];    /* from point a to point b */
  double dd[2];   /* d' */
  double bias[2]; /* the value of d'' if all accelerations are 0 */
} gap;

static gap measure_gap(const judge_scene *s, const judge_joint *j, const double *q, const double *v)
{
  gap g = {.a = locate(s, j->a, j->point_a, q, v), .b = locate(s, j->b, j->point_b, q, v)};
  for (int i = 0; i < 2; i++) {
    g.d[i] = g.b.p[i] - g.a.p[i];
    g.dd[i] = g.b.dp[i] - g.a.dp[i];
    g.bias[i] = g.a.arm[i] * g.a.w * g.a.w - g.b.arm[i] * g.b.w * g.b.w;
  }
  return g;
}

/* ---- rows ---- */

static void fill_pin(const gap *g, int row, judge_rows *out)
{
  for (int i = 0; i < 2; i++) {
    double unit[2] = {i == 0, i == 1};
    out->phi[row + i] = -g->d[i];
    out->gamma[row + i] = g->bias[i];
    add_point(out->jacobian[row + i], &g->a, unit, 1.0);
    add_point(out->jacobian[row + i], &g->b, unit, -1.0);
  }
}

/* Sets the row of u . d, where d is the vector between two points and u is a unit vector fixed in
 * body a. */
static void fill_along(const gap *g, const double axis[2], int row, judge_rows *out)
{
  double u[2];
  rotate(g->a.angle, axis, u);
  double w = g->a.w;
  out->phi[row] = dot(u, g->d);
  out->gamma[row] = -2.0 * w * cross(u, g->dd) + w * w * dot(u, g->d) - dot(u, g->bias);
  add_point(out->jacobian[row], &g->b, u, 1.0);
  add_point(out->jacobian[row], &g->a, u, -1.0);
  add_angle(out->jacobian[row], &g->a, cross(u, g->d));
}

static void fill_angle(const gap *g, double kept, int row, judge_rows *out)
{
  out->phi[row] = g->b.angle - g->a.angle - kept;
  add_angle(out->jacobian[row], &g->b, 1.0);
  add_angle(out->jacobian[row], &g->a, -1.0);
}

static void fill_distance(const gap *g, double length, int row, judge_rows *out)
{
  double direction[2] = {g->d[0] / length, g->d[1] / length};
  out->phi[row] = (dot(g->d, g->d) - length * length) / (2.0 * length);
  out->gamma[row] = -(dot(g->dd, g->dd) + dot(g->d, g->bias)) / length;
  add_point(out->jacobian[row], &g->b, direction, 1.0);
  add_point(out->jacobian[row], &g->a, direction, -1.0);
}

static int fill_joint(const judge_joint *j, const gap *g, double t, int row, judge_rows *out)
{
  const double normal[2] = {-j->axis[1], j->axis[0]};
  double law[3] = {0};
  switch (j->kind) {
  case JUDGE_REVOLUTE: fill_pin(g, row, out); return 2;
  case JUDGE_SLOT: fill_along(g, normal, row, out); return 1;
  case JUDGE_TRANSLATIONAL:
    fill_along(g, normal, row, out);
    fill_angle(g, j->kept, row + 1, out);
    return 2;
  case JUDGE_DISTANCE: fill_distance(g, j->kept, row, out); return 1;
  case JUDGE_DRIVE_ANGLE: fill_angle(g, 0.0, row, out); break;
  case JUDGE_DRIVE_SLIDE: fill_along(g, j->axis, row, out); break;
  }
  judge_law(j, t, law);
  out->phi[row] -= law[0];
  out->nu[row] = law[1];
  out->gamma[row] += law[2];
  return 1;
}

void judge_evaluate_rows(const judge_scene *s, double t, const double *q, const double *v,
                         judge_rows *out)
{
  int row = 0;
  memset(out, 0, sizeof *out);
  for (int k = 0; k < s->joint_count; k++) {
    gap g = measure_gap(s, &s->joints[k], q, v);
    row += fill_joint(&s->joints[k], &g, t, row, out);
  }
}

/* ---- forces ---- */

static void push(const marker *m, const double force[2], double *g)
{
  if (m->first >= 0) {
    g[m->first] += force[0];
    g[m->first + 1] += force[1];
    if (m->turns) {
      g[m->first + 2] += cross(m->arm, force);
    }
  }
}

static void add_spring(const judge_scene *s, const judge_spring *p, const double *q,
                       const double *v, double *g)
{
  marker a = locate(s, p->a, p->point_a, q, v);
  marker b = locate(s, p->b, p->point_b, q, v);
  if (p->torsion) {
    double torque = p->stiffness * (b.angle - a.angle - p->free) + p->damping * (b.w - a.w);
    add_angle(g, &a, torque);
    add_angle(g, &b, -torque);
    return;
  }
  double d[2] = {b.p[0] - a.p[0], b.p[1] - a.p[1]};
  double dd[2] = {b.dp[0] - a.dp[0], b.dp[1] - a.dp[1]};
  double length = hypot(d[0], d[1]);
  double tension = p->stiffness * (length - p->free) + p->damping * dot(d, dd) / length;
  double force[2] = {tension * d[0] / length, tension * d[1] / length};
  push(&a, force, g);
  force[0] = -force[0];
  force[1] = -force[1];
  push(&b, force, g);
}

void judge_forces(const judge_scene *s, const double *q, const double *v, double *g)
{
  memset(g, 0, (size_t)s->n * sizeof *g);
  for (int k = 0; k < s->body_count; k++) {
    g[s->bodies[k].first + 1] = -s->bodies[k].mass * s->gravity;
  }
  for (int k = 0; k < s->spring_count; k++) {
    add_spring(s, &s->springs[k], q, v, g);
  }
  if (s->load_body != JUDGE_GROUND) {
    for (int i = 0; i < 3; i++) {
      g[s->bodies[s->load_body].first + i] += s->load[i];
    }
  }
}

double judge_mass(const judge_scene *s, int column)
{
  int k = 0;
  while (k + 1 < s->body_count && s->bodies[k + 1].first <= column) {
    k++;
  }
  return column - s->bodies[k].first == 2 ? s->bodies[k].inertia : s->bodies[k].mass;
}

double judge_kinetic(const judge_scene *s, const double *v)
{
  double sum = 0.0;
  for (int i = 0; i < s->n; i++) {
    sum += 0.5 * judge_mass(s, i) * v[i] * v[i];
  }
  return sum;
}

/* ---- factors ---- */

/* Reflects x: x -= 2 h (h . x). h is a unit vector whose entries before `from` are 0. */
static void reflect(const double *h, int from, int n, double *x)
{
  double sum = 0.0;
  for (int i = from; i < n; i++) {
    sum += h[i] * x[i];
  }
  for (int i = from; i < n; i++) {
    x[i] -= 2.0 * sum * h[i];
  }
}

static double norm(const double *x, int from, int n)
{
  double sum = 0.0;
  for (int i = from; i < n; i++) {
    sum += x[i] * x[i];
  }
  return sqrt(sum);
}

bool judge_factor(const judge_scene *s, const judge_rows *rows, bool weighted, judge_factors *f)
{
  f->n = s->n;
  f->m = s->rows;
  for (int i = 0; i < f->n; i++) {
    f->root[i] = weighted ? sqrt(judge_mass(s, i)) : 1.0;
  }
  for (int k = 0; k < f->m; k++) {
    double *x = f->columns[k];
    for (int i = 0; i < f->n; i++) {
      x[i] = rows->jacobian[k][i] / f->root[i];
    }
    double whole = norm(x, 0, f->n);
    for (int p = 0; p < k; p++) {
      reflect(f->columns[p], p, f->n, x);
      f->r[p][k] = x[p];
    }
    double rest = norm(x, k, f->n);
    if (k >= f->n || !(rest > 1e-11 * whole)) {
      return false;
    }
    f->r[k][k] = x[k] > 0.0 ? -rest : rest;
    x[k] -= f->r[k][k];
    double size = norm(x, k, f->n);
    for (int i = k; i < f->n; i++) {
      x[i] /= size;
    }
  }
  return true;
}

void judge_nearest(const judge_factors *f, const double *rhs, double *x)
{
  for (int i = 0; i < f->n; i++) {
    x[i] *= f->root[i];
  }
  for (int k = 0; k < f->m; k++) {
    reflect(f->columns[k], k, f->n, x);
  }
  for (int k = 0; k < f->m; k++) {
    double sum = rhs[k];
    for (int p = 0; p < k; p++) {
      sum -= f->r[p][k] * x[p];
    }
    x[k] = sum / f->r[k][k];
  }
  for (int k = f->m - 1; k >= 0; k--) {
    reflect(f->columns[k], k, f->n, x);
  }
  for (int i = 0; i < f->n; i++) {
    x[i] /= f->root[i];
  }
}

void judge_null_vector(const judge_factors *f, int k, double *out)
{
  memset(out, 0, (size_t)f->n * sizeof *out);
  out[f->m + k] = 1.0;
  for (int p = f->m - 1; p >= 0; p--) {
    reflect(f->columns[p], p, f->n, out);
  }
}

bool judge_acceleration(const judge_scene *s, double t, const double *q, const double *v, double *a)
{
  judge_rows rows;
  judge_factors f;
  judge_evaluate_rows(s, t, q, v, &rows);
  if (!judge_factor(s, &rows, true, &f)) {
    return false;
  }
  judge_forces(s, q, v, a);
  for (int i = 0; i < s->n; i++) {
    a[i] /= f.root[i] * f.root[i];
  }
  judge_nearest(&f, rows.gamma, a);
  return true;
}

bool judge_project(const judge_scene *s, double t, bool weighted, double *q, double *v)
{
  enum { MOST = 30 };
  judge_rows rows;
  judge_factors f;
  for (int pass = 0; pass < MOST; pass++) {
    double step[JUDGE_N] = {0};
    judge_evaluate_rows(s, t, q, v, &rows);
    if (!judge_factor(s, &rows, weighted, &f)) {
      return false;
    }
    for (int k = 0; k < s->rows; k++) {
      rows.phi[k] = -rows.phi[k];
    }
    judge_nearest(&f, rows.phi, step);
    double size = norm(step, 0, s->n);
    for (int i = 0; i < s->n; i++) {
      q[i] += step[i];
    }
    if (size < 1e-9) { /* quadratic convergence: the next step would be below rounding errors */
      judge_evaluate_rows(s, t, q, v, &rows);
      bool fine = judge_factor(s, &rows, weighted, &f);
      if (fine) {
        judge_nearest(&f, rows.nu, v);
      }
      return fine;
    }
  }
  return false;
}
