/* SPDX-License-Identifier: BSD-3-Clause */
/* The path q(t) that solves Phi(q, t) = 0, for mechanisms without degrees of freedom. The functions
 * take one step along the path, and refuse a step that may lead to another branch. */
#ifndef BAUM_I_INTEGRATE_CONTINUATION_H
#define BAUM_I_INTEGRATE_CONTINUATION_H

#include "dynamics/dynamics.h"

/* A configuration that satisfies the constraints, with its velocities and accelerations. */
typedef struct baum_i_configuration {
  double t;
  double *q; /* (nq) */
  double *v; /* (nv) J v = nu */
  double *a; /* (nv) J a = gamma */
  /* (nv) direction in which J has changed most since the last configuration; zeros at the start */
  double *turn;
  double *jacobian; /* (jacobian_size) */
} baum_i_configuration;

/* The possible reasons why a configuration was refused. */
typedef enum baum_i_refusal {
  BAUM_I_REFUSAL_NONE,
  BAUM_I_REFUSAL_FAR, /* Newton's corrections were too large, or hardly decreased */
  /* J has changed so much that the step may pass a singular configuration */
  BAUM_I_REFUSAL_TURNED,
  BAUM_I_REFUSAL_SINGULAR,   /* J cannot be factored */
  BAUM_I_REFUSAL_OMITTED,    /* a row that was omitted as redundant is violated */
  BAUM_I_REFUSAL_EVALUATION, /* a user function asks for a smaller step; see baum_message() */
  BAUM_I_REFUSAL_STOP,       /* a user function stops the run, or memory is short */
} baum_i_refusal;

/* The result of a step: how the configuration was found, or why it was refused. */
typedef struct baum_i_verdict {
  baum_i_refusal refusal;
  baum_status status; /* failure, for BAUM_I_REFUSAL_EVALUATION, _SINGULAR and _STOP */
  int iterations;     /* number of iterations of Newton's method */
  double contraction; /* ratio of the second correction to the first; 0 if there was only one */
  double turning;     /* estimate of |I - J^-1 J_from|; J_from is J at the start of the step */
  int row;            /* violated row, for BAUM_I_REFUSAL_OMITTED */
} baum_i_verdict;

/* Working memory of a step. */
typedef struct baum_i_continuation {
  baum_workspace *workspace;
  double *memory;
  /* (nc) norm of each row of J after its columns have been multiplied by the scales */
  double *distance;
  double *zero;  /* (nv) */
  double *probe; /* (nv) */
  double *image; /* (nv) */
  double *left;  /* (nc) */
} baum_i_continuation;

/* The cause of a singular configuration. */
typedef struct baum_i_impasse {
  double gain; /* scaled |J^-1|; INFINITY if J cannot be factored */
  /* share (0 to 1) that rows depending on time have in the left singular vector of the smallest
   * singular value */
  double pull;
  int driver;   /* time-dependent joint with the largest share, or -1 */
  int resister; /* other joint with the largest share, or -1 */
} baum_i_impasse;

baum_status baum_i_continuation_open(baum_i_continuation *path, baum_workspace *workspace);
void baum_i_continuation_close(baum_i_continuation *path);

/* Compute J at to->q and to->t. to->q need not satisfy the constraints. The configuration can then
 * be `from` of baum_i_continuation_solve(). */
baum_status baum_i_continuation_mark(baum_i_continuation *path, baum_i_configuration *to);

/* Find a configuration at the time to->t by Newton's method, starting from the guess to->q, and
 * then compute its v and a. J is compared with J of the configuration `from`, in order to refuse a
 * configuration that may be on another branch. Returns true if the configuration is accepted;
 * otherwise verdict->refusal is the reason. */
bool baum_i_continuation_solve(baum_i_continuation *path, const baum_i_configuration *from,
                               baum_i_configuration *to, baum_i_verdict *verdict);

/* Analyse why no further configuration was found near the accepted configuration `to`. */
baum_status baum_i_continuation_explain(baum_i_continuation *path, const baum_i_configuration *to,
                                        baum_i_impasse *impasse);

#endif
