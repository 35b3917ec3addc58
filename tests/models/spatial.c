/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial.h"

#include <math.h>
#include <string.h>

#include <baum/catalog.h>

#include "catalog/spatial_parts.h"
#include "catalog/stewart.h"
#include "spatial_scenes.h"

/* ---- from the catalogue ---- */

static baum_status from_catalog(const char *name, const baum_catalog_setting *settings, int count,
                                model *out)
{
  const baum_catalog_choice choice = {name, settings, count};
  baum_mechanism *mechanism = NULL;
  baum_status status = baum_catalog_build(&choice, &mechanism);
  return status == BAUM_OK ? model_adopt(mechanism, out) : status;
}

static baum_status build_slider_crank(model *out)
{
  const baum_catalog_setting settings[] = {{"angle", 1.0}};
  return from_catalog("spatial_slider_crank", settings, 1, out);
}

/* `axial` is the moment of inertia of the rods about their own axes, divided by that about
 * transverse axes. */
static baum_status build_bricard(double axial, model *out)
{
  const baum_catalog_setting settings[] = {{"axial", axial}, {"angle", 0.3}, {"speed", 2.0}};
  return from_catalog("bricard", settings, 3, out);
}

/* Makes the Stewart platform of the catalogue without its drivers. */
static baum_status build_stewart(model *out)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_i_stewart_parts(&parts, baum_i_stewart.defaults, false);
  return model_finish(&parts, NULL, out);
}

/* ---- chains ---- */

static const double LINK_INERTIA[3] = {0.00167, 0.08417, 0.08417}; /* of a cylinder */

/* Returns a number from -1 to 1 that varies irregularly with k. */
static double irregular(int k, int which)
{
  double x = 0.6180339887498949 * (k + 1.0) + 0.37 * which;
  return 2.0 * (x - floor(x)) - 1.0;
}

/* Adds a chain along the x axes of its links. The links of a spherical chain have independent
 * orientations. Each link of a revolute chain rotates relative to the link before it about an axis
 * that is perpendicular to both links. */
static baum_status build_chain(bool revolute, int links, model *out)
{
  baum_i_parts parts = baum_i_parts_begin();
  baum_body_id last = BAUM_GROUND;
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_i_parts_gravity_z(&parts, 9.81);
  for (int k = 0; k < links; k++) {
    double point[3];
    double axis[3];
    memcpy(point, at.r, sizeof point);
    if (revolute) {
      baum_i_axes_turn(&at, 0, 2.0 * irregular(k, 0), 0.0);
    } else {
      at = baum_i_axes_at(at.r, at.v);
      baum_i_axes_turn(&at, 1, 0.4 * irregular(k, 0), irregular(k, 1));
    }
    baum_i_axes_direction(&at, 2, axis);
    baum_i_axes_turn(&at, 2, 0.4 * irregular(k, 2), irregular(k, 3));
    baum_i_axes_go(&at, 0.5, 0.0, 0.0);
    baum_body_id next =
      baum_i_parts_spatial_body(&parts, NULL, 1.0, LINK_INERTIA, baum_i_axes_state(&at));
    const baum_i_place place = {last, next, point, axis};
    if (revolute) {
      baum_i_parts_spatial_revolute(&parts, NULL, place);
    } else {
      baum_i_parts_spherical(&parts, NULL, place);
    }
    baum_i_axes_go(&at, 0.5, 0.0, 0.0);
    last = next;
  }
  return model_finish(&parts, NULL, out);
}

const char *model_spatial_name(model_spatial which)
{
  static const char *const names[] = {
    [MODEL_SPATIAL_SLIDER_CRANK] = "spatial_slider_crank",
    [MODEL_RSSR] = "rssr",
    [MODEL_BRICARD] = "bricard",
    [MODEL_SLENDER_BRICARD] = "slender_bricard",
    [MODEL_STEWART] = "stewart",
    [MODEL_QUADRUPED] = "quadruped",
    [MODEL_FLYBALL] = "flyball",
    [MODEL_SPHERICAL_CHAIN] = "spherical_chain",
    [MODEL_REVOLUTE_CHAIN] = "revolute_chain",
  };
  return names[which];
}

baum_status model_spatial_build(model_spatial which, int links, model *out)
{
  *out = (model){.mechanism = NULL};
  switch (which) {
  case MODEL_SPATIAL_SLIDER_CRANK: return build_slider_crank(out);
  case MODEL_RSSR: return model_adopt(spatial_make_rssr(), out);
  case MODEL_BRICARD: return build_bricard(0.02, out);
  case MODEL_SLENDER_BRICARD: return build_bricard(0.0, out);
  case MODEL_STEWART: return build_stewart(out);
  case MODEL_QUADRUPED: return from_catalog("quadruped", NULL, 0, out);
  case MODEL_FLYBALL: return from_catalog("flyball", NULL, 0, out);
  case MODEL_SPHERICAL_CHAIN: return build_chain(false, links, out);
  case MODEL_REVOLUTE_CHAIN: return build_chain(true, links, out);
  case MODEL_SPATIAL_COUNT: break;
  }
  return BAUM_ERR_ARGUMENT;
}
