/* SPDX-License-Identifier: BSD-3-Clause */
/* Names of settings, and the keys by which settings are distinguished. */
#include <math.h>

#include "base/digest.h"
#include "base/text.h"
#include "integrate/integrator.h"
#include "study/study.h"

const char *baum_study_state_name(baum_study_state state)
{
  static const char *const NAMES[] = {"waiting", "done", "refused", "failed", "timed_out"};
  int count = (int)(sizeof NAMES / sizeof NAMES[0]);
  return (int)state >= 0 && (int)state < count ? NAMES[state] : NULL;
}

static void name_gains(const baum_simulation_options *o, char *text, size_t size)
{
  int32_t rule =
    o->gains.rule == BAUM_GAINS_DEFAULT ? (int32_t)o->integrator->gains : o->gains.rule;
  const double *value = o->gains.value;
  switch ((baum_gain_rule)rule) {
  case BAUM_GAINS_FIXED:
    baum_i_append(text, size, " alpha %.4g beta %.4g 1/s", value[0], value[1]);
    break;
  case BAUM_GAINS_SCALED:
    baum_i_append(text, size, " alpha h %.4g beta^2 h^2 %.4g", value[0], value[1]);
    break;
  case BAUM_GAINS_FREQUENCY:
    baum_i_append(text, size, " %.4g Hz ratio %.4g", value[0], value[1]);
    break;
  case BAUM_GAINS_TAYLOR: baum_i_append(text, size, " taylor"); break;
  case BAUM_GAINS_DEADBEAT: baum_i_append(text, size, " dead-beat"); break;
  case BAUM_GAINS_BEST_DAMPING: baum_i_append(text, size, " best damping"); break;
  case BAUM_GAINS_AUTO: baum_i_append(text, size, " auto"); break;
  case BAUM_GAINS_DEFAULT: break;
  }
}

baum_i_text baum_i_method_name(const baum_simulation_options *options)
{
  const char *formulation = baum_formulation_name(options->formulation);
  bool has_one = options->formulation != BAUM_FORMULATION_DEFAULT && formulation;
  baum_i_text out = baum_i_text_of("%s%s%s", options->integrator->name, has_one ? " " : "",
                                   has_one ? formulation : "");
  if (options->formulation == BAUM_FORMULATION_BAUMGARTE) {
    name_gains(options, out.text, sizeof out.text);
    if (options->row_gains) {
      baum_i_append(out.text, sizeof out.text, " by rows");
    }
  }
  return out;
}

baum_i_text baum_i_options_name(const baum_simulation_options *options)
{
  baum_i_text out = baum_i_method_name(options);
  if (!isnan(options->step)) {
    baum_i_append(out.text, sizeof out.text, ", step %.4g s", options->step);
  }
  if (!isnan(options->rtol)) {
    baum_i_append(out.text, sizeof out.text, ", rtol %.3g", options->rtol);
  }
  return out;
}

double baum_i_setting(const baum_simulation_options *options)
{
  if (!isnan(options->step)) {
    return options->step;
  }
  return isnan(options->rtol) ? 0.0 : options->rtol;
}

/* Adds a number to a digest. All NaNs give the same digest. */
static void add_number(baum_i_digest *digest, double value)
{
  double number = isnan(value) ? (double)NAN : value;
  baum_i_digest_add(digest, &number, sizeof number);
}

uint64_t baum_i_options_key(const baum_simulation_options *options, bool with_setting)
{
  baum_i_digest d = {0};
  const baum_simulation_options *o = options;
  const double numbers[] = {o->gains.value[0],  o->gains.value[1], o->atol,
                            o->max_step,        o->tolerance_q,    o->tolerance_v,
                            o->tolerance_lambda};
  const int64_t integers[] = {o->formulation, o->gains.rule, o->allow_unstable, o->start,
                              o->solver,      o->max_steps,  o->row_gain_count, !isnan(o->step)};
  baum_i_digest_add_text(&d, o->integrator->name);
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
    add_number(&d, numbers[k]);
  }
  for (size_t k = 0; k < sizeof integers / sizeof integers[0]; k++) {
    baum_i_digest_add_integer(&d, integers[k]);
  }
  for (int k = 0; o->row_gains && k < o->row_gain_count; k++) {
    add_number(&d, o->row_gains[k]);
  }
  if (with_setting) {
    add_number(&d, o->step);
    add_number(&d, o->rtol);
  }
  return d.value;
}
