/* SPDX-License-Identifier: BSD-3-Clause */
/* Creates and destroys workspaces, which contain the memory for evaluations of a mechanism. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/block_path.h"
#include "dynamics/islands.h"
#include "mechanism/general/coordinate.h"

/* An array of the workspace. list_arrays() lists all arrays. */
typedef struct array {
  double **place;
  int count;
} array;

enum { ARRAY_COUNT = 34 };

static void list_arrays(baum_workspace *w, array list[ARRAY_COUNT])
{
  const baum_mechanism *m = w->mechanism;
  const array all[ARRAY_COUNT] = {
    {&w->mass, m->mass_size},
    {&w->jacobian, m->jacobian_size},
    {&w->phi, m->nc},
    {&w->phi_rate, m->nc},
    {&w->nu, m->nc},
    {&w->gamma, m->nc},
    {&w->force, m->nv},
    {&w->rhs, m->nc},
    {&w->a, m->nv},
    {&w->lambda, m->nc},
    {&w->work_v, 2 * m->nv},
    {&w->work_c, 2 * m->nc},
    {&w->shift, m->nc},
    {&w->sharing.part, m->nc},
    {&w->sharing.weight, m->mass_size},
    {&w->sharing.mobility, m->nc},
    {&w->sharing.work, 4 * m->nc},
    {&w->sharing.system, 4 * (m->nv + m->nc)},
    {&w->work_q, 9 * m->nq},
    {&w->rate_q, m->mass_size},
    {&w->mass_q, m->mass_size},
    {&w->body_force_q, m->mass_size},
    {&w->body_force_v, m->mass_size},
    {&w->jw_q, m->jacobian_size},
    {&w->jv_q, m->jacobian_size},
    {&w->gamma_q, m->jacobian_size},
    {&w->gamma_v, m->jacobian_size},
    {&w->nu_q, m->jacobian_size},
    {&w->jtl_q, m->joint_square_size},
    {&w->jtm_q, m->joint_square_size},
    {&w->force_q, m->force_square_size},
    {&w->force_v, m->force_square_size},
    {&w->inputs, m->input_count},
    {&w->metric, m->nv},
  };
  memcpy(list, all, sizeof all);
}

static baum_status make_arrays(baum_workspace *w)
{
  array list[ARRAY_COUNT];
  list_arrays(w, list);
  for (int i = 0; i < ARRAY_COUNT; i++) {
    *list[i].place = baum_i_alloc((size_t)list[i].count, sizeof(double));
    if (!*list[i].place) {
      return baum_i_fail_memory();
    }
  }
  w->rows.omitted = baum_i_alloc((size_t)w->mechanism->nc, 1);
  w->rows.selected = baum_i_alloc((size_t)w->mechanism->nc, 1);
  BAUM_I_TRY(baum_i_number_islands(w->mechanism, &w->island));
  return w->rows.omitted && w->rows.selected ? BAUM_OK : baum_i_fail_memory();
}

static baum_status make_structure(baum_workspace *w)
{
  const baum_mechanism *m = w->mechanism;
  baum_i_mass_block *mass = baum_i_alloc((size_t)m->body_count, sizeof *mass);
  baum_i_row_block *rows = baum_i_alloc((size_t)m->joint_count, sizeof *rows);
  w->structure = (baum_i_kkt_structure){.nv = m->nv, .nc = m->nc, .last_rows = m->velocity_rows};
  w->structure.mass_blocks = mass;
  w->structure.row_blocks = rows;
  if (!mass || !rows) {
    return baum_i_fail_memory();
  }
  w->structure.mass_block_count = m->body_count;
  w->structure.row_block_count = m->joint_count;
  for (int i = 0; i < m->body_count; i++) {
    const baum_i_body *body = m->bodies[i + 1];
    mass[i] = (baum_i_mass_block){.first = body->v, .size = body->nv, .value = body->mass};
  }
  for (int i = 0; i < m->joint_count; i++) {
    const baum_i_joint *joint = m->joints[i];
    rows[i] = (baum_i_row_block){.row = joint->row,
                                 .rows = joint->rows,
                                 .cols = joint->span.nl,
                                 .col = joint->span.columns,
                                 .value = joint->jacobian};
  }
  return BAUM_OK;
}

/* Set the inputs to their initial values. */
static void set_inputs(baum_workspace *w)
{
  const double *initial = baum_i_initial_inputs(w->mechanism);
  if (initial) {
    memcpy(w->inputs, initial, (size_t)w->mechanism->input_count * sizeof *initial);
    w->point.inputs = w->inputs;
  }
}

static baum_status fill(baum_workspace *w, baum_i_kkt_choice choice)
{
  w->choice = choice;
  BAUM_I_TRY(baum_i_point_create(w->mechanism, &w->point));
  BAUM_I_TRY(make_arrays(w));
  w->row_gains = w->mechanism->row_gains;
  set_inputs(w);
  BAUM_I_TRY(make_structure(w));
  return baum_i_kkt_create(&w->structure, choice, &w->kkt);
}

baum_status baum_i_workspace_create(const baum_mechanism *mechanism, baum_i_kkt_choice choice,
                                    baum_workspace **out)
{
  *out = NULL;
  baum_workspace *w = baum_i_alloc(1, sizeof *w);
  BAUM_I_TRY(baum_i_check_memory(w));
  w->mechanism = baum_i_mechanism_share(mechanism);
  baum_status status = fill(w, choice);
  if (status != BAUM_OK) {
    baum_workspace_destroy(w);
    return status;
  }
  *out = w;
  return BAUM_OK;
}

/* Fail because the block solver does not suit and no other solver is allowed. */
static baum_status refuse_other_solvers(const baum_workspace *w)
{
  return baum_i_fail(BAUM_ERR_UNSUPPORTED, "simulation options: solver is block, but %s",
                     baum_i_blocks_reason(w).text);
}

baum_status baum_i_use_blocks(baum_workspace *w)
{
  baum_i_paths made = {w->path, w->motion};
  baum_i_paths_destroy(&made);
  w->path = NULL;
  w->motion = NULL;
  w->verdict = (baum_i_block_verdict){.blocks = BAUM_I_BLOCKS_UNWANTED};
  if (w->choice != BAUM_I_KKT_AUTO) {
    return baum_i_kkt_prepare(w->kkt);
  }
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = baum_i_paths_create(w, &w->verdict, &made);
  w->path = made.all;
  w->motion = made.motion;
  if (status == BAUM_ERR_MEMORY) {
    return status;
  }
  if (status != BAUM_OK) {
    w->verdict = (baum_i_block_verdict){.blocks = BAUM_I_BLOCKS_UNKNOWN};
  }
  if (w->blocks_only && !w->path) {
    return refuse_other_solvers(w);
  }
  BAUM_I_TRY(w->path ? BAUM_OK : baum_i_kkt_prepare(w->kkt));
  return baum_i_message_settle(BAUM_OK, &kept);
}

void baum_i_probe_begin(baum_i_probe *probe, baum_workspace *workspace)
{
  probe->workspace = workspace;
  probe->near_singular = workspace->near_singular;
  probe->message = baum_i_message_keep();
}

baum_status baum_i_probe_end(const baum_i_probe *probe, baum_status status)
{
  probe->workspace->near_singular = probe->near_singular;
  return baum_i_message_settle(status, &probe->message);
}

baum_i_kkt_counters baum_i_workspace_work(const baum_workspace *w)
{
  baum_i_kkt_counters sum = baum_i_kkt_get_counters(w->kkt);
  const baum_i_block_path *paths[2] = {w->path, w->motion == w->path ? NULL : w->motion};
  for (int k = 0; k < 2; k++) {
    sum.factorizations += paths[k] ? paths[k]->factorizations : 0;
    sum.refinements += paths[k] ? paths[k]->refinements : 0;
  }
  return sum;
}

void baum_i_workspace_forget(baum_workspace *w)
{
  baum_i_block_path *const paths[] = {w->path, w->motion};
  for (int k = 0; k < 2; k++) {
    if (paths[k]) {
      paths[k]->largest_pivot = 0.0;
    }
  }
  baum_i_kkt_forget(w->kkt);
  if (w->sharing.kkt) {
    baum_i_kkt_forget(w->sharing.kkt);
  }
}

baum_status baum_i_check_idle(const baum_workspace *w, const char *call, const char *what)
{
  return w->point.asking
           ? baum_i_fail(BAUM_ERR_STATE, "%s: %s is calling a user function, which must not use it",
                         call, what)
           : BAUM_OK;
}

void baum_workspace_destroy(baum_workspace *workspace)
{
  if (!workspace || workspace->point.asking) {
    return;
  }
  array list[ARRAY_COUNT];
  list_arrays(workspace, list);
  for (int i = 0; i < ARRAY_COUNT; i++) {
    baum_i_free(*list[i].place);
  }
  baum_i_point_release(&workspace->point);
  baum_i_paths_destroy(&(baum_i_paths){workspace->path, workspace->motion});
  baum_i_free(workspace->rows.omitted);
  baum_i_free(workspace->rows.selected);
  baum_i_free(workspace->island);
  baum_i_kkt_destroy(workspace->sharing.kkt);
  baum_i_kkt_destroy(workspace->kkt);
  baum_i_free(workspace->structure.mass_blocks);
  baum_i_free(workspace->structure.row_blocks);
  baum_mechanism_destroy(baum_i_mutable(workspace->mechanism));
  baum_i_free(workspace);
}

/* ---- inputs ---- */

baum_status baum_workspace_set_input(baum_workspace *workspace, baum_input_id id, double value)
{
  const char *call = "baum_workspace_set_input";
  if (!workspace) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the workspace is NULL", call);
  }
  BAUM_I_TRY(baum_i_check_input_value(workspace->mechanism, id, call, value));
  BAUM_I_TRY(baum_i_check_idle(workspace, call, "the workspace"));
  workspace->inputs[id.index1 - 1] = value;
  return BAUM_OK;
}

double baum_workspace_input(const baum_workspace *workspace, baum_input_id id)
{
  int index = workspace ? baum_i_input_index(workspace->mechanism, id) : -1;
  return index < 0 ? (double)NAN : workspace->inputs[index];
}

/* ---- revolutions ---- */

baum_status baum_workspace_set_angle(baum_workspace *workspace, baum_joint_id joint,
                                     baum_joint_coordinate which, double angle)
{
  const char *call = "baum_workspace_set_angle";
  if (!workspace) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the workspace is NULL", call);
  }
  BAUM_I_TRY(baum_i_check_idle(workspace, call, "the workspace"));
  return baum_i_set_angle(&workspace->point, joint, which, angle, call);
}
