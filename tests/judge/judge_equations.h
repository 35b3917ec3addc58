/* SPDX-License-Identifier: BSD-3-Clause */
/* The equations of motion of a judge_scene, for bench_doubts. They use no code of the library:
 *
 *   M a + J^T lambda = g,  J a = gamma
 *
 * M is constant and diagonal, J is the constraint Jacobian, and g are the applied forces. With J~ =
 * J M^-1/2 and the Householder factorization J~^T = Q (R; 0), the solution is
 *
 *   a = M^-1/2 Q (R^-T gamma; Q2^T M^-1/2 g),
 *
 * where Q2 contains the columns of Q that belong to the zero block. Unlike a solution with J~ J~^T,
 * this solution does not square the condition number of J~.
 */
#ifndef BAUM_JUDGE_EQUATIONS_H
#define BAUM_JUDGE_EQUATIONS_H

#include "judge_scene.h"

typedef struct judge_rows {
  double phi[JUDGE_ROWS];
  double nu[JUDGE_ROWS];
  double gamma[JUDGE_ROWS];
  double jacobian[JUDGE_ROWS][JUDGE_N];
} judge_rows;

typedef struct judge_factors {
  int n;                               /* number of coordinates */
  int m;                               /* number of rows */
  double columns[JUDGE_ROWS][JUDGE_N]; /* the Householder vectors of J~^T */
  double r[JUDGE_ROWS][JUDGE_ROWS];
  double root[JUDGE_N]; /* M^1/2, or ones if not weighted */
} judge_factors;

void judge_evaluate_rows(const judge_scene *s, double t, const double *q, const double *v,
                         judge_rows *out);
void judge_forces(const judge_scene *s, const double *q, const double *v, double *g);
double judge_mass(const judge_scene *s, int column);

/** Factors J~ if `weighted` is set, and J otherwise. Returns false if the rows are dependent up to
 * rounding errors. */
bool judge_factor(const judge_scene *s, const judge_rows *rows, bool weighted, judge_factors *out);

/** Replaces x by the nearest vector for which J x = rhs. The distance is measured in the metric M,
 * or in the Euclidean metric if the factors are not weighted. */
void judge_nearest(const judge_factors *f, const double *rhs, double *x);

/** Writes column k of an orthonormal basis of the null space of J. The basis has n - m columns. The
 * factors must not be weighted. */
void judge_null_vector(const judge_factors *f, int k, double *out);

bool judge_acceleration(const judge_scene *s, double t, const double *q, const double *v,
                        double *a);

/** Replaces q and v by the nearest values that satisfy the constraints. The distance is measured in
 * the metric M if `weighted` is set, and in the Euclidean metric otherwise. */
bool judge_project(const judge_scene *s, double t, bool weighted, double *q, double *v);

double judge_kinetic(const judge_scene *s, const double *v);

#endif
