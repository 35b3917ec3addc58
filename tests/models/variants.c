/* SPDX-License-Identifier: BSD-3-Clause */
#include "variants.h"

#include <string.h>

baum_status variant_plan_make(variant_plan *out)
{
  memset(out, 0, sizeof *out);
  model_slider_crank options = {.driven = true, .angle = 1.0, .moving = true};
  baum_workspace *workspace = NULL;
  baum_status status = model_slider_crank_build(options, &out->m);
  if (status == BAUM_OK) {
    status = baum_workspace_create(out->m.mechanism, &workspace);
  }
  if (status == BAUM_OK) {
    status = baum_workspace_design(workspace, out->q, out->v);
  }
  baum_workspace_destroy(workspace);
  if (status != BAUM_OK) {
    variant_plan_clear(out);
  }
  return status;
}

void variant_plan_clear(variant_plan *plan)
{
  model_destroy(&plan->m);
}

static baum_status set_mass(baum_mechanism *variant, baum_body_id slider, double mass)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_status status = baum_mechanism_get_planar_body(variant, slider, &def, sizeof def);
  if (status == BAUM_OK) {
    def.mass = mass;
    status = baum_mechanism_set_planar_body(variant, slider, &def);
  }
  return status;
}

static baum_status solve(const variant_plan *plan, const baum_mechanism *variant,
                         variant_result *out)
{
  baum_workspace *workspace = NULL;
  baum_status status = baum_workspace_create(variant, &workspace);
  if (status == BAUM_OK) {
    status =
      baum_workspace_acceleration(workspace, 0.0, plan->q, plan->v, 0.0, 0.0, out->a, out->lambda);
  }
  baum_workspace_destroy(workspace);
  return status;
}

baum_status variant_make(const variant_plan *plan, double mass, variant_result *out)
{
  baum_mechanism *variant = NULL;
  baum_status status = baum_mechanism_copy(plan->m.mechanism, &variant);
  if (status == BAUM_OK) {
    status = set_mass(variant, plan->m.bodies[MODEL_SLIDER], mass);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_freeze(variant);
  }
  if (status == BAUM_OK && out) {
    status = solve(plan, variant, out);
  }
  baum_mechanism_destroy(variant);
  return status;
}
