/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Statuses and messages.
 *
 *  Every call that can fail returns a baum_status and writes its results through pointers. The
 *  status 0 means that the call has succeeded. A status from 1 to 9 means that a run has stopped
 *  before its end because your program asked for it. A status of 10 or more means that the call has
 *  reached its end with warnings. A negative status means that the call has failed.
 *
 *  If a call fails, it leaves the object that it works on unchanged and does not write its outputs,
 *  except that it sets pointers to new objects to NULL. A run that fails keeps the state after its
 *  last good step. The library never prints, exits or aborts. SUNDIALS is an exception: if memory
 *  runs out while a run with CVODE or IDA is created, SUNDIALS may print a line or crash.
 *
 *  Threads: each thread has its own message of the last call that did not return 0, see
 *  baum_message(). All other state is in objects that you create. */
#ifndef BAUM_STATUS_H
#define BAUM_STATUS_H

#include <baum/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The list of all statuses. Each line is X(name, value, meaning). The values are part of the ABI
 *  and are never reused. */
#define BAUM_STATUS_LIST(X)                                                                 \
  X(BAUM_OK, 0, "done")                                                                     \
  X(BAUM_STOP_CANCELLED, 1, "cancelled")                                                    \
  X(BAUM_STOP_EVENT, 2, "an event function changed sign")                                   \
  X(BAUM_STOP_TIME, 3, "the time limit of the call has passed")                             \
  X(BAUM_WARNED, 10, "reached the end with warnings")                                       \
  X(BAUM_ERR_ARGUMENT, -1, "an argument is NULL, out of range or not finite")               \
  X(BAUM_ERR_STATE, -2, "the call is not allowed at this stage")                            \
  X(BAUM_ERR_MEMORY, -3, "out of memory")                                                   \
  X(BAUM_ERR_STRUCT, -4, "struct_size is not that of a struct initialised by this library") \
  X(BAUM_ERR_UNSUPPORTED, -5, "not supported by this build or this pair of settings")       \
  X(BAUM_ERR_BUFFER, -6, "a saved run is damaged or of another mechanism, run or version")  \
  X(BAUM_ERR_FILE, -7, "a file cannot be read or written")                                  \
  X(BAUM_ERR_INCONSISTENT, -10, "the start or the constraints are inconsistent")            \
  X(BAUM_ERR_SINGULAR, -11, "the equations of motion cannot be solved here")                \
  X(BAUM_ERR_UNSTABLE, -12, "the gains are unstable with this integrator and step")         \
  X(BAUM_ERR_STEP, -20, "the step size fell below its minimum")                             \
  X(BAUM_ERR_CONVERGENCE, -21, "an iteration did not converge")                             \
  X(BAUM_ERR_INTEGRATOR, -22, "the integrator failed")                                      \
  X(BAUM_ERR_NOT_FINITE, -23, "a computed value is not finite")                             \
  X(BAUM_ERR_CALLBACK, -30, "a user function reported a failure")

/** The result of every call that can fail. BAUM_STATUS_LIST lists the statuses. */
typedef enum baum_status {
/** Expands a line of the list. */
#define BAUM_X(name, value, text) name = (value),
  BAUM_STATUS_LIST(BAUM_X)
#undef BAUM_X
} baum_status;

/** Name of a status, such as "BAUM_ERR_ARGUMENT".
 *  @param status  any value
 *  @return  static text, never NULL; "BAUM_?" for unknown values */
BAUM_API const char *baum_status_name(baum_status status);

/** General meaning of a status. @param status  any value @return static text, never NULL */
BAUM_API const char *baum_status_text(baum_status status);

/** Message of the last call in this thread that returned a status other than 0. The message names
 *  the element, the field, its value and its unit. The message of a run also names the time.
 *  @return  text owned by the library, never NULL, initially ""; valid until the next call in this
 *           thread that returns a status other than 0 */
BAUM_API const char *baum_message(void);

/** Set the message of this thread. This function is for libraries that use baum, and for user
 *  functions that fail. If a user function fails, the message of baum ends with the message of
 *  the user function.
 *  @param     status   returned unchanged
 *  @param[in] message  copied, truncated if very long; NULL stands for baum_status_text(status)
 *  @return  status, so that you can write `return baum_fail(...)` */
BAUM_API baum_status baum_fail(baum_status status, const char *message);

#ifdef __cplusplus
}
#endif

#endif
