/* SPDX-License-Identifier: BSD-3-Clause */
/* Dynamics from the inside: a workspace joins a mechanism's functions with a solver of the
 * saddle-point system.
 *
 * Stages, each named by what it depends on:
 *   position   (t, q):     frames, Phi, J, nu, M
 *   velocity   (t, q, v):  Phi' = J v - nu, gamma, g
 *   solution:              a, lambda of (5) or (7)
 * A later stage includes the earlier ones. Results stay in the workspace until the next evaluation.
 * Nothing here allocates but create functions, assembly and the search for redundancy.
 *
 * All functions return BAUM_OK, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, and what is said beside
 * them. After these two, workspace->point.retry tells whether a smaller step may help.
 */
#ifndef BAUM_I_DYNAMICS_DYNAMICS_H
#define BAUM_I_DYNAMICS_DYNAMICS_H

#include <baum/dynamics.h>

#include "base/message.h"
#include "dynamics/row_set.h"
#include "linear/kkt.h"
#include "mechanism/manifold.h"

/* Of least_multipliers.c. */
typedef struct baum_i_sharing {
  baum_i_kkt *kkt;  /* NULL while no row has been omitted */
  double *weight;   /* (mass_size) block values of W */
  double *mobility; /* (nc) square of the length of row i of J M^-1/2 */
  double *part;     /* (nc) of multipliers, in the null space of J^T */
  double *work;     /* (4 nc) */
  double *system;   /* (4 (nv + nc)) */
} baum_i_sharing;

typedef struct baum_i_block_path baum_i_block_path;

/* Whether accelerations go by blocks, or why not. */
typedef enum baum_i_blocks {
  BAUM_I_BLOCKS_SUIT,
  BAUM_I_BLOCKS_UNWANTED, /* another solver was asked for */
  BAUM_I_BLOCKS_CROWDED,  /* a body has very many joints */
  BAUM_I_BLOCKS_FILLED,   /* so has every part of a dense net */
  BAUM_I_BLOCKS_MASSLESS, /* M of a body is not positive definite */
  BAUM_I_BLOCKS_UNKNOWN   /* M or a force cannot be evaluated in the design configuration */
} baum_i_blocks;

typedef struct baum_i_block_verdict {
  baum_i_blocks blocks;
  int body; /* of which it is told, from 1; 0: none */
} baum_i_block_verdict;

struct baum_workspace {
  const baum_mechanism *mechanism;
  baum_i_point point;
  baum_i_kkt_structure structure;
  baum_i_kkt *kkt;
  baum_i_kkt_choice choice;
  baum_i_block_path *path;          /* NULL: every solution is kkt's */
  baum_i_block_path *motion;        /* for all but fixed bodies; the same where there are none */
  baum_i_block_verdict verdict;     /* of baum_i_use_blocks() */
  bool blocks_only;                 /* nothing is handed over */
  baum_i_block_path *solved_by;     /* of the last solution; NULL: kkt */
  baum_i_block_path *eliminated_by; /* whose pivots are of now, whoever has solved; NULL: none */
  baum_i_row_set rows;
  baum_i_sharing sharing;
  bool mass_ready;      /* a constant M has been evaluated */
  bool jacobian_ready;  /* the last evaluation has set all blocks of J */
  int32_t metric_ready; /* W has been chosen */

  double *mass;            /* block values */
  double *jacobian;        /* block values */
  double *phi;             /* (nc) */
  double *phi_rate;        /* (nc) */
  double *nu;              /* (nc) */
  double *gamma;           /* (nc) */
  double *force;           /* (nv) */
  double *rhs;             /* (nc) gamma - 2 alpha Phi' - beta^2 Phi */
  double *a;               /* (nv) last solution */
  double *lambda;          /* (nc) last solution */
  double *work_v;          /* (2 nv) */
  double *work_c;          /* (2 nc) */
  double *shift;           /* (nc) regularization of assembly */
  double *inputs;          /* (input_count) present values */
  const double *row_gains; /* (nc) factors on the gains of rows, of the run; NULL: 1 */
  double *metric;          /* (nv) diagonal of W, once metric_ready */

  double *work_q; /* (9 nq) for what has to do with rates of q */
  double *rate_q; /* (mass_size) of baum_i_linearize_rate() */
  double *mass_q; /* (mass_size) blocks of second derivatives, see baum_i_body_blocks */
  double *body_force_q;
  double *body_force_v;
  double *jw_q; /* (jacobian_size) */
  double *jv_q; /* likewise with v, where rows have gains of their own */
  double *gamma_q;
  double *gamma_v;
  double *nu_q;
  double *jtl_q;   /* (joint_square_size) */
  double *jtm_q;   /* (joint_square_size) likewise with mu */
  double *force_q; /* (force_square_size) */
  double *force_v;

  double
    *unprojected; /* (nq + nv) not owned: what the last projection began from; NULL: not kept */

  int64_t evaluations;   /* solutions and residuals */
  int64_t near_singular; /* solutions in which the matrix was close to singular */
};

baum_status baum_i_workspace_create(const baum_mechanism *mechanism, baum_i_kkt_choice choice,
                                    baum_workspace **out);

/* Once the redundancy is known: accelerations by blocks from now on, where these suit. Also
 * BAUM_ERR_MEMORY, and BAUM_ERR_UNSUPPORTED where they do not, but nothing else is allowed. */
baum_status baum_i_use_blocks(baum_workspace *workspace);

/* How accelerations are solved for, and why so; and why blocks are not used. Without a full
 * stop. */
enum { BAUM_I_SOLVER_TEXT_SIZE = 256 };
void baum_i_solver_text(const baum_workspace *workspace, char text[BAUM_I_SOLVER_TEXT_SIZE]);
void baum_i_blocks_reason(const baum_workspace *workspace, char text[BAUM_I_SOLVER_TEXT_SIZE]);

/* BAUM_ERR_STATE within a function of the user that the workspace is calling; `what` names
 * what it was used through. */
baum_status baum_i_check_idle(const baum_workspace *w, const char *call, const char *what);

/* A look at another state in the workspace of a motion: what it finds near singular is not counted,
 * and of its failures only the status that is returned in the end leaves a message. */
typedef struct baum_i_probe {
  baum_workspace *workspace;
  int64_t near_singular;
  baum_i_kept_message message;
} baum_i_probe;

void baum_i_probe_begin(baum_i_probe *probe, baum_workspace *workspace);
baum_status baum_i_probe_end(const baum_i_probe *probe, baum_status status);

/* Choose pivots again at the next factorizations, so that nothing depends on the ones before. */
void baum_i_workspace_forget(baum_workspace *workspace);

/* What solvers have done for accelerations, projection and assembly. */
baum_i_kkt_counters baum_i_workspace_work(const baum_workspace *workspace);

/* The omitted rows (nc) for solvers; NULL: none. */
static inline const unsigned char *baum_i_omitted_rows(const baum_workspace *workspace)
{
  return workspace->rows.count > 0 ? workspace->rows.omitted : NULL;
}

/* M, J and the omitted rows of the workspace, for its solver. */
static inline baum_i_kkt_values baum_i_kkt_values_of(const baum_workspace *w)
{
  return (baum_i_kkt_values){
    .mass = w->mass, .jacobian = w->jacobian, .omitted = baum_i_omitted_rows(w)};
}

/* ---- stages.c, acceleration.c ---- */

baum_status baum_i_position_stage(baum_workspace *workspace, double t, const double *q);
baum_status baum_i_velocity_stage(baum_workspace *workspace, double t, const double *q,
                                  const double *v);
/* M at the present point, but once only when it is constant. */
baum_status baum_i_evaluate_mass(baum_workspace *workspace);
/* Rows between fixed bodies, which a motion does not evaluate, as they are where these are in
 * place. */
void baum_i_clear_fixed_rows(baum_workspace *workspace);
/* Phi and Phi' only: cheaper than the velocity stage. */
baum_status baum_i_violation(baum_workspace *workspace, double t, const double *q, const double *v);

/* a and lambda of (7) into workspace->a, ->lambda; alpha = beta = 0 gives (5). alpha may be
 * negative (backward in time). J is there only after baum_i_need_jacobian(). Also BAUM_ERR_SINGULAR
 * (the message names a joint), BAUM_ERR_MEMORY. */
baum_status baum_i_acceleration(baum_workspace *workspace, double t, const double *q,
                                const double *v, double alpha, double beta);
/* Likewise a alone, 0 of fixed bodies, which are where baum_i_place_fixed_bodies() has them:
 * lambda, J and rows of these may not be there. */
baum_status baum_i_motion(baum_workspace *workspace, double t, const double *q, const double *v,
                          double alpha, double beta);
/* Blocks of J at the point of the last evaluation, where that did without. */
baum_status baum_i_need_jacobian(baum_workspace *workspace);
/* As reported: (5), multipliers of least norm where they are not unique; J is there. */
baum_status baum_i_reported_acceleration(baum_workspace *workspace, double t, const double *q,
                                         const double *v);

/* ---- pivot.c ---- */

/* Below this share of what it usually is the configuration is near a singular one: at a seventh of
 * the distance of ordinary ones. */
#define BAUM_I_NEAR_PIVOT 0.02

/* How far from singular the last solution was: 1 for no rows, 0 for singular, and falling with the
 * square of the distance. Its size depends on mechanism and solver: it is to be compared with
 * itself. *joint, unless NULL: the one that has it, -1: none. */
double baum_i_smallest_pivot(const baum_workspace *workspace, int *joint);
/* Whether that is told by the blocks that have been eliminated last. */
bool baum_i_blocks_tell(const baum_workspace *workspace);
/* acceleration.c: of a state that needs no solution. a, lambda and what was evaluated are not to be
 * read. Blocks stay with blocks, so that pivots go on without a jump where others solve. Statuses
 * of baum_i_motion(). */
baum_status baum_i_find_pivot(baum_workspace *workspace, double t, const double *q,
                              const double *v);

/* ---- energy.c, reaction.c ---- */

baum_status baum_i_energy(baum_workspace *workspace, double t, const double *q, const double *v,
                          double *kinetic, double *potential);
/* After a position stage. Number of values of a joint's reaction, and the values. */
int baum_i_reaction_width(const baum_mechanism *mechanism, int joint);
void baum_i_reaction(const baum_workspace *workspace, int joint, const double *lambda, double *out);

/* ---- metric.c: W of GGL, constant from its first choice on ---- */

/* From M in the workspace. */
void baum_i_choose_metric(baum_workspace *workspace);
/* From M in the design configuration, where W has not been chosen. */
baum_status baum_i_need_metric(baum_workspace *workspace);

/* ---- dae_residual.c, dae_matrix.c: F(t, y, y'), y = (q, v, lambda), for GGL (q, v, lambda, mu)
 * with W chosen before, and dF/dy + c dF/dy' with displacements of velocity size in place of dq
 * ---- */

/* Length of y. */
int baum_i_residual_size(const baum_mechanism *mechanism, baum_residual index);

baum_status baum_i_residual(baum_workspace *workspace, const baum_dae *dae, double t,
                            const double *y, const double *dy, double *residual);

/* v - W^-1 J^T mu at the last J, until workspace->work_v is used again. */
const double *baum_i_corrected_velocities(baum_workspace *workspace, const double *v,
                                          const double *mu);

/* Fixed sparsity of the Jacobian: compressed columns, sorted rows;
 * made once, filled without allocation. */
typedef struct baum_i_residual_matrix baum_i_residual_matrix;
baum_status baum_i_residual_matrix_create(const baum_workspace *workspace, baum_residual index,
                                          baum_i_residual_matrix **out);
void baum_i_residual_matrix_destroy(baum_i_residual_matrix *matrix);
int baum_i_residual_matrix_size(const baum_i_residual_matrix *matrix);
int baum_i_residual_matrix_nonzeros(const baum_i_residual_matrix *matrix);
const int32_t *baum_i_residual_matrix_columns(const baum_i_residual_matrix *matrix); /* (n + 1) */
const int32_t *baum_i_residual_matrix_rows(const baum_i_residual_matrix *matrix);
baum_status baum_i_residual_matrix_fill(const baum_i_residual_matrix *matrix,
                                        baum_workspace *workspace, const baum_dae *dae, double c,
                                        double t, const double *y, const double *dy,
                                        double *values);

/* dae_positions.c: with dq itself, made again. As baum_workspace_residual_jacobian(). */
baum_status baum_i_residual_jacobian(baum_workspace *workspace, const baum_dae *dae, double c,
                                     double t, const double *y, const double *dy, baum_sparse *out);

/* ---- finite.c ---- */

/* BAUM_ERR_NOT_FINITE, which names the joint or the body, where a number is not finite: of rows
 * (nc), of velocities (nv), of J. `what` is what the numbers are. */
baum_status baum_i_check_rows(const baum_workspace *w, const char *what, const double *values);
baum_status baum_i_check_velocities(const baum_workspace *w, const char *what,
                                    const double *values);
baum_status baum_i_check_positions(const baum_workspace *w, const char *what,
                                   const double *values); /* (nq) */
baum_status baum_i_check_jacobian(const baum_workspace *w);

/* Likewise where one of (nv) overflows in units of its scale, as baum_i_scaled_size() takes it. */
baum_status baum_i_check_sizes(const baum_workspace *w, const char *what, const double *values);

/* BAUM_ERR_NOT_FINITE: names whose number in J, force or rhs is not finite. */
baum_status baum_i_fail_not_finite(const baum_workspace *w);

/* ---- project.c, assemble.c ---- */

/* q, then v, changed in place to fulfil the constraints at t by the least change in the metric of
 * M. Also BAUM_ERR_CONVERGENCE, BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY; then q and v are undefined. */
baum_status baum_i_project(baum_workspace *workspace, double t, double *q, double *v);
/* v alone, of fixed bodies too. */
baum_status baum_i_project_velocities(baum_workspace *workspace, double t, const double *q,
                                      double *v);

/* The change of v that takes all of -Phi' away, into workspace->a. BAUM_ERR_SINGULAR,
 * BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE, BAUM_ERR_MEMORY. */
baum_status baum_i_change_of_velocities(baum_workspace *workspace, double t, const double *q,
                                        const double *v);

/* Whether rows that were left out as redundant are met by a state that has been projected: also
 * BAUM_ERR_INCONSISTENT. Runs watch them by themselves. speed: scaled size of the velocities
 * before. */
baum_status baum_i_check_left_out(baum_workspace *workspace, double t, const double *q,
                                  const double *v, double speed);

/* normal_part.c: the part P x of x (nv) that the constraints take away, into out (nv); P is that of
 * the last acceleration, motion or projection, which must have succeeded. BAUM_ERR_SINGULAR,
 * BAUM_ERR_MEMORY, BAUM_ERR_NOT_FINITE, without a message. */
baum_status baum_i_normal_part(baum_workspace *workspace, const double *x, double *out);
/* Likewise the smallest out, in the metric of M, with J out = rows (nc); rows may be
 * workspace->work_c. */
baum_status baum_i_least_with_rows(baum_workspace *workspace, const double *rows, double *out);

/* As baum_workspace_assemble(); v may be NULL; held (nv) flags or NULL. */
baum_status baum_i_assemble(baum_workspace *workspace, double t, double *q, double *v,
                            const bool *held);

/* ---- least_multipliers.c: where rows have been omitted, with M and J in the workspace ---- */

/* workspace->lambda becomes the one of least norm, in rows scaled by M, that holds the same forces.
 * BAUM_ERR_SINGULAR where it does not balance the forces; also BAUM_ERR_MEMORY. */
baum_status baum_i_make_multipliers_least(baum_workspace *workspace);

/* Names of the joints whose multipliers are not unique, into text. Likewise; then it is empty. */
baum_status baum_i_redundancy_text(baum_workspace *workspace, char *text, size_t size);

/* Which multipliers are unique (nc); all of them where no row has been omitted. Likewise. */
baum_status baum_i_find_unique_multipliers(baum_workspace *workspace, bool *unique);

/* ---- sizes of rows and states ---- */

/* Factor on alpha and beta of a row. */
static inline double baum_i_row_gain(const baum_workspace *workspace, int row)
{
  return workspace->row_gains ? workspace->row_gains[row] : 1.0;
}

/* (nc) norm of each row of J times the scales: |Phi_i| / size_i is a violation as a displacement;
 * 1 for empty rows. */
void baum_i_row_displacements(const baum_workspace *workspace, double *size);

/* (nc) diagonal of J M^-1 J^T with the diagonal of M: rows in their own units; 0 for empty rows. */
void baum_i_row_mobilities(const baum_workspace *workspace, double *mobility);

/* (nv) diagonal of M^-1/2, of coordinates without mass their scale, of fixed bodies 0. */
void baum_i_column_scales(const baum_workspace *workspace, double *scale);

/* Fastest angular rate of a state [1/s]: the largest of |v_i| / scale_i and sqrt(|a_i| /
 * scale_i). */
double baum_i_state_rate(const baum_mechanism *mechanism, const double *v, const double *a);

/* Largest |x_i| / scale_i of a vector over v. */
double baum_i_scaled_size(const baum_mechanism *mechanism, const double *x);
/* Likewise of positions (nq). */
double baum_i_position_size(const baum_mechanism *mechanism, const double *q);

/* Row of largest magnitude, or -1; largest may be NULL. */
int baum_i_largest(const double *values, int count, double *largest);

#endif
