/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/threads.h"

#include "base/alloc.h"

bool baum_i_lock_make(baum_i_lock *lock)
{
  return pthread_mutex_init(&lock->mutex, NULL) == 0;
}

void baum_i_lock_end(baum_i_lock *lock)
{
  (void)pthread_mutex_destroy(&lock->mutex);
}

void baum_i_lock_take(baum_i_lock *lock)
{
  (void)pthread_mutex_lock(&lock->mutex);
}

void baum_i_lock_give(baum_i_lock *lock)
{
  (void)pthread_mutex_unlock(&lock->mutex);
}

typedef struct hand {
  pthread_t thread;
  void (*work)(void *user, int k);
  void *user;
  int k;
  bool at_work;
} hand;

static void *start(void *self)
{
  hand *h = self;
  h->work(h->user, h->k);
  return NULL;
}

void baum_i_threads_run(int count, void (*work)(void *user, int k), void *user)
{
  hand *hands = baum_i_alloc((size_t)count, sizeof *hands);
  for (int k = 1; hands && k < count; k++) {
    hands[k] = (hand){.work = work, .user = user, .k = k};
    hands[k].at_work = pthread_create(&hands[k].thread, NULL, start, &hands[k]) == 0;
  }
  work(user, 0);
  for (int k = 1; hands && k < count; k++) {
    if (hands[k].at_work) {
      (void)pthread_join(hands[k].thread, NULL);
    }
  }
  baum_i_free(hands);
}
