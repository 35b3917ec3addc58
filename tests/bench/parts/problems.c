/* SPDX-License-Identifier: BSD-3-Clause */
#include "problems.h"

#include <stdio.h>

#include "a01_pendulum_reference.h"
#include "catalog/data/andrews.h"
#include "catalog/data/four_bar.h"
#include "catalog/data/slider_crank_eccentric.h"

static baum_status pendulum(model *out)
{
  return model_pendulum_rod(&MODEL_PENDULUM_A01, out);
}

static baum_status slider_crank(model *out)
{
  return model_slider_crank_build((model_slider_crank){.driven = false}, out);
}

static baum_status window(model *out)
{
  model_n_four_bar data = model_n_four_bar_a02(1);
  return model_n_four_bar_build(&data, out);
}

/* The angle th of the cranks of the N-four-bar with N = 1. It was computed from (5/3) th'' = -2 g
 * cos th by Taylor series with 30 digits (odefun of mpmath). Results with two tolerances agree to
 * 7e-20. */
enum { WINDOW_SAMPLES = 10 };
static const double WINDOW_T[WINDOW_SAMPLES] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0};
static const double WINDOW_ANGLE[WINDOW_SAMPLES] = {
  -1.8345566611421618, -4.789550999536392,  -8.627895250358991,  -11.155206903457577,
  -15.37448094142013,  -17.531807600725852, -22.057450423996066, -23.925640687038975,
  -28.672795261942145, -30.343944970943127,
};

static void take_angle(const double *q, double *out)
{
  out[0] = q[2];
}

static const problem PROBLEMS[] = {
  {"pendulum",
   "pendulum A01, 10 s",
   {.samples = A01_PENDULUM_SAMPLES,
    .width = A01_PENDULUM_WIDTH,
    .t = A01_PENDULUM_T,
    .q = A01_PENDULUM_Q[0],
    .lengths = "mm"},
   0.1,
   pendulum},
  {"slider_crank",
   "free slider-crank, 0.2 s: 5 turns",
   {.samples = SLIDER_CRANK_ECCENTRIC_SAMPLES,
    .width = 9,
    .t = SLIDER_CRANK_ECCENTRIC_T,
    .entry = "slider_crank_eccentric",
    .lengths = "mmrmmrmmr"},
   2e-3,
   slider_crank},
  {"four_bar",
   "Grashof four-bar, 5 s",
   {.samples = FOUR_BAR_SAMPLES,
    .width = 9,
    .t = FOUR_BAR_T,
    .entry = "four_bar",
    .lengths = "mmrmmrmmr"},
   0.05,
   model_four_bar},
  {"andrews",
   "Andrews' mechanism, 7 bodies, 0.03 s",
   {.samples = ANDREWS_SAMPLES,
    .width = ANDREWS_WIDTH,
    .t = ANDREWS_T,
    .q = ANDREWS_Q[0],
    .lengths = "rrrrrrr",
    .columns = model_andrews_from_bodies},
   5e-4,
   model_andrews_bodies},
  {"window",
   "N-four-bar N = 1, 10 s, through flat positions",
   {.samples = WINDOW_SAMPLES,
    .width = 1,
    .t = WINDOW_T,
    .q = WINDOW_ANGLE,
    .lengths = "r",
    .columns = take_angle},
   0.1,
   window},
};

const problem *problem_at(int k)
{
  int count = (int)(sizeof PROBLEMS / sizeof PROBLEMS[0]);
  return k >= 0 && k < count ? &PROBLEMS[k] : NULL;
}

void problem_pair(const baum_integrator *integrator, baum_formulation formulation,
                  char text[PAIR_SIZE])
{
  (void)snprintf(text, PAIR_SIZE, "%s/%s", baum_integrator_name(integrator),
                 baum_formulation_name(formulation));
}
