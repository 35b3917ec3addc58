/* SPDX-License-Identifier: BSD-3-Clause */
#include "scene/reader.h"

#include <string.h>

#include "base/alloc.h"

static baum_status read_form(const baum_i_scene_reader *r, const baum_i_json_node *node,
                             baum_outline_form *out)
{
  const char *text = NULL;
  BAUM_I_TRY(baum_i_scene_read_text(r, node, &text));
  for (int k = 0; k < BAUM_I_SCENE_FORMS; k++) {
    if (strcmp(baum_i_scene_forms[k], text) == 0) {
      *out = (baum_outline_form)k;
      return BAUM_OK;
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: there is no form \"%.80s\"", r->label,
                     node->line, text);
}

/* Allocate memory for the rows of a list. Each row has three numbers of `size` bytes. */
static baum_status make_rows(const baum_i_scene_reader *r, const baum_i_json_node *list,
                             size_t size, void **out)
{
  if (list->kind != BAUM_I_JSON_LIST) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: \"%s\" must be a list", r->label,
                       list->line, list->key);
  }
  *out = baum_i_alloc((size_t)list->count, 3 * size);
  return baum_i_check_memory(*out);
}

static baum_status read_points(const baum_i_scene_reader *r, const baum_i_json_node *list,
                               baum_outline *out)
{
  void *memory = NULL;
  BAUM_I_TRY(make_rows(r, list, sizeof(double), &memory));
  double *points = memory;
  out->points = points;
  out->point_count = list->count;
  for (const baum_i_json_node *row = baum_i_json_first(r->json, list); row;
       row = baum_i_json_next(r->json, row), points += 3) {
    BAUM_I_TRY(baum_i_scene_read_numbers(r, row, 3, points));
  }
  return BAUM_OK;
}

static baum_status read_triangles(const baum_i_scene_reader *r, const baum_i_json_node *list,
                                  baum_outline *out)
{
  void *memory = NULL;
  BAUM_I_TRY(make_rows(r, list, sizeof(int32_t), &memory));
  int32_t *corners = memory;
  out->triangles = corners;
  out->triangle_count = list->count;
  for (const baum_i_json_node *row = baum_i_json_first(r->json, list); row;
       row = baum_i_json_next(r->json, row)) {
    double numbers[3];
    BAUM_I_TRY(baum_i_scene_read_numbers(r, row, 3, numbers));
    const baum_i_json_node *corner = baum_i_json_first(r->json, row);
    for (int k = 0; k < 3; k++, corner = baum_i_json_next(r->json, corner)) {
      BAUM_I_TRY(baum_i_scene_read_integer(r, corner, corners++));
    }
  }
  return BAUM_OK;
}

static baum_status read_value(const baum_i_scene_reader *r, const baum_i_json_node *node,
                              baum_outline *out)
{
  if (strcmp(node->key, "form") == 0) {
    return read_form(r, node, &out->form);
  }
  if (strcmp(node->key, "points") == 0) {
    return read_points(r, node, out);
  }
  if (strcmp(node->key, "triangles") == 0) {
    return read_triangles(r, node, out);
  }
  if (strcmp(node->key, "color") == 0) {
    return baum_i_scene_read_text(r, node, &out->color);
  }
  for (const baum_i_def_field *f = baum_i_scene_outline_fields; f->name; f++) {
    if (strcmp(node->key, f->name) == 0) {
      return baum_i_scene_read_numbers(r, node, (int)(f->size / sizeof(double)),
                                       (double *)(void *)((char *)out + f->offset));
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: an outline has no field \"%.80s\"", r->label,
                     node->line, node->key);
}

static baum_status read_outline(const baum_i_scene_reader *r, const baum_i_json_node *object,
                                baum_outline *out)
{
  *out = baum_outline_default();
  if (object->kind != BAUM_I_JSON_OBJECT) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: an outline must be an object", r->label,
                       object->line);
  }
  for (const baum_i_json_node *node = baum_i_json_first(r->json, object); node;
       node = baum_i_json_next(r->json, node)) {
    BAUM_I_TRY(read_value(r, node, out));
  }
  return BAUM_OK;
}

baum_status baum_i_scene_read_outlines(const baum_i_scene_reader *r, const baum_i_json_node *list,
                                       baum_outline **out)
{
  if (list->kind != BAUM_I_JSON_LIST) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: line %d: \"%s\" must be a list", r->label,
                       list->line, list->key);
  }
  baum_outline *outlines = baum_i_alloc((size_t)list->count, sizeof *outlines);
  BAUM_I_TRY(baum_i_check_memory(outlines));
  const baum_i_json_node *node = baum_i_json_first(r->json, list);
  baum_status status = BAUM_OK;
  for (int k = 0; k < list->count && status == BAUM_OK; k++) {
    status = read_outline(r, node, &outlines[k]);
    node = baum_i_json_next(r->json, node);
  }
  if (status != BAUM_OK) {
    baum_i_scene_free_outlines(outlines, list->count);
    return status;
  }
  *out = outlines;
  return BAUM_OK;
}

void baum_i_scene_free_outlines(baum_outline *outlines, int count)
{
  for (int k = 0; k < count; k++) {
    baum_i_free(outlines[k].points);
    baum_i_free(outlines[k].triangles);
  }
  baum_i_free(outlines);
}
