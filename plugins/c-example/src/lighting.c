/* A simulated light with two scenes that are set at once. */
#include <stdlib.h>
#include <taceva/lighting.h>

#include "text.h"
#include "waiting.h"

typedef struct {
  int is_lit;
} lamp;

static void close_lamp(void *handle) { free(handle); }

static taceva_status set(void *handle, taceva_text scene, uint64_t timeout_ns, taceva_error *error) {
  (void)timeout_ns;
  if (!is(scene, "dark") && !is(scene, "room")) return failed(error, TACEVA_INVALID_ARGUMENT, "expected `dark` or `room`");
  ((lamp *)handle)->is_lit = is(scene, "room");
  return TACEVA_OK;
}

/* No call waits, so `interrupt` is NULL. */
static const taceva_lighting_calls calls = {{sizeof calls, 0, close_lamp, NULL, NULL}, set};

taceva_status open_lighting(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  (void)args, (void)rig;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one lighting");
  device->handle = calloc(1, sizeof(lamp));
  device->calls = &calls.device;
  return device->handle ? TACEVA_OK : failed(error, TACEVA_INTERNAL, "no memory");
}
