/* SPDX-License-Identifier: BSD-3-Clause */
/* Gains from a rule. */
#ifndef BAUM_I_STABILIZATION_GAINS_H
#define BAUM_I_STABILIZATION_GAINS_H

#include <stdbool.h>

#include "stabilization/amplification.h"

/* Data that a rule may depend on. */
typedef struct baum_i_gain_context {
  const baum_i_method *method;
  baum_i_method_family family; /* of a method with variable steps */
  const char *integrator;      /* name, for messages */
  double step;                 /* [s] > 0, or NaN for variable step */
  double rate;                 /* [1/s] >= 0 angular rate of the motion */
  const char *rate_is;         /* what the rate is, for messages */
  bool driven;                 /* drivers prescribe all degrees of freedom */
  bool velocity_rows;          /* there are rows of velocity level */
  bool no_position_rows;       /* all rows are of velocity level */
  baum_gain_rule rule_default; /* meaning of BAUM_GAINS_DEFAULT for this integrator */
  bool allow_unstable;
} baum_i_gain_context;

/* The gains chosen by a rule. */
typedef struct baum_i_gain_choice {
  double alpha;        /* [1/s] */
  double beta;         /* [1/s] */
  baum_gain_rule rule; /* the rule that was applied */
  /* at (alpha h, beta^2 h^2); of the rows of positions or of velocity level, of those whose
   * violations decay more slowly */
  baum_amplification amplification;
  /* [s] largest stable step of an explicit method with variable steps; otherwise infinite */
  double max_step;
  char why[400]; /* message with rule, numbers and stability */
  bool doubtful; /* `why` is a warning: violations may stay or grow */
} baum_i_gain_choice;

/* Applies a rule and checks the stability of its gains. Returns BAUM_OK, BAUM_ERR_ARGUMENT (invalid
 * numbers, or a rule that requires a fixed step), BAUM_ERR_UNSUPPORTED (the method has no dead-beat
 * point), BAUM_ERR_UNSTABLE (the message contains (alpha h, beta^2 h^2), the spectral radius, the
 * stable region and the nearest good pair, in 1/s and scaled). Marginal pairs are accepted with
 * BAUM_OK, and the caller warns. */
baum_status baum_i_gains_choose(const baum_gains *gains, const baum_i_gain_context *context,
                                baum_i_gain_choice *out);

#endif
