/* SPDX-License-Identifier: BSD-3-Clause */
/* Descriptions of the solver of accelerations. */
#include <stdio.h>

#include "dynamics/block_path.h"

static int count_joints(const baum_mechanism *m, int body)
{
  int count = 0;
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_span *span = &m->joints[k]->span;
    for (int i = 0; i < span->body_count; i++) {
      count += span->bodies[i] == body ? 1 : 0;
    }
  }
  return count;
}

static void blocks_text(const baum_workspace *w, const baum_i_block_path *path, char *text,
                        size_t size)
{
  const baum_i_block *block = path->block;
  char fixed[64] = "";
  if (path->fixed_count > 0) {
    (void)snprintf(fixed, sizeof fixed, "; %d fixed %s omitted", path->fixed_count,
                   path->fixed_count == 1 ? "body" : "bodies");
  }
  (void)snprintf(text, size, "blocks, %d %s, %d %s%s%s", block->node_count,
                 block->node_count == 1 ? "node" : "nodes", block->off_count,
                 block->off_count == 1 ? "coupling" : "couplings", fixed,
                 w->blocks_only ? ", no other solver" : "; klu and qr where pivots are bad");
}

void baum_i_blocks_reason(const baum_workspace *w, char text[BAUM_I_SOLVER_TEXT_SIZE])
{
  size_t size = BAUM_I_SOLVER_TEXT_SIZE;
  const baum_mechanism *m = w->mechanism;
  int body = w->verdict.body;
  char label[BAUM_I_LABEL_SIZE] = "a body";
  if (body > 0) {
    (void)baum_i_label(&m->bodies[body]->element, label);
  }
  switch (w->verdict.blocks) {
  case BAUM_I_BLOCKS_CROWDED:
    (void)snprintf(text, size, "%.150s has %d joints, too many for blocks", label,
                   count_joints(m, body));
    break;
  case BAUM_I_BLOCKS_FILLED:
    (void)snprintf(text, size, "the joints form a dense net, so blocks would fill");
    break;
  case BAUM_I_BLOCKS_MASSLESS:
    (void)snprintf(text, size, "the mass matrix of %.150s is not positive definite", label);
    break;
  case BAUM_I_BLOCKS_UNKNOWN:
    (void)snprintf(text, size, "mass or force cannot be evaluated in the design configuration");
    break;
  case BAUM_I_BLOCKS_SUIT:
  case BAUM_I_BLOCKS_UNWANTED:
  default: (void)snprintf(text, size, "another solver was chosen"); break;
  }
}

void baum_i_solver_text(const baum_workspace *w, char text[BAUM_I_SOLVER_TEXT_SIZE])
{
  const baum_i_block_path *path = w->motion;
  if (path) {
    blocks_text(w, path, text, BAUM_I_SOLVER_TEXT_SIZE);
    return;
  }
  char reason[BAUM_I_SOLVER_TEXT_SIZE];
  baum_i_blocks_reason(w, reason);
  (void)snprintf(text, BAUM_I_SOLVER_TEXT_SIZE, "%s on the whole system: %.200s",
                 baum_i_kkt_backend(w->kkt), reason);
}
