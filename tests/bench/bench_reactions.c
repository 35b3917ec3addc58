/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests whether reactions balance the forces if rows are redundant and masses are very different.
 *
 *   bench_reactions [COUNT [FIRST_SEED]]     1000 mechanisms from seed 0 by default
 *
 * The reactions of each mechanism are computed in a configuration that satisfies the constraints,
 * and in configurations that violate them by 1e-6 and 1e-3. They are computed both by a workspace
 * and by a run. The program prints and counts the results in which forces are out of balance by
 * more than 1e-9 of their size. It fails if there are any. It also prints the reaction of a bracket
 * for mass ratios of up to 1e14.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "redundant_mechanism.h"

static const char *const STATES[REDUNDANT_STATES] = {"on the constraints", "violated by 1e-6",
                                                     "violated by 1e-3"};

static long report(const char *what, long counts[][REDUNDANT_VERDICTS])
{
  long wrong = 0;
  for (int k = 0; k < REDUNDANT_STATES; k++) {
    (void)printf("%-10s %-20s %5ld right, %5ld refused, %5ld wrong\n", what, STATES[k],
                 counts[k][REDUNDANT_MET], counts[k][REDUNDANT_REFUSED],
                 counts[k][REDUNDANT_WRONG]);
    wrong += counts[k][REDUNDANT_WRONG];
  }
  return wrong;
}

static long hold_bracket(double ratio)
{
  baum_joint_id hold;
  double force[3] = {0.0};
  double q[6] = {0.4, -0.3, 0.0, 1.2, -0.9, 0.0};
  double v[6] = {0.0};
  double lambda[8];
  baum_workspace *w = NULL;
  baum_mechanism *m = redundant_bracket(ratio, &hold);
  baum_status status = baum_workspace_create(m, &w);
  if (status >= BAUM_OK) {
    status = baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, NULL, lambda);
  }
  if (status >= BAUM_OK) {
    status = baum_workspace_reaction(w, 0.0, q, lambda, hold, force);
  }
  (void)printf("ratio %.0e: %s, the bracket holds %.12g N\n", ratio, baum_status_name(status),
               force[1]);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
  return status >= BAUM_OK && !(fabs(force[1] - 9.81) <= 9.81e-9) ? 1 : 0;
}

int main(int count, char **arguments)
{
  redundant_tally tally = {.worst = 0.0};
  uint64_t mechanisms = count > 1 ? strtoull(arguments[1], NULL, 10) : 1000;
  uint64_t first = count > 2 ? strtoull(arguments[2], NULL, 10) : 0;
  long wrong = 0;
  for (int power = 0; power <= 14; power++) {
    wrong += hold_bracket(pow(10.0, power));
  }
  for (uint64_t k = 0; k < mechanisms; k++) {
    redundant_judge(first + k, &tally);
  }
  wrong += report("workspace", tally.workspace);
  wrong += report("run", tally.run);
  wrong += tally.wrong_unique;
  (void)printf(
    "largest imbalance of right ones: %.2g; %ld multipliers whose uniqueness is reported wrongly\n",
    tally.worst, tally.wrong_unique);
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
