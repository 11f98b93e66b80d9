/* A simulated sensor: 100 gray pictures per second of a bright bar that moves over the gel. */
#include <stdlib.h>
#include <string.h>
#include <taceva/sensor.h>

#include "waiting.h"

#define WIDTH 64u
#define HEIGHT 48u
#define LENGTH ((size_t)WIDTH * HEIGHT)
#define PERIOD_NS 10000000u
#define LENT_MAX 2u

typedef struct {
  waiting waiting;
  int is_started;
  uint64_t due_ns, frames;
  pthread_mutex_t lent; /* `release` may be called from any thread, even after `close`; the last of both frees the memory */
  uint32_t out, is_closed;
} sensor;

static void leave(sensor *it) {
  int is_last = it->is_closed && it->out == 0;
  pthread_mutex_unlock(&it->lent);
  if (is_last) {
    pthread_mutex_destroy(&it->lent);
    free(it);
  }
}

static void close_sensor(void *handle) {
  sensor *it = handle;
  waiting_close(&it->waiting);
  pthread_mutex_lock(&it->lent);
  it->is_closed = 1;
  leave(it);
}

static void interrupt_sensor(void *handle) { waiting_interrupt(&((sensor *)handle)->waiting); }

static taceva_status start(void *handle, uint64_t timeout_ns, taceva_error *error) {
  sensor *it = handle;
  (void)timeout_ns, (void)error;
  if (!it->is_started) it->due_ns = host->now_ns(host->context) + PERIOD_NS;
  it->is_started = 1;
  return TACEVA_OK;
}

static taceva_status stop(void *handle, taceva_error *error) {
  (void)error;
  ((sensor *)handle)->is_started = 0;
  return TACEVA_OK;
}

static void release(taceva_frame *frame) {
  sensor *it = frame->private_data;
  free((void *)frame->data);
  frame->release = NULL;
  pthread_mutex_lock(&it->lent);
  it->out -= 1;
  leave(it);
}

/* Memory for a picture: the buffer of the host, or lent memory of the plugin. */
static uint8_t *pixels_for(sensor *it, taceva_frame *frame) {
  if (frame->buffer) return frame->buffer;
  pthread_mutex_lock(&it->lent);
  uint8_t *pixels = it->out < LENT_MAX ? malloc(LENGTH) : NULL;
  if (pixels) it->out += 1, frame->release = release, frame->private_data = it;
  pthread_mutex_unlock(&it->lent);
  return pixels;
}

static taceva_status capture(void *handle, taceva_frame *frame, uint64_t timeout_ns, taceva_error *error) {
  sensor *it = handle;
  if (!frame || frame->size < sizeof *frame) return failed(error, TACEVA_ABI, "`frame` is NULL or too short");
  if (!it->is_started) return failed(error, TACEVA_INVALID_ARGUMENT, "it is not started");
  if (frame->buffer && frame->buffer_length < LENGTH) return failed(error, TACEVA_INVALID_ARGUMENT, "a frame does not fit: `frame` of plugin.toml differs from WIDTH, HEIGHT and format");
  taceva_status status = wait_until(&it->waiting, it->due_ns, timeout_ns, error);
  if (status != TACEVA_OK) return status;
  uint8_t *pixels = pixels_for(it, frame);
  if (!pixels) return failed(error, TACEVA_BUSY, "two frames are lent already");
  uint64_t bar = it->frames % WIDTH;
  for (size_t at = 0; at < LENGTH; at++) pixels[at] = at % WIDTH == bar ? 250 : 40;
  it->frames += 1;
  it->due_ns += PERIOD_NS;
  frame->format = TACEVA_GRAY8;
  frame->width = WIDTH, frame->height = HEIGHT;
  frame->flags = 0, frame->sequence = it->frames;
  /* A simulation has its own clock; a camera uses `host->now_ns` at the middle of the exposure. */
  frame->stamp.valid_ns = frame->stamp.received_ns = it->frames * PERIOD_NS;
  frame->data = pixels, frame->length = LENGTH;
  return TACEVA_OK;
}

static const taceva_sensor_calls calls = {
    {sizeof calls, 0, close_sensor, interrupt_sensor, NULL}, LENT_MAX, 0, start, capture, stop,
};

taceva_status open_sensor(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  (void)args, (void)rig;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one sensor");
  sensor *it = calloc(1, sizeof *it);
  if (!it) return failed(error, TACEVA_INTERNAL, "no memory");
  waiting_open(&it->waiting);
  pthread_mutex_init(&it->lent, NULL);
  device->handle = it;
  device->calls = &calls.device;
  return TACEVA_OK;
}
