/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions that the examples share: command line, tables and checks. They are not a part of the
 * library.
 *
 * - example_begin() reads the command line: [--json FILE] [--data FILE] [--page FILE].
 * - example_table() begins a table. Calls of example_text() and example_number() then write its
 *   cells, row by row.
 * - example_expect() makes a check. If a check fails, the program fails. All checks must come after
 *   all tables.
 * - example_end() closes the files and returns the exit code.
 *
 * A table is printed on the screen and written to two files. The JSON file contains it as
 * "name": {"columns": {key: title}, "rows": [{key: value}]}. The data file contains it as a block,
 * which gnuplot finds by its name (index "name"). */
#ifndef EXAMPLE_UTIL_H
#define EXAMPLE_UTIL_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/baum.h>

#include "check.h"

enum { EXAMPLE_SKIPPED = 77 };

/* One column of a table. The key is its name in the JSON file, and the title its heading on the
 * screen. */
typedef struct example_column {
  const char *key;
  const char *title;
  char format; /* 's' text, 'd' integer, 'f' fixed point, 'e' exponent */
  int digits;  /* digits after the point; for a text: minimum width */
} example_column;

static struct {
  const char *name;
  FILE *json;
  FILE *data;
  const char *page; /* where a program writes its HTML page; NULL: nowhere */
  const example_column *columns;
  int column_count;
  int column; /* index of the next cell */
  bool shown; /* whether the table is also printed on the screen */
  long rows;
  int checks;
  int failures;
} example;

/* ---- Begin ---------------------------------------------------------------- */

static inline FILE *example_open(const char *path)
{
  FILE *file = fopen(path, "w");
  if (!file) {
    perror(path);
    exit(EXIT_FAILURE);
  }
  return file;
}

static inline void example_begin(int argc, char **argv, const char *name)
{
  example.name = name;
  for (int k = 1; k < argc; k += 2) {
    if (k + 1 < argc && strcmp(argv[k], "--json") == 0) {
      example.json = example_open(argv[k + 1]);
    } else if (k + 1 < argc && strcmp(argv[k], "--data") == 0) {
      example.data = example_open(argv[k + 1]);
    } else if (k + 1 < argc && strcmp(argv[k], "--page") == 0) {
      example.page = argv[k + 1];
    } else {
      (void)fprintf(stderr, "usage: %s [--json FILE] [--data FILE] [--page FILE]\n", name);
      exit(EXIT_FAILURE);
    }
  }
  if (example.json) {
    (void)fprintf(example.json, "{\"example\": \"%s\", \"version\": \"%s\"", name, baum_version());
  }
}

/* Ends the program if a part of the library is not built in. */
static inline void example_needs(const char *feature)
{
  if (!baum_has(feature)) {
    printf("%s: skipped, this library is built without %s\n", example.name, feature);
    exit(EXAMPLE_SKIPPED);
  }
}

/* ---- Tables --------------------------------------------------------------- */

static inline int example_width(const example_column *column)
{
  int title = (int)strlen(column->title);
  int value = column->format == 'e'   ? column->digits + 7
              : column->format == 'f' ? column->digits + 5
                                      : column->digits;
  return title > value ? title : value;
}

static inline void example_close_table(void)
{
  if (example.columns && example.json) {
    (void)fprintf(example.json, "\n]}");
  }
  if (example.columns && example.data) {
    (void)fprintf(example.data, "\n\n");
  }
  example.columns = NULL;
}

/* Writes the titles of a table to the screen and to the files. */
static inline void example_heading(void)
{
  for (int k = 0; k < example.column_count; k++) {
    const example_column *column = &example.columns[k];
    if (example.shown) {
      int width = example_width(column);
      printf("%s%*s", k ? "  " : "", column->format == 's' ? -width : width, column->title);
    }
    if (example.data) {
      (void)fprintf(example.data, "%s\"%s\"", k ? " " : "", column->title);
    }
    if (example.json) {
      (void)fprintf(example.json, "%s\"%s\": \"%s\"", k ? ", " : "", column->key, column->title);
    }
  }
}

/* Begins a table. A table with shown = false is written only to the files. */
static inline void example_table(const char *name, const example_column *columns, int count,
                                 bool shown)
{
  example_close_table();
  example.columns = columns;
  example.column_count = count;
  example.column = 0;
  example.rows = 0;
  example.shown = shown;
  if (example.data) {
    (void)fprintf(example.data, "# %s\n", name);
  }
  if (example.json) {
    (void)fprintf(example.json, ",\n\"%s\": {\"columns\": {", name);
  }
  example_heading();
  if (shown) {
    printf("\n");
  }
  if (example.data) {
    (void)fprintf(example.data, "\n");
  }
  if (example.json) {
    (void)fprintf(example.json, "}, \"rows\": [");
  }
}

/* Writes the separator before the next cell. @return the column of this cell */
static inline const example_column *example_next_cell(void)
{
  const example_column *column = &example.columns[example.column];
  bool first = example.column == 0;
  if (example.json) {
    const char *gap = !first ? ", " : example.rows > 0 ? ",\n  {" : "\n  {";
    (void)fprintf(example.json, "%s\"%s\": ", gap, column->key);
  }
  example.rows += first;
  if (example.data && !first) {
    (void)fprintf(example.data, " ");
  }
  if (example.shown && !first) {
    printf("  ");
  }
  example.column = (example.column + 1) % example.column_count;
  return column;
}

static inline void example_close_cell(void)
{
  if (example.column > 0) {
    return;
  }
  if (example.json) {
    (void)fprintf(example.json, "}");
  }
  if (example.data) {
    (void)fprintf(example.data, "\n");
  }
  if (example.shown) {
    printf("\n");
  }
}

/* Writes a text into the next cell of the row. */
static inline void example_text(const char *text)
{
  const example_column *column = example_next_cell();
  if (example.json) {
    (void)fprintf(example.json, "\"%s\"", text);
  }
  if (example.data) {
    (void)fprintf(example.data, "\"%s\"", text);
  }
  if (example.shown) {
    printf("%-*s", example_width(column), text);
  }
  example_close_cell();
}

/* Writes a number into the next cell of the row. NaN becomes a dash on the screen, null in JSON and
 * NaN in the data file. */
static inline void example_number(double value)
{
  const example_column *column = example_next_cell();
  if (example.json) {
    (void)fprintf(example.json, isfinite(value) ? "%.17g" : "null", value);
  }
  if (example.data) {
    (void)fprintf(example.data, isfinite(value) ? "%.17g" : "NaN", value);
  }
  if (example.shown) {
    int width = example_width(column);
    if (!isfinite(value)) {
      printf("%*s", width, "-");
    } else if (column->format == 'e') {
      printf("%*.*e", width, column->digits, value);
    } else {
      printf("%*.*f", width, column->format == 'd' ? 0 : column->digits, value);
    }
  }
  example_close_cell();
}

/* Prints one line with the cost of a run and writes it to the JSON file as "counters". */
static inline void example_counters(baum_simulation *simulation)
{
  baum_counters c;
  CHECK(baum_simulation_counters(simulation, &c, sizeof c));
  example_close_table();
  printf("\nsteps %lld   evaluations %lld   rejected %lld   factorizations %lld\n",
         (long long)c.steps, (long long)c.evaluations, (long long)c.rejected,
         (long long)c.factorizations);
  if (example.json) {
    (void)fprintf(example.json,
                  ",\n\"counters\": {\"steps\": %lld, \"evaluations\": %lld, "
                  "\"rejected\": %lld, \"factorizations\": %lld}",
                  (long long)c.steps, (long long)c.evaluations, (long long)c.rejected,
                  (long long)c.factorizations);
  }
}

/* ---- Judgement ------------------------------------------------------------ */

/* Checks that value <= limit; NaN fails. */
static inline void example_expect(const char *name, double value, double limit)
{
  bool ok = value <= limit;
  example_close_table();
  printf("check  %-40s  %8.1e <= %-7.1e  %s\n", name, value, limit, ok ? "ok" : "FAILED");
  if (example.json) {
    (void)fprintf(example.json, "%s{\"name\": \"%s\", \"value\": ",
                  example.checks ? ",\n  " : ",\n\"checks\": [\n  ", name);
    (void)fprintf(example.json, isfinite(value) ? "%.17g" : "null", value);
    (void)fprintf(example.json, ", \"limit\": %.17g, \"ok\": %s}", limit, ok ? "true" : "false");
  }
  example.checks++;
  example.failures += !ok;
}

/* Closes the files. @return the exit code of the program */
static inline int example_end(void)
{
  example_close_table();
  if (example.json) {
    (void)fprintf(example.json, "%s,\n\"ok\": %s}\n", example.checks ? "\n]" : "",
                  example.failures ? "false" : "true");
    (void)fclose(example.json);
  }
  if (example.data) {
    (void)fclose(example.data);
  }
  return example.failures ? EXIT_FAILURE : EXIT_SUCCESS;
}

#endif
