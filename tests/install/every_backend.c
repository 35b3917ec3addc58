/* SPDX-License-Identifier: BSD-3-Clause */
/* A program that calls CVODE, IDA, QR and the catalogue. Linking it therefore needs all their
 * libraries. */
#include <stdio.h>

#include <baum/baum.h>
#include <baum/catalog.h>

static baum_status swing(const baum_mechanism *mechanism, const baum_integrator *integrator)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.rtol = 1e-6;
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(mechanism, &options, &run);
  if (status == BAUM_OK) {
    status = baum_simulation_advance_to(run, 0.05);
  }
  baum_simulation_destroy(run);
  return status;
}

int main(void)
{
  const baum_catalog_choice choice = {.name = "slider_crank"};
  const baum_integrator *const integrators[] = {baum_rk8(), baum_cvode_adams(), baum_cvode_bdf(),
                                                baum_ida()};
  baum_mechanism *mechanism = NULL;
  baum_status status = baum_catalog_build(&choice, &mechanism);
  for (int k = 0; k < 4 && status == BAUM_OK; k++) {
    status = swing(mechanism, integrators[k]);
  }
  if (status != BAUM_OK) {
    printf("%s\n", baum_message());
  }
  baum_mechanism_destroy(mechanism);
  return status == BAUM_OK ? 0 : 1;
}
