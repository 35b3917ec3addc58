/* SPDX-License-Identifier: BSD-3-Clause */
/* Implements the binary that all exported FMUs contain. The binary reads a mechanism from the
 * folder `resources` of its FMU, and implements co-simulation by FMI 3.0. docs/fmu.md describes the
 * FMUs.
 *
 * The value references count from 0 in this order: the time, the inputs, every number of every
 * parameter, and every column of the outputs. */
#include "fmu/fmi3.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "base/text.h"
#include "fmu/resources.h"

typedef struct baum_i_fmu_instance {
  baum_i_fmu_resources resources;
  baum_simulation_options options;
  double *numbers;      /* present values, in the order of resources.start */
  baum_simulation *run; /* NULL before initialization */
  double *row;          /* (width) the outputs */
  int width;
  bool is_initialized;
  fmi3LogMessage *log; /* may be NULL */
  void *environment;
} instance;

/* The saved state of an FMU. One block of memory contains this struct, the numbers and the saved
 * run. */
typedef struct baum_i_fmu_state {
  size_t size;    /* size of the whole block */
  size_t run;     /* size of the saved run, or 0 if there is no run */
  uint64_t check; /* hash of everything from start_time to the numbers; the run has its own */
  char token[64]; /* the first characters of the instantiation token of the FMU */
  double start_time;
  double rtol;
  bool is_initialized;
  double numbers[];
} state;

/* ---- messages ---- */

static fmi3Status report(const instance *fmu, fmi3Status status, const char *message)
{
  if (fmu && fmu->log) {
    fmu->log(fmu->environment, status, status == FMI3_WARNING ? "warning" : "error", message);
  }
  return status;
}

static fmi3Status fail(const instance *fmu, const char *message)
{
  return report(fmu, FMI3_ERROR, message);
}

/* Convert the status of a call to a status of FMI, and report the message of the call. */
static fmi3Status converted(const instance *fmu, baum_status status)
{
  if (status == BAUM_OK) {
    return FMI3_OK;
  }
  return status > 0 ? report(fmu, FMI3_WARNING, baum_simulation_message(fmu->run))
                    : fail(fmu, baum_message());
}

fmi3Status baum_i_fmu_refuse(fmi3Instance fmu, const char *function)
{
  const baum_i_text text = baum_i_text_of("%s is not supported", function);
  return fail(fmu, text.text);
}

/* ---- the run ---- */

static void end_run(instance *fmu)
{
  baum_simulation_destroy(fmu->run);
  fmu->run = NULL;
  baum_i_free(fmu->row);
  fmu->row = NULL;
}

static baum_status set_inputs(instance *fmu)
{
  for (int k = 0; k < fmu->resources.input_count; k++) {
    BAUM_I_TRY(baum_simulation_set_input(fmu->run, fmu->resources.inputs[k], fmu->numbers[k]));
  }
  return BAUM_OK;
}

static baum_status start_mechanism(instance *fmu, const baum_mechanism *mechanism)
{
  const baum_i_fmu_resources *found = &fmu->resources;
  fmu->width = baum_channels_width(mechanism, found->channels, found->channel_count);
  if (fmu->width < 0) {
    return BAUM_ERR_ARGUMENT; /* the call has set the message */
  }
  fmu->row = baum_i_alloc((size_t)fmu->width, sizeof(double));
  BAUM_I_TRY(baum_i_check_memory(fmu->row));
  BAUM_I_TRY(baum_simulation_create(mechanism, &fmu->options, &fmu->run));
  return set_inputs(fmu);
}

/* Create the run with the present parameters and inputs, unless there is already a run. */
static fmi3Status start_run(instance *fmu)
{
  if (fmu->run) {
    return FMI3_OK;
  }
  baum_mechanism *mechanism = NULL;
  baum_status status = baum_i_fmu_build(&fmu->resources, fmu->numbers, &mechanism);
  if (status == BAUM_OK) {
    status = start_mechanism(fmu, mechanism);
  }
  baum_mechanism_destroy(mechanism);
  const fmi3Status result = converted(fmu, status);
  if (result == FMI3_ERROR) {
    end_run(fmu);
  }
  return result;
}

/* ---- creation ---- */

FMI3_EXPORT const char *fmi3GetVersion(void);
const char *fmi3GetVersion(void)
{
  return "3.0";
}

FMI3_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance, bool, size_t, const char *const *);
fmi3Status fmi3SetDebugLogging(fmi3Instance fmu, bool on, size_t count,
                               const char *const *categories)
{
  (void)fmu; /* there are only warnings and errors, which are always reported */
  (void)on;
  (void)count;
  (void)categories;
  return FMI3_OK;
}

FMI3_EXPORT void fmi3FreeInstance(fmi3Instance);
void fmi3FreeInstance(fmi3Instance fmu)
{
  if (fmu) {
    end_run(fmu);
    baum_i_fmu_release(&fmu->resources);
    baum_i_free(fmu->numbers);
    baum_i_free(fmu);
  }
}

FMI3_EXPORT fmi3Status fmi3Reset(fmi3Instance);
fmi3Status fmi3Reset(fmi3Instance fmu)
{
  end_run(fmu);
  fmu->is_initialized = false;
  fmu->options = fmu->resources.options;
  memcpy(fmu->numbers, fmu->resources.start, (size_t)fmu->resources.number_count * sizeof(double));
  return FMI3_OK;
}

static fmi3Status load(instance *fmu, const char *folder, const char *token)
{
  const baum_status status = baum_i_fmu_read(folder, &fmu->resources);
  if (status != BAUM_OK) {
    return converted(fmu, status);
  }
  if (strcmp(fmu->resources.token, token) != 0) {
    return fail(fmu, "the instantiation token is that of another FMU");
  }
  fmu->numbers = baum_i_alloc((size_t)fmu->resources.number_count, sizeof(double));
  return fmu->numbers ? fmi3Reset(fmu) : converted(fmu, baum_i_fail_memory());
}

/* The last argument is a callback. It has the type `void *`, because it is never called. */
FMI3_EXPORT fmi3Instance fmi3InstantiateCoSimulation(const char *, const char *, const char *, bool,
                                                     bool, bool, bool, const fmi3ValueReference *,
                                                     size_t, void *, fmi3LogMessage *, void *);
fmi3Instance fmi3InstantiateCoSimulation(const char *name, const char *token, const char *folder,
                                         bool visible, bool logging, bool event_mode,
                                         bool early_return, const fmi3ValueReference *intermediate,
                                         size_t intermediate_count, void *environment,
                                         fmi3LogMessage *log, void *update)
{
  /* #lizard forgives: the parameters of FMI */
  (void)name;
  (void)visible;
  (void)logging;
  (void)event_mode;
  (void)early_return;
  (void)intermediate;
  (void)intermediate_count;
  (void)update;
  instance *fmu = token && folder ? baum_i_alloc(1, sizeof *fmu) : NULL;
  if (!fmu) {
    return NULL;
  }
  fmu->log = log;
  fmu->environment = environment;
  if (load(fmu, folder, token) != FMI3_OK) {
    fmi3FreeInstance(fmu);
    return NULL;
  }
  return fmu;
}

/* ---- initialization ---- */

FMI3_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance, bool, double, double, bool,
                                                   double);
fmi3Status fmi3EnterInitializationMode(fmi3Instance fmu, bool has_tolerance, double tolerance,
                                       double start_time, bool has_stop_time, double stop_time)
{
  (void)has_stop_time;
  (void)stop_time;
  if (fmu->is_initialized) {
    return fail(fmu, "fmi3EnterInitializationMode: the FMU is already initialized");
  }
  end_run(fmu);
  fmu->options.start_time = start_time;
  if (has_tolerance && !isnan(fmu->options.rtol)) {
    fmu->options.rtol = tolerance;
  }
  return start_run(fmu);
}

FMI3_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance);
fmi3Status fmi3ExitInitializationMode(fmi3Instance fmu)
{
  const fmi3Status status = start_run(fmu);
  fmu->is_initialized = status != FMI3_ERROR;
  return status;
}

FMI3_EXPORT fmi3Status fmi3Terminate(fmi3Instance);
fmi3Status fmi3Terminate(fmi3Instance fmu)
{
  (void)fmu; /* the values stay readable until the FMU is reset or released */
  return FMI3_OK;
}

/* ---- values ---- */

static fmi3Status update_outputs(instance *fmu)
{
  const fmi3Status status = start_run(fmu);
  if (status == FMI3_ERROR) {
    return status;
  }
  const baum_i_fmu_resources *found = &fmu->resources;
  return converted(fmu,
                   baum_simulation_get(fmu->run, found->channels, found->channel_count, fmu->row));
}

FMI3_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance, const fmi3ValueReference *, size_t, double *,
                                      size_t);
fmi3Status fmi3GetFloat64(fmi3Instance fmu, const fmi3ValueReference *references, size_t count,
                          double *values, size_t value_count)
{
  const size_t number_count = (size_t)fmu->resources.number_count;
  bool is_current = false; /* true after the outputs have been computed */
  if (count != value_count) {
    return fail(fmu, "fmi3GetFloat64: the numbers of variables and values differ");
  }
  for (size_t k = 0; k < count; k++) {
    const size_t place = references[k];
    if (place > number_count && !is_current) {
      if (update_outputs(fmu) == FMI3_ERROR) {
        return FMI3_ERROR;
      }
      is_current = true;
    }
    if (place == 0) {
      values[k] = fmu->run ? baum_simulation_time(fmu->run) : fmu->options.start_time;
    } else if (place <= number_count) {
      values[k] = fmu->numbers[place - 1];
    } else if (place <= number_count + (size_t)fmu->width) {
      values[k] = fmu->row[place - 1 - number_count];
    } else {
      return fail(fmu, "fmi3GetFloat64: there is no such variable");
    }
  }
  return FMI3_OK;
}

static fmi3Status set_number(instance *fmu, size_t place, double value)
{
  const size_t input_count = (size_t)fmu->resources.input_count;
  if (place < input_count) {
    const baum_input_id input = fmu->resources.inputs[place];
    const fmi3Status status =
      fmu->run ? converted(fmu, baum_simulation_set_input(fmu->run, input, value)) : FMI3_OK;
    fmu->numbers[place] = status == FMI3_ERROR ? fmu->numbers[place] : value;
    return status;
  }
  if (place >= (size_t)fmu->resources.number_count) {
    return fail(fmu, "fmi3SetFloat64: there is no such input or parameter");
  }
  if (fmu->is_initialized) {
    return fail(fmu, "fmi3SetFloat64: a parameter cannot change after initialization");
  }
  end_run(fmu); /* the next call that needs a run creates it with the new parameter */
  fmu->numbers[place] = value;
  return FMI3_OK;
}

FMI3_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance, const fmi3ValueReference *, size_t,
                                      const double *, size_t);
fmi3Status fmi3SetFloat64(fmi3Instance fmu, const fmi3ValueReference *references, size_t count,
                          const double *values, size_t value_count)
{
  fmi3Status status = FMI3_OK;
  if (count != value_count) {
    return fail(fmu, "fmi3SetFloat64: the numbers of variables and values differ");
  }
  for (size_t k = 0; k < count && status != FMI3_ERROR; k++) {
    /* reference 0, the time, wraps around to a place that does not exist, and is refused */
    status = set_number(fmu, (size_t)references[k] - 1, values[k]);
  }
  return status;
}

/* ---- steps ---- */

FMI3_EXPORT fmi3Status fmi3DoStep(fmi3Instance, double, double, bool, bool *, bool *, bool *,
                                  double *);
fmi3Status fmi3DoStep(fmi3Instance fmu, double t, double step, bool never_back, bool *needs_events,
                      bool *terminates, bool *returned_early, double *reached)
{
  (void)never_back;
  *needs_events = false;
  *terminates = false;
  *returned_early = false;
  *reached = t;
  if (!fmu->is_initialized) {
    return fail(fmu, "fmi3DoStep: the FMU is not initialized");
  }
  const double now = baum_simulation_time(fmu->run);
  *reached = now;
  if (!(step > 0.0)) {
    const baum_i_text text = baum_i_text_of("fmi3DoStep: the step is %g s, must be > 0", step);
    return fail(fmu, text.text);
  }
  if (!(fabs(t - now) <= 1e-9 * (fabs(step) + fabs(now)))) { /* more than rounding errors */
    const baum_i_text text =
      baum_i_text_of("fmi3DoStep: the FMU is at %.17g s, not %.17g s", now, t);
    return fail(fmu, text.text);
  }
  const fmi3Status status = converted(fmu, baum_simulation_advance_to(fmu->run, t + step));
  *reached = baum_simulation_time(fmu->run);
  return status;
}

/* ---- state ---- */

FMI3_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState *);
fmi3Status fmi3FreeFMUState(fmi3Instance fmu, fmi3FMUState *place)
{
  (void)fmu;
  if (place) {
    baum_i_free(*place);
    *place = NULL;
  }
  return FMI3_OK;
}

/* Tell whether a state was saved by an FMU with the same token. */
static bool is_own(const instance *fmu, const state *saved)
{
  return strncmp(saved->token, fmu->resources.token, sizeof saved->token) == 0;
}

static size_t numbers_size(const instance *fmu)
{
  return (size_t)fmu->resources.number_count * sizeof(double);
}

static uint64_t hash_of(const instance *fmu, const state *saved)
{
  baum_i_digest digest = {0};
  const size_t first = offsetof(state, start_time);
  baum_i_digest_add(&digest, (const char *)saved + first,
                    sizeof(state) - first + numbers_size(fmu));
  return digest.value;
}

FMI3_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance, fmi3FMUState *);
fmi3Status fmi3GetFMUState(fmi3Instance fmu, fmi3FMUState *place)
{
  size_t run_size = 0;
  if (fmu->run && baum_simulation_save(fmu->run, NULL, 0, &run_size) != BAUM_OK) {
    return converted(fmu, BAUM_ERR_ARGUMENT);
  }
  const size_t size = sizeof(state) + numbers_size(fmu) + run_size;
  state *saved = baum_i_alloc(size, 1);
  if (!saved) {
    return converted(fmu, baum_i_fail_memory());
  }
  saved->size = size;
  saved->run = run_size;
  const size_t length = strlen(fmu->resources.token);
  memcpy(saved->token, fmu->resources.token,
         length < sizeof saved->token ? length : sizeof saved->token);
  saved->start_time = fmu->options.start_time;
  saved->rtol = fmu->options.rtol;
  saved->is_initialized = fmu->is_initialized;
  memcpy(saved->numbers, fmu->numbers, numbers_size(fmu));
  saved->check = hash_of(fmu, saved);
  baum_i_free(*place); /* the caller may pass an earlier state, which is replaced */
  *place = saved;
  char *bytes = (char *)saved + sizeof(state) + numbers_size(fmu);
  return run_size > 0 ? converted(fmu, baum_simulation_save(fmu->run, bytes, run_size, &run_size))
                      : FMI3_OK;
}

/* Tell whether the present run must end before the saved state is restored. It must end if the
 * saved state has no run, or if the parameters or options of the saved state differ from the
 * present ones. Inputs are not compared, because restoring a run sets them. */
static bool needs_other_run(const instance *fmu, const state *saved)
{
  const size_t inputs = (size_t)fmu->resources.input_count;
  return saved->run == 0 || memcmp(&saved->start_time, &fmu->options.start_time, 8) != 0 ||
         memcmp(&saved->rtol, &fmu->options.rtol, 8) != 0 ||
         memcmp(saved->numbers + inputs, fmu->numbers + inputs,
                numbers_size(fmu) - inputs * sizeof(double)) != 0;
}

FMI3_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance, fmi3FMUState);
fmi3Status fmi3SetFMUState(fmi3Instance fmu, fmi3FMUState saved)
{
  if (!saved || !is_own(fmu, saved)) {
    return fail(fmu, "fmi3SetFMUState: the state is that of another FMU");
  }
  if (needs_other_run(fmu, saved)) {
    end_run(fmu);
  }
  fmu->options.start_time = saved->start_time;
  fmu->options.rtol = saved->rtol;
  fmu->is_initialized = saved->is_initialized;
  memcpy(fmu->numbers, saved->numbers, numbers_size(fmu));
  if (saved->run == 0) {
    return FMI3_OK;
  }
  fmi3Status status = start_run(fmu);
  if (status != FMI3_ERROR) {
    const char *bytes = (const char *)saved + sizeof(state) + numbers_size(fmu);
    status = converted(fmu, baum_simulation_restore(fmu->run, bytes, saved->run));
  }
  if (status == FMI3_ERROR) {
    end_run(fmu);
    fmu->is_initialized = false;
  }
  return status;
}

FMI3_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance, fmi3FMUState, size_t *);
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance fmu, fmi3FMUState saved, size_t *size)
{
  (void)fmu;
  *size = saved->size;
  return FMI3_OK;
}

FMI3_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance, fmi3FMUState, uint8_t *, size_t);
fmi3Status fmi3SerializeFMUState(fmi3Instance fmu, fmi3FMUState saved, uint8_t *bytes, size_t size)
{
  if (size < saved->size) {
    return fail(fmu, "fmi3SerializeFMUState: the buffer is too small");
  }
  memcpy(bytes, saved, saved->size);
  return FMI3_OK;
}

FMI3_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance, const uint8_t *, size_t,
                                               fmi3FMUState *);
fmi3Status fmi3DeserializeFMUState(fmi3Instance fmu, const uint8_t *bytes, size_t size,
                                   fmi3FMUState *place)
{
  const size_t least = sizeof(state) + numbers_size(fmu);
  state head = {.size = 0};
  memcpy(&head, bytes, size < least ? 0 : sizeof head);
  if (head.size < least || head.size > size || head.run != head.size - least ||
      !is_own(fmu, &head)) {
    return fail(fmu, "fmi3DeserializeFMUState: the bytes are not a state of this FMU");
  }
  state *copy = baum_i_copy(bytes, head.size, 1);
  if (!copy) {
    return converted(fmu, baum_i_fail_memory());
  }
  if (copy->check != hash_of(fmu, copy)) {
    baum_i_free(copy);
    return fail(fmu, "fmi3DeserializeFMUState: the bytes are damaged");
  }
  baum_i_free(*place);
  *place = copy;
  return FMI3_OK;
}
