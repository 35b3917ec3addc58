/* SPDX-License-Identifier: BSD-3-Clause */
/* The data of Andrews' squeezing mechanism in SI units, and a function that computes its angles.
 * The values are taken from the Bari test set (andrews.f). */
#ifndef BAUM_I_CATALOG_ANDREWS_H
#define BAUM_I_CATALOG_ANDREWS_H

/* These arrays have one entry for each of the bodies K1 to K7 of the test set, in this order. */
static const double ANDREWS_MASS[7] = {.04325, .00365, .02373, .00706, .07050, .00706, .05498};
static const double ANDREWS_INERTIA[7] = {2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7,
                                          1.169e-5, 5.667e-7, 1.912e-5};

static const double ANDREWS_O[2] = {0, 0};
static const double ANDREWS_A[2] = {-.06934, -.00227};
static const double ANDREWS_B[2] = {-.03635, .03273};
static const double ANDREWS_C[2] = {.014, .072};

#define ANDREWS_START  -0.0617138900142764496 /* the value of beta at which Theta = 0 */
#define ANDREWS_C0     4530.0                 /* [N/m] stiffness of the spring */
#define ANDREWS_L0     .07785                 /* [m] free length of the spring */
#define ANDREWS_MOMENT .033

#define ANDREWS_RR .007
#define ANDREWS_RA .00092
#define ANDREWS_D  .028
#define ANDREWS_DA .0115
#define ANDREWS_SS .035
#define ANDREWS_SA .01874
#define ANDREWS_SB .01043
#define ANDREWS_SC .018
#define ANDREWS_SD .02
#define ANDREWS_E  .02
#define ANDREWS_EA .01421
#define ANDREWS_ZT .04
#define ANDREWS_TA .02308
#define ANDREWS_TB .00916
#define ANDREWS_ZF .02
#define ANDREWS_FA .01421
#define ANDREWS_U  .04
#define ANDREWS_UA .01228
#define ANDREWS_UB .00449

#define ANDREWS_SOURCE                                                                   \
  "Bari test set, andrews.f (copy in the GitHub repository cran/deTestSet); E. Hairer, " \
  "G. Wanner, Solving ODEs II, p. 530 ff"
#define ANDREWS_PROVENANCE                                                                        \
  "extrapolation in 160-bit arithmetic; results with two tolerances agree to 16.5 digits; "       \
  "a second, independent model in double precision agrees to 13.1 digits; the motion differs by " \
  "1.4e-9 from the published values at 0.03 s, which have 10 digits"

enum { ANDREWS_ANGLES = 7 };

/* Computes the angles beta, Theta, gamma, Phi, delta, Omega and epsilon for a given beta. The loop
 * equations have several solutions. The function finds the solution that is reached by continuous
 * motion from the initial configuration of the test set. */
void baum_i_andrews_pose(double beta, double angles[ANDREWS_ANGLES]);

#endif
