/* A sensor: a camera behind a gel. */
#ifndef TACEVA_SENSOR_H
#define TACEVA_SENSOR_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_GRAY8 1u  /* one byte per pixel */
#define TACEVA_GRAY16 2u /* two bytes per pixel, little-endian */
#define TACEVA_RGB8 3u   /* three bytes per pixel */
#define TACEVA_RGB16 4u  /* three numbers of two bytes per pixel, little-endian */

#define TACEVA_FRAME_DROPPED 1u  /* flag: frames were lost since the last one */
#define TACEVA_FRAME_NUMBERED 2u /* flag, since minor 4: the device assigned `sequence`, so a gap means lost frames */

/* A picture, row by row from the top, without padding.
 *
 * A plugin either writes into `buffer` and sets `data` to it, or lends its own memory: `data` elsewhere, and `release` set. The plugin may write
 * to `buffer` only until the call returns. Later writes change recorded pictures, or crash the process after the sensor is closed. */
typedef struct taceva_frame {
  uint32_t size;
  uint32_t format; /* TACEVA_GRAY8 ... */
  uint32_t width;
  uint32_t height;
  uint32_t flags;
  uint32_t reserved;
  uint64_t sequence; /* frame number, which increases with each frame; see TACEVA_FRAME_NUMBERED */
  taceva_stamp stamp; /* valid: middle of the exposure, if known */

  uint8_t *buffer;         /* in: buffer of the caller, or NULL */
  uint64_t buffer_length;  /* in */
  const uint8_t *data;     /* out */
  uint64_t length;         /* out: height * width * bytes per pixel */

  void (*release)(struct taceva_frame *frame); /* out: [any] releases lent memory and sets itself to NULL; NULL: nothing was lent */
  void *private_data;                          /* for use by the plugin while it lends the frame */
} taceva_frame;

typedef struct taceva_sensor_calls {
  taceva_device_calls device;
  uint32_t max_lent; /* most frames lent at once; 0: it never lends */
  uint32_t reserved;
  taceva_status (*start)(void *handle, uint64_t timeout_ns, taceva_error *error);                        /* [owner & open] idempotent */
  taceva_status (*capture)(void *handle, taceva_frame *frame, uint64_t timeout_ns, taceva_error *error); /* [owner & started] the next frame */
  taceva_status (*stop)(void *handle, taceva_error *error);                                              /* [owner & open] idempotent */
} taceva_sensor_calls;

#ifdef __cplusplus
}
#endif
#endif
