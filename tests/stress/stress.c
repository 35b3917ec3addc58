/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the stress grid. Every run must meet its tolerance, or report why it does not.
 *
 *   stress [--axis NAME] [--thin K] [--list] [--list-bad] [--json]
 *
 * A cell of the grid is one run of one scene. With --thin, only every K-th cell is run. The program
 * fails if a run is silently wrong, or if more than one cell in twenty is a false alarm.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "axes.h"

enum { AXES_MOST = 64 };

typedef struct counts {
  int cells;
  int of[OUTCOMES];
  int false_alarms;
  double seconds;
} counts;

typedef struct wanted {
  const char *axis;
  int thin;
  bool list;
  bool list_bad;
  bool json;
} wanted;

static void count(counts *n, const grade *g)
{
  n->cells++;
  n->of[g->outcome]++;
  n->false_alarms += g->false_alarm;
  n->seconds += g->all_seconds;
}

static void print_counts(const char *axis, const counts *n)
{
  printf("%-18s %6d", axis, n->cells);
  for (int k = 0; k < OUTCOMES; k++) {
    printf(" %8d", n->of[k]);
  }
  printf(" %8d %9.1f\n", n->false_alarms, n->seconds);
}

static void print_cell(const cell *c, const grade *g)
{
  (void)fflush(stdout);
  printf(
    "  %s = %g, %s (%d), %s: %s%s, error %.1e, promised %.1e, %lld steps, %.2f s of %.2f s%s%s\n",
    c->axis, c->value, scene_name(&c->scene), scene_bodies(&c->scene), c->way->name,
    outcome_name(g->outcome), g->false_alarm ? ", false alarm" : "", g->error, g->promise,
    (long long)g->steps, g->seconds, g->all_seconds, g->message[0] ? "\n      " : "", g->message);
  (void)fflush(stdout);
}

static void print_json(const counts *n)
{
  printf("{\"cells\": %d", n->cells);
  for (int k = 0; k < OUTCOMES; k++) {
    printf(", \"%s\": %d", outcome_name((outcome)k), n->of[k]);
  }
  printf(", \"false_alarm\": %d}\n", n->false_alarms);
}

/* The counts for each axis. The axes are in the order of their first cells. */
typedef struct table {
  const char *axis[AXES_MOST];
  counts row[AXES_MOST];
  int rows;
} table;

static counts *row_of(table *t, const char *axis)
{
  int k = 0;
  while (k < t->rows && strcmp(t->axis[k], axis) != 0) {
    k++;
  }
  if (k == t->rows && t->rows < AXES_MOST) {
    t->axis[t->rows++] = axis;
  }
  return &t->row[k < AXES_MOST ? k : AXES_MOST - 1];
}

static void print_table(const table *t, const counts *all)
{
  printf("%-18s %6s %8s %8s %8s %8s %8s %8s %8s %9s\n", "axis", "cells", "met", "refused",
         "stopped", "warned", "crossed", "wrong", "false", "cpu s");
  for (int k = 0; k < t->rows; k++) {
    print_counts(t->axis[k], &t->row[k]);
  }
  print_counts("all", all);
}

static counts grade_all(const cell_list *list, const wanted *w)
{
  counts all = {0};
  table t = {.rows = 0};
  for (int k = 0; k < list->count; k += w->thin) {
    const cell *c = &list->cells[k];
    grade g = cell_grade(c);
    count(&all, &g);
    count(row_of(&t, c->axis), &g);
    if (w->list || (w->list_bad && (g.outcome == WRONG || g.false_alarm))) {
      print_cell(c, &g);
    }
  }
  print_table(&t, &all);
  return all;
}

static wanted read_arguments(int argc, char **argv)
{
  wanted w = {.thin = 1};
  for (int k = 1; k < argc; k++) {
    bool more = k + 1 < argc;
    if (strcmp(argv[k], "--axis") == 0 && more) {
      w.axis = argv[++k];
    } else if (strcmp(argv[k], "--thin") == 0 && more) {
      w.thin = atoi(argv[++k]) > 0 ? atoi(argv[k]) : 1;
    }
    w.list |= strcmp(argv[k], "--list") == 0;
    w.list_bad |= strcmp(argv[k], "--list-bad") == 0;
    w.json |= strcmp(argv[k], "--json") == 0;
  }
  return w;
}

int main(int argc, char **argv)
{
  wanted w = read_arguments(argc, argv);
  cell_list list = axes_cells(w.axis);
  counts all = grade_all(&list, &w);
  axes_free(&list);
  if (w.json) {
    print_json(&all);
  }
  /* At most one cell in twenty may be a false alarm. A thinned grid has only about a hundred cells,
   * in which the share may be twice as large by chance. In a thinned grid, one cell in ten is
   * therefore permitted. */
  int cells_to_an_alarm = w.thin > 1 ? 10 : 20;
  bool fine = all.of[WRONG] == 0 && cells_to_an_alarm * all.false_alarms <= all.cells;
  return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
