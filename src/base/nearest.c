/* SPDX-License-Identifier: BSD-3-Clause */
/* The distance between two names is the smallest number of characters that must be inserted,
 * deleted or replaced (Levenshtein). Let D(i, j) be the distance between the first i characters of
 * a name a and the first j characters of a name b. Then
 *
 *   D(i, j) = min(D(i-1, j) + 1,  D(i, j-1) + 1,  D(i-1, j-1) + [a_i != b_j]).
 *
 * If the given name has at least SHORTEST_PART characters, and another name contains the whole
 * given name, their distance is set to 1. Names are similar if their distance is at most a third of
 * the length of the given name, rounded to an integer, and neither name has more than LONGEST
 * characters. */
#include "base/nearest.h"

#include <stdbool.h>
#include <string.h>

enum { LONGEST = 63, SHORTEST_PART = 4 };

static int smaller(int a, int b)
{
  return a < b ? a : b;
}

static int distance_between(const char *a, const char *b)
{
  int row[LONGEST + 1]; /* row[j] is D(i, j) in columns already computed, otherwise D(i-1, j) */
  const int columns = (int)strlen(b);
  for (int j = 0; j <= columns; j++) {
    row[j] = j;
  }
  for (int i = 0; a[i]; i++) {
    int diagonal = row[0];
    row[0] = i + 1;
    for (int j = 0; j < columns; j++) {
      int above = row[j + 1];
      row[j + 1] = smaller(smaller(above, row[j]) + 1, diagonal + (a[i] != b[j]));
      diagonal = above;
    }
  }
  return row[columns];
}

baum_i_nearest baum_i_nearest_to(const char *given)
{
  const int length = (int)strlen(given);
  return (baum_i_nearest){.given = given, .distance = length <= LONGEST ? (length + 1) / 3 + 1 : 0};
}

void baum_i_nearest_offer(baum_i_nearest *search, const char *name)
{
  if (search->distance == 0 || strlen(name) > LONGEST) {
    return;
  }
  bool is_part = strlen(search->given) >= SHORTEST_PART && strstr(name, search->given);
  int distance = is_part ? 1 : distance_between(search->given, name);
  if (distance < search->distance) {
    search->distance = distance;
    search->name = name;
  }
}

baum_i_text baum_i_nearest_note(const baum_i_nearest *search)
{
  return search->name ? baum_i_text_of("; did you mean \"%s\"?", search->name)
                      : baum_i_text_of("%s", "");
}
