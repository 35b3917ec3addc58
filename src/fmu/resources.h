/* SPDX-License-Identifier: BSD-3-Clause */
/* The resources of an FMU are two files: scene.json contains the mechanism, and fmu.json contains
 * the variables of the FMU and the options of its run. The Python package writes both files. */
#ifndef BAUM_I_FMU_RESOURCES_H
#define BAUM_I_FMU_RESOURCES_H

#include <baum/simulation.h>

#include "mechanism/identify.h"

/* A parameter of the FMU: a field of numbers in the definition of an element. */
typedef struct baum_i_fmu_parameter {
  const baum_i_family *family;
  const baum_i_definition *definition;
  const baum_i_def_field *field;
  baum_i_id id;
} baum_i_fmu_parameter;

typedef struct baum_i_fmu_resources {
  baum_mechanism *mechanism; /* not frozen */
  baum_simulation_options options;
  char *token; /* instantiation token, as in the model description */
  int input_count;
  baum_input_id *inputs;
  int parameter_count;
  baum_i_fmu_parameter *parameters;
  int channel_count;
  baum_channel *channels; /* the outputs */
  int number_count;
  double *start; /* (number_count) values of the inputs, then of the parameters */
} baum_i_fmu_resources;

/* Read the resources in a folder. After a failure, only baum_i_fmu_release() may use `out`. */
baum_status baum_i_fmu_read(const char *folder, baum_i_fmu_resources *out);
void baum_i_fmu_release(baum_i_fmu_resources *resources);

/* Return how many numbers a parameter has. */
int baum_i_fmu_size(const baum_i_fmu_parameter *parameter);

/* Copy the mechanism, set the parameters of the copy, and freeze the copy. `numbers` (number_count)
 * is ordered like `start`. The function ignores the inputs in `numbers`. */
baum_status baum_i_fmu_build(const baum_i_fmu_resources *resources, const double *numbers,
                             baum_mechanism **out);

#endif
