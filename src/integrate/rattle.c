/* SPDX-License-Identifier: BSD-3-Clause */
/* RATTLE (H. C. Andersen, J. Comp. Phys. 52 (1983) 24-34; symplectic: B. Leimkuhler, R. Skeel, J.
 * Comp. Phys. 112 (1994) 117-125; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration,
 * 2006, VII.1.4), order 2, for constant M and forces g(t, q):
 *
 *   v'       = v + (h/2) M^-1 (g(t, q) - J(q)^T lambda)             (nv)
 *   q(t + h) = q moved by h v',           Phi(q(t + h)) = 0         (nq)   gives lambda
 *   v(t + h) = v' + (h/2) M^-1 (g - J^T mu)  at q(t + h),  J v = nu        gives mu
 *
 * For a rigid body in space, the angular momentum m = I w replaces the rotational part of M v':
 *
 *   m'       = I w + (h/2) (moments of g and -J^T lambda)
 *   m'' and the orientation at t + h result from m' by a rotation without moments
 *   I w(t + h) = m'' + (h/2) (moments of g and -J^T mu)  at q(t + h)
 *
 * (free_rotation.h; compositions with constraints are symplectic: S. Reich, SIAM J. Numer. Anal. 33
 * (1996) 475-491.) The gyroscopic moment -w x (I w) is then not part of g, although the
 * acceleration a of the caller contains it.
 *
 * The method is symmetric, and symplectic on the constraint manifold, so the energy of a long run
 * stays in a band of width O(h^2). If constraints or forces depend on time, the method is
 * symplectic in the phase space that includes time and its momentum.
 *
 * The caller provides the acceleration a at the start, which has the form M^-1 (g - J^T lambda).
 * Newton's method therefore begins with v' = v + (h/2) a. It iterates only v', because lambda
 * itself is not needed. All iterations use the matrix J(q) M^-1 J(q)^T of the start of the step. An
 * iteration computes a change dq along M^-1 J(q)^T, and changes v' by dq / h. It then computes the
 * end of the step again, by moving the q of its start by h v'. In this way v does not contain
 * rounding errors of q divided by h.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "base/rotation.h"
#include "dynamics/chord.h"
#include "integrate/free_rotation.h"
#include "integrate/integrator.h"

enum { ITERATIONS = 50 };

/* Changes of coordinates, relative to their scales, are treated as rounding errors if they are
 * below a limit. The limit is this fraction of the largest of three numbers: 1, the largest scaled
 * position, and the largest angle by which a body rotates in the step. The angle is included
 * because a rounding error of the momentum rotates a slender body about its axis. */
static const double ROUNDING = 2.0 * DBL_EPSILON;
/* Changes that no longer decrease are treated as rounding errors if they are at most this multiple
 * of the limit. */
static const double STALLED = 256.0;

/* The rotation of a rigid body that has a gyroscopic moment. */
typedef struct rattle_rotation {
  int at; /* index of the angular velocity in v */
  const double *inertia;
  baum_i_free_rotation free;
} rattle_rotation;

/* Memory of a run. */
typedef struct rattle_run {
  int nv;
  int rotation_count;
  rattle_rotation *rotations; /* (rotation_count); NULL in planar mechanisms */
  /* [rad] largest h |momentum| / (smallest moment of inertia) of a body, at least 1 */
  double largest_angle;
  int64_t iterations;
  double *memory; /* memory of the arrays below */
  double *q;      /* (nq) end of the step */
  double *v;      /* (nv) v', velocities after the first half of the step */
  double *mean;   /* (nv) velocities that move q; the same array as v unless bodies rotate */
  /* (nv) moments that replace the gyroscopic moments at the end of the step; NULL if no body
   * rotates */
  double *moments;
} rattle_run;

/* ---- rotations ---- */

/* Find the mean velocities of a step from v', and the moments that replace the gyroscopic moments
 * in its second half. The given acceleration, and therefore v', contains the gyroscopic moment at
 * the start. This function removes this moment from the momentum. */
static void rotate_bodies(rattle_run *run, const baum_i_state *state, double h)
{
  memcpy(run->mean, run->v, (size_t)run->nv * sizeof *run->v);
  run->largest_angle = 1.0;
  for (int k = 0; k < run->rotation_count; k++) {
    const rattle_rotation *r = &run->rotations[k];
    double half[3];
    double start[3];
    double gyroscopic[3];
    double momentum[3];
    baum_i_turn(r->inertia, run->v + r->at, half);
    baum_i_turn(r->inertia, state->v + r->at, start);
    baum_i_cross(state->v + r->at, start, gyroscopic);
    memcpy(momentum, half, sizeof half);
    baum_i_add_scaled3(0.5 * h, gyroscopic, momentum);
    double size = fabs(h) * sqrt(baum_i_dot3(momentum, momentum)) * r->free.largest;
    run->largest_angle = fmax(run->largest_angle, size);
    baum_i_rotate_freely(&r->free, h, momentum, run->mean + r->at);
    for (int i = 0; i < 3; i++) {
      run->moments[r->at + i] = (momentum[i] - half[i]) * 2.0 / h;
    }
  }
}

static baum_status find_rotations(rattle_run *run, const baum_workspace *w)
{
  const baum_mechanism *m = w->mechanism;
  if (!m->spatial) {
    return BAUM_OK;
  }
  run->rotations = baum_i_alloc((size_t)m->body_count, sizeof *run->rotations);
  BAUM_I_TRY(baum_i_check_memory(run->rotations));
  for (int k = 1; k <= m->body_count; k++) {
    const baum_i_body *body = m->bodies[k];
    if (body->type->inertia && body->type->depends_on_velocity(body->element.def)) {
      const double *inertia = body->type->inertia(body, w->point.parameters);
      run->rotations[run->rotation_count++] =
        (rattle_rotation){body->v + 3, inertia, baum_i_free_rotation_of(inertia)};
    }
  }
  return BAUM_OK;
}

/* ---- positions ---- */

/* Tell whether the next change would only be a rounding error. Changes decrease by a constant
 * factor, which is known from the second change on. */
static bool is_last(double size, double before, double rounding)
{
  if (size <= rounding || isinf(before)) {
    return size <= rounding;
  }
  bool falls = size < 0.5 * before;
  return falls ? size * (size / before) <= 0.01 * rounding : size <= STALLED * rounding;
}

static void move_end(rattle_run *run, const baum_mechanism *m, const baum_i_state *state, double h)
{
  if (run->rotation_count > 0) {
    rotate_bodies(run, state, h);
  }
  baum_i_move_from(m, state->q, h, run->mean, run->q);
}

static baum_status find_positions(rattle_run *run, baum_workspace *w, const baum_i_state *state,
                                  double h)
{
  const baum_mechanism *m = w->mechanism;
  baum_i_chord chord;
  BAUM_I_TRY(baum_i_chord_begin(w, state->t, state->q, &chord));
  double size = INFINITY;
  for (int k = 0; k < ITERATIONS; k++) {
    BAUM_I_TRY(baum_i_chord_change(w, &chord, state->t + h, run->q));
    run->iterations++;
    for (int i = 0; i < run->nv; i++) {
      run->v[i] += w->a[i] / h;
    }
    move_end(run, m, state, h);
    double before = size;
    size = baum_i_scaled_size(m, w->a);
    double largest = fmax(run->largest_angle, baum_i_position_size(m, run->q));
    if (is_last(size, before, ROUNDING * largest)) {
      return BAUM_OK;
    }
    if (!(size < 2.0 * before)) {
      break;
    }
  }
  return baum_i_fail_iteration("rattle", "the positions", state->t, size);
}

/* ---- one step ---- */

static baum_status take_step(void *self, const baum_i_problem *problem, baum_i_state *state,
                             double h, const double *a)
{
  rattle_run *run = self;
  baum_workspace *w = problem->workspace;
  int nv = run->nv;
  for (int i = 0; i < nv; i++) {
    run->v[i] = state->v[i] + 0.5 * h * a[i];
  }
  move_end(run, w->mechanism, state, h);
  BAUM_I_TRY(w->mechanism->nc > 0 ? find_positions(run, w, state, h) : BAUM_OK);
  BAUM_I_TRY(baum_i_hold_velocities(w, state->t + h, run->q, run->v, run->moments, 2.0 / h));
  memcpy(state->q, run->q, (size_t)w->mechanism->nq * sizeof *run->q);
  for (int i = 0; i < nv; i++) {
    state->v[i] = run->v[i] + 0.5 * h * w->a[i];
  }
  return BAUM_OK;
}

/* ---- life ---- */

static void close_run(void *self)
{
  rattle_run *run = self;
  baum_i_free(run->memory);
  baum_i_free(run->rotations);
}

static baum_status fail_velocities(const baum_i_element *element)
{
  return baum_i_fail(
    BAUM_ERR_UNSUPPORTED,
    "simulation options: rattle needs forces that depend on time and position "
    "only, but %s depends on velocities%s; take rk4 or rk8, or generalized_alpha if "
    "the force is stiff",
    baum_i_label(element).text,
    baum_i_fields_have_function(element->definition, element->def)
      ? ", or does not set depends_on_velocity = false"
      : ", because its damping is not 0");
}

static baum_status check_body(const baum_i_body *body)
{
  const void *def = body->element.def;
  if (body->type->constant_mass && !body->type->constant_mass(def)) {
    return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                       "simulation options: rattle needs constant masses, but %s does not set "
                       "constant_mass = true",
                       baum_i_label(&body->element).text);
  }
  bool depends =
    body->type->depends_on_velocity && body->type->depends_on_velocity(def) && !body->type->inertia;
  return depends ? fail_velocities(&body->element) : BAUM_OK;
}

static baum_status check_joint(const baum_i_joint *joint)
{
  if (joint->velocity_rows == 0) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                     "simulation options: rattle needs constraints of positions, but %s has rows "
                     "of velocity level; take rk4, rk8 or generalized_alpha",
                     baum_i_label(&joint->element).text);
}

/* Refuse variable masses, forces that depend on velocities, and constraints of velocities alone. */
static baum_status check_mechanism(const baum_mechanism *m)
{
  for (int k = 0; k < m->joint_count; k++) {
    BAUM_I_TRY(check_joint(m->joints[k]));
  }
  for (int i = 1; i <= m->body_count; i++) {
    BAUM_I_TRY(check_body(m->bodies[i]));
  }
  for (int k = 0; k < m->force_count; k++) {
    const baum_i_force *force = m->forces[k];
    if (force->type->depends_on_velocity && force->type->depends_on_velocity(force)) {
      return fail_velocities(&force->element);
    }
  }
  return BAUM_OK;
}

static baum_status open_run(void *self, const void *table, const baum_i_problem *problem,
                            const baum_i_state *start)
{
  (void)table;
  (void)start;
  rattle_run *run = self;
  const baum_mechanism *m = problem->workspace->mechanism;
  BAUM_I_TRY(check_mechanism(m));
  run->nv = m->nv;
  run->largest_angle = 1.0;
  BAUM_I_TRY(find_rotations(run, problem->workspace));
  run->memory = baum_i_alloc((size_t)m->nq + 3 * (size_t)m->nv, sizeof *run->memory);
  BAUM_I_TRY(baum_i_check_memory(run->memory));
  run->q = run->memory;
  run->v = run->q + m->nq;
  run->mean = run->rotation_count > 0 ? run->v + m->nv : run->v;
  run->moments = run->rotation_count > 0 ? run->mean + m->nv : NULL;
  return BAUM_OK;
}

static void count(const void *self, baum_i_statistics *out)
{
  const rattle_run *run = self;
  *out = (baum_i_statistics){.nonlinear_iterations = run->iterations};
}

static const baum_integrator RATTLE = {
  .name = "rattle",
  .order = 2,
  .formulations = {BAUM_FORMULATION_INDEX3},
  .gains = BAUM_GAINS_DEFAULT,
  .method = {.kind = BAUM_I_METHOD_WITHOUT_GAINS},
  .memory = sizeof(rattle_run),
  .open = open_run,
  .close = close_run,
  .step = take_step,
  .statistics = count,
};

const baum_integrator *baum_rattle(void)
{
  return &RATTLE;
}
