/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Visibility of the public functions. If you link the static library without CMake or pkg-config,
 *  define BAUM_STATIC.
 */
#ifndef BAUM_EXPORT_H
#define BAUM_EXPORT_H

/** @def BAUM_API
 *  Marks the declaration of a public function, so that programs can link to it. */
#if defined(_WIN32) && !defined(BAUM_STATIC)
#ifdef BAUM_BUILDING
#define BAUM_API __declspec(dllexport)
#else
#define BAUM_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define BAUM_API __attribute__((visibility("default")))
#else
#define BAUM_API
#endif

#endif
