/* SPDX-License-Identifier: BSD-3-Clause */
/* From a gain rule to numbers. */
#ifndef BAUM_I_STABILIZATION_GAINS_H
#define BAUM_I_STABILIZATION_GAINS_H

#include <stdbool.h>

#include "stabilization/amplification.h"

/* What a rule may depend on. */
typedef struct baum_i_gain_context {
  const baum_i_method *method;
  baum_i_method_family family; /* of a method that chooses its steps */
  const char *integrator;      /* name, for messages */
  double step;                 /* [s] > 0, or NaN for variable step */
  double rate;                 /* [1/s] >= 0 angular rate of the motion */
  const char *rate_is;         /* what the rate is, for messages */
  bool driven;                 /* no freedom is left */
  baum_gain_rule rule_default; /* what BAUM_GAINS_DEFAULT means for this integrator */
  bool allow_unstable;
} baum_i_gain_context;

/* What came of it. */
typedef struct baum_i_gain_choice {
  double alpha;                     /* [1/s] */
  double beta;                      /* [1/s] */
  baum_gain_rule rule;              /* the rule that was applied */
  baum_amplification amplification; /* at (alpha h, beta^2 h^2) */
  double max_step; /* [s] explicit methods that choose their step: the largest that is stable; else
                    * infinity */
  char why[400];   /* one message: rule, numbers, stability */
  bool doubtful;   /* `why` is worth a warning: violations may stay or grow */
} baum_i_gain_choice;

/* Apply a rule and check its stability. BAUM_OK, BAUM_ERR_ARGUMENT (rule's numbers, or a rule that
 * needs a fixed step), BAUM_ERR_UNSUPPORTED (the method has no such point), BAUM_ERR_UNSTABLE (the
 * message has (alpha h, beta^2 h^2), the spectral radius, what is stable and the nearest good pair,
 * both as alpha, beta [1/s] and scaled). Marginal pairs are BAUM_OK; the caller warns. */
baum_status baum_i_gains_choose(const baum_gains *gains, const baum_i_gain_context *context,
                                baum_i_gain_choice *out);

#endif
