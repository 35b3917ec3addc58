/* SPDX-License-Identifier: BSD-3-Clause */
/* Internal interface of the dynamics module. A workspace combines the functions of a mechanism with
 * a solver of the saddle-point system.
 *
 * Stages, with their arguments and results:
 *   position   (t, q):     frames, Phi, J, nu, M
 *   velocity   (t, q, v):  Phi' = J v - nu, gamma, g
 *   solution:              a, lambda of equation (5) or (7), see acceleration.c
 * A later stage includes the earlier ones. Results stay in the workspace until the next evaluation.
 * The stages allocate no memory. A solution allocates memory only if its solver is used for the
 * first time or chooses new pivots.
 *
 * All functions with a status may return BAUM_OK, BAUM_ERR_CALLBACK and BAUM_ERR_NOT_FINITE. The
 * comment of a function names the other statuses with which it may fail. After BAUM_ERR_CALLBACK or
 * BAUM_ERR_NOT_FINITE, workspace->point.retry tells whether a smaller step may help.
 */
#ifndef BAUM_I_DYNAMICS_DYNAMICS_H
#define BAUM_I_DYNAMICS_DYNAMICS_H

#include <baum/dynamics.h>

#include "base/message.h"
#include "dynamics/row_set.h"
#include "linear/compress.h"
#include "linear/kkt.h"
#include "mechanism/manifold.h"

/* Memory of least_multipliers.c. */
typedef struct baum_i_sharing {
  baum_i_kkt *kkt;  /* NULL while no row has been omitted */
  double *weight;   /* (mass_size) block values of W */
  double *mobility; /* (nc) result of baum_i_row_mobilities(), but 1 for empty rows */
  double *part;     /* (nc) multipliers in the null space of J^T */
  double *work;     /* (4 nc) */
  double *system;   /* (4 (nv + nc)) */
} baum_i_sharing;

typedef struct baum_i_block_path baum_i_block_path;

/* Tells whether the block solver computes accelerations, or why it does not. */
typedef enum baum_i_blocks {
  BAUM_I_BLOCKS_SUIT,
  BAUM_I_BLOCKS_UNWANTED, /* another solver was chosen */
  BAUM_I_BLOCKS_CROWDED,  /* a body has very many joints */
  BAUM_I_BLOCKS_FILLED,   /* the joints form a dense net */
  BAUM_I_BLOCKS_MASSLESS, /* M of a body is not positive definite */
  BAUM_I_BLOCKS_UNKNOWN   /* M or a force cannot be evaluated in the design configuration */
} baum_i_blocks;

typedef struct baum_i_block_verdict {
  baum_i_blocks blocks;
  int body; /* number (from 1) of the body that causes the verdict; 0: none */
} baum_i_block_verdict;

struct baum_workspace {
  const baum_mechanism *mechanism;
  baum_i_point point;
  baum_i_kkt_structure structure;
  baum_i_kkt *kkt;
  baum_i_kkt_choice choice;
  baum_i_block_path *path;      /* block solver for all bodies; NULL: kkt is used instead */
  baum_i_block_path *motion;    /* block solver without fixed bodies; `path` if none is fixed */
  baum_i_block_verdict verdict; /* result of baum_i_use_blocks() */
  bool blocks_only;             /* only the block solver is allowed */
  baum_i_block_path *solved_by; /* block path that gave the last solution; NULL: kkt */
  /* path of the last elimination by blocks, even if another solver then gave the solution; NULL:
   * none */
  baum_i_block_path *eliminated_by;
  baum_i_row_set rows;
  int *island; /* (body_count + 1) numbers of the islands, see islands.h */
  baum_i_sharing sharing;
  bool mass_ready;      /* a constant M has been evaluated */
  bool jacobian_ready;  /* the last evaluation has set all blocks of J */
  int32_t metric_ready; /* W of metric.c has been chosen */

  double *mass;     /* block values */
  double *jacobian; /* block values */
  double *phi;      /* (nc) */
  double *phi_rate; /* (nc) */
  double *nu;       /* (nc) */
  double *gamma;    /* (nc) */
  double *force;    /* (nv) */
  double *rhs;      /* (nc) right-hand side of the constraint rows */
  double *a;        /* (nv) last solution */
  double *lambda;   /* (nc) last solution */
  double *work_v;   /* (2 nv) */
  double *work_c;   /* (2 nc) */
  double *shift;    /* (nc) S of kkt.h */
  double *inputs;   /* (input_count) present values */
  /* (nc) factor by which the gains of each row are multiplied. It is the option row_gains of the
   * run (1 if the option is not set), times 1/2 for rows of velocity level. NULL: all factors are
   * 1. */
  const double *row_gains;
  double *metric; /* (nv) diagonal of W, once metric_ready */

  double *work_q; /* (9 nq) */
  double *rate_q; /* (mass_size) result of baum_i_linearize_rate() */
  double *mass_q; /* (mass_size) (M v')_q, see baum_i_body_blocks */
  double *body_force_q;
  double *body_force_v;
  double *jw_q; /* (jacobian_size) (J w)_q */
  double *jv_q; /* (J v)_q, if rows have different gains */
  double *gamma_q;
  double *gamma_v;
  double *nu_q;
  double *jtl_q;   /* (joint_square_size) */
  double *jtm_q;   /* (joint_square_size) (J^T mu)_q */
  double *force_q; /* (force_square_size) */
  double *force_v;

  /* (nq + nv) the caller's array that receives the state before each projection, or NULL */
  double *unprojected;

  int64_t evaluations;   /* number of computed solutions and residuals */
  int64_t near_singular; /* number of solutions whose matrix was close to singular */
};

baum_status baum_i_workspace_create(const baum_mechanism *mechanism, baum_i_kkt_choice choice,
                                    baum_workspace **out);

/* Use the block solver for accelerations from now on, if it suits the mechanism. Call this after
 * the redundant rows are known. May fail with BAUM_ERR_MEMORY, or with BAUM_ERR_UNSUPPORTED if the
 * block solver does not suit but no other solver is allowed. */
baum_status baum_i_use_blocks(baum_workspace *workspace);

/* The first function describes the solver and the reason for its choice. The second one states why
 * the block solver is not used. Both texts end without a full stop. */
baum_i_text baum_i_solver_text(const baum_workspace *workspace);
baum_i_text baum_i_blocks_reason(const baum_workspace *workspace);

/* Refuse calls made from inside a user function of this workspace (BAUM_ERR_STATE). `what` names
 * the object in the message. */
baum_status baum_i_check_idle(const baum_workspace *w, const char *call, const char *what);

/* A probe evaluates other states with the workspace of a run. Near-singular solutions between
 * baum_i_probe_begin() and baum_i_probe_end() are not counted. A message that is set between these
 * calls is kept only if `status` is an error. */
typedef struct baum_i_probe {
  baum_workspace *workspace;
  int64_t near_singular;
  baum_i_kept_message message;
} baum_i_probe;

void baum_i_probe_begin(baum_i_probe *probe, baum_workspace *workspace);
baum_status baum_i_probe_end(const baum_i_probe *probe, baum_status status);

/* Choose new pivots at the next factorizations, so that results do not depend on earlier
 * factorizations. */
void baum_i_workspace_forget(baum_workspace *workspace);

/* Return the sums of the counters of the solvers for accelerations, projection and assembly. */
baum_i_kkt_counters baum_i_workspace_work(const baum_workspace *workspace);

/* Return the flags of the omitted rows (nc) for solvers, or NULL if no row is omitted. */
static inline const unsigned char *baum_i_omitted_rows(const baum_workspace *workspace)
{
  return workspace->rows.count > 0 ? workspace->rows.omitted : NULL;
}

/* Return M, J and the omitted rows of the workspace for its solver. */
static inline baum_i_kkt_values baum_i_kkt_values_of(const baum_workspace *w)
{
  return (baum_i_kkt_values){
    .mass = w->mass, .jacobian = w->jacobian, .omitted = baum_i_omitted_rows(w)};
}

/* ---- stages.c, acceleration.c ---- */

baum_status baum_i_position_stage(baum_workspace *workspace, double t, const double *q);
baum_status baum_i_velocity_stage(baum_workspace *workspace, double t, const double *q,
                                  const double *v);
/* Evaluate M at the present point. A constant M is evaluated only once. */
baum_status baum_i_evaluate_mass(baum_workspace *workspace);
/* Set Phi and Phi' of rows between fixed bodies to zero; baum_i_motion() does not evaluate these
 * rows. */
void baum_i_clear_fixed_rows(baum_workspace *workspace);
/* Evaluate only Phi, J, nu and Phi', which is cheaper than the velocity stage. */
baum_status baum_i_violation(baum_workspace *workspace, double t, const double *q, const double *v);

/* Set workspace->a and ->lambda to the solution of equation (7) in acceleration.c, which becomes
 * equation (5) if alpha = beta = 0. alpha is negative for motion backward in time. J may remain
 * unset; baum_i_need_jacobian() sets it afterwards. May fail with BAUM_ERR_SINGULAR (the message
 * names a joint) or BAUM_ERR_MEMORY. */
baum_status baum_i_acceleration(baum_workspace *workspace, double t, const double *q,
                                const double *v, double alpha, double beta);
/* Do the same as baum_i_acceleration(), but exclude fixed bodies. They must have the poses that
 * baum_i_place_fixed_bodies() gives them, and their a is 0. For rows between fixed bodies, lambda,
 * J, Phi and Phi' are not always set. */
baum_status baum_i_motion(baum_workspace *workspace, double t, const double *q, const double *v,
                          double alpha, double beta);
/* Evaluate the blocks of J at the last point, if the last evaluation skipped them. */
baum_status baum_i_need_jacobian(baum_workspace *workspace);
/* Find the solution of equation (5) that users receive. Its multipliers have the least norm if they
 * are not unique. Sets J. */
baum_status baum_i_reported_acceleration(baum_workspace *workspace, double t, const double *q,
                                         const double *v);

/* ---- pivot.c ---- */

/* A configuration is nearly singular if its smallest pivot is below this fraction of the usual
 * pivot. Its distance from a singular configuration is then below a seventh of the usual
 * distance. */
#define BAUM_I_NEAR_PIVOT 0.02

/* Return the smallest pivot of the last solution, which measures the distance from a singular
 * configuration: 1 if the mechanism has no rows, 0 if the configuration is singular. The pivot
 * falls with the square of the distance. Its size depends on mechanism and solver, so it must be
 * compared with the usual pivot of the same mechanism and solver. *joint receives the joint of the
 * smallest pivot, or -1; `joint` may be NULL. */
double baum_i_smallest_pivot(const baum_workspace *workspace, int *joint);
/* Tell whether baum_i_smallest_pivot() uses the last elimination by blocks. */
bool baum_i_blocks_tell(const baum_workspace *workspace);
/* acceleration.c: find the pivot at a state, if possible without computing a solution. a, lambda
 * and evaluated terms are undefined afterwards. If baum_i_blocks_tell() then returns true, the
 * pivot is that of the block solver, even if another solver gave the solution. Returns the statuses
 * of baum_i_motion(). */
baum_status baum_i_find_pivot(baum_workspace *workspace, double t, const double *q,
                              const double *v);

/* ---- energy.c, reaction.c ---- */

baum_status baum_i_energy(baum_workspace *workspace, double t, const double *q, const double *v,
                          double *kinetic, double *potential);
/* The first function returns the number of values of a joint's reaction. The second function
 * computes these values. Call it after a position stage. */
int baum_i_reaction_width(const baum_mechanism *mechanism, int joint);
void baum_i_reaction(const baum_workspace *workspace, int joint, const double *lambda, double *out);

/* ---- metric.c: W of the form GGL, constant once chosen ---- */

/* Choose W from the present M of the workspace. */
void baum_i_choose_metric(baum_workspace *workspace);
/* Choose W from M of the design configuration, unless W has been chosen. */
baum_status baum_i_need_metric(baum_workspace *workspace);

/* ---- dae_residual.c, dae_matrix.c: the residual F(t, y, y') and its Jacobian dF/dy + c dF/dy'. y
 * is (q, v, lambda), and for GGL (q, v, lambda, mu). For GGL, W must have been chosen (metric.c).
 * The variables of the Jacobian are displacements of length nv in place of q. ---- */

/* Return the length of y. */
int baum_i_residual_size(const baum_mechanism *mechanism, baum_residual index);

baum_status baum_i_residual(baum_workspace *workspace, const baum_dae *dae, double t,
                            const double *y, const double *dy, double *residual);

/* Return v - W^-1 J^T mu with J of the last evaluation. The result is valid until workspace->work_v
 * is used again. */
const double *baum_i_corrected_velocities(baum_workspace *workspace, const double *v,
                                          const double *mu);

/* The Jacobian with a fixed pattern, in compressed columns with sorted rows. Filling it allocates
 * nothing. */
typedef struct baum_i_residual_matrix baum_i_residual_matrix;
baum_status baum_i_residual_matrix_create(const baum_workspace *workspace, baum_residual index,
                                          baum_i_residual_matrix **out);
void baum_i_residual_matrix_destroy(baum_i_residual_matrix *matrix);
const baum_i_compressed *baum_i_residual_matrix_pattern(const baum_i_residual_matrix *matrix);
baum_status baum_i_residual_matrix_fill(const baum_i_residual_matrix *matrix,
                                        baum_workspace *workspace, const baum_dae *dae, double c,
                                        double t, const double *y, const double *dy,
                                        double *values);

/* dae_positions.c: the Jacobian with respect to q itself. See
 * baum_workspace_residual_jacobian(). */
baum_status baum_i_residual_jacobian(baum_workspace *workspace, const baum_dae *dae, double c,
                                     double t, const double *y, const double *dy, baum_sparse *out);

/* ---- finite.c ---- */

/* Fail with BAUM_ERR_NOT_FINITE if a number in an array is not finite. The array has a number for
 * each row (nc), velocity (nv) or position (nq); the last function checks J. The message names the
 * joint or body, and calls the numbers `what`. */
baum_status baum_i_check_rows(const baum_workspace *w, const char *what, const double *values);
baum_status baum_i_check_velocities(const baum_workspace *w, const char *what,
                                    const double *values);
baum_status baum_i_check_positions(const baum_workspace *w, const char *what,
                                   const double *values); /* (nq) */
baum_status baum_i_check_jacobian(const baum_workspace *w);

/* Fail with BAUM_ERR_NOT_FINITE if a value (nv), divided by the scale of its coordinate,
 * overflows. */
baum_status baum_i_check_sizes(const baum_workspace *w, const char *what, const double *values);

/* Fail with BAUM_ERR_NOT_FINITE. The message names the joint or body of the first number in J,
 * force or rhs that is not finite. */
baum_status baum_i_fail_not_finite(const baum_workspace *w);

/* ---- project.c, assemble.c ---- */

/* Change q, and then v, by the least change in the metric of M, so that they fulfil the constraints
 * at t. Rows of velocity level restrict the directions in which q moves. May fail with
 * BAUM_ERR_CONVERGENCE, BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. After a failure, q and v are
 * undefined. */
baum_status baum_i_project(baum_workspace *workspace, double t, double *q, double *v);
/* Project only v. The velocities of fixed bodies become 0. */
baum_status baum_i_project_velocities(baum_workspace *workspace, double t, const double *q,
                                      double *v);

/* Set workspace->a to the change of v that removes Phi'. May fail with BAUM_ERR_SINGULAR or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_change_of_velocities(baum_workspace *workspace, double t, const double *q,
                                        const double *v);

/* Check that a projected state fulfils the omitted rows, and fail with BAUM_ERR_INCONSISTENT if it
 * does not. baum_i_project() does not check them; during a run, simulate/monitor.c observes them.
 * `before` contains the velocities before the projection. */
baum_status baum_i_check_projection(baum_workspace *workspace, double t, const double *q,
                                    const double *v, const double *before);

/* normal_part.c: set out (nv) to P x, the part of x (nv) that the constraints remove. P belongs to
 * the configuration of the last acceleration, motion or projection, which must have succeeded. May
 * return BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY or BAUM_ERR_NOT_FINITE, without a message. */
baum_status baum_i_normal_part(baum_workspace *workspace, const double *x, double *out);
/* Set out to the part of a displacement x that the projection of positions removes. It equals P x
 * unless there are rows of velocity level. */
baum_status baum_i_displaced_part(baum_workspace *workspace, const double *x, double *out);
/* Set out (nv) to the smallest vector, in the metric of M, with J out = rows (nc). rows may be
 * workspace->work_c. May fail with the same statuses as baum_i_normal_part(), without a message. */
baum_status baum_i_least_with_rows(baum_workspace *workspace, const double *rows, double *out);

/* Do the same as baum_workspace_assemble(). v may be NULL. held (nv) marks the coordinates that do
 * not move, or is NULL. */
baum_status baum_i_assemble(baum_workspace *workspace, double t, double *q, double *v,
                            const bool *held);
/* Assemble positions so that Phi has the values `left` (nc) instead of 0. */
baum_status baum_i_assemble_in_part(baum_workspace *workspace, double t, double *q,
                                    const bool *held, const double *left);
/* Assemble positions. After BAUM_ERR_INCONSISTENT, q is the configuration at which assembly gave
 * up. */
baum_status baum_i_assemble_closest(baum_workspace *workspace, double t, double *q,
                                    const bool *held);

/* Fail with BAUM_ERR_INCONSISTENT if the axes of a joint point in opposite directions instead of
 * the same direction in the configuration of workspace->point. The constraint equations cannot
 * distinguish the two cases. `action` is the subject of the message. */
baum_status baum_i_check_sides(const baum_workspace *workspace, double t, const char *action);

/* ---- least_multipliers.c: M and J must be in the workspace ---- */

/* Replace workspace->lambda by multipliers that give the same forces and have the least norm. In
 * this norm, the weight of multiplier i is the length of row i of J D^-1/2, where D is the diagonal
 * of M. May fail with BAUM_ERR_SINGULAR, if the multipliers of the last solution do not balance the
 * forces, or with BAUM_ERR_MEMORY. */
baum_status baum_i_make_multipliers_least(baum_workspace *workspace);

/* Write the names of joints whose multipliers are not unique. May fail with BAUM_ERR_SINGULAR or
 * BAUM_ERR_MEMORY; the text is then empty. */
baum_status baum_i_redundancy_text(baum_workspace *workspace, char *text, size_t size);

/* Set unique[i] (nc) to whether multiplier i is unique. All multipliers are unique if no row is
 * omitted. May fail with BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. */
baum_status baum_i_find_unique_multipliers(baum_workspace *workspace, bool *unique);

/* ---- sizes of rows and states ---- */

/* Return the factor by which alpha and beta of a row are multiplied. */
static inline double baum_i_row_gain(const baum_workspace *workspace, int row)
{
  return workspace->row_gains ? workspace->row_gains[row] : 1.0;
}

/* Set size[i] (nc) to the norm of row i of J after each column has been multiplied by the scale of
 * its coordinate, or to 1 if the row is empty. |Phi_i| / size[i] is the violation as a
 * displacement. */
void baum_i_row_displacements(const baum_workspace *workspace, double *size);

/* Set inverse (nv) to 1 / M_ii, or to 0 for coordinates without mass. Very small moments of inertia
 * are first raised (row_sizes.c). */
void baum_i_inverse_masses(const baum_workspace *workspace, double *inverse);

/* Set mobility (nc) to the diagonal of J D^-1 J^T, where D is the diagonal of M; 0 for empty
 * rows. */
void baum_i_row_mobilities(const baum_workspace *workspace, double *mobility);

/* Set scale (nv) to 1 / sqrt(M_ii), to the scale of the coordinate if it has no mass, and to 0 for
 * fixed bodies. */
void baum_i_column_scales(const baum_workspace *workspace, double *scale);

/* Return the fastest rate of a state [1/s]: the largest of |v_i| / scale_i and sqrt(|a_i| /
 * scale_i). */
double baum_i_state_rate(const baum_mechanism *mechanism, const double *v, const double *a);

/* Return the angular frequency [1/s] of a pendulum that is as long as the characteristic length; 0
 * without gravity. */
double baum_i_swing_rate(const baum_mechanism *mechanism);

/* Return the largest |x_i| / scale_i of a vector x (nv). */
double baum_i_scaled_size(const baum_mechanism *mechanism, const double *x);
/* Return the largest |q_i| / position_scale_i of positions q (nq). */
double baum_i_position_size(const baum_mechanism *mechanism, const double *q);

/* Return the index of the value of largest magnitude, or -1 if there are no values. `largest`
 * receives the magnitude and may be NULL. */
int baum_i_largest(const double *values, int count, double *largest);

#endif
