/* Waits that another thread can interrupt, and the error message of a failed call. */
#ifndef WAITING_H
#define WAITING_H

#include <pthread.h>
#include <stdio.h>
#include <taceva/plugin.h>
#include <time.h>

extern const taceva_host *host; /* the argument of `init` */

/* Wait of one device, with one pending call. */
typedef struct {
  pthread_mutex_t lock;
  pthread_cond_t bell;
  int is_pending, is_interrupted;
} waiting;

static inline taceva_status failed(taceva_error *error, taceva_status status, const char *why) {
  const size_t head = offsetof(taceva_error, message);
  if (error && error->size > head) {
    size_t room = error->size - head;
    snprintf(error->message, room < TACEVA_MESSAGE_SIZE ? room : TACEVA_MESSAGE_SIZE, "%s", why);
  }
  return status;
}

static inline void waiting_open(waiting *it) {
  pthread_condattr_t monotonic;
  pthread_condattr_init(&monotonic);
  pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC); /* the clock of `host->now_ns` */
  pthread_mutex_init(&it->lock, NULL);
  pthread_cond_init(&it->bell, &monotonic);
  pthread_condattr_destroy(&monotonic);
  it->is_pending = it->is_interrupted = 0;
}

static inline void waiting_close(waiting *it) {
  pthread_cond_destroy(&it->bell);
  pthread_mutex_destroy(&it->lock);
}

/* Interrupts the pending call, from any thread. Without one, it has no effect, not even on the next call. */
static inline void waiting_interrupt(waiting *it) {
  pthread_mutex_lock(&it->lock);
  if (it->is_pending) {
    it->is_interrupted = 1;
    pthread_cond_signal(&it->bell);
  }
  pthread_mutex_unlock(&it->lock);
}

/* Waits until `due_ns`, at most `timeout_ns`. */
static inline taceva_status wait_until(waiting *it, uint64_t due_ns, uint64_t timeout_ns, taceva_error *error) {
  uint64_t now_ns = host->now_ns(host->context);
  uint64_t latest_ns = timeout_ns < UINT64_MAX - now_ns ? now_ns + timeout_ns : UINT64_MAX;
  uint64_t until_ns = due_ns < latest_ns ? due_ns : latest_ns;
  struct timespec until = {(time_t)(until_ns / 1000000000u), (long)(until_ns % 1000000000u)};
  pthread_mutex_lock(&it->lock);
  it->is_pending = 1;
  while (!it->is_interrupted && host->now_ns(host->context) < until_ns) pthread_cond_timedwait(&it->bell, &it->lock, &until);
  int was_interrupted = it->is_interrupted;
  it->is_pending = it->is_interrupted = 0;
  pthread_mutex_unlock(&it->lock);
  if (was_interrupted) return failed(error, TACEVA_INTERRUPTED, "it was interrupted");
  return due_ns <= latest_ns ? TACEVA_OK : failed(error, TACEVA_TIMEOUT, "nothing came in time");
}

#endif
