/* A simulated changer with two specimens. Bringing the other one into place takes 100 ms. */
#include <stdlib.h>
#include <taceva/changer.h>

#include "text.h"
#include "waiting.h"

#define CHANGE_NS 100000000u
#define HOLDS 2

static const char *const HELD[HOLDS] = {"sphere of radius 4 mm", "line grating of 1.5 mm"};

typedef struct {
  waiting waiting;
  int place; /* index of the specimen in place; HOLDS: none */
} changer;

static void close_changer(void *handle) {
  changer *it = handle;
  waiting_close(&it->waiting);
  free(it);
}

static void interrupt_changer(void *handle) { waiting_interrupt(&((changer *)handle)->waiting); }

static taceva_status bring(void *handle, taceva_text name, uint64_t timeout_ns, taceva_take_text take, void *context, taceva_error *error) {
  changer *it = handle;
  int place = 0;
  if (!take) return failed(error, TACEVA_INVALID_ARGUMENT, "`take` is NULL");
  while (place < HOLDS && !is(name, HELD[place])) place += 1;
  if (place == HOLDS) return failed(error, TACEVA_INVALID_ARGUMENT, "the changer has no item of this name");
  if (place != it->place) {
    it->place = HOLDS; /* between two places, also after an interrupted call */
    taceva_status status = wait_until(&it->waiting, host->now_ns(host->context) + CHANGE_NS, timeout_ns, error);
    if (status != TACEVA_OK) return status;
    it->place = place;
  }
  taceva_text there = {HELD[place], strlen(HELD[place])};
  take(context, there);
  return TACEVA_OK;
}

static const taceva_changer_calls calls = {{sizeof calls, 0, close_changer, interrupt_changer, NULL}, bring};

taceva_status open_changer(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  (void)args, (void)rig;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one changer");
  changer *it = calloc(1, sizeof *it);
  if (!it) return failed(error, TACEVA_INTERNAL, "no memory");
  waiting_open(&it->waiting);
  it->place = HOLDS;
  device->handle = it;
  device->calls = &calls.device;
  return TACEVA_OK;
}
