/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the environment of a report: libraries, compiler, processor and date. */
#include <stdio.h>
#include <string.h>

#include <baum/version.h>

#include "base/platform.h"
#include "integrate/integrator.h"
#include "study/report.h"

#if defined(__clang__)
#define COMPILER __VERSION__ /* contains the name of the compiler */
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "not known"
#endif

/* Reads the name of the processor from a file that Linux provides. */
static void read_cpu(char *cpu, size_t size)
{
  char line[512];
  FILE *file = fopen("/proc/cpuinfo", "r");
  while (file && fgets(line, sizeof line, file)) {
    const char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) == 0 && colon) {
      line[strcspn(line, "\n")] = '\0';
      (void)snprintf(cpu, size, "%s", colon + 1 + strspn(colon + 1, " "));
      break;
    }
  }
  if (file) {
    (void)fclose(file);
  }
}

void baum_i_environment_read(baum_i_environment *out)
{
  *out = (baum_i_environment){.baum = baum_version(),
                              .sundials = baum_i_sundials_version(),
                              .compiler = COMPILER,
                              .cpu = "not known"};
  read_cpu(out->cpu, sizeof out->cpu);
  baum_i_date_read(out->date, sizeof out->date);
}
