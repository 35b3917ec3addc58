/* SPDX-License-Identifier: BSD-3-Clause */
/* The resources of an FMU: scene.json, the mechanism, and fmu.json, its variables and the options
 * of its run. The Python package writes both. */
#ifndef BAUM_I_FMU_RESOURCES_H
#define BAUM_I_FMU_RESOURCES_H

#include <baum/simulation.h>

#include "mechanism/identify.h"

/* A field of numbers in the definition of an element. */
typedef struct baum_i_fmu_parameter {
  const baum_i_family *family;
  const baum_i_definition *definition;
  const baum_i_def_field *field;
  baum_i_id id;
} baum_i_fmu_parameter;

typedef struct baum_i_fmu_resources {
  baum_mechanism *mechanism; /* not frozen */
  baum_simulation_options options;
  char *token; /* must be the instantiation token of the model description */
  int input_count;
  baum_input_id *inputs;
  int parameter_count;
  baum_i_fmu_parameter *parameters;
  int channel_count;
  baum_channel *channels; /* the outputs */
  int number_count;
  double *start; /* (number_count) the inputs, then the numbers of all parameters */
} baum_i_fmu_resources;

/* Read the resources in a folder. After a failure, only baum_i_fmu_release() may use `out`. */
baum_status baum_i_fmu_read(const char *folder, baum_i_fmu_resources *out);
void baum_i_fmu_release(baum_i_fmu_resources *resources);

/* How many numbers a parameter has. */
int baum_i_fmu_size(const baum_i_fmu_parameter *parameter);

/* Copy the mechanism with these numbers (number_count), and freeze the copy. */
baum_status baum_i_fmu_build(const baum_i_fmu_resources *resources, const double *numbers,
                             baum_mechanism **out);

#endif
