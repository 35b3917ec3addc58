/* SPDX-License-Identifier: BSD-3-Clause */
/* Random mechanisms of slender rods. Their accelerations are compared with a solution of the same
 * equations in quadruple precision. A mechanism consists of up to three islands whose masses,
 * lengths and accelerations differ by large factors. Joints lie on the axes of the rods or near
 * them, and half of the rods have full inertia tensors. Three quarters of the rods are slender: the
 * ratio of their axial moment of inertia to the transverse one is 0, or between 1e-12 and 1e-3. The
 * ratio of all other rods is between 0.5 and 1. */
#ifndef BAUM_TEST_SLENDER_RODS_H
#define BAUM_TEST_SLENDER_RODS_H

#include "random_mechanism.h"

typedef enum slender_verdict {
  SLENDER_RIGHT,    /* the error is at most SLENDER_ERROR */
  SLENDER_ROUNDED,  /* rounding M, J, g and gamma explains the error */
  SLENDER_UNJUDGED, /* rounding explains the error, but changes accelerations by more than 1e-3 */
  SLENDER_REFUSED,  /* refused; rows are dependent, or rounding has the effect stated above */
  SLENDER_FALSE_REFUSAL,
  SLENDER_WRONG, /* wrong without a message */
  SLENDER_VERDICTS
} slender_verdict;

/* The largest permitted error. Errors in an island are relative to the largest acceleration in this
 * island, without the angular accelerations of slender rods about their axes. If one of these
 * angular accelerations is larger, its error is relative to its own size. Accelerations of origins
 * are divided by the length of the island. A thousand times the effect of rounding is added to this
 * limit. */
static const double SLENDER_ERROR = 1e-9;

/* Mechanisms are counted in classes, by the smallest ratio of the axial to the transverse moment of
 * inertia of their rods. Each class covers one decade of this ratio. The last class is for the
 * ratio 0. */
enum { SLENDER_CLASSES = 14 };

typedef struct slender_tally {
  long mechanisms;
  long not_projected;
  long counts[SLENDER_VERDICTS];
  long by_class[SLENDER_CLASSES][SLENDER_VERDICTS];
  double worst;         /* largest error of SLENDER_RIGHT */
  double worst_rounded; /* largest error of SLENDER_ROUNDED */
} slender_tally;

/* Tests the mechanism of a seed in two configurations. `unit` is the number of units of length in a
 * metre. *first is the verdict of the first configuration, unless it is NULL. */
void slender_judge(uint64_t seed, double unit, slender_tally *tally, slender_verdict *first);

#endif
