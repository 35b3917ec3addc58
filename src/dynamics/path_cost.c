/* SPDX-License-Identifier: BSD-3-Clause */
/* Cost of an evaluation by blocks: frames, pins (pins_hot.c) and the other joints, then the solution
 * (block_cost.c). Forces and functions of the user are not counted.
 */
#include "dynamics/block_path.h"

enum {
  SINE_AND_COSINE = 65,
  SET_PIN = 75,  /* two markers 30, Phi Phi' gamma 6, r 10, pivot 16, J a0 - r 12, its size 1 */
  PER_ENTRY = 6, /* of J of other joints, with Phi and gamma: 5 to 7 for joints of the plane */
  CHECK_PIN = 24
};

/* Numbers of J of the joints that are not pins of the block. */
static double count_entries(const baum_i_block_path *path)
{
  double count = 0.0;
  for (int k = 0; k < path->group_count; k++) {
    for (int i = 0; i < path->groups[k].count; i++) {
      const baum_i_joint *joint = path->groups[k].joints[i];
      count += (double)joint->rows * joint->span.nl;
    }
  }
  return count;
}

static double count_angles(const baum_mechanism *m)
{
  double count = 0.0;
  for (int i = 1; i <= m->body_count; i++) {
    count += m->bodies[i]->type->frame == BAUM_I_FRAME_BODY ? 1.0 : 0.0;
  }
  return count;
}

baum_i_cost baum_i_block_path_cost(const baum_mechanism *m, const baum_i_block_path *path)
{
  double number = sizeof(double);
  double pins = path->block->pin_count;
  baum_i_cost cost = baum_i_block_cost(path->block);
  cost.flops += SINE_AND_COSINE * count_angles(m) + SET_PIN * pins +
                PER_ENTRY * count_entries(path) + (path->force_is_constant ? 0.0 : m->nv) +
                (path->always_check ? CHECK_PIN * pins : 0.0);
  /* q, v, a of bodies; points, Phi, Phi', gamma and lambda of pins. */
  cost.bytes += (double)sizeof(baum_i_frame) * m->body_count + number * 3.0 * m->nv +
                number * (4.0 + 4.0 * 2.0) * pins;
  return cost;
}
