/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  The version of the library, and the optional parts that it contains. */
#ifndef BAUM_VERSION_H
#define BAUM_VERSION_H

#include <stdbool.h>

#include <baum/export.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BAUM_VERSION_MAJOR 0 /**< Grows with changes of the interface that break callers. */
/** Grows with additions to the interface; before version 1.0 also with changes that break callers.
 */
#define BAUM_VERSION_MINOR 1
#define BAUM_VERSION_PATCH 0       /**< Grows with corrections. */
#define BAUM_VERSION       "0.1.0" /**< Major, minor and patch number as text. */

/** Version of the library that the program has loaded. It may differ from the version of the
 *  headers with which the program was compiled.
 *  @return  static text such as "0.1.0" */
BAUM_API const char *baum_version(void);

/** Tell whether an optional part of the library is built in.
 *  @param[in] feature  "sundials" (CVODE and IDA); NULL and unknown names give false
 *  @return  true if the program can use the part */
BAUM_API bool baum_has(const char *feature);

#ifdef __cplusplus
}
#endif

#endif
