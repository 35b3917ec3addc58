/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the joints whose geometry space_joints_hot.c computes, and sets their constants. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/rotation.h"
#include "dynamics/block_path.h"
#include "linear/space_columns.h"
#include "mechanism/spatial/spatial_joint.h"

static const char *const SHAPES[BAUM_I_SHAPES] = {"pp",   "ppp",   "pppd",   "pppde", "pppded",
                                                  "dess", "dessd", "des",    "ss",    "s",
                                                  "pppu", "pppdu", "pppdeu", "dessdu"};

/* Return the kind of a row, see space_joints.h. `before` is the preceding row of the joint, or
 * NULL. */
static char kind_of(const baum_i_spatial_row *row, const baum_i_spatial_row *before)
{
  if (row->x >= BAUM_I_X_GROUND) {
    return 'p';
  }
  if (row->x >= BAUM_I_X_B) {
    return '?';
  }
  if (row->y == BAUM_I_APART) {
    return 's';
  }
  return before && before->x < BAUM_I_X_B && before->y == row->y ? 'e' : 'd';
}

static baum_i_space_shape find_shape(const char *kinds)
{
  int shape = 0;
  while (shape < BAUM_I_SHAPES && strcmp(kinds, SHAPES[shape]) != 0) {
    shape++;
  }
  return (baum_i_space_shape)shape;
}

baum_i_space_shape baum_i_shape_of(const baum_i_joint *joint)
{
  const baum_i_spatial_row *rows = baum_i_spatial_rows_of(joint);
  if (joint->type->is_pin) {
    return BAUM_I_SHAPE_PIN;
  }
  char kinds[BAUM_I_SPACE_ROWS + 1] = {0};
  for (int i = 0; rows && i < joint->rows; i++) {
    kinds[i] = kind_of(&rows[i], i > 0 ? &rows[i - 1] : NULL);
  }
  return find_shape(kinds);
}

baum_i_space_shape baum_i_shape_with_spin(int shape)
{
  char kinds[BAUM_I_SPACE_ROWS + 2];
  (void)snprintf(kinds, sizeof kinds, "%su", SHAPES[shape]);
  return find_shape(kinds);
}

/* Set the vector s_k (space_joints_hot.c) of row i to sign * s. */
static void set_own(double *own, int i, double sign, const double s[3])
{
  for (int c = 0; c < 3; c++) {
    own[baum_i_column_entry(3, i, c)] = sign * s[c];
  }
}

/* Set the vectors s_a and s_b of all rows, and Phi - s_a . z_a of rows s. `points` are the joint's
 * points on both bodies, and `axes` its axes on body a and then on body b. */
static void set_vectors(const char *kinds, const baum_i_spatial_row *rows, double points[2][3],
                        const double *axes, double *own)
{
  int n = (int)strlen(kinds);
  double *own_b = own + baum_i_space_part(n);
  for (int i = 0; i < n && kinds[i] != 'u'; i++) {
    bool point = kinds[i] == 'p';
    bool slide = kinds[i] == 's';
    const double *x = point ? points[0] : axes + (ptrdiff_t)3 * (int)(rows[i].x - BAUM_I_X_A);
    const double *y =
      point || slide ? points[1] : axes + (ptrdiff_t)3 * (int)(rows[i].y - BAUM_I_X_A);
    set_own(own, i, point ? -1.0 : 1.0, x);
    set_own(own_b, i, -1.0, y);
    if (slide) {
      own_b[baum_i_space_part(n) + i] = -baum_i_dot3(x, points[0]);
    }
  }
}

static size_t count_numbers(int shape)
{
  const char *kinds = SHAPES[shape];
  size_t count = BAUM_I_JOINT_OWN + 2 * (size_t)baum_i_space_part((int)strlen(kinds));
  return count + (strchr(kinds, 's') ? 8 : 0) + (strchr(kinds, 'u') ? 8 : 0);
}

static void set_numbers(const baum_workspace *w, const baum_i_space *space,
                        const baum_i_space_joint *joint, double *out)
{
  const baum_i_space_node *node = &space->list[joint->node];
  const baum_i_joint *of = w->mechanism->joints[node->row_block];
  const double *numbers = w->point.parameters + of->element.parameter;
  const char *kinds = SHAPES[joint->shape];
  bool pin = of->type->is_pin; /* its points have two numbers, body_b comes first */
  double points[2][3] = {{0.0}};
  for (int k = 0; k < 2; k++) {
    memcpy(points[k], numbers + (pin ? 2 - 2 * k : BAUM_I_SPATIAL_POINTS + 3 * k),
           (pin ? 2 : 3) * sizeof *numbers);
  }
  for (int i = 0; i < node->rows; i++) {
    for (int k = 0; kinds[i] == 'p' && k < 2; k++) {
      out[BAUM_I_JOINT_DIAGONAL + i] += space->bodies[joint->body[k]].weight[i];
    }
  }
  set_vectors(kinds, baum_i_spatial_rows_of(of), points, numbers + BAUM_I_SPATIAL_AXES_A,
              out + BAUM_I_JOINT_OWN);
  if (node->spin != 0) {
    const baum_i_space_body *body = &space->bodies[node->spin];
    double *row = out + count_numbers(joint->shape) - 8 + (joint->body[0] == node->spin ? 0 : 4);
    memcpy(row, body->lack, sizeof body->lack);
    out[BAUM_I_JOINT_DIAGONAL + node->rows - 1] = -body->gap;
  }
}

static void set_pointers(const baum_i_space *space, baum_i_space_joint *joint)
{
  const baum_i_space_node *node = &space->list[joint->node];
  joint->equations = space->nodes + node->at;
  joint->measure = &space->measures[joint->node];
  for (int k = 0; k < 2; k++) {
    joint->white[k] = space->bodies[joint->body[k]].whiten;
    joint->weight[k] = space->bodies[joint->body[k]].weight;
    for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
      if (space->side_list[s].body == joint->body[k]) {
        joint->move[k] = space->sides + space->side_list[s].move;
        joint->turn[k] = space->sides + space->side_list[s].turn;
      }
    }
  }
}

/* Compares joints by stage, then by shape, then by the order of elimination. */
static int by_stage(const void *a, const void *b)
{
  const baum_i_space_joint *x = a;
  const baum_i_space_joint *y = b;
  if (x->stage != y->stage) {
    return x->stage - y->stage;
  }
  return x->shape != y->shape ? x->shape - y->shape : x->node - y->node;
}

/* Sorts the bodies by stages, and finds the starts of all stages. Bodies without joints are in the
 * first one. */
static baum_status make_stages(const baum_i_space *space, baum_i_space_joints *joints)
{
  int32_t *stage = baum_i_alloc((size_t)space->body_count, sizeof *stage);
  int32_t *start = joints->body_start;
  if (!stage) {
    return BAUM_ERR_MEMORY;
  }
  joints->joint_start = start + space->stage_count + 1;
  for (int i = joints->count - 1; i >= 0; i--) { /* the last stage comes first */
    for (int k = 0; k < 2; k++) {
      stage[joints->list[i].body[k]] = joints->list[i].stage;
    }
    joints->joint_start[joints->list[i].stage]++;
  }
  for (int t = 1; t < space->body_count; t++) {
    start[stage[t]]++;
  }
  for (int s = 0; s < space->stage_count; s++) { /* starts are ends for now */
    start[s + 1] += start[s];
    joints->joint_start[s + 1] += joints->joint_start[s];
  }
  for (int t = space->body_count - 1; t > 0; t--) {
    joints->bodies[--start[stage[t]]] = t;
  }
  for (int i = 0; i < joints->count; i++) {
    joints->joint_start[joints->list[i].stage]--;
  }
  baum_i_free(stage);
  return BAUM_OK;
}

/* Tells whether rows other than a spin row are omitted. */
static bool omits_own_rows(const baum_i_space_node *node)
{
  return (node->omitted & ((1u << baum_i_space_own_rows(node)) - 1u)) != 0;
}

static baum_status make_arrays(const baum_i_space *space, baum_i_space_joints *out)
{
  size_t bodies = (size_t)space->body_count;
  out->list = baum_i_alloc((size_t)space->node_count, sizeof *out->list);
  out->bodies = baum_i_alloc(bodies, sizeof *out->bodies);
  out->body_start = baum_i_alloc(2 * ((size_t)space->stage_count + 1), sizeof *out->body_start);
  out->frames = baum_i_alloc_lines(bodies, sizeof *out->frames);
  return out->list && out->bodies && out->body_start && out->frames ? BAUM_OK : BAUM_ERR_MEMORY;
}

baum_status baum_i_space_joints_find(const baum_workspace *w, baum_i_space *space,
                                     unsigned char *is_done, baum_i_space_joints *out)
{
  const baum_mechanism *m = w->mechanism;
  BAUM_I_TRY(make_arrays(space, out));
  for (int c = 0; c < 12; c += 5) {
    out->frames[0].columns[c] = 1.0;
  }
  for (int k = 0; k < space->node_count; k++) {
    baum_i_space_node *node = &space->list[k];
    const baum_i_joint *joint = m->joints[node->row_block];
    baum_i_space_shape shape = baum_i_shape_of(joint);
    node->direct = shape != BAUM_I_SHAPES && baum_i_space_own_rows(node) == joint->rows;
    if (node->direct) {
      shape = node->spin != 0 ? baum_i_shape_with_spin(shape) : shape;
      is_done[node->row_block] = 1;
      int first = joint->span.bodies[shape == BAUM_I_SHAPE_PIN ? 1 : 0];
      int second = joint->span.bodies[shape == BAUM_I_SHAPE_PIN ? 0 : 1];
      out->list[out->count] = (baum_i_space_joint){.shape = (int32_t)shape,
                                                   .node = k,
                                                   .row = joint->row,
                                                   .body = {first, second},
                                                   .stage = space->node_stages[k],
                                                   .omits = omits_own_rows(node) ? 1 : 0};
      set_pointers(space, &out->list[out->count++]);
    }
  }
  qsort(out->list, (size_t)out->count, sizeof *out->list, by_stage);
  return make_stages(space, out);
}

baum_status baum_i_space_joints_set(const baum_workspace *w, const baum_i_space *space,
                                    baum_i_space_joints *joints)
{
  size_t count = 0;
  for (int i = 0; i < joints->count; i++) {
    count += count_numbers(joints->list[i].shape);
  }
  joints->numbers = baum_i_alloc_lines(count, sizeof *joints->numbers);
  if (!joints->numbers) {
    return BAUM_ERR_MEMORY;
  }
  double *next = joints->numbers;
  for (int i = 0; i < joints->count; i++) {
    joints->list[i].numbers = next;
    joints->list[i].spin = next + count_numbers(joints->list[i].shape) - 8;
    set_numbers(w, space, &joints->list[i], next);
    next += count_numbers(joints->list[i].shape);
  }
  return BAUM_OK;
}

/* Set D_ij and D_ji of a node with n rows. */
static void set_pivot(double *d, int n, int i, int j, double x)
{
  for (int k = 0; k < 2; k++) {
    int row = k == 0 ? i : j;
    int column = k == 0 ? j : i;
    if (row < 4) {
      d[4 * column + row] = x;
    } else if (column >= 4) {
      d[4 * n + 2 * (column - 4) + row - 4] = x;
    }
  }
}

/* Clear row i of a side. */
static void clear_row(double *side, int i)
{
  for (int c = 0; side && c < 3; c++) {
    side[baum_i_column_entry(3, i, c)] = 0.0;
  }
}

void baum_i_space_joint_omit(const baum_i_space *space, const baum_i_space_joint *joint)
{
  const baum_i_space_node *node = &space->list[joint->node];
  int n = node->rows;
  double *d = joint->equations + baum_i_space_pivot(n);
  double *size = joint->measure->size;
  size[0] = 1.0;
  size[1] = 1.0;
  for (int i = 0; i < baum_i_space_own_rows(node); i++) {
    bool omitted = (node->omitted >> i & 1u) != 0;
    for (int k = 0; omitted && k < 2; k++) {
      clear_row(joint->turn[k], i);
      clear_row(node->lean ? NULL : joint->move[k], i);
      joint->equations[k * baum_i_space_vector(n) + i] = 0.0;
    }
    for (int j = 0; omitted && j < n; j++) {
      set_pivot(d, n, i, j, i == j ? 1.0 : 0.0);
    }
    size[i < 3 ? 0 : 1] *= i < 4 ? d[5 * i] : d[4 * n + 3 * (i - 4)];
  }
}

void baum_i_space_joints_clear(const baum_i_space_joints *joints)
{
  baum_i_free(joints->list);
  baum_i_free(joints->bodies);
  baum_i_free(joints->body_start);
  baum_i_free_lines(joints->numbers);
  baum_i_free_lines(joints->frames);
}
