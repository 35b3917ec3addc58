/* SPDX-License-Identifier: BSD-3-Clause */
/* The integrators of SUNDIALS in a build without it: they have their names and formulations, and refuse to run. */
#include "integrate/integrator.h"

#if !BAUM_HAVE_SUNDIALS

#include "base/message.h"

static baum_status refuse(const char *name, void **out)
{
  *out = NULL;
  return baum_i_fail(BAUM_ERR_UNSUPPORTED, "%s needs SUNDIALS, which this build does not have",
                     name);
}

static void destroy(void *self)
{
  (void)self;
}

static const baum_formulation ADAMS_FORMULATIONS[] = {
  BAUM_FORMULATION_BAUMGARTE,
  BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_DEFAULT,
};

static const baum_formulation BDF_FORMULATIONS[] = {
  BAUM_FORMULATION_PROJECTION,
  BAUM_FORMULATION_BAUMGARTE,
  BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_DEFAULT,
};

static const baum_formulation IDA_FORMULATIONS[] = {
  BAUM_FORMULATION_GGL,    BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED,
  BAUM_FORMULATION_INDEX2, BAUM_FORMULATION_INDEX3,    BAUM_FORMULATION_DEFAULT,
};

static baum_status create_adams(const baum_i_problem *problem, const baum_i_state *start,
                                void **out)
{
  (void)problem;
  (void)start;
  return refuse("cvode_adams", out);
}

static baum_status create_bdf(const baum_i_problem *problem, const baum_i_state *start, void **out)
{
  (void)problem;
  (void)start;
  return refuse("cvode_bdf", out);
}

static baum_status create_ida(const baum_i_problem *problem, const baum_i_state *start, void **out)
{
  (void)problem;
  (void)start;
  return refuse("ida", out);
}

static const baum_integrator ADAMS = {
  .name = "cvode_adams",
  .formulations = ADAMS_FORMULATIONS,
  .why_no_projection = "CVODE projects only within BDF",
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_ADAMS,
  .create = create_adams,
  .destroy = destroy,
};

static const baum_integrator BDF = {
  .name = "cvode_bdf",
  .formulations = BDF_FORMULATIONS,
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_BDF,
  .create = create_bdf,
  .destroy = destroy,
};

static const baum_integrator IDA = {
  .name = "ida",
  .formulations = IDA_FORMULATIONS,
  .gains = BAUM_GAINS_AUTO,
  .family = BAUM_I_FAMILY_BDF,
  .tests_multipliers = true,
  .solves_residuals = true,
  .create = create_ida,
  .destroy = destroy,
};

const char *baum_i_sundials_version(void)
{
  return "none";
}

const baum_integrator *baum_cvode_adams(void)
{
  return &ADAMS;
}

const baum_integrator *baum_cvode_bdf(void)
{
  return &BDF;
}

const baum_integrator *baum_ida(void)
{
  return &IDA;
}

#endif
