/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests sparse QR with random matrices. Residuals must be orthogonal to the columns. QR and a
 * Gram-Schmidt process must find the same dependent columns. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "assert_near.h"
#include "linear/sparse_qr.h"
#include "saddle.h"

enum { MOST = 40, ENTRIES = MOST * MOST };

static const double tolerance = 1e-11;

/* A random matrix, stored both as a dense matrix and in compressed columns. */
typedef struct sample {
  int32_t m;
  int32_t n;
  double dense[MOST][MOST]; /* by columns */
  unsigned char dependent[MOST];
  int32_t start[MOST + 1];
  int32_t row[ENTRIES];
  double value[ENTRIES];
  baum_i_sparse_columns pattern;
} sample;

static double draw(uint64_t *seed)
{
  return saddle_random(seed);
}

static int32_t draw_below(uint64_t *seed, int32_t bound)
{
  return (int32_t)floor(0.5 * (1.0 + draw(seed)) * bound);
}

/* Fills column j with up to three entries in rows near the diagonal, and with one more entry in a
 * random row. If `hub` is set, this entry is always in row 0, which couples all columns. */
static void fill_column(sample *s, int32_t j, bool hub, uint64_t *seed)
{
  for (int k = 0; k < 3; k++) {
    int32_t i = (j * s->m / s->n + draw_below(seed, 4)) % s->m;
    s->dense[j][i] = draw(seed);
  }
  s->dense[j][hub ? 0 : draw_below(seed, s->m)] = draw(seed);
}

/* Fills column j with a combination of up to two earlier columns. The combination may be zero. */
static void fill_dependent(sample *s, int32_t j, uint64_t *seed)
{
  for (int k = 0; k < 2 && j > 0; k++) {
    int32_t from = draw_below(seed, j);
    double part = draw(seed);
    for (int32_t i = 0; i < s->m; i++) {
      s->dense[j][i] += part * s->dense[from][i];
    }
  }
}

static void compress(sample *s)
{
  int32_t count = 0;
  for (int32_t j = 0; j < s->n; j++) {
    for (int32_t i = s->m - 1; i >= 0; i--) {
      if (s->dense[j][i] != 0.0) {
        s->row[count] = i;
        s->value[count++] = s->dense[j][i];
      }
    }
    s->start[j + 1] = count;
  }
  s->pattern = (baum_i_sparse_columns){s->m, s->n, s->start, s->row};
}

/* Draws a random m x n matrix in which a share of the columns is dependent. If there are enough
 * rows, the other columns are almost always independent. */
static void draw_sample(int32_t m, int32_t n, double share, uint64_t seed, sample *s)
{
  bool hub = seed % 4 == 0;
  memset(s, 0, sizeof *s);
  s->m = m;
  s->n = n;
  for (int32_t j = 0; j < n; j++) {
    s->dependent[j] = draw(&seed) < 2.0 * share - 1.0;
    if (s->dependent[j]) {
      fill_dependent(s, j, &seed);
    } else {
      fill_column(s, j, hub, &seed);
    }
  }
  compress(s);
}

static double product(const sample *s, int32_t j, const double *x)
{
  double sum = 0.0;
  for (int32_t i = 0; i < s->m; i++) {
    sum += s->dense[j][i] * x[i];
  }
  return sum;
}

/* Finds the independent columns in the given order, by the Gram-Schmidt process with two passes.
 * Returns the rank. Returns -1 if a column is so close to dependent that the process cannot
 * decide. */
static int32_t find_independent(const sample *s, const int32_t *order, unsigned char *independent)
{
  double basis[MOST][MOST];
  int32_t rank = 0;
  for (int32_t k = 0; k < s->n; k++) {
    double *x = basis[rank];
    memcpy(x, s->dense[order[k]], sizeof basis[0]);
    double length = sqrt(product(s, order[k], x));
    double left = 0.0;
    for (int32_t b = 0; b < 2 * rank; b++) {
      const double *other = basis[b % rank];
      double part = 0.0;
      for (int32_t i = 0; i < s->m; i++) {
        part += other[i] * x[i];
      }
      for (int32_t i = 0; i < s->m; i++) {
        x[i] -= part * other[i];
      }
    }
    for (int32_t i = 0; i < s->m; i++) {
      left += x[i] * x[i];
    }
    left = sqrt(left);
    if (left > 1e-13 * length && left < 1e-6) {
      return -1;
    }
    independent[order[k]] = left > tolerance;
    if (independent[order[k]]) {
      for (int32_t i = 0; i < s->m; i++) {
        x[i] /= left;
      }
      rank++;
    }
  }
  return rank;
}

static baum_i_sparse_qr *make(const sample *s, const int32_t *order)
{
  baum_i_sparse_qr *qr = NULL;
  assert_int_equal(baum_i_sparse_qr_create(&s->pattern, order, &qr), BAUM_OK);
  return qr;
}

/* Checks that x minimizes |A x - b| and is zero for dependent columns. Also checks that the
 * projection P satisfies P b = A x and P^2 = P. */
static void assert_solves(const sample *s, baum_i_sparse_qr *qr, const unsigned char *independent)
{
  double b[MOST];
  double x[MOST];
  double left[MOST];
  double projected[MOST];
  uint64_t seed = 77;
  for (int32_t i = 0; i < s->m; i++) {
    b[i] = x[i] = left[i] = projected[i] = draw(&seed);
  }
  baum_i_sparse_qr_solve(qr, x);
  baum_i_sparse_qr_project(qr, projected);
  double largest = 1.0;
  for (int32_t j = 0; j < s->n; j++) {
    assert_true(independent[j] || x[j] == 0.0);
    largest = fmax(largest, fabs(x[j]));
    for (int32_t i = 0; i < s->m; i++) {
      left[i] -= s->dense[j][i] * x[j];
    }
  }
  for (int32_t j = 0; j < s->n; j++) {
    ASSERT_NEAR(product(s, j, left), 0.0, 0.0, 1e-13 * largest);
  }
  for (int32_t i = 0; i < s->m; i++) {
    ASSERT_NEAR(projected[i], b[i] - left[i], 0.0, 1e-13 * largest);
  }
  memcpy(x, projected, sizeof x);
  baum_i_sparse_qr_project(qr, x);
  for (int32_t i = 0; i < s->m; i++) {
    ASSERT_NEAR(x[i], projected[i], 0.0, 1e-14);
  }
}

/* Chooses a random order of the columns. */
static void draw_order(int32_t n, uint64_t *seed, int32_t *order)
{
  for (int32_t k = 0; k < n; k++) {
    int32_t other = draw_below(seed, k + 1);
    order[k] = order[other];
    order[other] = k;
  }
}

static void random_matrices_of_all_shapes_are_solved_and_their_rank_found(void **state)
{
  (void)state;
  uint64_t seed = 5;
  int deficient = 0;
  for (int round = 0; round < 2000; round++) {
    sample s;
    int32_t order[MOST];
    unsigned char want[MOST];
    unsigned char got[MOST];
    draw_sample(1 + draw_below(&seed, MOST), 1 + draw_below(&seed, MOST), round % 3 * 0.2,
                (uint64_t)round, &s);
    draw_order(s.n, &seed, order);
    int32_t rank = find_independent(&s, order, want);
    if (rank < 0) {
      continue;
    }
    baum_i_sparse_qr *qr = make(&s, order);
    assert_int_equal(baum_i_sparse_qr_factor(qr, s.value, tolerance, got), rank);
    assert_memory_equal(got, want, (size_t)s.n);
    assert_solves(&s, qr, got);
    baum_i_sparse_qr_destroy(qr);
    deficient += rank < s.n && rank < s.m;
  }
  assert_true(deficient > 500);
}

static void later_columns_depend_on_earlier_columns(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed < 200; seed++) {
    sample s;
    unsigned char independent[MOST];
    draw_sample(MOST, MOST / 2, 0.3, seed, &s);
    baum_i_sparse_qr *qr = make(&s, NULL);
    int32_t rank = baum_i_sparse_qr_factor(qr, s.value, tolerance, independent);
    for (int32_t j = 0; j < s.n; j++) {
      assert_true(!s.dependent[j] || !independent[j]);
      rank -= independent[j];
    }
    assert_int_equal(rank, 0);
    baum_i_sparse_qr_destroy(qr);
  }
}

/* If the values change but the pattern does not, dependent columns may become independent, and
 * independent columns may become dependent. */
static void the_result_does_not_depend_on_earlier_values(void **state)
{
  (void)state;
  sample s;
  draw_sample(MOST, MOST, 0.2, 3, &s);
  baum_i_sparse_qr *kept = make(&s, NULL);
  uint64_t seed = 8;
  for (int round = 0; round < 50; round++) {
    double a[MOST];
    double b[MOST];
    for (int32_t e = 0; e < s.start[s.n]; e++) {
      s.value[e] = draw(&seed) < -0.2 ? 0.0 : s.value[e] + draw(&seed);
    }
    for (int32_t i = 0; i < s.m; i++) {
      a[i] = b[i] = draw(&seed);
    }
    baum_i_sparse_qr *fresh = make(&s, NULL);
    assert_int_equal(baum_i_sparse_qr_factor(kept, s.value, tolerance, NULL),
                     baum_i_sparse_qr_factor(fresh, s.value, tolerance, NULL));
    baum_i_sparse_qr_solve(kept, a);
    baum_i_sparse_qr_solve(fresh, b);
    assert_memory_equal(a, b, sizeof a);
    baum_i_sparse_qr_destroy(fresh);
  }
  baum_i_sparse_qr_destroy(kept);
}

/* The matrix belongs to a chain of 20000 links. Both ends of the chain are held, and every column
 * occurs twice. An algorithm whose time or memory grows as the square of the size could not solve
 * this. */
static void a_long_chain_takes_linear_time_and_memory(void **state)
{
  (void)state;
  enum { LINKS = 20000, COLUMNS = 2 * LINKS };
  static int32_t start[COLUMNS + 1];
  static int32_t row[4 * COLUMNS];
  static double value[4 * COLUMNS];
  static unsigned char independent[COLUMNS];
  int32_t count = 0;
  for (int32_t j = 0; j < COLUMNS; j++) {
    for (int32_t k = 0; k < 4; k++) {
      row[count] = j / 2 * 3 + k;
      value[count++] = 1.0 + (j / 2 * 7 + k * (j / 2 % 2 + 3)) % 5;
    }
    start[j + 1] = count;
  }
  const baum_i_sparse_columns pattern = {3 * LINKS + 1, COLUMNS, start, row};
  baum_i_sparse_qr *qr = NULL;
  assert_int_equal(baum_i_sparse_qr_create(&pattern, NULL, &qr), BAUM_OK);
  assert_int_equal(baum_i_sparse_qr_factor(qr, value, tolerance, independent), LINKS);
  for (int32_t j = 0; j < COLUMNS; j++) {
    assert_int_equal(independent[j], j % 2 == 0);
  }
  baum_i_sparse_qr_destroy(qr);
}

static void matrices_may_have_empty_columns_or_no_columns(void **state)
{
  (void)state;
  const int32_t start[] = {0, 0, 0};
  const int32_t row[] = {0};
  for (int32_t n = 0; n < 3; n++) {
    const baum_i_sparse_columns pattern = {2 - n / 2, n, start, row};
    baum_i_sparse_qr *qr = NULL;
    double x[] = {3.0, 4.0};
    assert_int_equal(baum_i_sparse_qr_create(&pattern, NULL, &qr), BAUM_OK);
    assert_int_equal(baum_i_sparse_qr_factor(qr, NULL, tolerance, NULL), 0);
    baum_i_sparse_qr_solve(qr, x);
    for (int32_t j = 0; j < n; j++) {
      assert_true(x[j] == 0.0);
    }
    baum_i_sparse_qr_destroy(qr);
  }
  baum_i_sparse_qr_destroy(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(random_matrices_of_all_shapes_are_solved_and_their_rank_found),
    cmocka_unit_test(later_columns_depend_on_earlier_columns),
    cmocka_unit_test(the_result_does_not_depend_on_earlier_values),
    cmocka_unit_test(a_long_chain_takes_linear_time_and_memory),
    cmocka_unit_test(matrices_may_have_empty_columns_or_no_columns),
  };
  return cmocka_run_group_tests_name("sparse_qr", tests, NULL, NULL);
}
