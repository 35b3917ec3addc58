/* SPDX-License-Identifier: BSD-3-Clause */
/* Declares the types of FMI 3.0 that a co-simulation FMU without events and clocks needs. The
 * official headers declare the whole interface and are ten times as long. Source: Functional
 * Mock-up Interface Specification 3.0 (Modelica Association, 2022), 2.2. */
#ifndef BAUM_I_FMU_FMI3_H
#define BAUM_I_FMU_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define FMI3_EXPORT __declspec(dllexport)
#else
#define FMI3_EXPORT __attribute__((visibility("default")))
#endif

typedef enum fmi3Status {
  FMI3_OK = 0,
  FMI3_WARNING = 1,
  FMI3_DISCARD = 2,
  FMI3_ERROR = 3,
  FMI3_FATAL = 4
} fmi3Status;

typedef struct baum_i_fmu_instance *fmi3Instance;
typedef struct baum_i_fmu_state *fmi3FMUState;
typedef uint32_t fmi3ValueReference;

typedef void fmi3LogMessage(void *environment, fmi3Status status, const char *category,
                            const char *message);

/* Report that these FMUs do not support a function. Returns FMI3_ERROR. */
fmi3Status baum_i_fmu_refuse(fmi3Instance instance, const char *function);

#endif
