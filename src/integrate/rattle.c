/* SPDX-License-Identifier: BSD-3-Clause */
/* RATTLE (H. C. Andersen, J. Comp. Phys. 52 (1983) 24-34; symplectic: B. Leimkuhler, R. Skeel, J.
 * Comp. Phys. 112 (1994) 117-125; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration,
 * 2006, VII.1.4), order 2, for constant M and forces g(t, q):
 *
 *   v'       = v + (h/2) M^-1 (g(t, q) - J(q)^T lambda)             (nv)
 *   q(t + h) = q moved by h v',           Phi(q(t + h)) = 0         (nq)   gives lambda
 *   v(t + h) = v' + (h/2) M^-1 (g - J^T mu)  at q(t + h),  J v = nu        gives mu
 *
 * Symmetric, and symplectic on the constraints, so that the energy of a long run stays in a band of
 * width O(h^2). With constraints and forces that depend on time this holds in the phase space that
 * includes time and its momentum.
 *
 * Only the sum of all changes of lambda matters. The acceleration a of the caller has the form M^-1
 * (g - J^T lambda), so Newton's method begins with v' = v + (h/2) a. Its matrix J(q) M^-1 J(q)^T
 * may be kept: it gives changes dq along M^-1 J(q)^T, which change v' by dq / h. Each iteration
 * moves q by h v' from the start of the step, so that the rounding of q does not enter v divided by
 * h.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/chord.h"
#include "integrate/integrator.h"

enum { ITERATIONS = 50 };

/* Changes below this many roundings of the coordinates count as rounding. The scale replaces
 * coordinates that are smaller, as for a body at the origin. */
static const double ROUNDING = 2.0 * DBL_EPSILON;
/* Changes that have stopped falling count as rounding up to this many roundings. */
static const double STALLED = 256.0;

/* Memory of a run. */
typedef struct rattle_run {
  int nv;
  int64_t iterations;
  double *memory; /* all below */
  double *q;      /* (nq) end of the step */
  double *v;      /* (nv) half velocities */
} rattle_run;

/* ---- positions ---- */

/* Would another change only be rounding? Changes fall by a constant factor, which the first change
 * cannot show yet. */
static bool is_last(double size, double before, double rounding)
{
  if (size <= rounding || isinf(before)) {
    return size <= rounding;
  }
  bool falls = size < 0.5 * before;
  return falls ? size * (size / before) <= 0.01 * rounding : size <= STALLED * rounding;
}

static void move_end(const rattle_run *run, const baum_mechanism *m, const baum_i_state *state,
                     double h)
{
  baum_i_move_from(m, state->q, h, run->v, run->q);
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
    if (is_last(size, before, ROUNDING * fmax(1.0, baum_i_position_size(m, run->q)))) {
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
  BAUM_I_TRY(baum_i_hold_velocities(w, state->t + h, run->q, run->v, 2.0 / h));
  memcpy(state->q, run->q, (size_t)w->mechanism->nq * sizeof *run->q);
  for (int i = 0; i < nv; i++) {
    state->v[i] = run->v[i] + 0.5 * h * w->a[i];
  }
  return BAUM_OK;
}

/* ---- life ---- */

static void close_run(void *self)
{
  baum_i_free(((rattle_run *)self)->memory);
}

static baum_status fail_velocities(const baum_i_element *element)
{
  char label[BAUM_I_LABEL_SIZE];
  return baum_i_fail(
    BAUM_ERR_UNSUPPORTED,
    "simulation options: rattle needs forces of time and position, but that of %s depends on "
    "velocities, or does not set depends_on_velocity = false; take rk4 or rk8, or "
    "generalized_alpha if it is stiff",
    baum_i_label(element, label));
}

static baum_status check_body(const baum_i_body *body)
{
  const void *def = body->element.def;
  char label[BAUM_I_LABEL_SIZE];
  if (body->type->constant_mass && !body->type->constant_mass(def)) {
    return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                       "simulation options: rattle needs constant masses, but %s does not set "
                       "constant_mass = true",
                       baum_i_label(&body->element, label));
  }
  bool depends = body->type->depends_on_velocity && body->type->depends_on_velocity(def);
  return depends ? fail_velocities(&body->element) : BAUM_OK;
}

/* Refuse variable masses and forces that depend on velocities. */
static baum_status check_mechanism(const baum_mechanism *m)
{
  for (int i = 1; i <= m->body_count; i++) {
    BAUM_I_TRY(check_body(m->bodies[i]));
  }
  for (int k = 0; k < m->force_count; k++) {
    const baum_i_force *force = m->forces[k];
    if (force->type->depends_on_velocity && force->type->depends_on_velocity(force->element.def)) {
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
  run->memory = baum_i_alloc((size_t)m->nq + (size_t)m->nv, sizeof *run->memory);
  BAUM_I_TRY(baum_i_check_memory(run->memory));
  run->q = run->memory;
  run->v = run->q + m->nq;
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
