/* SPDX-License-Identifier: BSD-3-Clause */
/* The saddle-point system by its Schur complement in blocks of two by two:
 *
 *   S lambda = J a0 - r,  S = J W J^T,  a = a0 - W J^T lambda,     W = M^-1, a0 = W f
 *
 * Rows of J go in pairs, *nodes*, a missing second row being 0 lambda = 0 with a unit pivot.
 * Columns go in *body blocks*: a planar body is one, W diagonal; user coordinates with M = L L^T
 * take as many as they need, over y = L^T a, where W is the identity. Triple 0 is the ground: W =
 * 0. Numbers of body blocks stand in the order of v, then ground, then y; a particle's third is
 * that of its neighbour, which it leaves alone, its W being 0. A body block that a node touches is
 * a *side*, a block of 2 x 3 of J. Those of a pin are
 *
 *   + [ I  c_a ]  on its body a,    - [ I  -c_b ] on its body b,     c_a = k x p_a, c_b = -k x p_b
 *
 * so that only c, its *arm*, is stored. Two nodes that share a body block are coupled; S is sparse,
 * and its order of elimination, fill and every index are fixed when the solver is made.
 *
 * Structure here; the arithmetic is block_sides_hot.c and block_hot.c.
 */
#ifndef BAUM_I_LINEAR_BLOCK_H
#define BAUM_I_LINEAR_BLOCK_H

#include "linear/elimination.h"
#include "linear/kkt.h"

/* Two row, the first of them here, that say: a point of one body is a point of another one. */
typedef struct baum_i_block_pin {
  bool is_pin;
  int body_a; /* mass block, -1: ground */
  int body_b;
} baum_i_block_pin;

/* What is to be solved. The structure must outlive the solver. */
typedef struct baum_i_block_layout {
  const baum_i_kkt_structure *structure;
  const baum_i_block_pin *pins;  /* (row_block_count) */
  const unsigned char *diagonal; /* (mass_block_count) non-zero: M is diagonal and constant there */
  const unsigned char *omitted;  /* (nc) or NULL, see baum_i_kkt_values */
  const unsigned char *fixed;    /* (mass_block_count) or NULL: a = 0 there whatever acts, as of
                                    ground; diagonal ones only */
} baum_i_block_layout;

/* A node with two sides of the shape of a pin. They are set two at a time: of an odd number the
 * last one stands twice in arrays that are said to have an even one. */
typedef struct baum_i_pin_node {
  int32_t node;
  int32_t row;           /* first of its two */
  int32_t body_block[2]; /* of body a and b */
  int32_t place[2];      /* of these body blocks */
} baum_i_pin_node;

static inline size_t baum_i_even(size_t count)
{
  return count + count % 2;
}

/* A node of any other shape. */
typedef struct baum_i_full_node {
  int32_t node;
  int32_t row[2];     /* -1: a missing or omitted one */
  int32_t first_side; /* of all full sides */
  int32_t side_count;
} baum_i_full_node;

/* One column of J in a full side that is not taken from there as a whole. */
typedef struct baum_i_side_entry {
  int32_t to;      /* in side[] */
  int32_t from[2]; /* in the values of J; the second -1: the node has one row */
} baum_i_side_entry;

/* A coupling of two pins by one body. */
typedef struct baum_i_pin_pair {
  int32_t off;
  int32_t arm[2]; /* of the later and of the earlier node */
  int32_t body_block;
} baum_i_pin_pair;

/* A coupling by one body block of which one side at least is full; ~arm stands for a pin's side. */
typedef struct baum_i_full_pair {
  int32_t off;
  int32_t side[2]; /* of the later and of the earlier node */
  int32_t body_block;
} baum_i_full_pair;

/* A body whose M is not diagonal, or not constant. */
typedef struct baum_i_dense_body {
  int mass_block;
  int32_t body_block; /* first of its own */
  int32_t place;      /* of that, and so of y */
  int factor;         /* start of L in factor[] */
} baum_i_dense_body;

/* Where a node touches a dense body: sides of all its body blocks, one after the other. */
typedef struct baum_i_dense_side {
  int32_t body; /* in dense[] */
  int32_t side; /* first */
} baum_i_dense_side;

/* The numbers of a node; one cache line. */
typedef struct baum_i_node {
  double pivot[4];  /* D, column by column */
  double lambda[2]; /* J a0 - r, then D^-1 L^-1 of it, then lambda */
  double inverse;   /* 1 / det D */
  double size;      /* product of the diagonal that S had here */
} baum_i_node;

typedef struct baum_i_block {
  const baum_i_kkt_structure *structure;
  baum_i_elimination order;

  int node_count;
  int body_block_count; /* with ground */
  int pin_count;
  int full_count;
  int side_count;
  int entry_count;
  int alike_count;    /* pin pairs of arms a and a, or b and b */
  int opposite_count; /* pin pairs of arms a and b */
  int first_count;
  int full_pair_count;
  int zero_count;
  int off_count;
  int dense_count;
  int dense_side_count;
  int factor_size;   /* numbers in factor[] */
  int motion_size;   /* v, ground, and y of dense bodies */
  double weak_pivot; /* det D over the product of the diagonal that S had: refined below */
  bool leaves_v;     /* a body block has numbers outside of v: dense bodies, particles */
  int hub;           /* mass block that more rows touch than blocks are good for; -1: none */

  unsigned char *fixed; /* (mass_block_count) W = 0 */

  baum_i_pin_node *pins;         /* (even pin_count) */
  baum_i_full_node *fulls;       /* (full_count) */
  int32_t *side_body_block;      /* (side_count) */
  int32_t *side_from;            /* (side_count x 2) where its columns are in the values of J,
                                    row by row; -1: no second row; both: by entries */
  baum_i_side_entry *entries;    /* (entry_count) */
  baum_i_pin_pair *alike;        /* (alike_count) set their block */
  baum_i_pin_pair *opposite;     /* (opposite_count) likewise */
  baum_i_full_pair *first_pairs; /* (first_count) likewise */
  baum_i_full_pair *full_pairs;  /* (full_pair_count) add to it */
  int32_t *zeros;                /* (zero_count) blocks to clear first */
  int32_t *target;               /* blocks that pairs of couplings go to, node after node */
  int32_t *place; /* (body_block_count) where its numbers are in free[], motion[] and such */
  baum_i_dense_body *dense;       /* (dense_count) */
  baum_i_dense_side *dense_sides; /* (dense_side_count) */

  double *numbers;    /* behind all arrays below */
  baum_i_node *nodes; /* (node_count) */
  double *weight;     /* (body_block_count x 2) W of the first two columns, and of the third */
  double *free;       /* (motion_size) a0 = W f */
  double *motion;     /* (motion_size) a */
  double *response;   /* (motion_size) W, where free[] is */
  double *arm;        /* (even pin_count x 4) c_a, c_b */
  double *pin_weight; /* (even pin_count x 4) weights of both body blocks once more, side by side */
  double *side;       /* (side_count x 6) column by column */
  double *right;      /* (node_count x 2) r */
  double *off;        /* (off_count x 4) S below the diagonal, then L^T, column by column */
  double *factor;     /* L of the dense bodies */

  /* For refinement. */
  double *mass;     /* (motion_size) M, since W is rounded */
  double *force;    /* (motion_size) f */
  double *pull;     /* (motion_size) W (f - M a - J^T lambda) */
  double *pull_low; /* (motion_size) what pull[] lacks while it is made */
  double *rest;     /* (node_count x 2) r - J a, then lambda while it is corrected */
  double *rest_low; /* (node_count x 2) as pull_low */

  double *nothing;    /* (motion_size) zeros */
  const double *from; /* a0 of the present right side: free, or nothing */
  const double *load; /* f of it: force, or nothing */
} baum_i_block;

/* BAUM_OK, BAUM_ERR_MEMORY, or BAUM_ERR_SINGULAR where another solver suits better: a body with so
 * many joints, or so much fill, that blocks would be slow. Which body is told in *hub, a mass
 * block, or -1; NULL is fine. */
baum_status baum_i_block_create(const baum_i_block_layout *layout, int *hub, baum_i_block **out);
void baum_i_block_destroy(baum_i_block *block); /* NULL is fine */

/* The weights of the diagonal bodies. False where M is not positive. */
bool baum_i_block_set_mass(baum_i_block *block, const double *mass);
/* Factors of the dense bodies; their M may change. False likewise. */
bool baum_i_block_factor_dense(baum_i_block *block, const double *mass);

/* Whether right sides are (f, r) from now on, as at first, or (0, r). */
void baum_i_block_use_force(baum_i_block *block, bool use);

/* pull[] and rest[], in twice the precision. */
void baum_i_block_find_residual(baum_i_block *block);

/* block_pull.c. Before a correction with the factors at hand: motion, pull and multipliers are 0,
 * rest is r (nc), so that the correction gives a motion with J a = r. */
void baum_i_block_set_rest(baum_i_block *block, const double *r);

/* How good the pivots of a factorization were. */
typedef enum baum_i_pivots {
  BAUM_I_PIVOTS_GOOD,
  BAUM_I_PIVOTS_WEAK,
  BAUM_I_PIVOTS_BAD
} baum_i_pivots;

/* Rows of the joints that are not pins: all rows of the mechanism, as their joints give them. */
typedef struct baum_i_block_rows {
  const double *jacobian; /* values of J */
  const double *v;        /* (nv) NULL: at rest */
  const double *phi;      /* (nc) */
  const double *nu;       /* (nc) */
  const double *gamma;    /* (nc) */
  double bending;         /* r = bending gamma - damping Phi' - stiffness Phi */
  double damping;
  double stiffness;
  double *phi_rate; /* (nc) rows of nodes are set */
} baum_i_block_rows;

/* The hot part: right sides, and nodes that are not pins, */
typedef struct baum_i_block_sides_kernel {
  /* f, and a0 = W f. */
  void (*set_force)(baum_i_block *block, const double *force);
  /* Sides, Phi' = J v - nu, r, pivots and J a0 - r of the general nodes; pins are set by the
   * caller. */
  void (*set)(baum_i_block *block, const baum_i_block_rows *rows);
} baum_i_block_sides_kernel;

extern const baum_i_block_sides_kernel baum_i_block_sides_kernel_plain;
extern const baum_i_block_sides_kernel baum_i_block_sides_kernel_wide;

/* and the solution. */
typedef struct baum_i_block_kernel {
  /* Off-diagonal blocks. */
  void (*couple)(baum_i_block *block);
  /* L D L^T, and the right side forward; the motion is a0. */
  baum_i_pivots (*eliminate)(baum_i_block *block);
  /* The right side backward, which gives lambda, also into its rows (nc) but for omitted ones;
   * and the motion. */
  void (*substitute)(baum_i_block *block, double *lambda);
  /* Whether every row of r - J a is rounding. */
  bool (*check)(const baum_i_block *block);
  /* One correction of a and lambda by the residual in pull[] and rest[]. Returns the largest change
   * of a multiplier against the largest multiplier. */
  double (*correct)(baum_i_block *block);
  /* a (nv); whether all of it is finite. */
  bool (*read_motion)(const baum_i_block *block, double *a);
  /* lambda once more, after corrections. */
  void (*read_lambda)(const baum_i_block *block, double *lambda);
} baum_i_block_kernel;

extern const baum_i_block_kernel baum_i_block_kernel_plain;
extern const baum_i_block_kernel baum_i_block_kernel_wide;

#endif
