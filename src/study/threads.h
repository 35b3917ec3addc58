/* SPDX-License-Identifier: BSD-3-Clause */
/* Threads and locks of a study. */
#ifndef BAUM_I_STUDY_THREADS_H
#define BAUM_I_STUDY_THREADS_H

#include <pthread.h>
#include <stdbool.h>

typedef struct baum_i_lock {
  pthread_mutex_t mutex;
} baum_i_lock;

bool baum_i_lock_make(baum_i_lock *lock);
void baum_i_lock_end(baum_i_lock *lock);
void baum_i_lock_take(baum_i_lock *lock);
void baum_i_lock_give(baum_i_lock *lock);

/* Calls work(user, k) for k = 0 to count - 1. The first call is in this thread, the others are in
 * separate threads. Calls for which no thread can be created are omitted. Returns after all calls
 * have ended. */
void baum_i_threads_run(int count, void (*work)(void *user, int k), void *user);

#endif
