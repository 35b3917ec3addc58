/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the joints whose geometry space_joints_hot.c computes, and sets their constants. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/rotation.h"
#include "dynamics/block_path.h"
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

/* Computes the columns of sign * [s]x L^-T, where s is a point of the body and I = L L^T. */
static void set_arms(const baum_i_space_body *body, const double s[3], double sign, double out[12])
{
  for (int c = 0; c < 3; c++) {
    const double column[3] = {sign * body->whiten[c], sign * body->whiten[4 + c],
                              sign * body->whiten[8 + c]};
    baum_i_cross(s, column, out + (ptrdiff_t)4 * c);
  }
}

static void set_numbers(const baum_workspace *w, const baum_i_space *space,
                        const baum_i_space_joint *joint, double *out)
{
  const baum_i_space_node *node = &space->list[joint->node];
  const baum_i_joint *of = w->mechanism->joints[node->row_block];
  const baum_i_spatial_row *rows = baum_i_spatial_rows_of(of);
  const double *numbers = w->point.parameters + of->element.parameter;
  bool pin = of->type->is_pin; /* its points have two numbers, body_b comes first */
  double *axes = out + BAUM_I_JOINT_AXES;
  const double *weights[2];
  for (int k = 0; k < 2; k++) {
    weights[k] = space->bodies[joint->body[k]].weight;
    double *s = out + BAUM_I_JOINT_POINTS + (ptrdiff_t)4 * k;
    memcpy(s, numbers + (pin ? 2 - 2 * k : BAUM_I_SPATIAL_POINTS + 3 * k),
           (pin ? 2 : 3) * sizeof *s);
    set_arms(&space->bodies[joint->body[k]], s, k == 0 ? 1.0 : -1.0,
             out + BAUM_I_JOINT_ARMS + (ptrdiff_t)12 * k);
  }
  for (int i = 0; i < baum_i_space_own_rows(node); i++) {
    bool point = SHAPES[joint->shape][i] == 'p';
    double keep = (node->omitted >> i & 1u) != 0 ? 0.0 : 1.0;
    out[BAUM_I_JOINT_KEEP + i] = keep;
    out[BAUM_I_JOINT_DIAGONAL + i] = 1.0 - keep + (point ? weights[0][i] + weights[1][i] : 0.0);
    if (!point) {
      memcpy(axes, numbers + BAUM_I_SPATIAL_AXES_A + (ptrdiff_t)3 * (int)(rows[i].x - BAUM_I_X_A),
             3 * sizeof *axes);
      if (rows[i].y < BAUM_I_X_GROUND) {
        memcpy(axes + 4,
               numbers + BAUM_I_SPATIAL_AXES_B + (ptrdiff_t)3 * (int)(rows[i].y - BAUM_I_X_B),
               3 * sizeof *axes);
      }
      axes += 8;
    }
  }
  if (node->spin != 0) {
    int side = joint->body[0] == node->spin ? 0 : 4;
    memcpy(axes + side, space->bodies[node->spin].lack, sizeof space->bodies->lack);
    out[BAUM_I_JOINT_DIAGONAL + node->rows - 1] = -1.0;
  }
}

static int32_t count_numbers(int shape)
{
  int32_t count = BAUM_I_JOINT_AXES;
  for (const char *kind = SHAPES[shape]; *kind; kind++) {
    count += *kind == 'p' ? 0 : 8;
  }
  return count;
}

static void find_sides(const baum_i_space *space, const baum_i_space_node *node,
                       baum_i_space_joint *joint)
{
  for (int k = 0; k < 2; k++) {
    joint->move[k] = -1;
    joint->turn[k] = -1;
    for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
      if (space->side_list[s].body == joint->body[k]) {
        joint->move[k] = space->side_list[s].move;
        joint->turn[k] = space->side_list[s].turn;
      }
    }
  }
}

/* Compares joints by shape, then by the order of elimination. */
static int by_shape(const void *a, const void *b)
{
  const baum_i_space_joint *x = a;
  const baum_i_space_joint *y = b;
  return x->shape != y->shape ? x->shape - y->shape : x->node - y->node;
}

baum_status baum_i_space_joints_find(const baum_workspace *w, baum_i_space *space,
                                     unsigned char *is_done, baum_i_space_joints *out)
{
  const baum_mechanism *m = w->mechanism;
  out->list = baum_i_alloc((size_t)space->node_count, sizeof *out->list);
  out->frames = baum_i_alloc((size_t)space->body_count, sizeof *out->frames);
  if (!out->list || !out->frames) {
    return BAUM_ERR_MEMORY;
  }
  for (int c = 0; c < 12; c += 5) {
    out->frames[0].axes[c] = 1.0;
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
      out->list[out->count] = (baum_i_space_joint){
        .shape = (int32_t)shape, .node = k, .row = joint->row, .body = {first, second}};
      find_sides(space, node, &out->list[out->count++]);
    }
  }
  qsort(out->list, (size_t)out->count, sizeof *out->list, by_shape);
  return BAUM_OK;
}

baum_status baum_i_space_joints_set(const baum_workspace *w, const baum_i_space *space,
                                    baum_i_space_joints *joints)
{
  int32_t next = 0;
  for (int i = 0; i < joints->count; i++) {
    joints->list[i].numbers = next;
    next += count_numbers(joints->list[i].shape);
  }
  joints->numbers = baum_i_alloc((size_t)next, sizeof *joints->numbers);
  if (!joints->numbers) {
    return BAUM_ERR_MEMORY;
  }
  for (int i = 0; i < joints->count; i++) {
    set_numbers(w, space, &joints->list[i], joints->numbers + joints->list[i].numbers);
  }
  return BAUM_OK;
}

void baum_i_space_joints_clear(const baum_i_space_joints *joints)
{
  baum_i_free(joints->list);
  baum_i_free(joints->numbers);
  baum_i_free(joints->frames);
}
