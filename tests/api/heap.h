/* SPDX-License-Identifier: BSD-3-Clause */
/* Counts the allocations of a test program and makes chosen ones fail. The program and all
 * libraries that it loads allocate through the functions defined here. These functions have to be
 * in the program itself. Therefore only a program with one source file may include this header.
 * Before it includes this header, it must define _GNU_SOURCE and include cmocka.h.
 *
 * This works with glibc. If another tool replaces malloc, as valgrind and the thread sanitizer do,
 * heap_is_ours() returns false. In builds with the address sanitizer, the functions here call the
 * allocation functions of the sanitizer by their names. The sanitizer thus still checks memory
 * accesses after a failed allocation.
 */
#ifndef BAUM_TEST_HEAP_H
#define BAUM_TEST_HEAP_H

#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HEAP_OF_ADDRESS_SANITIZER 1
#elif __has_feature(thread_sanitizer)
#define HEAP_LEFT_ALONE 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define HEAP_OF_ADDRESS_SANITIZER 1
#elif defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define HEAP_LEFT_ALONE 1
#endif

static struct {
  atomic_long blocks;  /* number of blocks that are allocated now */
  atomic_long count;   /* number of allocations since heap_watch() */
  long fail_from;      /* index of the first allocation that fails */
  long fail_to;        /* index after the last allocation that fails */
  bool inside;         /* true during a call of an excluded function (see below) */
  long may_still_fail; /* how many more allocations of the excluded function may fail */
} heap;

/* ---- counting ---- */

static void heap_watch(void)
{
  heap.fail_from = LONG_MAX;
  heap.fail_to = LONG_MAX;
  atomic_store(&heap.count, 0);
}

/* From now on allocation number n fails. If `for_good` is set, all later ones also fail. */
static void heap_fail(long n, bool for_good)
{
  heap_watch();
  heap.fail_from = n;
  heap.fail_to = for_good ? LONG_MAX : n + 1;
}

/* Returns the number of allocations since heap_watch(). From now on, no allocation fails. */
static long heap_stop(void)
{
  long count = atomic_load(&heap.count);
  heap_watch();
  return count;
}

static long heap_blocks(void)
{
  return atomic_load(&heap.blocks);
}

#ifndef HEAP_LEFT_ALONE

/* ---- the functions ---- */

#ifdef HEAP_OF_ADDRESS_SANITIZER
#define HEAP_REAL(name) __interceptor_##name
#else
#define HEAP_REAL(name) __libc_##name
#endif
/* Functions with this mark are also called before the sanitizer has been set up. */
#define HEAP_EARLY  __attribute__((no_sanitize("address", "undefined")))
#define HEAP_PUBLIC __attribute__((visibility("default"))) HEAP_EARLY

void *HEAP_REAL(malloc)(size_t size);
void *HEAP_REAL(calloc)(size_t number, size_t size);
void *HEAP_REAL(realloc)(void *old, size_t size);
void HEAP_REAL(free)(void *memory);

/* Tells whether an allocation has to fail. Allocations of an excluded function are not counted,
 * except the first ones, which may fail. */
HEAP_EARLY static bool heap_refuses(void)
{
  if (heap.inside && heap.may_still_fail-- <= 0) {
    return false;
  }
  long k = atomic_fetch_add(&heap.count, 1);
  if (k < heap.fail_from || k >= heap.fail_to) {
    return false;
  }
  errno = ENOMEM;
  return true;
}

HEAP_EARLY static void *heap_counted(void *memory)
{
  atomic_fetch_add(&heap.blocks, memory ? 1 : 0);
  return memory;
}

HEAP_PUBLIC void *malloc(size_t size)
{
  return heap_refuses() ? NULL : heap_counted(HEAP_REAL(malloc)(size));
}

HEAP_PUBLIC void *calloc(size_t number, size_t size)
{
  return heap_refuses() ? NULL : heap_counted(HEAP_REAL(calloc)(number, size));
}

HEAP_PUBLIC void *realloc(void *old, size_t size)
{
  if (heap_refuses()) {
    return NULL;
  }
  void *memory = HEAP_REAL(realloc)(old, size);
  return old ? memory : heap_counted(memory);
}

HEAP_PUBLIC void free(void *memory)
{
  atomic_fetch_sub(&heap.blocks, memory ? 1 : 0);
  HEAP_REAL(free)(memory);
}

/* ---- calls that are excluded, and why ---- */

/* SUNLogger_Create() of SUNDIALS 6.4.1, which SUNContext_Create() calls, checks only its first
 * allocation. SUNHashMap_New() then allocates a map and writes to it without checking, because it
 * compares `map` with NULL where `*map` is meant. If the buckets of the map cannot be allocated,
 * SUNHashMap_New() frees the map, although the logger keeps the map and later destroys it again. A
 * caller cannot prevent these two errors. The test therefore lets only the first allocation fail.
 */
#if BAUM_HAVE_SUNDIALS

typedef int heap_create_logger(void *communicator, int rank, void **logger);

static heap_create_logger *heap_real_create_logger;
static bool heap_find_excluded(void);

/* This is the declaration from SUNDIALS' header, with other type names. */
int SUNLogger_Create(void *communicator, int rank, void **logger);

HEAP_PUBLIC int SUNLogger_Create(void *communicator, int rank, void **logger)
{
  if (!heap_real_create_logger) {
    (void)heap_find_excluded(); /* for tests that have not called heap_is_ours() */
  }
  heap.inside = true;
  heap.may_still_fail = 1;
  int code = heap_real_create_logger(communicator, rank, logger);
  heap.inside = false;
  return code;
}

#endif

/* Finds the addresses of the excluded functions in advance, because dlsym() allocates memory. */
static bool heap_find_excluded(void)
{
  bool all = true;
  void *found = NULL;
#if BAUM_HAVE_SUNDIALS
  found = dlsym(RTLD_NEXT, "SUNLogger_Create");
  memcpy(&heap_real_create_logger, &found, sizeof found);
  all = all && found;
#endif
  (void)found;
  return all;
}

/* Tells whether malloc, calloc and free are the functions of this file. They are called through
 * volatile pointers, so that the compiler cannot remove the calls. */
static bool heap_is_ours(void)
{
  void *(*volatile get)(size_t) = malloc;
  void *(*volatile get_zeros)(size_t, size_t) = calloc;
  void (*volatile give_back)(void *) = free;
  bool found = heap_find_excluded();
  heap_watch();
  give_back(get(1));
  give_back(get_zeros(1, 1));
  return heap_stop() == 2 && found;
}

#else

static bool heap_is_ours(void)
{
  return false;
}

#endif

#endif
