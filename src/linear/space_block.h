/* SPDX-License-Identifier: BSD-3-Clause */
/* Solves the saddle-point system of mechanisms in space by its Schur complement S (for planar
 * mechanisms, see block.h):
 *
 *   S lambda = J a0 - r,  S = J W J^T,  a = a0 - W J^T lambda,     W = M^-1, a0 = W f
 *
 * A *node* is one joint, or up to six of its rows. Omitted rows belong to a node only if the layout
 * marks their row block as `whole`. Rotations are *whitened*: with the inertia tensor I = L L^T,
 * the unknowns of a body are the acceleration x of its origin, for which W is 1 / m, and y = L^T
 * w', for which W is 1. Here w' is the angular acceleration. The entries of J for one node and one
 * body form a *side* [E | R] of two n x 3 blocks: E multiplies x, and R = (columns for w') L^-T
 * multiplies y. Then
 *
 *   S_nk = +- sum over shared bodies of E_n E_k^T / m + R_n R_k^T
 *
 * The first three rows of many joints make two points coincide. In these rows, E is plus or minus
 * the identity (written +I or -I). In rows that compare directions, E is 0. A side is *lean* if E
 * consists of these two kinds of rows alone. Only R of a lean side is stored. For a planar body, W
 * is 0 for the third entry of x and for the first two entries of y. Body 0 is the ground, with W =
 * 0.
 *
 * If the inertia tensor of a body is nearly singular, 1 / m and 1 are small compared with R R^T,
 * and digits are lost in S. The solver then uses the tensor I' = I + e c e^T, where e is the axis
 * of the smallest moment of inertia and c a number of the size of the other moments. With I' = L
 * L^T, u = c^(1/2) L^-1 e and y = L^T w', the equations of motion contain the term -u (u . y). Its
 * factor mu = -u . y is a further multiplier: it is the last one of a node of the body, and its row
 *
 *   u . y + k mu = 0
 *
 * is called a *spin row*. The spin row is the row [0 | u^T] of J, and its diagonal entry in S is
 * u . u - k. The factor k is nearly 1. It differs from 1 by the effect of rounding I', which would
 * otherwise be larger than that of a small moment of inertia.
 *
 * A matrix of n rows is stored in two parts: first rows 0 to 3 of all columns, four numbers for
 * each column, and then, if n > 4, rows 4 and 5 of all columns, two numbers for each column. Unused
 * rows are 0. A vector of n rows has four or eight numbers. Numbers are loaded in groups of the
 * same width in which they were stored, because the processor delays a load that is wider than a
 * recent store to the same memory. */
#ifndef BAUM_I_LINEAR_SPACE_BLOCK_H
#define BAUM_I_LINEAR_SPACE_BLOCK_H

#include "linear/block.h"

enum { BAUM_I_SPACE_ROWS = 6, BAUM_I_SPACE_MOTION = 8 /* x, 0, y, 0 of a body */ };

/* The kind of a body determines its columns. */
typedef enum baum_i_space_kind {
  BAUM_I_SPACE_BODY,
  BAUM_I_SPACE_PARTICLE,
  BAUM_I_SPACE_PLANAR_BODY,
  BAUM_I_SPACE_PLANAR_PARTICLE
} baum_i_space_kind;

/* The system to be solved. `structure` must outlive the solver. */
typedef struct baum_i_space_layout {
  const baum_i_kkt_structure *structure;
  const unsigned char *kinds; /* (mass_block_count) baum_i_space_kind */
  /* (row_block_count) number of the body whose E is -I (0: ground), if the first three rows, or the
   * two rows of a planar pin, make two points coincide and all other rows compare directions;
   * otherwise -1 */
  const int *pinned;
  /* (row_block_count) non-zero: omitted rows stay in the node as rows of zeros with the pivot 1, so
   * that the node has as many rows as the joint */
  const unsigned char *whole;
  const unsigned char *omitted; /* (nc) */
  const unsigned char *moments; /* (nc) non-zero: the multiplier is a moment, otherwise a force */
  const unsigned char *fixed;   /* (mass_block_count) non-zero: a = 0 */
  /* [m] characteristic length, to compare accelerations of origins with angular accelerations, and
   * forces with moments */
  double length;
  /* (row_block_count) number of the body whose spin row is in the node of the row block, or 0.
   * NULL: there are no spin rows. */
  const int *spins;
} baum_i_space_layout;

typedef struct baum_i_space_node {
  int32_t rows;                   /* n, with the spin row */
  int32_t row[BAUM_I_SPACE_ROWS]; /* rows of the system; not set for a spin row */
  uint32_t omitted;               /* bit i is set if row i is omitted and therefore zero */
  int32_t spin;                   /* the body whose spin row is the last row, or 0 */
  int32_t row_block;
  int32_t at;    /* start of its numbers in nodes[]: lambda, r, D */
  int32_t place; /* start of its vectors in rest[] */
  int32_t first_side;
  int32_t side_count;
  bool lean;   /* all sides are lean */
  bool direct; /* the caller sets its sides, Phi', r and D; otherwise they come from J */
} baum_i_space_node;

typedef struct baum_i_space_side {
  int32_t body;
  int32_t move; /* start of E in sides[] */
  int32_t turn; /* start of R */
  int32_t sign; /* +1 or -1: lean, with E = +I or -I; 0: E is stored */
  /* column in the row block of each of the six columns of [E | R]; -1: none */
  int32_t from[BAUM_I_SPACE_ROWS];
} baum_i_space_side;

/* Two nodes that share a body. The node that is eliminated later comes first. */
typedef struct baum_i_space_pair {
  int32_t to;   /* start of their block in off[] */
  int32_t adds; /* 0: the pair sets the block; otherwise it adds to the block */
  int32_t body;
  int32_t sign;  /* both sides are lean: product of their signs; otherwise 0 */
  int32_t stage; /* in which the block must be set */
  int32_t rows[2];
  int32_t move[2];
  int32_t turn[2];
} baum_i_space_pair;

/* A coupling of a node with a node that is eliminated later. */
typedef struct baum_i_space_coupling {
  int32_t later;
  int32_t at;      /* start of its block in off[] */
  int32_t numbers; /* start of the numbers of the later node in nodes[] */
  int32_t rows;    /* of the later node */
} baum_i_space_coupling;

/* A mechanism with many nodes is set, coupled and eliminated in stages, so that the data of a stage
 * stay in the cache. A stage eliminates successive nodes. All nodes and couplings that this changes
 * are set in the same stage or before. The members are the first ones of the stage. */
typedef struct baum_i_space_stage {
  int32_t node;
  int32_t pair;
  int32_t target; /* in targets[] */
} baum_i_space_stage;

/* Pivots of a node. Its rows are divided into a first block of up to three rows and a second block.
 * `det` contains the determinant of the first block, and the determinant that the second block has
 * after the first block has been eliminated. */
typedef struct baum_i_space_measure {
  double det[2];
  double size[2]; /* products of the diagonal entries of S in the rows of each block */
} baum_i_space_measure;

/* Constants of a body. With pointers of 64 bits, the size is a multiple of 32, so that no vector
 * crosses a cache line. */
typedef struct baum_i_space_body {
  double weight[4];   /* W of x: 1 / m three times (planar: twice), then 0 */
  double whiten[12];  /* L^-T, row-major, each row followed by 0 */
  double columns[12]; /* L^-T, column-major, each column followed by 0 */
  double inertia[12]; /* I, stored like `whiten` */
  double unwhite[12]; /* L^T, stored like `whiten` */
  double axis[4];     /* axis e of the smallest moment of inertia */
  double spin[4];     /* L^-1 e, so that spin . y is the angular acceleration about the axis */
  double lack[4];     /* u if a node has the spin row of the body */
  double gap;         /* k - u . u, with k of the spin row */
  double factor[2];   /* k as the sum of two numbers, in twice the working precision */
  double mass;        /* 0 if W = 0 */
  double heft;        /* mass of the body, even if the body is fixed */
  bool fixed;         /* W = 0 */
  bool thin;          /* the moment of inertia about `axis` is small */
  bool raised;        /* a node has the spin row of the body */
  int32_t first;      /* first column of the body in J */
  int32_t size;
  const int32_t *slots; /* (size) column of [E | R] for each column of the body */
} baum_i_space_body;

typedef struct baum_i_space {
  const baum_i_kkt_structure *structure;
  baum_i_elimination order;
  int body_count; /* with ground */
  int node_count;
  int side_count;
  int pair_count;
  int coupling_count;
  int zero_count;
  int stage_count;
  int numbers_of_sides, numbers_of_nodes, numbers_of_rows, numbers_off;
  int hub;       /* mass block with too many sides; -1: none */
  double length; /* [m] see the layout */
  /* pivots are weak if the ratio det[k] / size[k] of a node (baum_i_space_measure) is below this */
  double weak_pivot;
  double weakest; /* the smallest of these ratios, or weak_pivot if all are larger */

  baum_i_space_body *bodies;        /* (body_count) */
  baum_i_space_node *list;          /* (node_count) in the order of elimination */
  baum_i_space_side *side_list;     /* (side_count) */
  baum_i_space_pair *pairs;         /* (pair_count) ascending in stages and then in `to` */
  baum_i_space_coupling *couplings; /* (coupling_count) */
  baum_i_space_stage *stages;       /* (stage_count + 1) */
  int32_t *node_stages;             /* (node_count) stage in which a node must be set */
  /* The bodies of island i are island_bodies[k] for body_start[i] <= k < body_start[i + 1]. The
   * nodes of an island are found in the same way with island_nodes[] and node_start[]. Island 0
   * consists of ground and fixed bodies, and has no nodes. */
  int island_count;
  int32_t *island_bodies; /* (body_count) */
  int32_t *body_start;
  int32_t *island_nodes; /* (node_count) in the order of elimination */
  int32_t *node_start;
  int32_t *zeros;   /* (zero_count x 2) start and length of blocks in off[] that no pair sets */
  int32_t *targets; /* starts in off[] of blocks that receive products of couplings */

  double *numbers;                /* memory of all arrays below */
  double *sides;                  /* constants (space_structure.c), then E and R of all sides */
  double *nodes;                  /* lambda, r, and D or, later, the factors of D */
  baum_i_space_measure *measures; /* (node_count) */
  double *off;     /* S below the diagonal, later replaced by [ U1 U2 ] of space_factor_hot.c */
  double *free;    /* (body_count x 8) a0 */
  double *motion;  /* a */
  double *force;   /* f, whitened */
  double *nothing; /* zeros */
  double *pull;    /* W (f - M a - J^T lambda) */
  double *pull_low;
  double *units; /* (numbers_of_rows) factors that convert multipliers to forces; 0: spin row */
  bool has_thin; /* at least one body is thin */
  double *rest;  /* (numbers_of_rows) r - J a, for a spin row -u . y - k mu */
  double *rest_low;
  const double *from; /* a0 of the present right-hand side: free or nothing */
  const double *load; /* f of the present right-hand side: force or nothing */
} baum_i_space;

/* The first function returns the number of stored entries of a vector with `rows` rows. The second
 * one returns the number of stored entries of a matrix with `rows` rows and three columns. */
static inline int baum_i_space_vector(int rows)
{
  return rows > 4 ? 8 : 4;
}

static inline int baum_i_space_part(int rows)
{
  return rows > 4 ? 20 : 12;
}

/* Returns the number of rows of a node without its spin row. */
static inline int baum_i_space_own_rows(const baum_i_space_node *node)
{
  return node->rows - (node->spin != 0 ? 1 : 0);
}

/* Start of D in the numbers of a node. */
static inline int baum_i_space_pivot(int rows)
{
  return 2 * baum_i_space_vector(rows);
}

/* Returns the same statuses as baum_i_block_create(). */
baum_status baum_i_space_create(const baum_i_space_layout *layout, int *hub, baum_i_space **out);
void baum_i_space_destroy(baum_i_space *space); /* NULL is allowed */

/* Sets all members of an empty solver except the arrays of numbers (space_structure.c). */
baum_status baum_i_space_find_structure(const baum_i_space_layout *layout, baum_i_space *space);

/* Sets the islands of an otherwise complete structure (space_islands.c). */
baum_status baum_i_space_find_islands(baum_i_space *space);

/* Sets W. Returns -1 if all mass blocks are positive definite, otherwise the index of the first one
 * that is not. */
int baum_i_space_set_mass(baum_i_space *space, const double *mass);

/* Returns how completely the rows of a node alone determine the spin of a body that has a side of
 * the node, from 0 to 1. The sides must be set. */
double baum_i_space_grip(const baum_i_space *space, int node, const baum_i_space_side *side);

/* Selects the right-hand side (f, r) or (0, r). Initially it is (f, r). */
void baum_i_space_use_force(baum_i_space *space, bool use);

/* Prepare a solution with the present factors, as baum_i_block_set_rest() and baum_i_block_pull()
 * do for planar mechanisms. */
void baum_i_space_set_rest(baum_i_space *space, const double *r);
void baum_i_space_pull(baum_i_space *space, const double *x);
void baum_i_space_move_rest(baum_i_space *space);

/* Computes what det[] of baum_i_space_measure would be if no other node had been eliminated before
 * this one. */
void baum_i_space_undivided(const baum_i_space *space, int node, double det[2]);

/* Functions of hot files (base/hot.h) for right-hand sides and for nodes whose sides come from
 * J. */
typedef struct baum_i_space_sides_kernel {
  /* Sets f and a0 = W f. */
  void (*set_force)(baum_i_space *space, const double *force);
  /* Sets sides, Phi' = J v - nu, r, D and J a0 - r of the nodes that are not `direct`. */
  void (*set)(baum_i_space *space, const baum_i_block_rows *rows);
} baum_i_space_sides_kernel;

extern const baum_i_space_sides_kernel baum_i_space_sides_kernel_plain;
extern const baum_i_space_sides_kernel baum_i_space_sides_kernel_wide;

/* Functions of hot files (base/hot.h) for the factorization of stages `first` to `end` - 1, like
 * those of baum_i_block_kernel. */
typedef struct baum_i_space_factor_kernel {
  void (*couple)(baum_i_space *space, int first, int end);
  /* Rates the pivots of all nodes after the last stage. After other stages, returns
   * BAUM_I_PIVOTS_GOOD. */
  baum_i_pivots (*eliminate)(baum_i_space *space, int first, int end);
} baum_i_space_factor_kernel;

extern const baum_i_space_factor_kernel baum_i_space_factor_kernel_plain;
extern const baum_i_space_factor_kernel baum_i_space_factor_kernel_wide;

typedef struct baum_i_space_residual_kernel {
  /* Computes pull[] and rest[] in twice the working precision. */
  void (*find)(baum_i_space *space);
} baum_i_space_residual_kernel;

extern const baum_i_space_residual_kernel baum_i_space_residual_kernel_plain;
extern const baum_i_space_residual_kernel baum_i_space_residual_kernel_wide;

/* Functions of hot files (base/hot.h) for the solution, like those of baum_i_block_kernel. */
typedef struct baum_i_space_kernel {
  /* `lambda` may be NULL. */
  void (*substitute)(baum_i_space *space, double *lambda);
  bool (*read_motion)(const baum_i_space *space, double *a);
  void (*read_lambda)(const baum_i_space *space, double *lambda);
} baum_i_space_kernel;

extern const baum_i_space_kernel baum_i_space_kernel_plain;
extern const baum_i_space_kernel baum_i_space_kernel_wide;

/* Functions of hot files (base/hot.h) that check and refine solutions. */
typedef struct baum_i_space_refine_kernel {
  /* Tells how strongly the effects of different nodes cancel. Returns the largest acceleration that
   * the multipliers of one node alone would cause, divided by the largest acceleration in the same
   * island, which all multipliers and forces cause. For the spin that a node causes on a thin body,
   * the divisor is this largest acceleration or the whole spin of the body, whichever is larger. If
   * the returned quotient is large, digits have cancelled. */
  double (*amplification)(const baum_i_space *space);
  bool (*check)(const baum_i_space *space);
  /* Tells whether the residual r - J a is small at all nodes with weak pivots in both blocks. */
  bool (*check_weak_nodes)(const baum_i_space *space);
  /* Corrects a and lambda once. Returns the largest change of the multipliers or of the
   * accelerations, relative to their largest values in the island. */
  double (*correct)(baum_i_space *space);
  /* The same for r - J a in working precision, if the residual of the equations of motion is 0. */
  double (*correct_rows)(baum_i_space *space);
} baum_i_space_refine_kernel;

extern const baum_i_space_refine_kernel baum_i_space_refine_kernel_plain;
extern const baum_i_space_refine_kernel baum_i_space_refine_kernel_wide;

#endif
