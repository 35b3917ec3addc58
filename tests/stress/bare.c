/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the stress grid without this library. Simulates the pendulum and the slider-crank with CVODE
 * and IDA, as a simple hand-written program would. Matrices are dense, gains are 5 1/s as in
 * textbooks, and atol = rtol. Runs start in the design configuration. Nothing is scaled, assembled
 * or checked.
 *
 *   bare [--list]
 *
 * The program prints how often each outcome occurs, next to the same numbers for the library.
 * Cells, oracle and permitted errors are the same for this program and for the library.
 */
#include <cvode/cvode.h>
#include <ida/ida.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "axes.h"

enum { Q = 9, ROWS = 64, KKT = Q + ROWS, MOST_STEPS = 5000 };

static const double GAIN = 5.0; /* [1/s] alpha = beta */

typedef enum bare_way { ADAMS, BDF, INDEX1, INDEX3, BARE_WAYS } bare_way;
static const char *const BARE_NAMES[BARE_WAYS] = {"CVODE Adams", "CVODE BDF", "IDA index 1",
                                                  "IDA index 3"};
/* The setting of the library with which each of the hand-written programs is compared. Both
 * programs that use IDA are compared with the same setting. */
static const char *const BESIDE[BARE_WAYS] = {"adams", "bdf", "ida ggl", "ida ggl"};

/* ---- the equations, by hand ---- */

typedef struct hand {
  const scene *s;
  int n;
  int rows;
  double mass[Q];
  double gravity;
  double crank; /* length of the crank; the length of the rod is the next member */
  double rod;
} hand;

static hand write_down(const scene *s)
{
  double l = s->units.length;
  double m = s->units.mass;
  double t = s->units.time;
  hand h = {.s = s, .gravity = s->gravity * l / (t * t), .crank = l, .rod = s->rod * l};
  bool crank = s->kind == SCENE_CRANK;
  h.n = crank ? 9 : 2;
  h.rows = crank ? 8 + 2 * s->spare : 1 + s->spare;
  if (!crank) {
    h.mass[0] = h.mass[1] = m;
    return h;
  }
  double length[3] = {1.0, s->rod, 0.1};
  for (int k = 0; k < 3; k++) {
    double mass = m * (k == 2 ? s->ratio : 1.0);
    h.mass[3 * k] = h.mass[3 * k + 1] = mass;
    h.mass[3 * k + 2] = mass * length[k] * length[k] * l * l / 12.0;
  }
  return h;
}

typedef struct rows {
  double phi[ROWS];
  double rate[ROWS];
  double gamma[ROWS];
  double j[ROWS][Q];
} rows;

/* Adds the position of a point, multiplied by `sign`, to two rows. The point is (x, 0) in the axes
 * of body b. Its position in ground axes is r + A(angle) (x, 0), where r is the position of the
 * body and A is the rotation matrix. */
static void add_point(rows *r, int row, const double *q, const double *v, int b, double x,
                      double sign)
{
  const double *p = q + 3 * b;
  const double *w = v + 3 * b;
  double c = sign * x * cos(p[2]);
  double s = sign * x * sin(p[2]);
  r->phi[row] += sign * p[0] + c;
  r->phi[row + 1] += sign * p[1] + s;
  r->j[row][3 * b] += sign;
  r->j[row + 1][3 * b + 1] += sign;
  r->j[row][3 * b + 2] += -s;
  r->j[row + 1][3 * b + 2] += c;
  r->gamma[row] += c * w[2] * w[2];
  r->gamma[row + 1] += s * w[2] * w[2];
}

static void crank_rows(const hand *h, const double *q, const double *v, rows *r)
{
  add_point(r, 0, q, v, 0, -h->crank / 2, 1.0);
  add_point(r, 2, q, v, 0, h->crank / 2, 1.0);
  add_point(r, 2, q, v, 1, -h->rod / 2, -1.0);
  add_point(r, 4, q, v, 1, h->rod / 2, 1.0);
  add_point(r, 4, q, v, 2, 0.0, -1.0);
  for (int k = 0; k <= h->s->spare; k++) {
    r->phi[6 + 2 * k] = q[7] - k * h->s->off * h->crank;
    r->phi[7 + 2 * k] = q[8];
    r->j[6 + 2 * k][7] = r->j[7 + 2 * k][8] = 1.0;
  }
}

/* Sets the rows of the constraint x^2 + y^2 = l^2. */
static void bob_rows(const hand *h, const double *q, const double *v, rows *r)
{
  for (int k = 0; k < h->rows; k++) {
    double l = h->crank * (1.0 + k * h->s->off);
    r->phi[k] = q[0] * q[0] + q[1] * q[1] - l * l;
    r->j[k][0] = 2 * q[0];
    r->j[k][1] = 2 * q[1];
    r->gamma[k] = -2 * (v[0] * v[0] + v[1] * v[1]);
  }
}

static void constrain(const hand *h, const double *q, const double *v, rows *r)
{
  memset(r, 0, sizeof *r);
  if (h->n == 2) {
    bob_rows(h, q, v, r);
  } else {
    crank_rows(h, q, v, r);
  }
  for (int i = 0; i < h->rows; i++) {
    for (int k = 0; k < h->n; k++) {
      r->rate[i] += r->j[i][k] * v[k];
    }
  }
}

static void load(const hand *h, const double *q, const double *v, double *force)
{
  const scene *s = h->s;
  double unit = s->units.mass * s->units.length * s->units.length / s->units.time;
  memset(force, 0, Q * sizeof *force);
  for (int k = 1; k < h->n; k += h->n == 2 ? 2 : 3) {
    force[k] = -h->mass[k] * h->gravity;
  }
  if (h->n > 2) {
    force[2] =
      -s->stiffness * unit / s->units.time * (q[2] - (s->angle - 0.1)) - s->damping * unit * v[2];
  }
}

/* Solves a system by Gaussian elimination with partial pivoting. Returns false if a pivot is
 * zero. */
static bool eliminate(int n, double a[KKT][KKT + 1])
{
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++) {
      best = fabs(a[i][k]) > fabs(a[best][k]) ? i : best;
    }
    if (a[best][k] == 0.0) {
      return false;
    }
    for (int j = k; j <= n && best != k; j++) {
      double kept = a[k][j];
      a[k][j] = a[best][j];
      a[best][j] = kept;
    }
    for (int i = k + 1; i < n; i++) {
      double factor = a[i][k] / a[k][k];
      for (int j = k; factor != 0.0 && j <= n; j++) {
        a[i][j] -= factor * a[k][j];
      }
    }
  }
  for (int k = n - 1; k >= 0; k--) {
    for (int j = k + 1; j < n; j++) {
      a[k][n] -= a[k][j] * a[j][n];
    }
    a[k][n] /= a[k][k];
  }
  return true;
}

/* Solves for accelerations and multipliers with Baumgarte's gains. Returns false if the matrix is
 * singular. */
static bool accelerate(const hand *h, const double *q, const double *v, double *x)
{
  static double a[KKT][KKT + 1];
  static rows r;
  int n = h->n + h->rows;
  double force[Q];
  memset(a, 0, sizeof a);
  constrain(h, q, v, &r);
  load(h, q, v, force);
  for (int k = 0; k < h->n; k++) {
    a[k][k] = h->mass[k];
    a[k][n] = force[k];
  }
  for (int i = 0; i < h->rows; i++) {
    for (int k = 0; k < h->n; k++) {
      a[h->n + i][k] = a[k][h->n + i] = r.j[i][k];
    }
    a[h->n + i][n] = r.gamma[i] - 2 * GAIN * r.rate[i] - GAIN * GAIN * r.phi[i];
  }
  bool fine = eliminate(n, a);
  for (int k = 0; fine && k < n; k++) {
    x[k] = a[k][n];
  }
  return fine;
}

/* ---- CVODE and IDA ---- */

typedef struct problem {
  hand h;
  bare_way which;
  SUNContext context;
  N_Vector y;
  N_Vector dy;
  SUNMatrix matrix;
  SUNLinearSolver solver;
  SUNNonlinearSolver fixed_point;
  void *memory;
} problem;

static int ode(double t, N_Vector y_, N_Vector dy_, void *user)
{
  (void)t;
  const problem *p = user;
  int n = p->h.n;
  const double *y = N_VGetArrayPointer(y_);
  double *dy = N_VGetArrayPointer(dy_);
  double x[KKT];
  if (!accelerate(&p->h, y, y + n, x)) {
    return -1;
  }
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
  memcpy(dy + n, x, (size_t)n * sizeof *dy);
  return 0;
}

static int dae(double t, N_Vector y_, N_Vector dy_, N_Vector residual, void *user)
{
  (void)t;
  const problem *p = user;
  const hand *h = &p->h;
  int n = h->n;
  const double *y = N_VGetArrayPointer(y_);
  const double *dy = N_VGetArrayPointer(dy_);
  double *out = N_VGetArrayPointer(residual);
  rows r;
  double force[Q];
  constrain(h, y, y + n, &r);
  load(h, y, y + n, force);
  for (int k = 0; k < n; k++) {
    out[k] = dy[k] - y[n + k];
    out[n + k] = h->mass[k] * dy[n + k] - force[k];
    for (int i = 0; i < h->rows; i++) {
      out[n + k] += r.j[i][k] * y[2 * n + i];
    }
  }
  for (int i = 0; i < h->rows; i++) {
    double a = -r.gamma[i] + 2 * GAIN * r.rate[i] + GAIN * GAIN * r.phi[i];
    for (int k = 0; k < n; k++) {
      a += r.j[i][k] * dy[n + k];
    }
    out[2 * n + i] = p->which == INDEX3 ? r.phi[i] : a;
  }
  return 0;
}

/* Sets q and v to the design configuration. */
static void set_design(const scene *s, double *q, double *v)
{
  const double nudge = 1e-7;
  int width = scene_width(s);
  int last = scene_bodies(s) - 1;
  for (int k = 0; k <= last; k++) {
    long double at[SCENE_NUMBERS];
    long double next[SCENE_NUMBERS];
    scene_pose(s, k, s->angle, at);
    scene_pose(s, k, s->angle + (long double)nudge, next);
    for (int i = 0; i < width; i++) {
      double unit = i < 2 ? s->units.length : 1.0;
      double aside = k == last && i < 2 ? s->violation * (i == 0 ? 0.6 : 0.8) : 0.0;
      q[width * k + i] = ((double)at[i] + aside) * unit;
      v[width * k + i] = (double)((next[i] - at[i]) / nudge) * s->rate * unit / s->units.time;
    }
  }
}

static bool start_cvode(problem *p, const cell *c, double t)
{
  p->memory = CVodeCreate(p->which == ADAMS ? CV_ADAMS : CV_BDF, p->context);
  bool fine = CVodeInit(p->memory, ode, t, p->y) == 0 &&
              CVodeSStolerances(p->memory, c->rtol, c->rtol) == 0 &&
              CVodeSetUserData(p->memory, p) == 0 &&
              CVodeSetMaxNumSteps(p->memory, MOST_STEPS) == 0;
  if (p->which == ADAMS) {
    p->fixed_point = SUNNonlinSol_FixedPoint(p->y, 0, p->context);
    return fine && CVodeSetNonlinearSolver(p->memory, p->fixed_point) == 0;
  }
  return fine && CVodeSetLinearSolver(p->memory, p->solver, p->matrix) == 0;
}

/* Starts IDA with consistent accelerations and multipliers, as the user guide of IDA recommends. */
static bool start_ida(problem *p, const cell *c, double t)
{
  int n = p->h.n;
  double *y = N_VGetArrayPointer(p->y);
  double *dy = N_VGetArrayPointer(p->dy);
  double x[KKT];
  if (!accelerate(&p->h, y, y + n, x)) {
    return false;
  }
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
  memcpy(dy + n, x, (size_t)n * sizeof *dy);
  memcpy(y + 2 * n, x + n, (size_t)p->h.rows * sizeof *y);
  N_Vector id = N_VClone(p->y);
  for (int k = 0; k < 2 * n + p->h.rows; k++) {
    N_VGetArrayPointer(id)[k] = k < 2 * n ? 1.0 : 0.0;
  }
  p->memory = IDACreate(p->context);
  bool fine = IDAInit(p->memory, dae, t, p->y, p->dy) == 0 &&
              IDASStolerances(p->memory, c->rtol, c->rtol) == 0 &&
              IDASetUserData(p->memory, p) == 0 && IDASetId(p->memory, id) == 0 &&
              IDASetSuppressAlg(p->memory, 1) == 0 &&
              IDASetMaxNumSteps(p->memory, MOST_STEPS) == 0 &&
              IDASetLinearSolver(p->memory, p->solver, p->matrix) == 0;
  N_VDestroy(id);
  return fine;
}

/* Integrates to the time `end`, and counts the steps. Returns whether the integrator reports
 * success. */
static bool advance(problem *p, const cell *c, double t, double end, int64_t *steps)
{
  bool ida = p->which >= INDEX3 || p->which == INDEX1;
  long taken = 0;
  bool fine = ida ? start_ida(p, c, t) : start_cvode(p, c, t);
  if (fine && ida) {
    fine = IDASolve(p->memory, end, &t, p->y, p->dy, IDA_NORMAL) >= 0;
    (void)IDAGetNumSteps(p->memory, &taken);
  } else if (fine) {
    fine = CVode(p->memory, end, p->y, &t, CV_NORMAL) >= 0;
    (void)CVodeGetNumSteps(p->memory, &taken);
  }
  *steps = taken;
  return fine;
}

static void close_problem(problem *p)
{
  if (p->which == ADAMS || p->which == BDF) {
    CVodeFree(&p->memory);
  } else {
    IDAFree(&p->memory);
  }
  if (p->fixed_point) {
    (void)SUNNonlinSolFree(p->fixed_point);
  }
  (void)SUNLinSolFree(p->solver);
  SUNMatDestroy(p->matrix);
  N_VDestroy(p->y);
  N_VDestroy(p->dy);
  (void)SUNContext_Free(&p->context);
}

static problem open_problem(const scene *s, bare_way which)
{
  problem p = {.h = write_down(s), .which = which};
  int size = 2 * p.h.n + (which == INDEX1 || which == INDEX3 ? p.h.rows : 0);
#if SUNDIALS_VERSION_MAJOR >= 7
  (void)SUNContext_Create(SUN_COMM_NULL, &p.context);
#else
  (void)SUNContext_Create(NULL, &p.context);
#endif
  p.y = N_VNew_Serial(size, p.context);
  p.dy = N_VNew_Serial(size, p.context);
  p.matrix = SUNDenseMatrix(size, size, p.context);
  p.solver = SUNLinSol_Dense(p.y, p.matrix, p.context);
  return p;
}

/* ---- grading ---- */

static grade grade_bare(const cell *c, bare_way which, double scale)
{
  grade out = {.error = (double)NAN, .promise = (double)NAN, .outcome = STOPPED};
  const scene *s = &c->scene;
  cell_time time = cell_time_of(c);
  problem p = open_problem(s, which);
  double *y = N_VGetArrayPointer(p.y);
  double t = s->start * s->units.time;
  set_design(s, y, y + p.h.n);
  time.scale = scale;
  if (advance(&p, c, t, t + time.span * s->units.time, &out.steps)) {
    cell_measure(c, s, y, &time, &out);
    out.outcome = out.error <= out.promise ? MET : WRONG;
  }
  close_problem(&p);
  return out;
}

static bool suits(const cell *c, bare_way which)
{
  const scene *s = &c->scene;
  return (s->kind == SCENE_BOB || s->kind == SCENE_CRANK) && !s->driven && !s->tilted &&
         strcmp(c->way->name, BESIDE[which]) == 0 && isnan(c->gain) && s->spare <= 5 &&
         c->begin == BAUM_START_ASSEMBLE;
}

static double scale_of(const scene *s)
{
  model m;
  double scale = 1.0;
  if (scene_build(s, &m) == BAUM_OK) {
    (void)baum_mechanism_get_characteristic_length(m.mechanism, &scale);
    model_destroy(&m);
  }
  return scale / s->units.length;
}

static void print_row(const char *name, const int of[OUTCOMES], int cells)
{
  printf("%-24s %6d", name, cells);
  for (int k = 0; k < OUTCOMES; k++) {
    printf(" %8d", of[k]);
  }
  printf("\n");
}

static void compare(const cell_list *list, bare_way which, bool tell)
{
  int bare[OUTCOMES] = {0};
  int ours[OUTCOMES] = {0};
  int cells = 0;
  for (int k = 0; k < list->count; k++) {
    const cell *c = &list->cells[k];
    if (!suits(c, which)) {
      continue;
    }
    grade a = grade_bare(c, which, scale_of(&c->scene));
    grade b = cell_grade(c);
    bare[a.outcome]++;
    ours[b.outcome]++;
    cells++;
    if (tell) {
      printf("  %s = %g, %s: %s %.1e of %.1e, %lld steps; %s %.1e\n", c->axis, c->value,
             scene_name(&c->scene), outcome_name(a.outcome), a.error, a.promise, (long long)a.steps,
             outcome_name(b.outcome), b.error);
    }
  }
  print_row(BARE_NAMES[which], bare, cells);
  char name[40];
  (void)snprintf(name, sizeof name, "  baum, %s", BESIDE[which]);
  print_row(name, ours, cells);
}

int main(int argc, char **argv)
{
  bool tell = argc > 1 && strcmp(argv[1], "--list") == 0;
  cell_list list = axes_cells(NULL);
  /* SUNDIALS prints messages to stderr. They are discarded. */
  if (!freopen("/dev/null", "w", stderr)) {
    return EXIT_FAILURE;
  }
  printf("%-24s %6s %8s %8s %8s %8s %8s %8s\n", "", "cells", "met", "refused", "stopped", "warned",
         "crossed", "wrong");
  for (int k = 0; k < BARE_WAYS; k++) {
    compare(&list, (bare_way)k, tell);
  }
  axes_free(&list);
  return EXIT_SUCCESS;
}
