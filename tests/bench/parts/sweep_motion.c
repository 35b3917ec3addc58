/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes the growth of perturbations. A perturbation of the start is a combination of given
 * directions. Row d of A_k is the effect of direction d at time k, from central differences. It
 * contains the change of q and the change of v / rate, where `rate` is the initial angular velocity
 * of the crank. Let G_j = A_j A_j^T. Let P_k be the same product for time k, but only with the
 * columns that belong to q. The growth from time j to time k is the change of q at time k divided
 * by the change of q and v / rate at time j. It is at most the square root of trace(G_j^-1 P_k),
 * which is a Frobenius norm. */
#include "sweep_motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gragg.h"

enum { NUMBERS = SWEEP_NUMBERS, INSTANTS = 200 };

static const long double TOLERANCE = 1e-16L;

void sweep_must(bool fine, const char *what)
{
  if (!fine) {
    (void)fprintf(stderr, "%s: %s\n", what, baum_message());
    exit(EXIT_FAILURE);
  }
}

typedef struct neighbours {
  long double change[NUMBERS][2 * SWEEP_NQ]; /* the matrix A, with a row for each direction */
  long double positions[NUMBERS][NUMBERS];   /* the matrix P */
  long double both[NUMBERS][NUMBERS];        /* the matrix G, and later its Cholesky factor L */
} neighbours;

/* Computes z = (q, v / rate). Each entry is divided by its unit, a length or 1 rad. The velocities
 * v are computed by differences of q. */
static void measure(const sweep_scene *s, const sweep_motion *m, const long double *y,
                    long double *z)
{
  static const long double SHORT = 1e-6L; /* [s] */
  long double dy[NUMBERS];
  m->rate(m->data, y, dy);
  for (int side = -1; side <= 1; side++) {
    long double near[NUMBERS];
    long double q[SWEEP_NQ];
    for (int i = 0; i < m->n; i++) {
      near[i] = y[i] + side * SHORT * dy[i];
    }
    m->q(m->data, near, q);
    for (int i = 0; i < s->nq; i++) {
      long double unit = (long double)s->unit[i];
      z[s->nq + i] = side < 0 ? 0.0L : z[s->nq + i];
      z[s->nq + i] += side * q[i] / unit / (2.0L * SHORT * (long double)s->rate);
      z[i] = side <= 0 ? q[i] / unit : z[i];
    }
  }
}

static void add_neighbour(const sweep_scene *s, const sweep_motion *m, int d, long double nudge,
                          neighbours *at)
{
  gragg g = {m->rate, m->data, m->n, TOLERANCE, 0.0L};
  long double y[NUMBERS];
  long double z[2 * SWEEP_NQ];
  for (int i = 0; i < m->n; i++) {
    y[i] = m->y[i] + nudge * m->direction[d][i];
  }
  for (int k = 0; k < INSTANTS; k++) {
    measure(s, m, y, z);
    for (int i = 0; i < 2 * s->nq; i++) {
      at[k].change[d][i] += z[i] / (2.0L * nudge);
    }
    sweep_must(gragg_advance(&g, (long double)s->span / (INSTANTS - 1), y), s->name);
  }
}

static void find_gram(const sweep_scene *s, int directions, neighbours *at)
{
  for (int a = 0; a < directions; a++) {
    for (int b = 0; b < directions; b++) {
      for (int i = 0; i < 2 * s->nq; i++) {
        long double product = at->change[a][i] * at->change[b][i];
        at->both[a][b] += product;
        at->positions[a][b] += i < s->nq ? product : 0.0L;
      }
    }
  }
  for (int a = 0; a < directions; a++) {
    for (int b = 0; b <= a; b++) {
      long double sum = at->both[a][b];
      for (int i = 0; i < b; i++) {
        sum -= at->both[a][i] * at->both[b][i];
      }
      at->both[a][b] = a == b ? sqrtl(sum) : sum / at->both[b][b];
    }
  }
}

/* Returns the trace of G^-1 P, where G = L L^T. */
static long double trace_of(int n, const neighbours *from, const neighbours *to)
{
  long double trace = 0.0L;
  for (int c = 0; c < n; c++) {
    long double x[NUMBERS];
    for (int i = 0; i < n; i++) {
      x[i] = to->positions[i][c];
      for (int j = 0; j < i; j++) {
        x[i] -= from->both[i][j] * x[j];
      }
      x[i] /= from->both[i][i];
    }
    for (int i = n - 1; i >= c; i--) {
      for (int j = i + 1; j < n; j++) {
        x[i] -= from->both[j][i] * x[j];
      }
      x[i] /= from->both[i][i];
    }
    trace += x[c];
  }
  return trace;
}

static double find_growth(const sweep_scene *s, const sweep_motion *m)
{
  static const long double NUDGE = 1e-6L;
  static neighbours at[INSTANTS];
  long double most = 0.0L;
  memset(at, 0, sizeof at);
  for (int d = 0; d < m->directions; d++) {
    add_neighbour(s, m, d, NUDGE, at);
    add_neighbour(s, m, d, -NUDGE, at);
  }
  for (int k = 0; k < INSTANTS; k++) {
    find_gram(s, m->directions, &at[k]);
    for (int j = 0; j < k; j++) {
      most = fmaxl(most, trace_of(m->directions, &at[j], &at[k]));
    }
  }
  return (double)sqrtl(most);
}

void sweep_follow(sweep_scene *s, sweep_motion *m, bool growth)
{
  gragg g = {m->rate, m->data, m->n, TOLERANCE, 0.0L};
  s->growth = growth ? find_growth(s, m) : (double)NAN;
  for (int k = 0; k < SWEEP_SAMPLES; k++) {
    long double q[SWEEP_NQ];
    sweep_must(gragg_advance(&g, (long double)s->span / SWEEP_SAMPLES, m->y), s->name);
    s->times[k] = s->span * (k + 1) / SWEEP_SAMPLES;
    m->q(m->data, m->y, q);
    for (int i = 0; i < s->nq; i++) {
      s->want[k][i] = (double)q[i];
    }
  }
}
