/* SPDX-License-Identifier: BSD-3-Clause */
/* The N-four-bar of problem A02 of IFToMM and A Coruna, with 40 windows. The motion starts with
 * upright cranks and ends 1e-6 s before the first flat configuration. The columns are the common
 * angle of the cranks, and the largest deviation from parallel cranks and horizontal couplers.
 * README.md in this folder says where the values come from. */
#ifndef BAUM_TEST_N_FOUR_BAR_REFERENCE_H
#define BAUM_TEST_N_FOUR_BAR_REFERENCE_H

enum { N_FOUR_BAR_SAMPLES = 17, N_FOUR_BAR_WIDTH = 2 };

static const double N_FOUR_BAR_T[17] = {0,
                                        0.050000000000000003,
                                        0.10000000000000001,
                                        0.14999999999999999,
                                        0.20000000000000001,
                                        0.25,
                                        0.29999999999999999,
                                        0.34999999999999998,
                                        0.40000000000000002,
                                        0.45000000000000001,
                                        0.5,
                                        0.55000000000000004,
                                        0.59999999999999998,
                                        0.65000000000000002,
                                        0.69999999999999996,
                                        0.71999999999999997,
                                        0.72158002482565686};

static const double N_FOUR_BAR_Q[17][2] = {
  {1.5707963267948966, 0.0},   {1.5205656391895348, 0.0},     {1.468943873143165, 0.0},
  {1.4145051927692005, 0.0},   {1.3557543317778109, 0.0},     {1.2910923439275874, 0.0},
  {1.2187836823980274, 0.0},   {1.1369265127687791, 0.0},     {1.0434297842587767, 0.0},
  {0.93600307193692311, 0.0},  {0.81216881071213343, 0.0},    {0.66931136208159081, 0.0},
  {0.50478293598564206, 0.0},  {0.31609100934071599, 0.0},    {0.10119146866619078, 0.0},
  {0.007587964999799926, 0.0}, {4.8081332742016099e-06, 0.0},
};

#endif
