/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes a study as one HTML page. The page consists of the template report.html, a picture of the
 * mechanism, and the data that the script in the template draws. The data contain the report as
 * JSON. For each fixed-step integrator with gains, they also contain its gain rule, its point of
 * best damping, and level lines of the spectral radius, which show the region of stability. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "draw/picture.h"
#include "integrate/integrator.h"
#include "study/report.h"
#include "study/study.h"

enum { POINTS = 4000, LEVELS = 3 };
static const double RADII[LEVELS] = {1.0, 0.75, 0.5};
/* Placeholders in the template for the picture and the data. */
static const char PICTURE[] = "<!-- PICTURE -->";
static const char DATA[] = "\"DATA\"";

/* The contents of report.html, in a C file that cmake/Embed.cmake generates. */
extern const unsigned char baum_i_report_html[];

static bool has_gains(const baum_study_entry *entry)
{
  return entry->formulation == BAUM_FORMULATION_BAUMGARTE && !isnan(entry->step);
}

/* Tells whether entry k is the first entry with gains for its integrator. */
static bool is_first(const baum_i_snapshot *snapshot, int k)
{
  const baum_study_entry *entry = &snapshot->entries[k].entry;
  for (int j = 0; j < k; j++) {
    const baum_study_entry *other = &snapshot->entries[j].entry;
    if (other->integrator == entry->integrator && has_gains(other)) {
      return false;
    }
  }
  return has_gains(entry);
}

/* Appends the points (alpha h, beta^2 h^2) of level lines. A null separates one line from the
 * next. */
static void put_outline(const baum_integrator *integrator, double radius, double *points,
                        baum_i_buffer *out)
{
  int32_t count = 0;
  (void)baum_stability_outline(integrator, radius, POINTS, points, points + POINTS, &count);
  baum_i_put(out, "[");
  for (int k = 0; k < count && k < POINTS; k++) {
    baum_i_put(out, k ? "," : "");
    if (isnan(points[k])) {
      baum_i_put(out, "null");
    } else {
      baum_i_putf(out, "[%.4g,%.4g]", points[k], points[POINTS + k]);
    }
  }
  baum_i_put(out, "]");
}

static void put_regions(const baum_i_snapshot *snapshot, double *points, baum_i_buffer *out)
{
  const char *gap = "";
  for (int k = 0; k < snapshot->entry_count; k++) {
    const baum_integrator *integrator = snapshot->entries[k].entry.integrator;
    double best[2];
    if (!is_first(snapshot, k) || baum_stability_best(integrator, &best[0], &best[1]) != BAUM_OK) {
      continue;
    }
    baum_i_putf(out, "%s\n{\"integrator\": \"%s\", \"gains\": \"%s\", \"best\": [%.6g, %.6g], ",
                gap, baum_integrator_name(integrator),
                baum_i_gain_rule_name((int)integrator->gains), best[0], best[1]);
    baum_i_put(out, "\"levels\": [");
    for (int level = 0; level < LEVELS; level++) {
      baum_i_put(out, level ? ",\n" : "\n");
      put_outline(integrator, RADII[level], points, out);
    }
    baum_i_put(out, "]}");
    gap = ",";
  }
}

/* Draws the initial configuration of the mechanism, or the design configuration if assembly
 * fails. */
static void put_picture(const baum_study *study, baum_i_buffer *out)
{
  baum_simulation *start = NULL;
  baum_status status = baum_i_study_probe(study, &start);
  const double *q = start ? baum_simulation_q(start) : NULL;
  if (status != BAUM_ERR_MEMORY) {
    status = baum_i_put_svg(study->mechanism, q, "picture", out);
  }
  out->failed = out->failed || status != BAUM_OK;
  baum_simulation_destroy(start);
}

void baum_i_report_page(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const char *page = (const char *)baum_i_report_html;
  const char *picture = strstr(page, PICTURE);
  const char *data = strstr(picture, DATA);
  double *points = baum_i_alloc((size_t)2 * POINTS, sizeof *points);
  if (!points) {
    out->failed = true;
    return;
  }
  baum_i_kept_message kept = baum_i_message_keep();
  baum_i_putf(out, "%.*s", (int)(picture - page), page);
  put_picture(snapshot->study, out);
  picture += strlen(PICTURE);
  baum_i_putf(out, "%.*s{\"regions\": [", (int)(data - picture), picture);
  put_regions(snapshot, points, out);
  baum_i_put(out, "],\n\"report\": ");
  baum_i_report_json(snapshot, out);
  baum_i_putf(out, "}%s", data + strlen(DATA));
  (void)baum_i_message_settle(BAUM_OK, &kept);
  baum_i_free(points);
}
