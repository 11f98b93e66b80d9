/* A simulated force transducer under a constant load that the user sets. It measures only Fz, every 5 ms. */
#include <stdlib.h>
#include <string.h>
#include <taceva/ext/numbered.h>
#include <taceva/ext/tare.h>
#include <taceva/force.h>

#include "text.h"
#include "waiting.h"

#define PERIOD_NS 5000000u
#define RANGE_N 50.0

typedef struct {
  waiting waiting;
  int is_started;
  uint64_t due_ns, readings;
  double load_n, zero_n;
} transducer;

static void close_force(void *handle) {
  transducer *it = handle;
  waiting_close(&it->waiting);
  free(it);
}

static void interrupt_force(void *handle) { waiting_interrupt(&((transducer *)handle)->waiting); }

static taceva_status start(void *handle, uint64_t timeout_ns, taceva_error *error) {
  transducer *it = handle;
  (void)timeout_ns, (void)error;
  if (!it->is_started) it->due_ns = host->now_ns(host->context) + PERIOD_NS;
  it->is_started = 1;
  return TACEVA_OK;
}

static taceva_status stop(void *handle, taceva_error *error) {
  (void)error;
  ((transducer *)handle)->is_started = 0;
  return TACEVA_OK;
}

static taceva_status next(transducer *it, uint64_t timeout_ns, taceva_error *error) {
  if (!it->is_started) return failed(error, TACEVA_INVALID_ARGUMENT, "it is not started");
  taceva_status status = wait_until(&it->waiting, it->due_ns, timeout_ns, error);
  if (status == TACEVA_OK) it->due_ns += PERIOD_NS, it->readings += 1;
  return status;
}

static taceva_status read_force(void *handle, taceva_wrench *wrench, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  transducer *it = handle;
  if (!wrench || !stamp) return failed(error, TACEVA_INVALID_ARGUMENT, "`wrench` or `stamp` is NULL");
  taceva_status status = next(it, timeout_ns, error);
  if (status != TACEVA_OK) return status;
  if (it->load_n >= RANGE_N) return failed(error, TACEVA_OUT_OF_RANGE, "the load is 50 N or more");
  memset(wrench, 0, sizeof *wrench);
  wrench->force_n[2] = it->load_n - it->zero_n;
  stamp->valid_ns = stamp->received_ns = it->readings * PERIOD_NS;
  return TACEVA_OK;
}

static taceva_status zero(void *handle, uint64_t timeout_ns, taceva_error *error) {
  transducer *it = handle;
  taceva_status status = next(it, timeout_ns, error);
  if (status == TACEVA_OK) it->zero_n = it->load_n;
  return status;
}

static const taceva_tare_calls tare_calls = {sizeof tare_calls, 0, zero};

/* Number of the last reading. The simulation counts its readings; a real plugin returns the number from the device. */
static taceva_status sequence(void *handle, uint64_t *number, taceva_error *error) {
  transducer *it = handle;
  if (!number) return failed(error, TACEVA_INVALID_ARGUMENT, "`sequence` is NULL");
  if (it->readings == 0) return failed(error, TACEVA_NOT_FOUND, "no reading yet");
  *number = it->readings;
  return TACEVA_OK;
}

static const taceva_numbered_calls numbered_calls = {sizeof numbered_calls, 0, sequence};

static const void *extension(void *handle, taceva_text id) {
  (void)handle;
  if (is(id, TACEVA_TARE)) return &tare_calls;
  return is(id, TACEVA_NUMBERED) ? &numbered_calls : NULL;
}

static const taceva_force_calls calls = {
    {sizeof calls, 0, close_force, interrupt_force, extension}, start, read_force, stop, NULL,
};

taceva_status open_force(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  (void)rig;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one force transducer");
  transducer *it = calloc(1, sizeof *it);
  if (!it) return failed(error, TACEVA_INTERNAL, "no memory");
  waiting_open(&it->waiting);
  it->load_n = 1.0;
  /* `load`, 0 to 60 N, checked by the host against the manifest. */
  for (size_t at = 0; args && at < args->count; at++) it->load_n = args->items[at].number;
  device->handle = it;
  device->calls = &calls.device;
  return TACEVA_OK;
}
