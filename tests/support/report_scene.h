/* SPDX-License-Identifier: BSD-3-Clause */
/* A small study. Some of its entries are accurate, one has a warning, and one is refused. Names in
 * the mechanism and the title contain markup, which reports must escape. */
#ifndef BAUM_TEST_REPORT_SCENE_H
#define BAUM_TEST_REPORT_SCENE_H

#include <baum/baum.h>

/* These names contain a tab, a byte that is not UTF-8, and characters that could end attributes,
 * elements and JSON strings. */
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

/* Returns a study that has not been run. If there is not enough memory, both pointers are NULL. */
report_scene report_scene_make(void);
void report_scene_end(report_scene *scene);

#endif
