/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes the text that explains a run. */
#include <math.h>

#include "base/text.h"
#include "simulate/run.h"

#define say(run, ...) baum_i_append((run)->explain, sizeof(run)->explain, __VA_ARGS__)

static const char *const FORMULATIONS[] = {
  [BAUM_FORMULATION_UNSTABILIZED] = "J a = gamma, without stabilization",
  [BAUM_FORMULATION_BAUMGARTE] = "J a = gamma - 2 alpha Phi' - beta^2 Phi",
  [BAUM_FORMULATION_PROJECTION] = "J a = gamma, then q and v projected after each step",
  [BAUM_FORMULATION_INDEX2] = "J v = nu kept by the implicit method itself; Phi drifts slowly",
  [BAUM_FORMULATION_GGL] =
    "Phi = 0 and J v = nu kept by the implicit method itself (Gear, Gupta, Leimkuhler)",
  [BAUM_FORMULATION_INDEX3] = "Phi = 0 kept by the method itself",
};

static void explain_lack_of_freedom(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  if (baum_i_has_constant_constraints(m)) {
    say(run, "              no degree of freedom is left, and no driver moves the mechanism: it "
             "stays at rest\n");
    return;
  }
  bool suggests = !run->integrator->without_freedom && m->velocity_row_count == 0;
  say(run,
      "              no degree of freedom is left: the motion follows from the drivers alone%s\n",
      suggests ? "; kinematics gives it exactly, without integration" : "");
}

static void explain_mechanism(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_row_set *r = &run->workspace->rows;
  int rank = m->nc > 0 ? r->rank : 0;
  say(run,
      "mechanism     bodies %d, joints %d, forces %d; velocities %d, constraint rows %d, degrees "
      "of freedom "
      "%d",
      m->body_count, m->joint_count, m->force_count, m->nv, m->nc, m->nv - rank);
  if (m->velocity_row_count > 0) {
    say(run, " of velocity, %d of position; %d %s of velocity level", m->nv - r->position_rank,
        m->velocity_row_count, m->velocity_row_count == 1 ? "row" : "rows");
  }
  say(run, "\n");
  if (r->count > 0) {
    say(run, "              %d redundant %s omitted from every solution\n", r->count,
        r->count == 1 ? "row" : "rows");
  }
  if (m->nv == rank) {
    explain_lack_of_freedom(run);
  }
  say(run, "scale         %.6g m, and 1 rad\n", m->length);
}

/* Describe what the formulation does with rows of velocity level. */
static void explain_velocity_rows(baum_simulation *run)
{
  static const char *const TEXTS[] = {
    [BAUM_FORMULATION_BAUMGARTE] = "J a = gamma - alpha (J v - nu)",
    [BAUM_FORMULATION_PROJECTION] = "J a = gamma, then only v is projected for them",
    [BAUM_FORMULATION_GGL] = "J v = nu",
    [BAUM_FORMULATION_INDEX3] = "J v = nu",
  };
  baum_formulation f = run->options.formulation;
  bool differs = f != BAUM_FORMULATION_UNSTABILIZED && f != BAUM_FORMULATION_INDEX2;
  if (run->workspace->mechanism->velocity_row_count > 0 && differs) {
    say(run, "              rows of velocity level: %s\n", TEXTS[f]);
  }
}

static void explain_factor(baum_simulation *run, const char *name, double value, double without)
{
  if (value != without) {
    say(run, ", %s %.3g", name, value);
  }
}

static void explain_integrator(baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  if (run->integrator->without_freedom) {
    say(run, "integrator    %s: Phi(q, t) = 0 is solved to rounding at every requested time\n",
        run->integrator->name);
    return;
  }
  if (baum_i_run_has_fixed_step(run)) {
    say(run, "integrator    %s, order %d, fixed step %.6g s\n", run->integrator->name,
        run->integrator->order, o->step);
    return;
  }
  say(run, "integrator    %s, rtol %.3g", run->integrator->name, o->rtol);
  if (!isnan(o->atol)) {
    say(run, ", atol %.3g", o->atol);
  }
  explain_factor(run, "tolerance_q", o->tolerance_q, 1.0);
  explain_factor(run, "tolerance_v", o->tolerance_v, 1.0);
  explain_factor(run, "tolerance_lambda", o->tolerance_lambda, (double)INFINITY);
  say(run,
      "; positions relative to the scale, velocities to the scale times %.4g 1/s or the present "
      "velocity\n",
      run->problem.rate);
}

static void explain_solver(baum_simulation *run)
{
  const baum_i_text text = baum_i_solver_text(run->workspace);
  if (run->integrator->without_freedom) {
    say(run, "solver        %s on the constraints\n", baum_i_kkt_backend(run->workspace->kkt));
  } else if (run->integrator->solves_residuals) {
    /* The integrator solves with its own matrix. The solver for accelerations is used only at the
     * start and for outputs, to solve equation (5) of docs/notation.md. */
    say(run, "solver        klu on the Jacobian of the residual; start and channels: %s\n",
        text.text);
  } else {
    say(run, "solver        %s\n", text.text);
  }
}

void baum_i_run_explain(baum_simulation *run)
{
  run->explain[0] = '\0';
  explain_mechanism(run);
  if (!run->integrator->without_freedom) {
    say(run, "formulation   %s: %s\n", baum_formulation_name(run->options.formulation),
        FORMULATIONS[run->options.formulation]);
    explain_velocity_rows(run);
  }
  explain_integrator(run);
  if (run->options.formulation == BAUM_FORMULATION_BAUMGARTE) {
    say(run, "gains         alpha %.6g 1/s, beta %.6g 1/s\n              %s\n", run->problem.alpha,
        run->problem.beta, run->gains.why);
    if (run->row_gains) {
      say(run, "              times the factors of row_gains\n");
    }
  }
  explain_solver(run);
  say(run,
      "start         t = %.9g s, assembly moved a body by up to %.3g characteristic lengths or rad",
      run->state.t, run->counters.start_change);
}
