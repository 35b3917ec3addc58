/* SPDX-License-Identifier: BSD-3-Clause */
/* Contains the texts that say with which gains violations decay, for each kind of method.
 *
 * Explicit methods with variable steps: outside of the region of stability, violations grow until
 * the error test reduces the step (Hairer, Wanner 1996, IV.2). For this reason gains.c limits the
 * step of such a run. Adams-Moulton methods treat the terms that contain the gains implicitly.
 * Their orders 1 and 2 are A-stable. Orders 3, 4, 5 and 6 are stable on the real axis down to
 * mu = -6, -3, -90/49 and -45/38, where z = -1. Beyond these limits the error test has to lower the
 * order or the step, as it does for explicit methods. BDF of order k is A(a_k)-stable, with
 * a_5 = 51.84 degrees (Hairer, Wanner 1996, V.2). The ratio alpha / beta is the cosine of the angle
 * between the roots of s^2 + 2 alpha s + beta^2 = 0 and the negative real axis. The limit for this
 * ratio is therefore cos 51.84 degrees = 0.618. */
#include "stabilization/amplification.h"

static const char *of_variable_step(baum_i_method_family family)
{
  if (family == BAUM_I_FAMILY_BDF) {
    return "BDF, variable step: orders 1 to 5 are A(51.84 degrees)-stable. If alpha / beta >= "
           "0.618, violations therefore decay at any alpha h. If alpha / beta is smaller, they may "
           "grow at orders 3 to 5 until the error test shortens the step.";
  }
  return "Adams-Moulton, variable step: orders 1 and 2 damp violations with any gains. Higher "
         "orders damp them in bounded regions (with critical damping up to alpha h = 6 at order 3 "
         "and 3 at order 4). The error test keeps order and step inside these regions. Violations "
         "therefore decay for any gains, and high gains cost steps.";
}

const char *baum_i_method_statement(const baum_i_method *method, baum_i_method_family family,
                                    bool chooses_step)
{
  switch (method->kind) {
  case BAUM_I_METHOD_VARIABLE_STEP: return of_variable_step(family);
  case BAUM_I_METHOD_WITHOUT_GAINS:
    return "Fixed step; the method keeps the constraints by itself and takes no gains.";
  case BAUM_I_METHOD_ONE_STEP:
  case BAUM_I_METHOD_SEMI_IMPLICIT:
  case BAUM_I_METHOD_ADAMS_BASHFORTH:
  default: break;
  }
  if (chooses_step) {
    return "With a fixed step, violations decay where the spectral radius at (alpha h, beta^2 h^2) "
           "is below 1. With variable steps, the same region caps the step: it is at most 0.9 of "
           "the step at which violations would stop decaying. Violations therefore decay for any "
           "gains, and high gains cost steps.";
  }
  return "Fixed step: violations decay where the spectral radius at (alpha h, beta^2 h^2) is below "
         "1, and grow where it is above.";
}
