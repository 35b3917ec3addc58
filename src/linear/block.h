/* SPDX-License-Identifier: BSD-3-Clause */
/* The saddle-point system, solved by its Schur complement in blocks of two by two:
 *
 *   S lambda = J a0 - r,  S = J W J^T,  a = a0 - W J^T lambda,     W = M^-1, a0 = W f
 *
 * The rows of J are paired into *nodes*; a missing second row stands for 0 lambda = 0 with a unit
 * pivot. Columns are grouped into *body blocks*. A planar body is one body block with diagonal W.
 * User coordinates with M = L L^T take as many as they need, in terms of y = L^T a, where W is the
 * identity. Body block 0 is the ground: W = 0. The numbers of body blocks are stored in the order
 * of v, then ground, then y. The third number of a particle's body block belongs to its neighbour;
 * it does not change, because its W is 0. A body block that a node touches is a *side*, a 2 x 3
 * block of J. The sides of a pin are
 *
 *   + [ I  c_a ]  on its body a,    - [ I  -c_b ] on its body b,     c_a = k x p_a, c_b = -k x p_b
 *
 * so only c, its *arm*, is stored. Two nodes that share a body block are coupled. S is sparse; its
 * order of elimination, its fill and every index are fixed when the solver is created.
 *
 * The arithmetic is in block_sides_hot.c and block_hot.c. */
#ifndef BAUM_I_LINEAR_BLOCK_H
#define BAUM_I_LINEAR_BLOCK_H

#include "linear/elimination.h"
#include "linear/kkt.h"

/* Whether this row and the next are the rows of a pin: a point of one body coincides with a point
 * of another. */
typedef struct baum_i_block_pin {
  bool is_pin;
  int body_a; /* mass block, -1: ground */
  int body_b;
} baum_i_block_pin;

/* The system. The structure must outlive the solver. */
typedef struct baum_i_block_layout {
  const baum_i_kkt_structure *structure;
  const baum_i_block_pin *pins;  /* (row_block_count) */
  const unsigned char *diagonal; /* (mass_block_count) non-zero: M is diagonal and constant there */
  const unsigned char *omitted;  /* (nc) or NULL, see baum_i_kkt_values */
  /* (mass_block_count) or NULL; non-zero: a fixed body with diagonal M, a = 0 */
  const unsigned char *fixed;
} baum_i_block_layout;

/* A node with the two sides of a pin. Pins are processed two at a time: where their number is odd,
 * the last one is repeated in the arrays described as even. */
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

/* A general node: any other shape. */
typedef struct baum_i_full_node {
  int32_t node;
  int32_t row[2];     /* -1: a missing or omitted one */
  int32_t first_side; /* first of its general sides */
  int32_t side_count;
} baum_i_full_node;

/* One column of J in a general side that is not copied from J as a whole. */
typedef struct baum_i_side_entry {
  int32_t to;      /* in side[] */
  int32_t from[2]; /* in the values of J; the second -1: the node has one row */
} baum_i_side_entry;

/* A coupling of two pins through one body. */
typedef struct baum_i_pin_pair {
  int32_t off;
  int32_t arm[2]; /* of the later and of the earlier node */
  int32_t body_block;
} baum_i_pin_pair;

/* A coupling through one body block of which at least one side is general; ~arm denotes a side of a
 * pin. */
typedef struct baum_i_full_pair {
  int32_t off;
  int32_t side[2]; /* of the later and of the earlier node */
  int32_t body_block;
} baum_i_full_pair;

/* A body whose M is not diagonal or not constant. */
typedef struct baum_i_dense_body {
  int mass_block;
  int32_t body_block; /* first of its own */
  int32_t place;      /* of that, and so of y */
  int factor;         /* start of L in factor[] */
} baum_i_dense_body;

/* The sides of a node on a dense body: those of all its body blocks, in order. */
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
  int factor_size; /* numbers in factor[] */
  int motion_size; /* v, ground, and y of dense bodies */
  /* limit of det D over the product of the original diagonal of S; refined below it */
  double weak_pivot;
  bool leaves_v; /* some body block has numbers outside v: dense bodies, particles */
  int hub;       /* mass block with too many rows for blocks; -1: none */

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

  double *numbers;    /* memory of all arrays below */
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
  double *mass;     /* (motion_size) M, because W is rounded */
  double *force;    /* (motion_size) f */
  double *pull;     /* (motion_size) W (f - M a - J^T lambda) */
  double *pull_low; /* (motion_size) low part of pull[] while it is summed */
  double *rest;     /* (node_count x 2) r - J a, then lambda while it is corrected */
  double *rest_low; /* (node_count x 2) as pull_low */

  double *nothing;    /* (motion_size) zeros */
  const double *from; /* a0 of the present right-hand side: free, or nothing */
  const double *load; /* f of it: force, or nothing */
} baum_i_block;

/* BAUM_OK, BAUM_ERR_MEMORY, or BAUM_ERR_SINGULAR where another solver is better: a body with too
 * many joints, or too much fill for blocks to be fast. *hub receives the mass block of that body,
 * or -1; hub may be NULL. */
baum_status baum_i_block_create(const baum_i_block_layout *layout, int *hub, baum_i_block **out);
void baum_i_block_destroy(baum_i_block *block); /* NULL is fine */

/* Sets the weights of the diagonal bodies. Returns false where M is not positive. */
bool baum_i_block_set_mass(baum_i_block *block, const double *mass);
/* Factors the dense bodies, whose M may change. Returns false where M is not positive. */
bool baum_i_block_factor_dense(baum_i_block *block, const double *mass);

/* Selects the right-hand side: (f, r), which is initially selected, or (0, r). */
void baum_i_block_use_force(baum_i_block *block, bool use);

/* Computes pull[] and rest[] in twice the working precision. */
void baum_i_block_find_residual(baum_i_block *block);

/* Prepares a solution with the present factors (block_pull.c): sets motion, pull and multipliers to
 * 0 and rest to r (nc), so that the next correction gives a motion with J a = r. */
void baum_i_block_set_rest(baum_i_block *block, const double *r);

/* Quality of the pivots of a factorization. */
typedef enum baum_i_pivots {
  BAUM_I_PIVOTS_GOOD,
  BAUM_I_PIVOTS_WEAK,
  BAUM_I_PIVOTS_BAD
} baum_i_pivots;

/* Rows of all joints; those of general nodes are read. */
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

/* Hot functions for right-hand sides and general nodes. */
typedef struct baum_i_block_sides_kernel {
  /* Sets f and a0 = W f. */
  void (*set_force)(baum_i_block *block, const double *force);
  /* Sets sides, Phi' = J v - nu, r, pivots and J a0 - r of the general nodes; the caller sets pins.
   */
  void (*set)(baum_i_block *block, const baum_i_block_rows *rows);
} baum_i_block_sides_kernel;

extern const baum_i_block_sides_kernel baum_i_block_sides_kernel_plain;
extern const baum_i_block_sides_kernel baum_i_block_sides_kernel_wide;

/* Hot functions for the solution. */
typedef struct baum_i_block_kernel {
  /* Sets the off-diagonal blocks. */
  void (*couple)(baum_i_block *block);
  /* Factors L D L^T and substitutes forward; the motion becomes a0. */
  baum_i_pivots (*eliminate)(baum_i_block *block);
  /* Substitutes backward, which gives lambda and the motion. lambda (nc) receives all rows but
   * omitted ones. */
  void (*substitute)(baum_i_block *block, double *lambda);
  /* Tells whether every row of r - J a is rounding. */
  bool (*check)(const baum_i_block *block);
  /* Corrects a and lambda once by the residual in pull[] and rest[]. Returns the largest change of
   * a multiplier over the largest multiplier. */
  double (*correct)(baum_i_block *block);
  /* Copies a (nv); tells whether all of it is finite. */
  bool (*read_motion)(const baum_i_block *block, double *a);
  /* Copies lambda again, after corrections. */
  void (*read_lambda)(const baum_i_block *block, double *lambda);
} baum_i_block_kernel;

extern const baum_i_block_kernel baum_i_block_kernel_plain;
extern const baum_i_block_kernel baum_i_block_kernel_wide;

#endif
