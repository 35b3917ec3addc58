/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes gains by a rule. */
#ifndef BAUM_I_STABILIZATION_GAINS_H
#define BAUM_I_STABILIZATION_GAINS_H

#include <stdbool.h>

#include "stabilization/amplification.h"

/* The data on which a rule may depend. */
typedef struct baum_i_gain_context {
  const baum_i_method *method;
  baum_i_method_family family; /* for methods with variable steps */
  const char *integrator;      /* name of the integrator, for messages */
  double step;                 /* [s] > 0, or NaN if the step is variable */
  double rate;                 /* [1/s] >= 0, the angular rate of the motion */
  const char *rate_is;         /* describes the rate, for messages */
  bool driven;                 /* whether drivers prescribe all degrees of freedom */
  bool velocity_rows;          /* whether there are rows of velocity level */
  bool no_position_rows;       /* whether all rows are of velocity level */
  baum_gain_rule rule_default; /* the rule that BAUM_GAINS_DEFAULT means for this integrator */
  bool allow_unstable;
} baum_i_gain_context;

/* The gains chosen by a rule. */
typedef struct baum_i_gain_choice {
  double alpha;        /* [1/s] */
  double beta;         /* [1/s] */
  baum_gain_rule rule; /* the rule that was applied */
  /* The amplification at the point (alpha h, beta^2 h^2). If there are rows of positions and of
   * velocity level, it is that of the rows whose violations decay more slowly. */
  baum_amplification amplification;
  /* [s] The limit of the step of an explicit method with variable steps: 0.9 of its largest stable
   * step. It is infinite for other methods. */
  double max_step;
  char why[400]; /* message that gives the rule, the numbers and the stability */
  bool doubtful; /* whether `why` is a warning that violations may stay or grow */
} baum_i_gain_choice;

/* Applies a rule and checks the stability of its gains. Returns BAUM_OK if the gains can be used.
 * Returns BAUM_ERR_ARGUMENT for invalid numbers, and if the rule requires a fixed step but the step
 * is variable. Returns BAUM_ERR_UNSUPPORTED if the method has no dead-beat point. Returns
 * BAUM_ERR_UNSTABLE if the gains are unstable. The message then gives (alpha h, beta^2 h^2), the
 * spectral radius, the stable region and the nearest pair of gains with a spectral radius of at
 * most 0.9, in 1/s and multiplied by the step. Gains at which violations neither decay nor grow are
 * accepted with BAUM_OK, and the caller warns. */
baum_status baum_i_gains_choose(const baum_gains *gains, const baum_i_gain_context *context,
                                baum_i_gain_choice *out);

#endif
