/* SPDX-License-Identifier: BSD-3-Clause */
/* Proportional-integral control (K. Gustafsson, ACM TOMS 17, 1991; constants: Hairer, Norsett, Wanner 1993, section
 * II.4, and Hairer, Wanner 1996, section IV.2). With the error e_n of step n in units of the tolerance, which grows with
 * h^k:
 *
 *   accepted:  h' = h 0.9 e_n^-(1/k - 3 b/4) e_(n-1)^b,   b = 0.2 / k
 *   refused:   h' = h 0.9 e_n^-(1/k)
 *
 * within [1/5, 6] h, and without growth in the step after a refusal. The second factor, from the error before, damps
 * the swinging of h where stability, not accuracy, limits it.
 */
#include "integrate/step_control.h"

#include <math.h>

static const double SAFETY = 0.9;
static const double SMALLEST = 0.2;
static const double LARGEST = 6.0;
static const double LARGEST_REFUSED = 0.9;
static const double MEMORY = 0.2;      /* b k */
static const double LEAST_LAST = 1e-4; /* an error by chance near zero says nothing of the next */

void baum_i_step_control_begin(baum_i_step_control *control, int order, double step)
{
  *control = (baum_i_step_control){.order = order, .step = step, .last = LEAST_LAST};
}

static double clamp(double factor, double largest)
{
  return fmin(fmax(factor, SMALLEST), largest);
}

void baum_i_step_control_accept(baum_i_step_control *control, double taken, double error)
{
  double k = control->order;
  double b = control->measured ? MEMORY / k : 0.0;
  double factor = SAFETY * pow(error, 0.75 * b - 1.0 / k) * pow(control->last, b);
  control->step = taken * clamp(factor, control->refused ? 1.0 : LARGEST);
  control->last = fmax(error, LEAST_LAST);
  control->refused = false;
  control->measured = true;
}

void baum_i_step_control_refuse(baum_i_step_control *control, double taken, double error)
{
  double factor = isfinite(error) ? SAFETY * pow(error, -1.0 / control->order) : 0.5;
  control->step = taken * clamp(factor, LARGEST_REFUSED);
  control->refused = true;
}

void baum_i_step_control_halve(baum_i_step_control *control, double taken)
{
  control->step = 0.5 * taken;
  control->refused = true;
}
