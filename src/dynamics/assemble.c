/* SPDX-License-Identifier: BSD-3-Clause */
/* Performs assembly: finds a configuration and velocities that fulfil the constraints, with the
 * least change in the metric of M.
 *
 *   [ M  J^T ] [ dq     ]   [  0   ]         S_ii = MU (J D^-1 J^T)_ii
 *   [ J  -S  ] [ lambda ] = [ -Phi ]
 *
 * The columns of held coordinates in J, and their coupling in M, are cleared, so these coordinates
 * do not move. D is the diagonal of M. The small S (Levenberg, Marquardt) permits redundant rows.
 * If rows contradict each other, the system with S is a least-squares problem. The remaining
 * violation is in the conflicting rows only, and therefore identifies them. Steps are limited, and
 * halved until the violation decreases. Rows of velocity level take part only in the assembly of
 * velocities. Violations are compared as displacements |Phi_i| / d_i, where d_i is the norm of row
 * i of J after each column has been multiplied by the scale of its coordinate.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/text.h"
#include "dynamics/dynamics.h"

enum { ITERATIONS = 200, HALVINGS = 12, CORRECTIONS = 8 };
/* Relative size of S. A step leaves at least about this fraction of the violation. */
static const double MU = 1e-10;
/* largest change of a coordinate in one step, relative to its scale */
static const double STEP_LIMIT = 0.25;
static const double CONVERGED = 1e-11; /* a step of this size leaves an error of about 1e-22 */
static const double ROUNDING = 1e-13;  /* a violation up to this displacement counts as zero */
static const double CONSISTENT = 1e-9; /* violation above which rows contradict each other */
/* A violation below this displacement suggests that the dimensions of redundant constraints are
 * rounded. */
static const double SLIGHT = 1e-4;
/* Corrections of velocities end when they have reduced the violation to this fraction of its first
 * value. The remaining violation is then far below rounding errors. */
static const double CORRECTED = 1e-20;
/* Violations of velocities below NO_RATE + NO_SWING * baum_i_swing_rate() are rounding errors.
 * NO_RATE is in 1/s. */
static const double NO_RATE = 1e-14;
static const double NO_SWING = 1e-12;

/* Memory of one assembly. */
typedef struct assembly {
  baum_workspace *w;
  const bool *held;   /* (nv) true for coordinates that do not move; NULL: all may move */
  const double *left; /* (nc) values of Phi after assembly; NULL: all are 0 */
  double t;
  double *q;        /* (nq) present configuration */
  double *trial;    /* (nq) */
  double *distance; /* (nc) d_i */
  bool fits;        /* the last violation found at q was only rounding */
  int open;         /* row with the largest violation before assembly; -1: none */
} assembly;

static bool is_held(const bool *held, int i)
{
  return held && held[i];
}

/* ---- the matrix ---- */

/* Clear the columns of held coordinates in a row. If the remaining entries are only rounding
 * errors, clear them, too. This occurs in the row of a driver if the rotation of the driven body
 * about the axis is held. */
static void clear_held_entries(const baum_workspace *w, const bool *held,
                               const baum_i_row_block *block, double *row)
{
  double all = 0.0;
  double kept = 0.0;
  for (int j = 0; j < block->cols; j++) {
    double size = row[j] * w->mechanism->scale[block->col[j]];
    all += size * size;
    if (is_held(held, block->col[j])) {
      row[j] = 0.0;
    } else {
      kept += size * size;
    }
  }
  if (kept <= ROUNDING * ROUNDING * all) {
    memset(row, 0, (size_t)block->cols * sizeof *row);
  }
}

static void clear_held_columns(baum_workspace *w, const bool *held)
{
  for (int k = 0; k < w->structure.row_block_count; k++) {
    const baum_i_row_block *block = &w->structure.row_blocks[k];
    for (int i = 0; i < block->rows; i++) {
      clear_held_entries(w, held, block, w->jacobian + block->value + i * block->cols);
    }
  }
}

/* Clear the rows of velocity level in J, because they do not restrict positions. */
static void clear_velocity_rows(const baum_workspace *w)
{
  const baum_mechanism *m = w->mechanism;
  for (int k = 0; k < m->joint_count && m->velocity_rows; k++) {
    const baum_i_joint *joint = m->joints[k];
    size_t count = (size_t)joint->velocity_rows * (size_t)joint->span.nl;
    size_t all = (size_t)joint->rows * (size_t)joint->span.nl;
    memset(w->jacobian + joint->jacobian + (all - count), 0, count * sizeof *w->jacobian);
  }
}

static void decouple_held_masses(baum_workspace *w, const bool *held)
{
  for (int k = 0; k < w->structure.mass_block_count; k++) {
    const baum_i_mass_block *block = &w->structure.mass_blocks[k];
    for (int i = 0; i < block->size; i++) {
      for (int j = 0; j < block->size; j++) {
        bool coupled = is_held(held, block->first + i) || is_held(held, block->first + j);
        if (i != j && coupled) {
          w->mass[block->value + i * block->size + j] = 0.0;
        }
      }
    }
  }
}

/* Compute S from the present J and M. */
static void find_shift(baum_workspace *w)
{
  baum_i_row_mobilities(w, w->shift);
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->shift[i] = w->shift[i] > 0.0 ? MU * w->shift[i] : 1.0;
  }
}

static baum_status translate(const assembly *s, baum_status status)
{
  if (status == BAUM_ERR_SINGULAR) {
    return baum_i_fail(status, "t = %.9g s: assembly: the equations are singular", s->t);
  }
  if (status == BAUM_ERR_NOT_FINITE) {
    return baum_i_fail_not_finite(s->w);
  }
  return status;
}

/* Factor the matrix of the present J and M. J and M must not change while the factors are used. */
static baum_status factor(const assembly *s)
{
  baum_workspace *w = s->w;
  const baum_i_kkt_values values = {.mass = w->mass, .jacobian = w->jacobian, .shift = w->shift};
  w->mass_ready = false; /* the next line may change M */
  decouple_held_masses(w, s->held);
  find_shift(w);
  return translate(s, baum_i_kkt_factor(w->kkt, &values));
}

/* Set w->a to the least change a of the coordinates with J a = rhs. */
static baum_status least_change(const assembly *s)
{
  baum_workspace *w = s->w;
  memset(w->force, 0, (size_t)w->mechanism->nv * sizeof *w->force);
  return translate(s, baum_i_kkt_solve(w->kkt, w->force, w->rhs, w->a, w->lambda));
}

/* ---- naming contradicting joints ---- */

static double displacement(const assembly *s, const double *rows, int i)
{
  return fabs(rows[i]) / s->distance[i];
}

static double worst_displacement(const assembly *s, const double *rows)
{
  double worst = 0.0;
  for (int i = 0; i < s->w->mechanism->nc; i++) {
    double size = displacement(s, rows, i);
    worst = size > worst || isnan(size) ? size : worst;
  }
  return worst;
}

/* Store the row that is violated most before assembly. If rows contradict each other, this row
 * often belongs to the joint that is defined wrongly. The violations after assembly do not show
 * which joint this is, because assembly distributes them among all contradicting rows. */
static void keep_open_row(assembly *s)
{
  double worst = ROUNDING;
  for (int i = 0; i < s->w->mechanism->nc; i++) {
    double size = displacement(s, s->w->phi, i);
    s->open = size > worst ? i : s->open;
    worst = fmax(worst, size);
  }
}

/* Write the names of the joints whose violation is at least a tenth of the largest violation. */
static void name_contradicting(const assembly *s, const double *rows, const char *unit,
                               char text[BAUM_I_MESSAGE_SIZE])
{
  enum { ROOM = BAUM_I_MESSAGE_SIZE - 512 }; /* leaves room for the rest of the message */
  const baum_mechanism *m = s->w->mechanism;
  double worst = worst_displacement(s, rows);
  size_t used = 0;
  int last = -1;
  text[0] = '\0';
  for (int i = 0; i < m->nc && used < ROOM; i++) {
    int joint = baum_i_row_joint(m, i);
    if (joint == last || displacement(s, rows, i) < 0.1 * worst) {
      continue;
    }
    used += (size_t)baum_i_print(text + used, BAUM_I_MESSAGE_SIZE - used,
                                 "%s%s (remaining violation %.3g%s)", used ? ", " : "",
                                 baum_i_joint_label(m, joint).text, rows[i], unit);
    last = joint;
  }
}

static baum_status fail_positions(const assembly *s)
{
  char text[BAUM_I_MESSAGE_SIZE];
  name_contradicting(s, s->w->phi, " m or rad", text);
  const baum_mechanism *m = s->w->mechanism;
  if (worst_displacement(s, s->w->phi) < SLIGHT) {
    return baum_i_fail(BAUM_ERR_INCONSISTENT,
                       "t = %.9g s: assembly does not satisfy %s; these violations are small, as "
                       "if dimensions of redundant constraints were rounded; give the dimensions "
                       "with all digits, or remove redundant constraints",
                       s->t, text);
  }
  return baum_i_fail(BAUM_ERR_INCONSISTENT,
                     "t = %.9g s: assembly does not satisfy %s; either constraints and held bodies "
                     "contradict each other, or the design configuration is too far from an "
                     "assembled one%s; before assembly, %s is violated most, see "
                     "baum_mechanism_svg()",
                     s->t, text, baum_i_degrees(m).text, baum_i_row_label(m, s->open).text);
}

static baum_status fail_velocities(const assembly *s)
{
  char text[BAUM_I_MESSAGE_SIZE];
  name_contradicting(s, s->w->phi_rate, " per s", text);
  bool is_given = false;
  for (int i = 0; i < s->w->mechanism->nv; i++) {
    is_given = is_given || s->held[i];
  }
  return baum_i_fail(
    BAUM_ERR_INCONSISTENT,
    is_given ? "t = %.9g s: the given velocities do not satisfy %s; leave those free that "
               "follow from the others"
             : "t = %.9g s: no velocities satisfy %s; a driver, or another function "
               "of time, contradicts one of these joints",
    s->t, text);
}

/* ---- positions ---- */

/* Subtract the intended values of Phi (s->left) from w->phi, which then contains only violations
 * that must vanish. */
static void subtract_left(const assembly *s)
{
  for (int i = 0; s->left && i < s->w->mechanism->nc; i++) {
    s->w->phi[i] -= s->left[i];
  }
}

static double merit(const assembly *s, const double *phi)
{
  double sum = 0.0;
  for (int i = 0; i < s->w->mechanism->nc; i++) {
    double size = displacement(s, phi, i);
    sum += size * size;
  }
  return sum;
}

/* Shorten the step in w->a if it exceeds STEP_LIMIT. Returns the scaled size of the original
 * step. */
static double limit_step(const assembly *s)
{
  const baum_mechanism *m = s->w->mechanism;
  double size = baum_i_scaled_size(m, s->w->a);
  for (int i = 0; i < m->nv && size > STEP_LIMIT; i++) {
    s->w->a[i] *= STEP_LIMIT / size;
  }
  return size;
}

/* Move the configuration by the step in w->a. Halve the step until the violation decreases. *fell
 * tells whether it has decreased. */
static baum_status search_along_step(assembly *s, double before, bool *fell)
{
  baum_workspace *w = s->w;
  double fraction = 1.0;
  *fell = false;
  for (int k = 0; k < HALVINGS && !*fell; k++) {
    baum_i_move_from(w->mechanism, s->q, fraction, w->a, s->trial);
    baum_i_point_set(&w->point, s->t, s->trial, NULL);
    baum_status status = baum_i_mechanism_phi(&w->point, w->phi);
    if (status != BAUM_OK && !w->point.retry) {
      return status;
    }
    subtract_left(s);
    *fell = status == BAUM_OK && merit(s, w->phi) < before;
    fraction *= 0.5;
  }
  if (*fell) {
    memcpy(s->q, s->trial, (size_t)w->mechanism->nq * sizeof *s->q);
  }
  return BAUM_OK;
}

static baum_status newton_step(assembly *s, double *size, bool *fell, bool first)
{
  baum_workspace *w = s->w;
  BAUM_I_TRY(baum_i_position_stage(w, s->t, s->q));
  subtract_left(s);
  clear_held_columns(w, s->held);
  clear_velocity_rows(w);
  baum_i_row_displacements(w, s->distance);
  s->fits = worst_displacement(s, w->phi) <= ROUNDING;
  if (first) {
    keep_open_row(s);
  }
  if (s->fits) {
    return BAUM_OK;
  }
  double before = merit(s, w->phi);
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->rhs[i] = -w->phi[i];
  }
  BAUM_I_TRY(factor(s));
  BAUM_I_TRY(least_change(s));
  *size = limit_step(s);
  return search_along_step(s, before, fell);
}

static baum_status assemble_positions(assembly *s)
{
  double size = (double)INFINITY;
  bool fell = true;
  for (int k = 0; k < ITERATIONS && fell && size > CONVERGED; k++) {
    BAUM_I_TRY(newton_step(s, &size, &fell, k == 0));
    if (s->fits) {
      return BAUM_OK;
    }
  }
  BAUM_I_TRY(baum_i_position_stage(s->w, s->t, s->q));
  subtract_left(s);
  return worst_displacement(s, s->w->phi) <= CONSISTENT ? BAUM_OK : fail_positions(s);
}

baum_status baum_i_check_sides(const baum_workspace *w, double t, const char *action)
{
  const baum_mechanism *m = w->mechanism;
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    if (joint->type->is_reversed && joint->type->is_reversed(joint, &w->point)) {
      return baum_i_fail(BAUM_ERR_INCONSISTENT,
                         "t = %.9g s: %s makes the axes of %s point in opposite directions; give a "
                         "configuration in which they point in the same direction",
                         t, action, baum_i_joint_label(m, k).text);
    }
  }
  return BAUM_OK;
}

/* ---- velocities ---- */

/* Set the right-hand side to -Phi' at v, and *worst to the largest Phi', as a displacement per unit
 * of time. */
static baum_status find_rate(const assembly *s, const double *v, double *worst)
{
  baum_workspace *w = s->w;
  BAUM_I_TRY(baum_i_violation(w, s->t, s->q, v));
  clear_held_columns(w, s->held);
  baum_i_row_displacements(w, s->distance);
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->rhs[i] = -w->phi_rate[i];
  }
  *worst = worst_displacement(s, w->phi_rate);
  return BAUM_OK;
}

static baum_status correct_velocities(const assembly *s, double *v)
{
  BAUM_I_TRY(least_change(s));
  for (int i = 0; i < s->w->mechanism->nv; i++) {
    v[i] += is_held(s->held, i) ? 0.0 : s->w->a[i];
  }
  return BAUM_OK;
}

/* Tell whether some velocities are free. */
static bool has_free_velocity(const assembly *s)
{
  bool all_held = true;
  for (int i = 0; i < s->w->mechanism->nv; i++) {
    all_held = all_held && is_held(s->held, i);
  }
  return !all_held;
}

/* Complete the velocities: given velocities are held, free ones start at zero. The matrix is
 * evaluated once, at the assembled configuration. */
static baum_status assemble_velocities(const assembly *s, double *v)
{
  double last = (double)INFINITY;
  double worst = 0.0;
  BAUM_I_TRY(find_rate(s, v, &worst));
  if (!(worst > 0.0) || !has_free_velocity(s)) {
    return BAUM_OK;
  }
  double corrected = CORRECTED * worst;
  BAUM_I_TRY(baum_i_evaluate_mass(s->w));
  BAUM_I_TRY(factor(s));
  for (int k = 0; k < CORRECTIONS && worst > corrected && worst < 0.5 * last; k++) {
    last = worst;
    BAUM_I_TRY(correct_velocities(s, v));
    BAUM_I_TRY(find_rate(s, v, &worst));
  }
  return BAUM_OK;
}

/* Replace the NaN entries of v (nv), which stand for free velocities, by velocities that fulfil the
 * constraints. */
static baum_status complete_velocities(assembly *s, double *v, bool *given)
{
  baum_workspace *w = s->w;
  const baum_mechanism *m = w->mechanism;
  for (int i = 0; i < m->nv; i++) {
    given[i] = !isnan(v[i]);
    v[i] = given[i] ? v[i] : 0.0;
  }
  s->held = given;
  BAUM_I_TRY(assemble_velocities(s, v));
  BAUM_I_TRY(baum_i_violation(w, s->t, s->q, v));
  BAUM_I_TRY(baum_i_check_sizes(w, "velocity", v));
  BAUM_I_TRY(baum_i_check_rows(w, "velocity violation", w->phi_rate));
  baum_i_row_displacements(w, s->distance);
  double size = fmax(baum_i_scaled_size(m, v), worst_displacement(s, w->nu));
  double rounding = NO_RATE + NO_SWING * baum_i_swing_rate(m);
  if (!(worst_displacement(s, w->phi_rate) <= CONSISTENT * size + rounding)) {
    return fail_velocities(s);
  }
  return BAUM_OK;
}

/* ---- assembly ---- */

/* Assemble q and, unless v is NULL, v. If `closest` is true, q is set even if the rows contradict
 * each other. */
static baum_status assemble(baum_workspace *workspace, double t, double *q, double *v,
                            const bool *held, const double *left, bool closest)
{
  size_t nq = (size_t)workspace->mechanism->nq;
  size_t nv = (size_t)workspace->mechanism->nv;
  size_t nc = (size_t)workspace->mechanism->nc;
  double *memory = baum_i_alloc(2 * nq + nv + nc, sizeof *memory);
  bool *given = baum_i_alloc(nv, sizeof *given);
  if (!memory || !given) {
    baum_i_free(memory);
    baum_i_free(given);
    return baum_i_fail_memory();
  }
  assembly s = {.w = workspace, .held = held, .left = left, .t = t, .q = memory, .open = -1};
  s.trial = memory + nq;
  s.distance = memory + 2 * nq + nv;
  double *velocity = memory + 2 * nq;
  memcpy(s.q, q, nq * sizeof *q);
  baum_i_normalize(workspace->mechanism, s.q);
  baum_status status = assemble_positions(&s);
  if (status == BAUM_OK) {
    status = baum_i_check_sides(workspace, t, "assembly");
  }
  if (status == BAUM_OK && v) {
    memcpy(velocity, v, nv * sizeof *v);
    status = complete_velocities(&s, velocity, given);
  }
  if (status == BAUM_OK || (closest && status == BAUM_ERR_INCONSISTENT)) {
    memcpy(q, s.q, nq * sizeof *q);
  }
  if (status == BAUM_OK && v) {
    memcpy(v, velocity, nv * sizeof *v);
  }
  workspace->mass_ready = false;
  baum_i_free(memory);
  baum_i_free(given);
  return status;
}

baum_status baum_i_assemble(baum_workspace *workspace, double t, double *q, double *v,
                            const bool *held)
{
  return assemble(workspace, t, q, v, held, NULL, false);
}

baum_status baum_i_assemble_in_part(baum_workspace *workspace, double t, double *q,
                                    const bool *held, const double *left)
{
  return assemble(workspace, t, q, NULL, held, left, false);
}

baum_status baum_i_assemble_closest(baum_workspace *workspace, double t, double *q,
                                    const bool *held)
{
  return assemble(workspace, t, q, NULL, held, NULL, true);
}
