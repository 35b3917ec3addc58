/* SPDX-License-Identifier: BSD-3-Clause */
#include "saddle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 wide;
#else
typedef long double wide;
#endif

static void *room(int count, size_t size)
{
  void *memory = calloc((size_t)count + 1, size);
  if (!memory) {
    abort();
  }
  return memory;
}

double saddle_random(uint64_t *seed)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(*seed >> 11) * 0x1p-52 - 1.0;
}

static int pick(uint64_t *seed, int count)
{
  int k = (int)((saddle_random(seed) + 1.0) / 2.0 * count);
  return k < count ? k : count - 1;
}

/* ---- creation ---- */

static saddle make(int mass_blocks, int row_blocks, int columns)
{
  return (saddle){
    .mass_blocks = room(mass_blocks, sizeof(baum_i_mass_block)),
    .row_blocks = room(row_blocks, sizeof(baum_i_row_block)),
    .columns = room(columns, sizeof(int)),
  };
}

/* Allocates the values and vectors. The blocks must have been defined before. */
static void complete(saddle *system)
{
  baum_i_kkt_structure *structure = &system->structure;
  structure->mass_blocks = system->mass_blocks;
  structure->row_blocks = system->row_blocks;
  system->mass = room(system->mass_count, sizeof(double));
  system->jacobian = room(system->jacobian_count, sizeof(double));
  system->shift = room(structure->nc, sizeof(double));
  system->omitted = room(structure->nc, 1);
  system->f = room(structure->nv, sizeof(double));
  system->r = room(structure->nc, sizeof(double));
  system->a = room(structure->nv, sizeof(double));
  system->lambda = room(structure->nc, sizeof(double));
  system->values = (baum_i_kkt_values){.mass = system->mass, .jacobian = system->jacobian};
}

static void add_mass_block(saddle *system, int size)
{
  baum_i_kkt_structure *structure = &system->structure;
  system->mass_blocks[structure->mass_block_count++] =
    (baum_i_mass_block){.first = structure->nv, .size = size, .value = system->mass_count};
  structure->nv += size;
  system->mass_count += size * size;
}

static void add_row_block(saddle *system, int rows, int cols, const int *col)
{
  baum_i_kkt_structure *structure = &system->structure;
  system->row_blocks[structure->row_block_count++] = (baum_i_row_block){
    .row = structure->nc, .rows = rows, .cols = cols, .col = col, .value = system->jacobian_count};
  structure->nc += rows;
  system->jacobian_count += rows * cols;
}

saddle saddle_make_dense(int nv, int nc)
{
  saddle system = make(1, 1, nv);
  for (int j = 0; j < nv; j++) {
    system.columns[j] = j;
  }
  add_mass_block(&system, nv);
  add_row_block(&system, nc, nv, system.columns);
  complete(&system);
  return system;
}

void saddle_free(saddle *system)
{
  void *all[] = {system->mass,        system->jacobian,   system->shift,  system->omitted,
                 system->f,           system->r,          system->a,      system->lambda,
                 system->mass_blocks, system->row_blocks, system->columns};
  for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
    free(all[k]);
  }
}

/* ---- random systems ---- */

/* Lists the columns of a block in random order. The block belongs to bodies i and j, or only to i
 * if i = j. */
static int list_columns(const saddle *system, int i, int j, uint64_t *seed, int *col)
{
  int cols = 0;
  for (int body = i; body <= j; body += j > i ? j - i : 1) {
    const baum_i_mass_block *block = &system->mass_blocks[body];
    for (int k = 0; k < block->size; k++) {
      col[cols++] = block->first + k;
    }
  }
  for (int k = cols - 1; k > 0; k--) {
    int other = pick(seed, k + 1);
    int kept = col[k];
    col[k] = col[other];
    col[other] = kept;
  }
  return cols;
}

static void add_joint(saddle *system, int rows, int i, int j, uint64_t *seed, int *columns)
{
  int *col = system->columns + *columns;
  int cols = list_columns(system, i, j, seed, col);
  *columns += cols;
  system->jacobian_count += 1; /* leaves a gap between blocks */
  add_row_block(system, rows, cols, col);
}

static void swap_row_blocks(saddle *system, uint64_t *seed)
{
  for (int k = system->structure.row_block_count - 1; k > 0; k--) {
    int other = pick(seed, k + 1);
    baum_i_row_block kept = system->row_blocks[k];
    system->row_blocks[k] = system->row_blocks[other];
    system->row_blocks[other] = kept;
  }
}

/* Fills a block of M with R R^T + I / 10, where R is random. */
static void fill_mass_block(const baum_i_mass_block *block, uint64_t *seed, double *mass)
{
  double root[36];
  int n = block->size;
  for (int k = 0; k < n * n; k++) {
    root[k] = saddle_random(seed);
  }
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++) {
      double sum = i == j ? 0.1 : 0.0;
      for (int k = 0; k < n; k++) {
        sum += root[i * n + k] * root[j * n + k];
      }
      mass[block->value + i * n + j] = sum;
    }
  }
}

static void fill_random(double *x, int count, uint64_t *seed)
{
  for (int k = 0; k < count; k++) {
    x[k] = saddle_random(seed);
  }
}

saddle saddle_make_random(uint64_t seed, int bodies)
{
  int loops = bodies / 3;
  saddle system = make(bodies, bodies + loops, 12 * (bodies + loops));
  for (int k = 0; k < bodies; k++) {
    system.mass_count += 2; /* leaves a gap between blocks */
    add_mass_block(&system, pick(&seed, 2) ? 3 : 6);
  }
  int columns = 0;
  for (int k = 0; k < bodies; k++) {
    int rows = system.mass_blocks[k].size == 3 ? 1 + pick(&seed, 2) : 3;
    add_joint(&system, rows, k > 0 ? k - 1 : 0, k, &seed, &columns);
  }
  for (int k = 0; k < loops; k++) {
    int i = pick(&seed, bodies - 1);
    add_joint(&system, 1, i, i + 1 + pick(&seed, bodies - 1 - i), &seed, &columns);
  }
  swap_row_blocks(&system, &seed);
  complete(&system);
  for (int k = 0; k < bodies; k++) {
    fill_mass_block(&system.mass_blocks[k], &seed, system.mass);
  }
  fill_random(system.jacobian, system.jacobian_count, &seed);
  fill_random(system.f, system.structure.nv, &seed);
  fill_random(system.r, system.structure.nc, &seed);
  return system;
}

/* ---- coupled four-bars ---- */

static void add_pin(saddle *system, int i, int j, int *columns)
{
  int *col = system->columns + *columns;
  int cols = 0;
  for (int k = 0; k < 3 && i >= 0; k++) {
    col[cols++] = 3 * i + k;
  }
  for (int k = 0; k < 3; k++) {
    col[cols++] = 3 * j + k;
  }
  *columns += cols;
  add_row_block(system, 2, cols, col);
}

saddle saddle_make_four_bar(int loops)
{
  int bodies = 2 * loops + 1;
  int pins = 3 * loops + 1;
  saddle system = make(bodies, pins, 6 * pins);
  for (int k = 0; k < bodies; k++) {
    add_mass_block(&system, 3);
  }
  int columns = 0;
  for (int k = 0; k <= loops; k++) {
    add_pin(&system, -1, k, &columns);
  }
  for (int k = 0; k < loops; k++) {
    add_pin(&system, k, loops + 1 + k, &columns);
    add_pin(&system, loops + 1 + k, k + 1, &columns);
  }
  complete(&system);
  return system;
}

/* Writes the columns of one body in the rows of a pin. The pin is at (x, y) from the centre of the
 * body, in ground axes. */
static double *write_pin(double *value, int cols, double sign, double x, double y)
{
  const double rows[2][3] = {{sign, 0.0, -sign * y}, {0.0, sign, sign * x}};
  for (int i = 0; i < 2; i++) {
    memcpy(value + (ptrdiff_t)i * cols, rows[i], sizeof rows[i]);
  }
  return value + 3;
}

void saddle_pose_four_bar(saddle *system, double angle)
{
  for (int b = 0; b < system->structure.mass_block_count; b++) {
    double *mass = system->mass + (ptrdiff_t)9 * b;
    mass[0] = mass[4] = 1.0;
    mass[8] = 1.0 / 12.0;
  }
  int loops = (system->structure.mass_block_count - 1) / 2;
  double x = cos(angle) / 2.0;
  double y = sin(angle) / 2.0;
  for (int k = 0; k <= loops; k++) {
    (void)write_pin(system->jacobian + system->row_blocks[k].value, 3, -1.0, -x, -y);
  }
  for (int k = 0; k < loops; k++) {
    const baum_i_row_block *block = &system->row_blocks[loops + 1 + 2 * k];
    double *value = write_pin(system->jacobian + block[0].value, 6, 1.0, x, y);
    (void)write_pin(value, 6, -1.0, -0.5, 0.0);
    value = write_pin(system->jacobian + block[1].value, 6, 1.0, 0.5, 0.0);
    (void)write_pin(value, 6, -1.0, x, y);
  }
}

/* ---- changes ---- */

void saddle_make_consistent(saddle *system, uint64_t seed)
{
  fill_random(system->a, system->structure.nv, &seed);
  memset(system->r, 0, (size_t)system->structure.nc * sizeof *system->r);
  baum_i_jacobian_times(&system->structure, system->jacobian, system->a, system->r);
}

void saddle_use_omitted(saddle *system)
{
  system->values.omitted = system->omitted;
}

void saddle_use_shift(saddle *system)
{
  system->values.shift = system->shift;
}

/* ---- the dense system ---- */

void saddle_write_dense(const saddle *system, double *matrix)
{
  const baum_i_kkt_structure *structure = &system->structure;
  int nv = structure->nv;
  int n = nv + structure->nc;
  memset(matrix, 0, (size_t)n * (size_t)n * sizeof *matrix);
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    for (int k = 0; k < block->size * block->size; k++) {
      int row = block->first + k / block->size;
      matrix[row * n + block->first + k % block->size] += system->mass[block->value + k];
    }
  }
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    for (int k = 0; k < block->rows * block->cols; k++) {
      int row = nv + block->row + k / block->cols;
      int column = block->col[k % block->cols];
      matrix[row * n + column] += system->jacobian[block->value + k];
      matrix[column * n + row] += system->jacobian[block->value + k];
    }
  }
  for (int i = 0; i < structure->nc && system->values.shift; i++) {
    matrix[(ptrdiff_t)(nv + i) * (n + 1)] = -system->shift[i];
  }
}

static wide size_of(wide x)
{
  return x < 0 ? -x : x;
}

/* Writes the dense system and its right side in extended precision, as n rows of n + 1 numbers. An
 * omitted row becomes the equation lambda_i = 0. */
static wide *write_wide(const saddle *system, int n)
{
  int nv = system->structure.nv;
  double *matrix = room(n * n, sizeof *matrix);
  wide *wide_matrix = room(n * (n + 1), sizeof *wide_matrix);
  saddle_write_dense(system, matrix);
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < n; j++) {
      wide_matrix[i * (n + 1) + j] = matrix[i * n + j];
    }
    wide_matrix[i * (n + 1) + n] = i < nv ? system->f[i] : system->r[i - nv];
  }
  for (int i = nv; i < n && system->values.omitted; i++) {
    for (int j = 0; j <= n && system->omitted[i - nv]; j++) {
      wide_matrix[i * (n + 1) + j] = i == j;
    }
  }
  free(matrix);
  return wide_matrix;
}

static void bring_up_pivot(wide *matrix, int n, int k)
{
  int best = k;
  for (int i = k + 1; i < n; i++) {
    if (size_of(matrix[i * (n + 1) + k]) > size_of(matrix[best * (n + 1) + k])) {
      best = i;
    }
  }
  for (int j = 0; j <= n && best != k; j++) {
    wide kept = matrix[k * (n + 1) + j];
    matrix[k * (n + 1) + j] = matrix[best * (n + 1) + j];
    matrix[best * (n + 1) + j] = kept;
  }
}

/* Solves the system by Gauss-Jordan elimination. */
static void eliminate(wide *matrix, int n)
{
  for (int k = 0; k < n; k++) {
    bring_up_pivot(matrix, n, k);
    for (int i = 0; i < n; i++) {
      wide factor = matrix[i * (n + 1) + k] / matrix[k * (n + 1) + k];
      for (int j = k; j <= n && i != k && factor != 0; j++) {
        matrix[i * (n + 1) + j] -= factor * matrix[k * (n + 1) + j];
      }
    }
  }
}

void saddle_solve(const saddle *system, double *want)
{
  int n = system->structure.nv + system->structure.nc;
  wide *matrix = write_wide(system, n);
  eliminate(matrix, n);
  for (int i = 0; i < n; i++) {
    want[i] = (double)(matrix[i * (n + 1) + n] / matrix[i * (n + 1) + i]);
  }
  free(matrix);
}

double saddle_backward_error(const saddle *system)
{
  int nv = system->structure.nv;
  int n = nv + system->structure.nc;
  wide *matrix = write_wide(system, n);
  double worst = 0.0;
  for (int i = 0; i < n; i++) {
    wide residual = matrix[i * (n + 1) + n];
    wide size = size_of(residual);
    for (int j = 0; j < n; j++) {
      wide term = matrix[i * (n + 1) + j] * (j < nv ? system->a[j] : system->lambda[j - nv]);
      residual -= term;
      size += size_of(term);
    }
    /* This comparison keeps NaN. */
    double error = size > 0 ? (double)(size_of(residual) / size) : 0.0;
    worst = error <= worst ? worst : error;
  }
  free(matrix);
  return worst;
}
