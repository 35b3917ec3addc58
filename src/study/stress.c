/* SPDX-License-Identifier: BSD-3-Clause */
/* Settings for a stress test of a user's mechanism. Steps, tolerances and gains vary by factors of
 * ten over a wide range. */
#include <math.h>

#include "base/text.h"
#include "integrate/integrator.h"
#include "study/study.h"

static const double PI = 3.14159265358979323846;

/* Exponents of ten. Steps are 10^-1 to 10^-9 periods, rtol is 10^-2 to 10^-14, and gains are 10^-6
 * to 10^12 1/s.
 */
enum {
  FIRST_STEP = 1,
  LAST_STEP = 9,
  FIRST_RTOL = 2,
  LAST_RTOL = 14,
  FIRST_GAIN = -6,
  LAST_GAIN = 12,
  STEP_WITH_GAINS = 3,
  RTOL_WITH_GAINS = 7
};

typedef struct ladders {
  baum_study *study;
  double period; /* [s] period of the motion */
} ladders;

static baum_status add_step(const ladders *l, baum_simulation_options o, int decade)
{
  o.step = l->period * pow(10.0, -decade);
  return baum_study_add(l->study, &o);
}

static baum_status add_rtol(const ladders *l, baum_simulation_options o, int decade)
{
  o.rtol = pow(10.0, -decade);
  return baum_study_add(l->study, &o);
}

static baum_status add_settings(const ladders *l, const baum_simulation_options *o)
{
  bool fixed = baum_integrator_has_fixed_step(o->integrator);
  bool variable = baum_integrator_has_variable_step(o->integrator);
  for (int k = FIRST_STEP; fixed && k <= LAST_STEP; k++) {
    BAUM_I_TRY(add_step(l, *o, k));
  }
  for (int k = FIRST_RTOL; variable && k <= LAST_RTOL; k++) {
    BAUM_I_TRY(add_rtol(l, *o, k));
  }
  return BAUM_OK;
}

/* Adds settings with different gains, at one moderate step or tolerance. The first setting has
 * gains of zero. The others have alpha = beta = 10^k 1/s for every exponent k in the range. */
static baum_status add_gains(const ladders *l, baum_simulation_options o)
{
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  bool variable = baum_integrator_has_variable_step(o.integrator);
  for (int k = FIRST_GAIN - 1; k <= LAST_GAIN; k++) {
    double gain = k < FIRST_GAIN ? 0.0 : pow(10.0, k);
    o.gains = baum_gains_fixed(gain, gain);
    BAUM_I_TRY(variable ? add_rtol(l, o, RTOL_WITH_GAINS) : add_step(l, o, STEP_WITH_GAINS));
  }
  return BAUM_OK;
}

static baum_status add_integrator(void *user, const baum_integrator *integrator)
{
  const ladders *l = user;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  BAUM_I_TRY(add_settings(l, &o));
  return baum_integrator_offers(integrator, BAUM_FORMULATION_BAUMGARTE) ? add_gains(l, o) : BAUM_OK;
}

baum_status baum_study_add_stress(baum_study *study, const baum_integrator *integrator)
{
  const char *call = "baum_study_add_stress";
  BAUM_I_TRY(baum_i_study_check(study, call));
  double rate = 0.0;
  BAUM_I_TRY(baum_i_study_rate(study, &rate));
  ladders l = {.study = study, .period = 2.0 * PI / rate};
  const char *wanted = integrator ? baum_integrator_name(integrator) : "integrator";
  const baum_i_text missing =
    baum_i_text_of("%s: this build has no %s with a step or a tolerance", call, wanted);
  return baum_i_study_add_each(study, integrator, add_integrator, &l, missing.text);
}
