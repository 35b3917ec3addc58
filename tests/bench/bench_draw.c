/* SPDX-License-Identifier: BSD-3-Clause */
/* Prints the size of pages and pictures, and how long it takes to write them.
 *
 * usage: bench_draw
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "timing.h"

enum { REPEATS = 20 };

static void must(baum_status status)
{
  if (status < BAUM_OK) {
    (void)fprintf(stderr, "%s\n", baum_message());
    exit(1);
  }
}

static void print_sizes(const char *name, const baum_mechanism *m, const baum_page *page)
{
  size_t svg = 0, html = 0;
  double begin = timing_now();
  for (int k = 0; k < REPEATS; k++) {
    must(baum_mechanism_svg(m, NULL, NULL, 0, &svg));
  }
  double between = timing_now();
  for (int k = 0; k < REPEATS; k++) {
    must(baum_page_print(m, page, NULL, 0, &html));
  }
  double end = timing_now();
  printf("%-14s %6d %7lld | %9.1f %8.2f | %9.1f %8.2f\n", name, (int)baum_mechanism_body_count(m),
         (long long)page->count, (double)svg * 1e-3, 1e3 * (between - begin) / REPEATS,
         (double)html * 1e-3, 1e3 * (end - between) / REPEATS);
}

/* Draws a motion of a mechanism of the catalogue. The page contains all positions and the reactions
 * of the joints at `count` times. */
static void show_catalog(const char *name, int count, double end)
{
  baum_mechanism *m = NULL;
  const baum_catalog_choice choice = {.name = name};
  must(baum_catalog_build(&choice, &m));
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = end / count;
  baum_simulation *run = NULL;
  must(baum_simulation_create(m, &options, &run));
  baum_channel channels[32];
  int used = 0;
  channels[used++] = baum_channel_of(BAUM_Q);
  for (int k = 0; k < baum_mechanism_joint_count(m) && used < 32; k++) {
    channels[used++] = baum_channel_of_joint(BAUM_JOINT_REACTION, baum_mechanism_joint_at(m, k));
  }
  const int width = baum_channels_width(m, channels, used);
  double *times = malloc((size_t)count * sizeof *times);
  double *rows = malloc((size_t)count * (size_t)width * sizeof *rows);
  for (int k = 0; times && k < count; k++) {
    times[k] = end * k / (count - 1);
  }
  must(baum_simulation_sample(run, times, count, channels, used, rows, NULL));
  baum_page page = baum_page_default();
  page.times = times;
  page.count = count;
  page.channels = channels;
  page.channel_count = used;
  page.rows = rows;
  print_sizes(name, m, &page);
  free(rows);
  free(times);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Draws a row of pendulums side by side. The samples do not come from a run: all angles grow by
 * 1e-3 rad from one sample to the next, and the positions remain the same. */
static void show_many(int bodies, int count)
{
  baum_mechanism *m = NULL;
  must(baum_mechanism_create(&m));
  for (int k = 0; k < bodies; k++) {
    baum_planar_body_def body = baum_planar_body_def_default();
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    body.position[0] = k;
    body.position[1] = -1.0;
    must(baum_mechanism_add_planar_body(m, &body, &pin.body_b));
    pin.body_a = BAUM_GROUND;
    pin.point[0] = k;
    pin.point[1] = 0.0;
    must(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  }
  must(baum_mechanism_freeze(m));
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const int width = baum_channels_width(m, &channel, 1);
  double *times = malloc((size_t)count * sizeof *times);
  double *rows = malloc((size_t)count * (size_t)width * sizeof *rows);
  for (int k = 0; times && rows && k < count; k++) {
    times[k] = k;
    for (int i = 0; i < width; i++) {
      rows[k * width + i] = i % 3 == 0 ? i / 3 : i % 3 == 1 ? -1.0 : 1e-3 * k;
    }
  }
  baum_page page = baum_page_default();
  page.times = times;
  page.count = count;
  page.channels = &channel;
  page.channel_count = 1;
  page.rows = rows;
  print_sizes("pendulums", m, &page);
  free(rows);
  free(times);
  baum_mechanism_destroy(m);
}

/* Makes the vertices and triangles of a torus, which consists of n circles with n points each. */
static baum_outline make_ring(int n, double *points, int32_t *triangles)
{
  for (int k = 0; k < n * n; k++) {
    const int i = k / n, j = k % n, next = (i + 1) % n * n, side = (j + 1) % n;
    const double u = 6.283185307179586 * i / n, v = 6.283185307179586 * j / n;
    const int32_t corners[6] = {k, next + j, next + side, k, next + side, i * n + side};
    const double point[3] = {(0.3 + 0.1 * cos(v)) * cos(u), (0.3 + 0.1 * cos(v)) * sin(u),
                             0.1 * sin(v)};
    memcpy(points + 3 * k, point, sizeof point);
    memcpy(triangles + 6 * k, corners, sizeof corners);
  }
  baum_outline ring = baum_outline_default();
  ring.form = BAUM_OUTLINE_MESH;
  ring.points = points;
  ring.point_count = n * n;
  ring.triangles = triangles;
  ring.triangle_count = 2 * n * n;
  return ring;
}

/* Draws a body whose outline has 2 n^2 triangles. */
static void show_mesh(int n)
{
  const double row[7] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  const double time = 0.0;
  const baum_channel channel = baum_channel_of(BAUM_Q);
  baum_mechanism *m = NULL;
  baum_body_id body;
  baum_page page = baum_page_default();
  const baum_spatial_body_def def = baum_spatial_body_def_default();
  double *points = malloc(3 * (size_t)(n * n) * sizeof *points);
  int32_t *triangles = malloc(6 * (size_t)(n * n) * sizeof *triangles);
  if (points && triangles) {
    const baum_outline ring = make_ring(n, points, triangles);
    must(baum_mechanism_create(&m));
    must(baum_mechanism_add_spatial_body(m, &def, &body));
    must(baum_mechanism_set_outlines(m, body, &ring, 1));
    must(baum_mechanism_freeze(m));
    page.times = &time;
    page.rows = row;
    page.channels = &channel;
    page.count = page.channel_count = 1;
    print_sizes("mesh", m, &page);
  }
  free(points);
  free(triangles);
  baum_mechanism_destroy(m);
}

int main(void)
{
  printf("%-14s %6s %7s | %9s %8s | %9s %8s\n", "mechanism", "bodies", "samples", "SVG [kB]",
         "[ms]", "page [kB]", "[ms]");
  show_catalog("slider_crank", 400, 0.1);
  show_catalog("andrews_bodies", 400, 0.03);
  show_many(1000, 2000);
  show_many(10000, 10);
  show_mesh(100); /* 20 000 triangles */
  return 0;
}
