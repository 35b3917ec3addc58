/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes the messages that explain why gains were chosen or refused. */
#ifndef BAUM_I_STABILIZATION_GAIN_TEXT_H
#define BAUM_I_STABILIZATION_GAIN_TEXT_H

#include "stabilization/gains.h"

enum { BAUM_I_GAIN_NOTE_SIZE = 128 };

/* Gains, both in 1/s and multiplied by the step, and a note about them. */
typedef struct baum_i_gain_draft {
  double alpha;
  double beta;
  double alpha_h; /* alpha_h and beta2_h2 are NaN if there is no step */
  double beta2_h2;
  char note[BAUM_I_GAIN_NOTE_SIZE];
} baum_i_gain_draft;

/* Amplification of rows of positions and of rows of velocity level. */
typedef struct baum_i_two_amplifications {
  baum_amplification positions;
  baum_amplification velocities;
  /* True if the mechanism has only rows of velocity level, or if its rows of velocity level have
   * the larger spectral radius. */
  bool by_velocities;
} baum_i_two_amplifications;

/* Sets the members `why` and `doubtful` of a choice. All numbers of the choice must have been
 * set. */
void baum_i_gain_explain(const char *rule, const baum_i_gain_context *context,
                         const baum_i_gain_draft *gains, const baum_i_two_amplifications *two,
                         baum_i_gain_choice *choice);

/* Fails with BAUM_ERR_UNSTABLE. The message gives the region of stability, the requested point and
 * the nearest point with a spectral radius of at most 0.9. */
baum_status baum_i_gain_refuse(const baum_i_gain_context *context, const baum_i_gain_draft *gains,
                               double radius);

/* Fails with BAUM_ERR_UNSTABLE because rows of velocity level are unstable. The message gives the
 * requested point and the limit of stability. */
baum_status baum_i_gain_refuse_velocities(const baum_i_gain_context *context,
                                          const baum_i_gain_draft *gains,
                                          const baum_amplification *velocities);

/* Fails with BAUM_ERR_UNSUPPORTED. The message says why the method has no dead-beat point, and
 * gives its best point. */
baum_status baum_i_gain_refuse_deadbeat(const baum_i_gain_context *context, double alpha_h,
                                        double beta2_h2, double radius);

#endif
