/* SPDX-License-Identifier: BSD-3-Clause */
/* Copies and frees outlines, which are the shapes that users give to bodies for drawings. src/draw
 * checks and draws them. */
#include <baum/draw.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/mechanism.h"

static void free_one(baum_outline *outline)
{
  baum_i_free(outline->points);
  baum_i_free(outline->triangles);
  baum_i_free(outline->color);
}

void baum_i_free_outlines(baum_outline *outlines, int count)
{
  for (int k = 0; k < count; k++) {
    free_one(&outlines[k]);
  }
  baum_i_free(outlines);
}

/* Copy 3 x count numbers of `size` bytes each. Returns NULL if count is 0. If memory runs out,
 * returns NULL and sets *fine to false. */
static void *copy_rows(const void *rows, int count, size_t size, bool *fine)
{
  void *copy = count > 0 ? baum_i_copy(rows, 3 * (size_t)count, size) : NULL;
  *fine = *fine && (copy || count == 0);
  return copy;
}

/* Copies one outline. Only meshes have triangles, and only polygons and meshes have points. */
static bool copy_one(const baum_outline *from, baum_outline *to)
{
  const bool mesh = from->form == BAUM_OUTLINE_MESH;
  bool fine = true;
  *to = *from;
  to->point_count = mesh || from->form == BAUM_OUTLINE_POLYGON ? from->point_count : 0;
  to->triangle_count = mesh ? from->triangle_count : 0;
  to->points = copy_rows(from->points, to->point_count, sizeof *to->points, &fine);
  to->triangles = copy_rows(from->triangles, to->triangle_count, sizeof *to->triangles, &fine);
  to->color = from->color ? baum_i_copy_text(from->color) : NULL;
  if (!fine || (from->color && !to->color)) {
    free_one(to);
    return false;
  }
  return true;
}

baum_status baum_i_copy_outlines(const baum_outline *outlines, int count, baum_outline **out)
{
  *out = NULL;
  if (count == 0) {
    return BAUM_OK;
  }
  baum_outline *copies = baum_i_alloc((size_t)count, sizeof *copies);
  BAUM_I_TRY(baum_i_check_memory(copies));
  for (int k = 0; k < count; k++) {
    if (!copy_one(&outlines[k], &copies[k])) {
      baum_i_free_outlines(copies, k);
      return baum_i_fail_memory();
    }
  }
  *out = copies;
  return BAUM_OK;
}
