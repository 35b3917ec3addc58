/* SPDX-License-Identifier: BSD-3-Clause */
/* Starts a run, or continues it from a given state. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "mechanism/definition.h"
#include "mechanism/general/driven.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"

/* Largest displacement that assembly may cause. LARGEST_MOVE is for lengths and relative to the
 * characteristic length. LARGEST_TURN is for angles, in radians. If the displacement is larger,
 * assembly has probably found another branch than the user intended. */
static const double LARGEST_MOVE = 0.25;
static const double LARGEST_TURN = 1.0;
/* Largest number of steps in which assembly moves the drivers to their initial values. */
enum { DRIVER_STEPS = 256 };
static const double EXACT = 1e-9; /* largest violation of an exact start, relative to the scales */

/* ---- assembled ---- */

/* Return the index of the first angle among the velocities of a body. */
static int first_angle(const baum_i_body *body)
{
  baum_i_frame_kind frame = body->type->frame;
  return body->v + (frame == BAUM_I_FRAME_BODY           ? 2
                    : frame == BAUM_I_FRAME_SPATIAL_BODY ? 3
                                                         : body->nv);
}

/* Coordinate i of a body is the first one of a displacement vector or of a rotation vector. Return
 * the index after the last coordinate of this vector. */
static int vector_end(const baum_i_body *body, int i)
{
  if (body->type->frame == BAUM_I_FRAME_NONE) {
    return i + 1;
  }
  return i < first_angle(body) ? first_angle(body) : body->v + body->nv;
}

/* Return the unit of a coordinate. For user coordinates, whose unit only the user knows, return an
 * empty text. */
static const char *unit_of(const baum_i_body *body, int coordinate)
{
  if (body->type->frame == BAUM_I_FRAME_NONE) {
    return "";
  }
  return coordinate >= first_angle(body) ? " rad" : " m";
}

/* Return the name of the joint that is violated most at the positions `design`, at which assembly
 * starts. */
static baum_i_text name_worst_joint(baum_simulation *run, double t, const double *design)
{
  baum_workspace *w = run->workspace;
  int row = -1;
  if (w->mechanism->nc > 0 && baum_i_position_stage(w, t, design) == BAUM_OK) {
    (void)baum_i_row_sizes(w, w->phi, &row);
  }
  return baum_i_row_label(w->mechanism, row);
}

static baum_status fail_far(baum_simulation *run, const double *design, const baum_i_body *body,
                            int coordinate, double moved, double limit)
{
  double scale = run->workspace->mechanism->scale[coordinate];
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_text joint = name_worst_joint(run, run->trial.t, design);
  bool is_design = memcmp(design, m->design_q, (size_t)m->nq * sizeof *design) == 0;
  return baum_i_fail(
    BAUM_ERR_INCONSISTENT,
    "t = %.9g s: assembly would move %s by %.3g%s, more than %.3g%s; the %s violates %s most, see "
    "baum_mechanism_svg(); give a configuration closer to the assembled one%s",
    run->trial.t, baum_i_label(&body->element).text, moved, unit_of(body, coordinate),
    limit * scale, unit_of(body, coordinate), is_design ? "design configuration" : "given state",
    joint.text, baum_i_degrees(m).text);
}

/* Find the largest displacement that assembly has caused, and fail if it is too large. */
static baum_status check_displacement(baum_simulation *run, const double *design, double *largest)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double *moved = run->workspace->work_v;
  baum_i_difference(m, design, run->trial.q, moved);
  *largest = 0.0;
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    int end = 0;
    for (int i = body->v; i < body->v + body->nv; i = end) {
      end = vector_end(body, i);
      double square = 0.0;
      for (int j = i; j < end; j++) {
        square += moved[j] * moved[j];
      }
      double limit = i < first_angle(body) ? LARGEST_MOVE : LARGEST_TURN;
      *largest = fmax(*largest, sqrt(square) / m->scale[i]);
      if (sqrt(square) > limit * m->scale[i]) {
        return fail_far(run, design, body, i, sqrt(square), limit);
      }
    }
  }
  return BAUM_OK;
}

static baum_status assemble_near(baum_simulation *run, const double *left, double *before,
                                 double *moved)
{
  const baum_mechanism *m = run->workspace->mechanism;
  memcpy(before, run->trial.q, (size_t)m->nq * sizeof *before);
  BAUM_I_TRY(baum_i_assemble_in_part(run->workspace, run->trial.t, run->trial.q, m->held, left));
  return check_displacement(run, before, moved);
}

/* Find by how much each driver is violated in the design configuration, and write this to the entry
 * of its row in `violations`. The entries of other rows are zero. Return false if no driver is
 * violated. The design configuration then already agrees with the initial values of all drivers. */
static bool find_driver_violations(baum_simulation *run, double *violations)
{
  baum_workspace *w = run->workspace;
  bool found = false;
  if (baum_i_position_stage(w, run->trial.t, run->trial.q) != BAUM_OK) {
    return false;
  }
  for (int k = 0; k < w->mechanism->joint_count; k++) {
    const baum_i_joint *joint = w->mechanism->joints[k];
    for (int i = joint->row; joint->type->driven && i < joint->row + joint->rows; i++) {
      violations[i] = w->phi[i];
      found = found || violations[i] != 0.0;
    }
  }
  return found;
}

/* Assemble first with the drivers at the values that they have in the design configuration. Then
 * move the drivers in equal steps to the values with which the run begins, and assemble after each
 * step. */
static baum_status follow_drivers(baum_simulation *run, const double *violations, int steps,
                                  double *left, double *before)
{
  for (int k = 0; k <= steps; k++) {
    double moved = 0.0;
    for (int i = 0; i < run->workspace->mechanism->nc; i++) {
      left[i] = violations[i] * (steps - k) / steps;
    }
    BAUM_I_TRY(assemble_near(run, left, before, &moved));
    run->counters.start_change = k == 0 ? moved : run->counters.start_change;
  }
  return BAUM_OK;
}

/* Assemble the design configuration. This may fail because the drivers begin at values that are far
 * from the design configuration. In this case follow the drivers to these values, first in 4 steps,
 * then in more and more steps, up to DRIVER_STEPS. */
static baum_status assemble_positions(baum_simulation *run, const double *design, double *work)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double *before = work + 2 * (ptrdiff_t)m->nc;
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = assemble_near(run, NULL, before, &run->counters.start_change);
  for (int steps = 4; status == BAUM_ERR_INCONSISTENT && steps <= DRIVER_STEPS; steps *= 2) {
    memcpy(run->trial.q, design, (size_t)m->nq * sizeof *design);
    if (!find_driver_violations(run, work)) {
      break;
    }
    status = follow_drivers(run, work, steps, work + m->nc, before);
  }
  return baum_i_message_settle(status, &kept);
}

/* The given velocities v were refused. Add to the message the body that assembly has moved most,
 * and its displacement. Velocities that satisfy the constraints in an inaccurate design
 * configuration do not satisfy them in the assembled one. */
static baum_status explain_velocities(baum_simulation *run, const double *design, const double *v)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double *moved = run->workspace->work_v;
  baum_i_difference(m, design, run->trial.q, moved);
  int most = -1;
  bool is_given = false;
  double largest = EXACT;
  for (int i = 0; i < m->nv; i++) {
    is_given = is_given || !isnan(v[i]);
    most = fabs(moved[i]) / m->scale[i] > largest ? i : most;
    largest = fmax(largest, fabs(moved[i]) / m->scale[i]);
  }
  if (most < 0 || !is_given) {
    return BAUM_ERR_INCONSISTENT;
  }
  const baum_i_body *body = baum_i_velocity_body(m, most);
  return baum_i_fail(
    BAUM_ERR_INCONSISTENT,
    "%.700s; they must fit the assembled configuration, in which %s is %.3g%s away "
    "from the design configuration",
    baum_message(), baum_i_label(&body->element).text, fabs(moved[most]), unit_of(body, most));
}

static baum_status start_assembled(baum_simulation *run, const double *v)
{
  const baum_mechanism *m = run->workspace->mechanism;
  size_t nq = (size_t)m->nq;
  double *design = baum_i_alloc(2 * nq + 2 * (size_t)m->nc, sizeof *design);
  if (!design) {
    return baum_i_fail_memory();
  }
  memcpy(design, run->trial.q, nq * sizeof *design);
  baum_status status = assemble_positions(run, design, design + nq);
  if (status == BAUM_OK) {
    memcpy(run->trial.v, v, (size_t)m->nv * sizeof *v);
    status = baum_i_assemble(run->workspace, run->trial.t, run->trial.q, run->trial.v, m->held);
    status = status == BAUM_ERR_INCONSISTENT ? explain_velocities(run, design, v) : status;
  }
  baum_i_free(design);
  return status;
}

/* ---- exact ---- */

static baum_status check_rows(baum_simulation *run, const double *rows, double allowed,
                              const char *what, const char *unit)
{
  const baum_workspace *w = run->workspace;
  for (int i = 0; i < w->mechanism->nc; i++) {
    if (!(fabs(rows[i]) <= allowed * w->rhs[i])) {
      return baum_i_fail(BAUM_ERR_INCONSISTENT,
                         "t = %.9g s: start is exact, but in %s %s = %.3g %s, must be 0",
                         run->trial.t, baum_i_row_label(w->mechanism, i).text, what, rows[i], unit);
    }
  }
  return BAUM_OK;
}

static baum_status check_exact(baum_simulation *run)
{
  baum_workspace *w = run->workspace;
  BAUM_I_TRY(baum_i_violation(w, run->trial.t, run->trial.q, run->trial.v));
  double rate = baum_i_scaled_size(w->mechanism, run->trial.v);
  baum_i_row_displacements(w, w->rhs);
  BAUM_I_TRY(check_rows(run, w->phi, EXACT, "Phi", "m or rad"));
  return check_rows(run, w->phi_rate, EXACT * rate, "Phi'", "m/s or rad/s");
}

/* ---- velocities that ill-conditioned rows do not determine ---- */

/* Velocities may satisfy ill-conditioned rows up to rounding, although the rows do not determine
 * these velocities accurately. Suppose, for example, that two pins a nanometre apart connect two
 * bodies. A relative angular velocity of 1 rad/s then violates the rows by only 1e-9 m/s. The
 * accelerations then have errors of the same relative size as the change of velocities that a
 * projection would cause. */
/* If a projection changes the velocities by more than this, relative to their size, the run
 * warns. */
static const double OPEN = 1e-6;
/* If a projection changes the velocities by more than this, relative to their size, the start is
 * refused. */
static const double CONTRADICTS = 1e-3;
/* Rounding errors of the rows, relative to the velocities. */
static const double ROUNDING = 1e-13;

/* Find the largest violation of velocities, relative to the size of the velocities, and the row in
 * which it occurs. If nothing moves, return 0. */
static double find_worst_rate(const baum_i_state *state, baum_workspace *w, int *row, double *size)
{
  double nu = baum_i_row_sizes(w, w->nu, row);
  double worst = baum_i_row_sizes(w, w->phi_rate, row);
  *size = fmax(nu, baum_i_scaled_size(w->mechanism, state->v));
  return *size > baum_i_rest_rate(w->mechanism) ? worst / *size : 0.0;
}

static baum_status report_loose_velocities(baum_simulation *run, int row, double rate,
                                           double change)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_text label = baum_i_row_label(m, row);
  if (change > CONTRADICTS) {
    return baum_i_fail(BAUM_ERR_INCONSISTENT,
                       "t = %.9g s: the given velocities and the constraints contradict each other "
                       "in %s, which is violated by %.3g per s and is so ill-conditioned that "
                       "velocities would be uncertain by %.1e of their size",
                       run->trial.t, label.text, rate, change);
  }
  baum_i_run_warn(run, BAUM_WARNING_LOOSE_VELOCITIES, run->trial.t, baum_i_row_joint(m, row),
                  "t = %.9g s: %s is violated by %.3g per s at the given velocities, and is so "
                  "ill-conditioned that velocities and accelerations are uncertain by %.1e of "
                  "their size",
                  run->trial.t, label.text, rate, change);
  return BAUM_OK;
}

/* Find by how much a projection changes the velocities, relative to their size. If the projection
 * fails because rows nearly depend on others, the change counts as 1. If it fails because rows
 * depend exactly on others, the change counts as 0. */
static baum_status find_change(baum_workspace *w, const baum_i_state *state, double size,
                               double *change)
{
  baum_status status = baum_i_change_of_velocities(w, state->t, state->q, state->v);
  if (status == BAUM_ERR_SINGULAR) {
    *change = baum_i_kkt_rcond(w->kkt) > 0.0 ? 1.0 : 0.0;
    return BAUM_OK;
  }
  *change = baum_i_scaled_size(w->mechanism, w->a) / size;
  return status;
}

baum_status baum_i_run_check_velocities(baum_simulation *run)
{
  baum_workspace *w = run->workspace;
  const baum_i_state *trial = &run->trial;
  if (w->mechanism->nc == 0 || run->options.start == BAUM_START_AS_GIVEN) {
    return BAUM_OK;
  }
  BAUM_I_TRY(baum_i_violation(w, trial->t, trial->q, trial->v));
  int row = -1;
  double size = 0.0;
  if (!(find_worst_rate(trial, w, &row, &size) > ROUNDING)) {
    return BAUM_OK;
  }
  double rate = fabs(w->phi_rate[row]);
  double change = 0.0;
  BAUM_I_TRY(find_change(w, trial, size, &change));
  return change > OPEN ? report_loose_velocities(run, row, rate, change) : BAUM_OK;
}

/* ---- the whole ---- */

/* Set the trial state to the state that the user has given. Velocities that are not given (NaN)
 * become zero. */
static void start_as_given(baum_simulation *run, double t, const double *q, const double *v)
{
  const baum_mechanism *m = run->workspace->mechanism;
  run->trial.t = t;
  memcpy(run->trial.q, q, (size_t)m->nq * sizeof *q);
  baum_i_normalize(m, run->trial.q);
  for (int i = 0; i < m->nv; i++) {
    run->trial.v[i] = isnan(v[i]) ? 0.0 : v[i];
  }
}

/* Move fixed bodies to the poses that their welds determine. Poses that the user has given for them
 * are ignored. */
static void place_fixed_bodies(baum_simulation *run)
{
  baum_i_place_fixed_bodies(run->workspace->mechanism, run->trial.q);
  baum_i_rest_fixed_bodies(run->workspace->mechanism, run->trial.v);
}

baum_status baum_i_run_start(baum_simulation *run, double t, const double *q, const double *v)
{
  baum_workspace *w = run->workspace;
  start_as_given(run, t, q, v);
  if (run->options.start == BAUM_START_ASSEMBLE) {
    BAUM_I_TRY(start_assembled(run, v));
  } else {
    w->point.t = t; /* the time that the message shows */
    BAUM_I_TRY(baum_i_check_sizes(w, "velocity", run->trial.v));
    BAUM_I_TRY(run->options.start == BAUM_START_EXACT ? check_exact(run) : BAUM_OK);
  }
  place_fixed_bodies(run);
  return BAUM_OK;
}

baum_status baum_i_run_measure(baum_simulation *run, double *energy)
{
  baum_workspace *w = run->workspace;
  const baum_i_state *trial = &run->trial;
  double kinetic = 0.0;
  double potential = 0.0;
  BAUM_I_TRY(baum_i_violation(w, trial->t, trial->q, trial->v));
  BAUM_I_TRY(baum_i_energy(w, trial->t, trial->q, trial->v, &kinetic, &potential));
  *energy = kinetic + potential;
  return BAUM_OK;
}

void baum_i_run_accept(baum_simulation *run, double energy)
{
  baum_i_run_observe(run, run->trial.t, false);
  (void)baum_i_run_follow_angles(run, &run->trial);
  baum_i_run_copy(run, &run->trial, &run->state);
  baum_i_run_copy(run, &run->trial, &run->ahead);
  run->start_energy = energy;
  run->grid = (baum_i_grid){.origin = run->state.t};
  run->origin = run->state.t;
  baum_i_companion_begin(run);
  baum_i_crossings_forget(run->crossings);
  if (run->account) {
    baum_i_account_begin(run);
  }
  if (run->events) {
    baum_i_events_begin(run);
  }
}

static baum_status check_entry(const char *call, char name, int i, double value, bool may_be_free)
{
  if (isfinite(value) || (may_be_free && isnan(value))) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %c[%d] is %g, must be finite%s", call, name, i, value,
                     may_be_free ? ", or NaN if free" : "");
}

/* Rounding of the given numbers may move q off the manifold of valid positions. Check that the
 * distance of q from the manifold is small enough to be explained by rounding. */
static baum_status check_manifold(const baum_simulation *run, const char *call, const double *q)
{
  static const double NEAR = 1e-6;
  const baum_mechanism *m = run->workspace->mechanism;
  double *normal = run->spare.q;
  memcpy(normal, q, (size_t)m->nq * sizeof *q);
  baum_i_normalize(m, normal);
  for (int i = 0; i < m->nq; i++) {
    if (!(fabs(normal[i] - q[i]) <= NEAR * m->position_scale[i])) {
      return baum_i_fail(
        BAUM_ERR_ARGUMENT,
        "%s: q[%d] is %.9g, but %.9g after normalizing q; give a q on the configuration manifold",
        call, i, q[i], normal[i]);
    }
  }
  return BAUM_OK;
}

static baum_status check_state(const baum_simulation *run, double t, const double *q,
                               const double *v)
{
  const char *call = "baum_simulation_set_state";
  BAUM_I_TRY(baum_i_run_may_be_changed(run, call));
  BAUM_I_TRY(baum_i_check_given(call, q ? "v" : "q", q && v));
  const baum_mechanism *m = run->workspace->mechanism;
  bool may_be_free = run->options.start == BAUM_START_ASSEMBLE;
  BAUM_I_TRY(baum_i_check_finite(call, "t", "s", t));
  for (int i = 0; i < m->nq; i++) {
    BAUM_I_TRY(check_entry(call, 'q', i, q[i], false));
  }
  BAUM_I_TRY(check_manifold(run, call, q));
  for (int i = 0; i < m->nv; i++) {
    BAUM_I_TRY(check_entry(call, 'v', i, v[i], may_be_free));
  }
  return BAUM_OK;
}

/* Tell whether a state belongs to this run: all of its velocities are given, and it violates the
 * constraints by no more than earlier states of the run. Such a state is not changed. A run can
 * therefore return exactly to an earlier state. */
static bool is_of_this_run(baum_simulation *run, double t, const double *q, const double *v)
{
  baum_workspace *w = run->workspace;
  double phi = 0.0;
  double phi_rate = 0.0;
  bool is_whole = true;
  for (int i = 0; i < w->mechanism->nv; i++) {
    is_whole = is_whole && !isnan(v[i]);
  }
  if (!is_whole || baum_i_violation(w, t, q, v) != BAUM_OK) {
    return false;
  }
  (void)baum_i_largest(w->phi, w->mechanism->nc, &phi);
  (void)baum_i_largest(w->phi_rate, w->mechanism->nc, &phi_rate);
  return phi <= run->counters.max_phi && phi_rate <= run->counters.max_phi_rate;
}

/* Set the trial state to the given state. Do everything here that can fail. */
static baum_status prepare(baum_simulation *run, double t, const double *q, const double *v,
                           double *energy)
{
  if (is_of_this_run(run, t, q, v)) {
    start_as_given(run, t, q, v);
    place_fixed_bodies(run);
  } else {
    BAUM_I_TRY(baum_i_run_start(run, t, q, v));
    BAUM_I_TRY(baum_i_run_check_velocities(run));
  }
  BAUM_I_TRY(baum_i_run_measure(run, energy));
  if (run->events) {
    BAUM_I_TRY(baum_i_events_evaluate_start(run, &run->trial));
  }
  baum_i_run_restart_rows(run, &run->trial);
  if (baum_i_integrator_remembers(run->integrator, &run->problem)) {
    /* this comes last, because a restart cannot be undone */
    BAUM_I_TRY(run->integrator->restart(run->self, &run->problem, &run->trial));
    run->counters.restarts++;
  }
  return BAUM_OK;
}

baum_status baum_i_run_set_state(baum_simulation *simulation, double t, const double *q,
                                 const double *v)
{
  BAUM_I_TRY(check_state(simulation, t, q, v));
  baum_i_kept_message kept = baum_i_message_keep();
  double start_change = simulation->counters.start_change;
  double energy = 0.0;
  double before = simulation->state.t;
  baum_i_schedule_move(simulation, before, t);
  baum_i_hold_angles(&simulation->workspace->point, t);
  baum_status status = prepare(simulation, t, q, v, &energy);
  if (status == BAUM_OK) {
    baum_i_run_accept(simulation, energy);
  } else {
    simulation->counters.start_change = start_change;
    baum_i_schedule_move(simulation, t, before);
    baum_i_hold_angles(&simulation->workspace->point, before);
    (void)baum_i_run_follow_angles(simulation, &simulation->state);
    baum_i_clear_fixed_rows(simulation->workspace);
  }
  return baum_i_run_end_call(simulation, status, &kept);
}

/* Copy the angles at the present state, or set *out to NULL if the mechanism has none. */
static baum_status copy_angles(baum_simulation *run, double **out)
{
  const baum_i_point *point = &run->workspace->point;
  (void)baum_i_run_follow_angles(run, &run->state); /* steps may have skipped this */
  if (point->angles) {
    *out = baum_i_copy(point->angles, (size_t)baum_i_angles_size(point->mechanism), sizeof **out);
  }
  return *out || !point->angles ? BAUM_OK : baum_i_fail_memory();
}

/* After a failure, write the copied angles back to the run. In any case, free the copy. */
static baum_status end_with_angles(baum_simulation *run, baum_status status, double *copy)
{
  const baum_i_point *point = &run->workspace->point;
  if (copy && status < BAUM_OK) {
    memcpy(point->angles, copy, (size_t)baum_i_angles_size(point->mechanism) * sizeof *copy);
  }
  baum_i_free(copy);
  return status;
}

baum_status baum_simulation_set_state(baum_simulation *simulation, double t, const double *q,
                                      const double *v)
{
  double *angles = NULL;
  BAUM_I_TRY(check_state(simulation, t, q, v));
  BAUM_I_TRY(copy_angles(simulation, &angles));
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = t == simulation->state.t
                         ? BAUM_OK
                         : baum_i_expect_driven_angles(&simulation->workspace->point, t);
  status = status == BAUM_OK ? baum_i_run_set_state(simulation, t, q, v) : status;
  return baum_i_run_end_call(simulation, end_with_angles(simulation, status, angles), &kept);
}

baum_status baum_simulation_set_angle(baum_simulation *simulation, baum_joint_id joint,
                                      baum_joint_coordinate which, double angle)
{
  const char *call = "baum_simulation_set_angle";
  double *angles = NULL;
  BAUM_I_TRY(baum_i_run_may_be_changed(simulation, call));
  BAUM_I_TRY(copy_angles(simulation, &angles));
  baum_i_kept_message kept = baum_i_message_keep();
  const baum_i_state *now = &simulation->state;
  baum_status status = baum_i_set_angle(&simulation->workspace->point, joint, which, angle, call);
  status = status == BAUM_OK ? baum_i_run_set_state(simulation, now->t, now->q, now->v) : status;
  return baum_i_run_end_call(simulation, end_with_angles(simulation, status, angles), &kept);
}
