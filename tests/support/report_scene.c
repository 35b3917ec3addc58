/* SPDX-License-Identifier: BSD-3-Clause */
/* A small study. Some of its entries are accurate, one has a warning, and one is refused. */
#include "report_scene.h"

#include <stddef.h>

static int circle(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

static baum_status make_pendulum(baum_mechanism **out)
{
  baum_body_id body;
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.position[0] = 1.0;
  baum_user_constraint_def rod = baum_user_constraint_def_default();
  rod.name = REPORT_JOINT;
  rod.bodies = &body;
  rod.body_count = 1;
  rod.row_count = 1;
  rod.phi = circle;
  baum_status status = baum_mechanism_create(out);
  status = status ? status : baum_mechanism_add_planar_particle(*out, &bob, &body);
  status = status ? status : baum_mechanism_add_user_constraint(*out, &rod, NULL);
  return status ? status : baum_mechanism_freeze(*out);
}

/* Adds six entries. The first four entries are accurate. Three of them belong to rk4, and one
 * belongs to rk2. The fifth entry drifts until it gives a warning, which names the joint. The last
 * entry is refused, because its gains are unstable. */
static baum_status add_entries(baum_study *study)
{
  static const double steps[REPORT_ENTRIES] = {0.04, 0.02, 0.01, 0.01, 0.05, 0.01};
  baum_status status = BAUM_OK;
  for (int k = 0; k < REPORT_ENTRIES && status == BAUM_OK; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = k < 3 ? baum_rk4() : k == REPORT_WARNED_ENTRY ? baum_dp5() : baum_rk2();
    o.formulation = k < 3                      ? BAUM_FORMULATION_PROJECTION
                    : k == REPORT_WARNED_ENTRY ? BAUM_FORMULATION_UNSTABILIZED
                                               : BAUM_FORMULATION_BAUMGARTE;
    if (o.formulation == BAUM_FORMULATION_BAUMGARTE) {
      double gain = k == REPORT_REFUSED_ENTRY ? 1e3 : 5.0;
      o.gains = baum_gains_fixed(gain, gain);
    }
    if (k == REPORT_WARNED_ENTRY) {
      o.rtol = 0.1;
    } else {
      o.step = steps[k];
    }
    status = baum_study_add(study, &o);
  }
  return status;
}

report_scene report_scene_make(void)
{
  report_scene scene = {NULL, NULL};
  baum_status status = make_pendulum(&scene.mechanism);
  status = status ? status : baum_study_create(scene.mechanism, 0.0, 2.0, &scene.study);
  status = status ? status : add_entries(scene.study);
  if (status != BAUM_OK) {
    report_scene_end(&scene);
  }
  return scene;
}

void report_scene_end(report_scene *scene)
{
  baum_study_destroy(scene->study);
  baum_mechanism_destroy(scene->mechanism);
  *scene = (report_scene){NULL, NULL};
}
