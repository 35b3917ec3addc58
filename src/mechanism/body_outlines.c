/* SPDX-License-Identifier: BSD-3-Clause */
/* The memory of outlines that users give to bodies. src/draw checks and draws them. */
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

/* Only meshes have triangles, only polygons and meshes have points. */
static bool copy_one(const baum_outline *from, baum_outline *to)
{
  *to = *from;
  const bool mesh = from->form == BAUM_OUTLINE_MESH;
  const bool pointed = mesh || from->form == BAUM_OUTLINE_POLYGON;
  to->point_count = pointed ? from->point_count : 0;
  to->triangle_count = mesh ? from->triangle_count : 0;
  to->points =
    pointed ? baum_i_copy(from->points, 3 * (size_t)to->point_count, sizeof *to->points) : NULL;
  to->triangles =
    mesh ? baum_i_copy(from->triangles, 3 * (size_t)to->triangle_count, sizeof *to->triangles)
         : NULL;
  to->color = from->color ? baum_i_copy_text(from->color) : NULL;
  if ((pointed && !to->points) || (mesh && !to->triangles) || (from->color && !to->color)) {
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
