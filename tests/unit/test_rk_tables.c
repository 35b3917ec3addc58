/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the coefficients of Runge-Kutta pairs by the order conditions (J. Butcher; Hairer,
 * Norsett, Wanner 1993, section II.2). A method with the weights b_i and the coefficients a_ij has
 * the order p if every rooted tree t of up to p nodes satisfies
 *
 *   sum_i b_i phi_i(t) = 1 / gamma(t),
 *   phi_i(t) = product over the branches t' of the root of sum_j a_ij phi_j(t'),
 *   gamma(t) = |t| times the product of gamma(t') over these branches,
 *
 * where |t| is the number of nodes of t.
 *
 * An interpolant b(x) has the order p if these trees satisfy sum_i b_i(x) phi_i(t) = x^|t| /
 * gamma(t). The weights of an error estimate are differences of the weights of two methods.
 * Therefore sum_i b_i phi_i(t) is zero for these weights up to the lower of the two orders. There
 * are 200 trees of up to 8 nodes.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "integrate/rk_adaptive.h"

/* ---- rooted trees ---- */

enum { TREES = 200, NODES_MAX = 8, STAGES_MAX = 16 };

typedef struct tree {
  int nodes;
  int branch_count;
  /* Indices of the smaller trees that are the branches of the root, in increasing order. */
  int branches[NODES_MAX];
  double gamma;
} tree;

typedef struct forest {
  tree trees[TREES];
  int count;
} forest;

static void add_tree(forest *f, const tree *t)
{
  tree grown = *t;
  grown.gamma = t->nodes;
  for (int i = 0; i < t->branch_count; i++) {
    grown.gamma *= f->trees[t->branches[i]].gamma;
  }
  assert_true(f->count < TREES);
  f->trees[f->count++] = grown;
}

/* Adds branches that have `missing` nodes in total to the tree, in all possible ways. Only trees
 * from number `first` on are used as branches. */
static void branch_out(forest *f, tree *t, int missing, int first)
{
  if (missing == 0) {
    add_tree(f, t);
    return;
  }
  for (int i = first; i < f->count && f->trees[i].nodes <= missing; i++) {
    t->branches[t->branch_count++] = i;
    branch_out(f, t, missing - f->trees[i].nodes, i);
    t->branch_count--;
  }
}

/* Generates all trees, in the order of their numbers of nodes. */
static void grow(forest *f)
{
  f->count = 0;
  for (int nodes = 1; nodes <= NODES_MAX; nodes++) {
    tree t = {.nodes = nodes};
    branch_out(f, &t, nodes - 1, 0);
  }
  assert_int_equal(f->count, TREES);
}

/* ---- a pair as one matrix ---- */

/* A matrix whose rows are the coefficients of the stages, of the end of the step, and of the extra
 * stages. */
typedef struct matrix {
  int n;
  double a[STAGES_MAX][STAGES_MAX];
  double c[STAGES_MAX];
} matrix;

static void fill_matrix(const baum_i_rk_pair *pair, matrix *m)
{
  const baum_i_rk_table *table = &pair->table;
  int s = table->stages;
  const double *row = table->a;
  memset(m, 0, sizeof *m);
  m->n = s + 1 + pair->extra;
  for (int i = 1; i < s; row += i, i++) {
    memcpy(m->a[i], row, (size_t)i * sizeof *row);
  }
  memcpy(m->a[s], table->b, (size_t)s * sizeof *row);
  row = pair->extra_a;
  for (int i = s + 1; i < m->n; row += i, i++) {
    memcpy(m->a[i], row, (size_t)i * sizeof *row);
  }
  memcpy(m->c, table->c, (size_t)s * sizeof *row);
  m->c[s] = 1.0;
  for (int i = 0; i < pair->extra; i++) {
    m->c[s + 1 + i] = pair->extra_c[i];
  }
}

/* Computes phi of all trees at all stages. */
static void compute_phi(const forest *f, const matrix *m, double phi[TREES][STAGES_MAX])
{
  for (int k = 0; k < f->count; k++) {
    for (int i = 0; i < m->n; i++) {
      phi[k][i] = 1.0;
      for (int b = 0; b < f->trees[k].branch_count; b++) {
        double sum = 0.0;
        for (int j = 0; j < i; j++) {
          sum += m->a[i][j] * phi[f->trees[k].branches[b]][j];
        }
        phi[k][i] *= sum;
      }
    }
  }
}

/* A Runge-Kutta pair, with all trees and the values of phi for these trees at all stages. */
typedef struct scene {
  const baum_i_rk_pair *pair;
  const baum_integrator *integrator;
  int dense_order;
  int error_order;  /* sums of the estimates are zero up to this order */
  int error3_order; /* 0 if there is no second estimate */
  forest trees;
  matrix m;
  double phi[TREES][STAGES_MAX];
} scene;

static scene *scenes(void)
{
  static scene both[2] = {{.dense_order = 4, .error_order = 4},
                          {.dense_order = 7, .error_order = 5, .error3_order = 3}};
  both[0].integrator = baum_dp5();
  both[1].integrator = baum_rk8();
  for (int k = 0; k < 2; k++) {
    both[k].pair = both[k].integrator->table;
    grow(&both[k].trees);
    fill_matrix(both[k].pair, &both[k].m);
    compute_phi(&both[k].trees, &both[k].m, both[k].phi);
  }
  return both;
}

static double sum_of(const scene *s, const double *weights, int count, int k)
{
  double sum = 0.0;
  for (int i = 0; i < count; i++) {
    sum += weights[i] * s->phi[k][i];
  }
  return sum;
}

/* ---- conditions ---- */

/* The coefficients are up to 358, and they are rounded to 16 digits. */
static const double ROUNDING = 1e-13;

static void rows_sum_to_their_times(void **state)
{
  (void)state;
  scene *all = scenes();
  for (int k = 0; k < 2; k++) {
    const matrix *m = &all[k].m;
    for (int i = 0; i < m->n; i++) {
      double sum = 0.0;
      for (int j = 0; j < i; j++) {
        sum += m->a[i][j];
      }
      ASSERT_NEAR(sum, m->c[i], 0.0, ROUNDING);
    }
  }
}

static bool fulfils(const scene *s, int k)
{
  const tree *t = &s->trees.trees[k];
  double sum = sum_of(s, s->pair->table.b, s->pair->table.stages, k);
  return fabs(sum - 1.0 / t->gamma) <= ROUNDING;
}

static void order_conditions_hold_up_to_the_order_and_not_beyond(void **state)
{
  (void)state;
  scene *all = scenes();
  for (int k = 0; k < 2; k++) {
    int order = baum_integrator_order(all[k].integrator);
    int failures = 0;
    for (int i = 0; i < TREES; i++) {
      bool wanted = all[k].trees.trees[i].nodes <= order;
      assert_true(!wanted || fulfils(&all[k], i));
      failures += !wanted && !fulfils(&all[k], i);
    }
    assert_true(order == NODES_MAX || failures > 0);
  }
}

static void check_zero_sums(const scene *s, const double *weights, int order)
{
  double beyond = 0.0;
  for (int i = 0; i < TREES; i++) {
    double sum = sum_of(s, weights, s->pair->error_count, i);
    int nodes = s->trees.trees[i].nodes;
    if (nodes <= order) {
      ASSERT_NEAR(sum, 0.0, 0.0, ROUNDING);
    } else if (nodes == order + 1) {
      beyond = fmax(beyond, fabs(sum));
    }
  }
  assert_true(beyond > 1e-6);
}

static void estimates_are_zero_up_to_their_order(void **state)
{
  (void)state;
  scene *all = scenes();
  for (int k = 0; k < 2; k++) {
    check_zero_sums(&all[k], all[k].pair->error, all[k].error_order);
    if (all[k].pair->error3) {
      check_zero_sums(&all[k], all[k].pair->error3, all[k].error3_order);
    }
  }
}

/* Computes the weights of the interpolant at x in a step of length 1, in the same nested form as
 * rk_adaptive.c. */
static void interpolate(const scene *s, double x, double *weights)
{
  const baum_i_rk_pair *pair = s->pair;
  int stages = pair->table.stages;
  for (int i = 0; i < s->m.n; i++) {
    double b = i < stages ? pair->table.b[i] : 0.0;
    double f[8] = {b, (i == 0) - b, 2.0 * b - (i == 0) - (i == stages)};
    for (int k = 0; k < pair->dense; k++) {
      f[3 + k] = pair->dense_row[k * s->m.n + i];
    }
    double value = 0.0;
    for (int k = 2 + pair->dense; k >= 0; k--) {
      value = (value + f[k]) * (k % 2 == 0 ? x : 1.0 - x);
    }
    weights[i] = value;
  }
}

static void interpolants_satisfy_the_conditions_up_to_their_order(void **state)
{
  (void)state;
  scene *all = scenes();
  for (int k = 0; k < 2; k++) {
    for (double x = 0.125; x < 1.1; x += 0.125) {
      double weights[STAGES_MAX];
      interpolate(&all[k], x, weights);
      for (int i = 0; i < TREES; i++) {
        const tree *t = &all[k].trees.trees[i];
        if (t->nodes <= all[k].dense_order) {
          ASSERT_NEAR(sum_of(&all[k], weights, all[k].m.n, i), pow(x, t->nodes) / t->gamma, 0.0,
                      ROUNDING);
        }
      }
    }
  }
}

/* The polynomial is R(mu) = 1 + sum over k of mu^k b A^(k-1) e, where e is the vector of ones. */
static void the_stability_polynomial_agrees_with_the_table(void **state)
{
  (void)state;
  scene *all = scenes();
  for (int k = 0; k < 2; k++) {
    const baum_i_method *method = &all[k].integrator->method;
    int stages = all[k].pair->table.stages;
    double power[STAGES_MAX];
    assert_int_equal(method->kind, BAUM_I_METHOD_ONE_STEP);
    assert_int_equal(method->degree, stages);
    assert_true(method->coefficients[0] == 1.0);
    for (int i = 0; i < stages; i++) {
      power[i] = 1.0;
    }
    for (int d = 1; d <= stages; d++) {
      double sum = 0.0;
      for (int i = stages - 1; i >= 0; i--) {
        sum += all[k].pair->table.b[i] * power[i];
        double next = 0.0;
        for (int j = 0; j < i; j++) {
          next += all[k].m.a[i][j] * power[j];
        }
        power[i] = next;
      }
      /* The absolute tolerance is 1e-17, because the last coefficient of rk8 is only 3.6e-10. */
      ASSERT_NEAR(method->coefficients[d], sum, 1e-9, 1e-17);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(rows_sum_to_their_times),
    cmocka_unit_test(order_conditions_hold_up_to_the_order_and_not_beyond),
    cmocka_unit_test(estimates_are_zero_up_to_their_order),
    cmocka_unit_test(interpolants_satisfy_the_conditions_up_to_their_order),
    cmocka_unit_test(the_stability_polynomial_agrees_with_the_table),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
