/* SPDX-License-Identifier: BSD-3-Clause */
/* Where the gains of the entries lie in the regions of stability of their methods (Fig. 1 of Flores et al. 2008), one map for
 * each integrator of fixed step whose entries have gains. What lies outside of a map is drawn at its edge. Drawn are
 * the gains that a run has used; those of entries that were refused by their rule, but for auto, which is of a run. */
#include <math.h>
#include <stdint.h>

#include "base/alloc.h"
#include "integrate/integrator.h"
#include "study/report.h"

enum {
  SIZE = 240,
  LEFT = 34,
  RIGHT = 10,
  TOP = 10,
  BOTTOM = 34,
  POINTS = 4000,
  LEVELS = 3,
  TICKS = 4
};

static const double RADII[LEVELS] = {1.0, 0.75, 0.5};
static const double PI = 3.14159265358979323846;

typedef struct map {
  const baum_integrator *integrator;
  double width;   /* in alpha h */
  double height;  /* in beta^2 h^2 */
  double best[2]; /* its point of best damping, which is the dead-beat one where there is one */
  double *points; /* room for an outline: 2 x POINTS */
} map;

static bool give(double a, double b, double out[2])
{
  out[0] = a;
  out[1] = b;
  return true;
}

/* (alpha h, beta^2 h^2) of an entry; false where they are not known. */
static bool find_gains(const map *m, const baum_study_entry *entry, double out[2])
{
  const double h = fabs(entry->step);
  if (isfinite(entry->alpha)) {
    return give(fabs(entry->alpha) * h, entry->beta * h * entry->beta * h, out);
  }
  const double *value = entry->gains.value;
  double beta_h = 2.0 * PI * value[0] * h;
  bool is_default = entry->gains.rule == BAUM_GAINS_DEFAULT;
  switch (is_default ? entry->integrator->gains : (baum_gain_rule)entry->gains.rule) {
  case BAUM_GAINS_FIXED: return give(value[0] * h, value[1] * h * value[1] * h, out);
  case BAUM_GAINS_SCALED: return give(value[0], value[1], out);
  case BAUM_GAINS_FREQUENCY: return give(value[1] * beta_h, beta_h * beta_h, out);
  case BAUM_GAINS_TAYLOR: return give(1.0, 2.0, out);
  case BAUM_GAINS_DEADBEAT:
  case BAUM_GAINS_BEST_DAMPING: return give(m->best[0], m->best[1], out);
  case BAUM_GAINS_DEFAULT:
  case BAUM_GAINS_AUTO: break;
  }
  return false;
}

static bool has_point(const baum_study_entry *entry, const baum_integrator *integrator)
{
  return entry->integrator == integrator && entry->formulation == BAUM_FORMULATION_BAUMGARTE &&
         !isnan(entry->step) && entry->state != BAUM_STUDY_WAITING;
}

/* Points of an outline, of which those that are kept. */
static int32_t read_outline(const map *m, double radius)
{
  int32_t count = 0;
  baum_status status =
    baum_stability_outline(m->integrator, radius, POINTS, m->points, m->points + POINTS, &count);
  return status == BAUM_OK && count < POINTS ? count : status == BAUM_OK ? POINTS : 0;
}

/* A little more than the region. */
static bool measure(map *m)
{
  if (baum_stability_best(m->integrator, &m->best[0], &m->best[1]) != BAUM_OK) {
    return false;
  }
  int32_t count = read_outline(m, 1.0);
  m->width = 0.0;
  m->height = 0.0;
  for (int k = 0; k < count; k++) {
    m->width = fmax(m->width, m->points[k]);
    m->height = fmax(m->height, m->points[POINTS + k]);
  }
  m->width *= 1.2;
  m->height *= 1.2;
  return m->width > 0.0 && m->height > 0.0;
}

static baum_i_number across(const map *m, double alpha_h)
{
  double x = fmin(fmax(alpha_h / m->width, 0.0), 1.0);
  return baum_i_fixed(LEFT + (SIZE - LEFT - RIGHT) * x, 1);
}

static baum_i_number upwards(const map *m, double beta2_h2)
{
  double y = fmin(fmax(beta2_h2 / m->height, 0.0), 1.0);
  return baum_i_fixed(SIZE - BOTTOM - (SIZE - TOP - BOTTOM) * y, 1);
}

static void put_outline(const map *m, int level, baum_i_buffer *out)
{
  int32_t count = read_outline(m, RADII[level]);
  bool begun = false;
  baum_i_putf(out, "<path class=\"level%d\" d=\"M0 0", level);
  for (int k = 0; k < count; k++) {
    double alpha_h = m->points[k];
    if (isnan(alpha_h)) {
      begun = false;
      continue;
    }
    baum_i_putf(out, "%s%s %s", begun ? "L" : "M", across(m, alpha_h).text,
                upwards(m, m->points[POINTS + k]).text);
    begun = true;
  }
  baum_i_put(out, "\"/>\n");
}

/* 1, 2 or 5 times a power of ten. */
static double tick(double range)
{
  double least = range / TICKS;
  double power = pow(10.0, floor(log10(least)));
  double share = least / power;
  return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

static void put_axes(const map *m, baum_i_buffer *out)
{
  double dx = tick(m->width);
  double dy = tick(m->height);
  for (int k = 0; k * dx < m->width; k++) {
    baum_i_number x = across(m, k * dx);
    baum_i_putf(
      out, "<path class=\"grid\" d=\"M%s %dV%d\"/><text class=\"mid\" x=\"%s\" y=\"%d\">%s</text>",
      x.text, TOP, SIZE - BOTTOM, x.text, SIZE - BOTTOM + 14, baum_i_short(k * dx, 3).text);
  }
  for (int k = 0; k * dy < m->height; k++) {
    baum_i_number y = upwards(m, k * dy);
    baum_i_putf(out,
                "<path class=\"grid\" d=\"M%d %sH%d\"/><text class=\"end\" x=\"%d\" y=\"%s\" "
                "dy=\"4\">%s</text>",
                LEFT, y.text, SIZE - RIGHT, LEFT - 4, y.text, baum_i_short(k * dy, 3).text);
  }
  baum_i_putf(out, "<text class=\"mid\" x=\"%d\" y=\"%d\">αh</text>", (LEFT + SIZE - RIGHT) / 2,
              SIZE - 5);
  baum_i_putf(out, "<text x=\"%d\" y=\"%d\">β²h²</text>\n", LEFT + 5, TOP + 10);
}

/* What has become of an entry, those that are drawn first first. */
typedef enum fate { ELSEWHERE, STOPPED, RIGHT_MOTION, FATES } fate;

static const char *const FATE_CLASS[FATES] = {"off", "bad", "good"};
static const int FATE_MARK[FATES] = {3, 6, 0};

/* FATES: not known. */
static fate find_fate(const baum_study_entry *entry)
{
  switch (entry->state) {
  case BAUM_STUDY_DONE: return entry->off ? ELSEWHERE : RIGHT_MOTION;
  case BAUM_STUDY_REFUSED:
  case BAUM_STUDY_FAILED: return STOPPED;
  case BAUM_STUDY_WAITING:
  case BAUM_STUDY_TIMED_OUT: break;
  }
  return FATES;
}

static void put_points(const baum_i_snapshot *snapshot, const map *m, fate wanted,
                       baum_i_buffer *out)
{
  for (int k = 0; k < snapshot->entry_count; k++) {
    const baum_study_entry *entry = &snapshot->entries[k].entry;
    double at[2];
    if (!has_point(entry, m->integrator) || find_fate(entry) != wanted ||
        !find_gains(m, entry, at)) {
      continue;
    }
    baum_i_putf(out, "<use class=\"%s\" href=\"#k%d\" x=\"%s\" y=\"%s\"><title>",
                FATE_CLASS[wanted], FATE_MARK[wanted], across(m, at[0]).text,
                upwards(m, at[1]).text);
    baum_i_put_html(out, entry->name);
    baum_i_putf(out, "\nαh %s, β²h² %s: %s</title></use>", baum_i_short(at[0], 3).text,
                baum_i_short(at[1], 3).text,
                wanted == ELSEWHERE ? "another motion" : snapshot->entries[k].state);
  }
}

static void put_map(const baum_i_snapshot *snapshot, const map *m, baum_i_buffer *out)
{
  baum_i_putf(out,
              "<figure><figcaption>%s</figcaption><svg class=\"map\" viewBox=\"0 0 %d %d\" "
              "role=\"img\" aria-label=\"region of stability and gains of the settings\">\n",
              baum_integrator_name(m->integrator), SIZE, SIZE);
  put_axes(m, out);
  for (int level = 0; level < LEVELS; level++) {
    put_outline(m, level, out);
  }
  for (int f = 0; f < FATES; f++) {
    put_points(snapshot, m, (fate)f, out);
  }
  baum_i_put(out, "</svg></figure>\n");
}

/* Entry k is the first with gains of its integrator. */
static bool is_first(const baum_i_snapshot *snapshot, int k)
{
  const baum_integrator *integrator = snapshot->entries[k].entry.integrator;
  for (int j = 0; j < k; j++) {
    if (has_point(&snapshot->entries[j].entry, integrator)) {
      return false;
    }
  }
  return has_point(&snapshot->entries[k].entry, integrator);
}

static const char HEADING[] =
  "<section>\n<h2>Where gains are stable</h2>\n<p>Shaded: violations decay, the darker the faster "
  "(spectral radius below 1, 0.75, 0.5). Discs: the motion is right. Diamonds: it is another one, "
  "as "
  "with steps that are too long for the motion, however stable the gains. Crosses: refused or "
  "failed. What lies outside of a map is drawn at its edge.</p>\n<div class=\"maps\">\n";

void baum_i_put_stability_maps(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  map m = {.points = baum_i_alloc((size_t)2 * POINTS, sizeof(double))};
  if (!m.points) {
    out->failed = true;
    return;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  bool begun = false;
  for (int k = 0; k < snapshot->entry_count; k++) {
    m.integrator = snapshot->entries[k].entry.integrator;
    if (is_first(snapshot, k) && measure(&m)) {
      baum_i_put(out, begun ? "" : HEADING);
      begun = true;
      put_map(snapshot, &m, out);
    }
  }
  baum_i_put(out, begun ? "</div>\n</section>\n" : "");
  (void)baum_i_message_settle(BAUM_OK, &kept);
  baum_i_free(m.points);
}
