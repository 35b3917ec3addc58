/* SPDX-License-Identifier: BSD-3-Clause */
/* Solves the saddle-point system by its Schur complement S, which consists of 2 x 2 blocks:
 *
 *   S lambda = J a0 - r,  S = J W J^T,  a = a0 - W J^T lambda,     W = M^-1, a0 = W f
 *
 * The rows of J are paired into *nodes*. A node with only one row gets a second row in S, with
 * diagonal entry 1 and multiplier 0. The columns of J are grouped into *body blocks* of three. A
 * planar body is one body block with diagonal W. A *dense* body (user coordinates, M = L L^T) has
 * as many body blocks as it needs; its unknowns are y = L^T a, for which W is the identity. Body
 * block 0 is the ground, with W = 0. Arrays such as motion[] begin with nv numbers, one for each
 * velocity. Three numbers of the ground follow, and then y of the dense bodies. Each body block
 * uses three consecutive numbers. A particle has only two numbers. The third number of its body
 * block is the first number of the next body block. The particle does not change that number,
 * because the third diagonal entry of its W is 0. A *side* of a node is the 2 x 3 block of J in the
 * rows of the node and the columns of one body block. A pin is a joint that makes a point of body a
 * coincide with a point of body b. Its sides are
 *
 *   + [ I  c_a ]  on its body a,    - [ I  -c_b ] on its body b,     c_a = k x p_a, c_b = -k x p_b
 *
 * where k is the unit normal of the plane, and p_a and p_b point from the origins of the bodies to
 * the joint. Only c, the *arm*, is stored. All other sides are *general*. Two nodes that share a
 * body block are coupled. S is sparse. The order of elimination, the fill and all indices are
 * determined when the solver is created.
 *
 * The arithmetic is in block_sides_hot.c and block_hot.c. */
#ifndef BAUM_I_LINEAR_BLOCK_H
#define BAUM_I_LINEAR_BLOCK_H

#include "linear/elimination.h"
#include "linear/kkt.h"

/* Tells whether a row block consists of the two rows of a pin, which makes a point of one body
 * coincide with a point of another. */
typedef struct baum_i_block_pin {
  bool is_pin;
  int body_a; /* mass block, -1: ground */
  int body_b;
} baum_i_block_pin;

/* The system to be solved. `structure` must outlive the solver. */
typedef struct baum_i_block_layout {
  const baum_i_kkt_structure *structure;
  const baum_i_block_pin *pins;  /* (row_block_count) */
  const unsigned char *diagonal; /* (mass_block_count) non-zero: M is diagonal and constant */
  const unsigned char *omitted;  /* (nc) or NULL, see baum_i_kkt_values */
  /* (mass_block_count) or NULL; non-zero: the body is fixed (a = 0); its M must be diagonal */
  const unsigned char *fixed;
} baum_i_block_layout;

/* A node with the two sides of a pin. Pins are processed two at a time. If the number of pins is
 * odd, the last pin is repeated in the arrays of size "even pin_count". */
typedef struct baum_i_pin_node {
  int32_t node;
  int32_t row;           /* first of its two rows */
  int32_t body_block[2]; /* body blocks of body a and b */
  int32_t place[2];      /* index in motion[] at which each of them begins */
} baum_i_pin_node;

static inline size_t baum_i_even(size_t count)
{
  return count + count % 2;
}

/* A general node, which is any node other than a pin. */
typedef struct baum_i_full_node {
  int32_t node;
  int32_t row[2];     /* -1: no row, or an omitted one */
  int32_t first_side; /* first of its general sides */
  int32_t side_count;
} baum_i_full_node;

/* Tells where a column of a general side comes from. Sides that are copied from J as a whole need
 * no entries. */
typedef struct baum_i_side_entry {
  int32_t to;      /* in side[] */
  int32_t from[2]; /* indices in the values of J; from[1] = -1: the node has one row */
} baum_i_side_entry;

/* Two pins that are coupled through one body. `off` is the index in off[] of the block of S that
 * couples them. `arm` contains the indices of the two arms on this body: first the arm of the node
 * that is eliminated later, then the arm of the other node. */
typedef struct baum_i_pin_pair {
  int32_t off;
  int32_t arm[2];
  int32_t body_block;
} baum_i_pin_pair;

/* Two nodes that are coupled through one body block. At least one of them is general, or both are
 * pins whose block another pair sets. `side` identifies their sides on this body block: first the
 * side of the node that is eliminated later, then the side of the other node. side[i] >= 0 is the
 * index of a general side, and side[i] < 0 means the side with the arm ~side[i] of a pin. */
typedef struct baum_i_full_pair {
  int32_t off;
  int32_t side[2];
  int32_t body_block;
} baum_i_full_pair;

/* A body whose M is not diagonal, or is diagonal but not constant. */
typedef struct baum_i_dense_body {
  int mass_block;
  int32_t body_block; /* first body block of this body */
  int32_t place;      /* index in motion[] of this block, where y starts */
  int factor;         /* start of L in factor[] */
} baum_i_dense_body;

/* The sides of a node on all body blocks of a dense body. They are consecutive in side[]. */
typedef struct baum_i_dense_side {
  int32_t body; /* in dense[] */
  int32_t side; /* first of these sides */
} baum_i_dense_side;

/* The numbers of a node, which fill one cache line. */
typedef struct baum_i_node {
  double pivot[4];  /* D, column by column */
  double lambda[2]; /* J a0 - r, then D^-1 L^-1 (J a0 - r), then lambda */
  double inverse;   /* 1 / det D */
  double size;      /* product of the diagonal entries of S at this node */
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
  int alike_count;    /* pairs of pins whose shared body is body a of both, or body b of both */
  int opposite_count; /* pairs of pins whose shared body is body a of one and body b of the other */
  int first_count;
  int full_pair_count;
  int zero_count;
  int off_count;
  int dense_count;
  int dense_side_count;
  int factor_size; /* numbers in factor[] */
  int motion_size; /* v, ground, and y of dense bodies */
  /* the solution is refined if the smallest ratio of det D to `size` of a node is below this */
  double weak_pivot;
  bool leaves_v; /* dense bodies or particles use entries of motion[] after the first nv */
  int hub;       /* mass block with too many sides; -1: none */

  unsigned char *fixed; /* (mass_block_count) non-zero: W = 0 */

  baum_i_pin_node *pins;    /* (even pin_count) */
  baum_i_full_node *fulls;  /* (full_count) */
  int32_t *side_body_block; /* (side_count) */
  /* (side_count x 2) indices in the values of J at which the two rows of a side begin; the second
   * index is -1 if the node has one row, and both are -1 if entries[] define the side */
  int32_t *side_from;
  baum_i_side_entry *entries;    /* (entry_count) */
  baum_i_pin_pair *alike;        /* (alike_count) pairs that set their block of off[] */
  baum_i_pin_pair *opposite;     /* (opposite_count) likewise */
  baum_i_full_pair *first_pairs; /* (first_count) likewise */
  baum_i_full_pair *full_pairs;  /* (full_pair_count) pairs that add to their block */
  int32_t *zeros;  /* (zero_count) blocks of off[] that no pair sets; couple() clears them */
  int32_t *target; /* blocks of off[] that receive products of couplings, node after node */
  int32_t *place;  /* (body_block_count) first index of the body block in free[], motion[], ... */
  baum_i_dense_body *dense;       /* (dense_count) */
  baum_i_dense_side *dense_sides; /* (dense_side_count) */

  double *numbers;    /* memory of all arrays below */
  baum_i_node *nodes; /* (node_count) */
  double *weight;     /* (body_block_count x 2) W of the first two columns, and of the third */
  double *free;       /* (motion_size) a0 = W f */
  double *motion;     /* (motion_size) a */
  double *response;   /* (motion_size) W of each number in free[] */
  double *arm;        /* (even pin_count x 4) c_a, c_b */
  double *pin_weight; /* (even pin_count x 4) copies of the weights of both body blocks */
  double *side;       /* (side_count x 6) column by column */
  double *right;      /* (node_count x 2) r */
  double *off;        /* (off_count x 4) S below the diagonal, later L^T, column by column */
  double *factor;     /* L of the dense bodies */

  /* For refinement. */
  double *mass;     /* (motion_size) M, because 1 / W has rounding errors */
  double *force;    /* (motion_size) f */
  double *pull;     /* (motion_size) W (f - M a - J^T lambda) */
  double *pull_low; /* (motion_size) rounding errors of pull[] */
  double *rest;     /* (node_count x 2) r - J a */
  double *rest_low; /* (node_count x 2) errors of rest[]; correct() keeps the old lambda here */

  double *nothing;    /* (motion_size) zeros */
  const double *from; /* a0 of the present right-hand side: free or nothing */
  const double *load; /* f of the present right-hand side: force or nothing */
} baum_i_block;

/* Returns BAUM_OK, BAUM_ERR_MEMORY, or BAUM_ERR_SINGULAR if another solver is faster, because a
 * body has too many joints or there is too much fill. *hub receives the mass block of a body with
 * too many joints, or -1. hub may be NULL. */
baum_status baum_i_block_create(const baum_i_block_layout *layout, int *hub, baum_i_block **out);
void baum_i_block_destroy(baum_i_block *block); /* NULL is allowed */

/* Sets W of the bodies whose M is diagonal. Returns false if an M is not positive. */
bool baum_i_block_set_mass(baum_i_block *block, const double *mass);
/* Factors M of the dense bodies. Call this again whenever an M has changed. Returns false if an M
 * is not positive definite. */
bool baum_i_block_factor_dense(baum_i_block *block, const double *mass);

/* Selects the right-hand side (f, r) or (0, r). Initially it is (f, r). */
static inline void baum_i_block_use_force(baum_i_block *block, bool use)
{
  block->from = use ? block->free : block->nothing;
  block->load = use ? block->force : block->nothing;
}

/* Computes pull[] and rest[] in twice the working precision. */
void baum_i_block_find_residual(baum_i_block *block);

/* Prepares a solution with the present factors (block_pull.c): sets motion, pull and multipliers to
 * 0, and both r and rest to r (nc). The next correct() then gives a motion with J a = r. */
void baum_i_block_set_rest(baum_i_block *block, const double *r);

/* Quality of the pivots of a factorization. */
typedef enum baum_i_pivots {
  BAUM_I_PIVOTS_GOOD,
  BAUM_I_PIVOTS_WEAK,
  BAUM_I_PIVOTS_BAD
} baum_i_pivots;

/* Rows of all joints. Only the rows of general nodes are read. */
typedef struct baum_i_block_rows {
  const double *jacobian; /* values of J */
  const double *v;        /* (nv) NULL: at rest */
  const double *phi;      /* (nc) */
  const double *nu;       /* (nc) */
  const double *gamma;    /* (nc) */
  double bending;         /* r = bending gamma - damping Phi' - stiffness Phi */
  double damping;
  double stiffness;
  double *phi_rate; /* (nc) only rows of general nodes are set */
} baum_i_block_rows;

/* Functions of hot files (base/hot.h) for right-hand sides and general nodes. */
typedef struct baum_i_block_sides_kernel {
  /* Sets f and a0 = W f. */
  void (*set_force)(baum_i_block *block, const double *force);
  /* Sets sides, Phi' = J v - nu, r, pivots and J a0 - r of the general nodes. The caller sets the
   * same quantities of the pins.
   */
  void (*set)(baum_i_block *block, const baum_i_block_rows *rows);
} baum_i_block_sides_kernel;

extern const baum_i_block_sides_kernel baum_i_block_sides_kernel_plain;
extern const baum_i_block_sides_kernel baum_i_block_sides_kernel_wide;

/* Functions of hot files (base/hot.h) for the solution. */
typedef struct baum_i_block_kernel {
  /* Sets the off-diagonal blocks. */
  void (*couple)(baum_i_block *block);
  /* Factors S = L D L^T, substitutes forward, and sets the motion to a0. */
  baum_i_pivots (*eliminate)(baum_i_block *block);
  /* Substitutes backward, which gives lambda and the motion. Writes lambda (nc), except omitted
   * rows. */
  void (*substitute)(baum_i_block *block, double *lambda);
  /* Tells whether every row of r - J a is at rounding level. This level is proportional to the
   * magnitudes of r and of the terms of J a. If `beside` (motion_size) is not NULL, the magnitudes
   * of the terms of the product of J and `beside` are added. */
  bool (*check)(const baum_i_block *block, const double *beside);
  /* Corrects a and lambda once by the residual in pull[] and rest[]. Returns the largest change of
   * a multiplier, divided by the largest multiplier. */
  double (*correct)(baum_i_block *block);
  /* Copies a (nv) and tells whether all numbers are finite. */
  bool (*read_motion)(const baum_i_block *block, double *a);
  /* Copies lambda (nc), with the corrections made so far. */
  void (*read_lambda)(const baum_i_block *block, double *lambda);
} baum_i_block_kernel;

extern const baum_i_block_kernel baum_i_block_kernel_plain;
extern const baum_i_block_kernel baum_i_block_kernel_wide;

#endif
