/* SPDX-License-Identifier: BSD-3-Clause */
/* A small study with an entry of every kind, of a mechanism and under a title whose names try to be
 * markup. */
#ifndef BAUM_TEST_REPORT_SCENE_H
#define BAUM_TEST_REPORT_SCENE_H

#include <baum/baum.h>

/* In the names: what ends attributes, elements and JSON strings, a tabulator, and a byte that is no
 * UTF-8. */
#define REPORT_JOINT "<img src=x onerror=\"document.title='taken'\">"
#define REPORT_TITLE "</title><script>document.title='taken'</script> \"q\" \\ \t \xff \xc3\xa9"

enum {
  REPORT_FINE_ROWS = 4,
  REPORT_WARNED_ENTRY = 4,
  REPORT_REFUSED_ENTRY = 5,
  REPORT_ENTRIES = 6
};

typedef struct report_scene {
  baum_mechanism *mechanism;
  baum_study *study;
} report_scene;

/* Not run yet. NULLs without memory. */
report_scene report_scene_make(void);
void report_scene_end(report_scene *scene);

#endif
