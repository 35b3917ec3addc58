/* SPDX-License-Identifier: BSD-3-Clause */
/* Methods that get a colour. A line can be told from so many others and no more.
 *
 * The best method of each integrator comes first, then the best of what is left. Good is what costs little work wherever
 * it reaches an error: the mean over errors of the decades of work above the cheapest, with MISSED decades for errors
 * that it does not reach.
 */
#include <math.h>

#include "study/report.h"

enum { ERRORS = 6 }; /* 1e-1, 1e-3, ... 1e-11 */
static const double MISSED = 3.0;

static double work_at(const baum_i_snapshot *snapshot, int method, int k)
{
  double work = (double)NAN;
  double error = pow(10.0, -1.0 - 2.0 * k);
  baum_status status = baum_study_cost_at(snapshot->study, method, error, BAUM_STUDY_WORK, &work);
  return status == BAUM_OK ? work : (double)NAN;
}

static void find_cheapest(const baum_i_snapshot *snapshot, double cheapest[ERRORS])
{
  for (int k = 0; k < ERRORS; k++) {
    cheapest[k] = (double)NAN;
    for (int m = 0; m < snapshot->method_count; m++) {
      cheapest[k] = fmin(cheapest[k], work_at(snapshot, m, k));
    }
  }
}

/* Decades of work above the cheapest, summed over the errors that anyone reaches. */
static double score(const baum_i_snapshot *snapshot, int method, const double cheapest[ERRORS])
{
  double sum = 0.0;
  for (int k = 0; k < ERRORS; k++) {
    if (!isnan(cheapest[k])) {
      double decades = log10(work_at(snapshot, method, k) / cheapest[k]);
      sum += isnan(decades) ? MISSED : decades;
    }
  }
  return sum;
}

static bool is_taken(const baum_i_snapshot *snapshot, const baum_i_highlights *taken, int method,
                     bool by_integrator)
{
  for (int k = 0; k < taken->count; k++) {
    const baum_study_method *other = &snapshot->methods[taken->methods[k]];
    if (taken->methods[k] == method ||
        (by_integrator && other->integrator == snapshot->methods[method].integrator)) {
      return true;
    }
  }
  return false;
}

/* -1: there is none left. */
static int best_left(const baum_i_snapshot *snapshot, const double cheapest[ERRORS],
                     const baum_i_highlights *taken, bool by_integrator)
{
  int best = -1;
  double least = INFINITY;
  for (int m = 0; m < snapshot->method_count; m++) {
    if (snapshot->methods[m].usable > 0 && !is_taken(snapshot, taken, m, by_integrator)) {
      double s = score(snapshot, m, cheapest);
      if (s < least) {
        least = s;
        best = m;
      }
    }
  }
  return best;
}

baum_i_highlights baum_i_choose_highlights(const baum_i_snapshot *snapshot)
{
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  double cheapest[ERRORS];
  find_cheapest(snapshot, cheapest);
  baum_i_highlights out = {.count = 0};
  for (int pass = 0; pass < 2; pass++) {
    int best = 0;
    while (out.count < BAUM_I_HIGHLIGHTS && best >= 0) {
      best = best_left(snapshot, cheapest, &out, pass == 0);
      if (best >= 0) {
        out.methods[out.count++] = best;
      }
    }
  }
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return out;
}

int baum_i_highlight_of(const baum_i_highlights *highlights, int method)
{
  for (int k = 0; k < highlights->count; k++) {
    if (highlights->methods[k] == method) {
      return k;
    }
  }
  return -1;
}
