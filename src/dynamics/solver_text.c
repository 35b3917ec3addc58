/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes texts that describe the solver for accelerations and explain why it was chosen. */

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

static baum_i_text blocks_text(const baum_workspace *w, const baum_i_block_path *path)
{
  const baum_i_block_size size = baum_i_block_path_size(path);
  baum_i_text fixed = {""};
  if (path->fixed_count > 0) {
    fixed = baum_i_text_of("; %d fixed %s omitted", path->fixed_count,
                           path->fixed_count == 1 ? "body" : "bodies");
  }
  return baum_i_text_of("blocks, %d %s, %d %s%s%s", size.nodes, size.nodes == 1 ? "node" : "nodes",
                        size.couplings, size.couplings == 1 ? "coupling" : "couplings", fixed.text,
                        w->blocks_only ? ", no other solver" : "; klu and qr where pivots are bad");
}

baum_i_text baum_i_blocks_reason(const baum_workspace *w)
{
  const baum_mechanism *m = w->mechanism;
  int body = w->verdict.body;
  const baum_i_text label =
    body > 0 ? baum_i_label(&m->bodies[body]->element) : (baum_i_text){"a body"};
  switch (w->verdict.blocks) {
  case BAUM_I_BLOCKS_CROWDED:
    return baum_i_text_of("%.150s has %d joints, too many for blocks", label.text,
                          count_joints(m, body));
  case BAUM_I_BLOCKS_FILLED:
    return (baum_i_text){
      "the joints form a dense net, so the block solver would have too much fill"};
  case BAUM_I_BLOCKS_MASSLESS:
    return baum_i_text_of("the mass matrix of %.150s is not positive definite", label.text);
  case BAUM_I_BLOCKS_UNKNOWN:
    return (baum_i_text){"mass or force cannot be evaluated in the design configuration"};
  case BAUM_I_BLOCKS_SUIT:
  case BAUM_I_BLOCKS_UNWANTED:
  default: return (baum_i_text){"another solver was chosen"};
  }
}

baum_i_text baum_i_solver_text(const baum_workspace *w)
{
  return w->motion ? blocks_text(w, w->motion)
                   : baum_i_text_of("%s on the whole system: %.200s", baum_i_kkt_backend(w->kkt),
                                    baum_i_blocks_reason(w).text);
}
