/* Extension of a sensor: it controls its own lighting. */
#ifndef TACEVA_EXT_SENSOR_LIGHTING_H
#define TACEVA_EXT_SENSOR_LIGHTING_H

#include "../plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_SENSOR_LIGHTING "taceva.sensor.lighting/1"

typedef struct taceva_sensor_lighting_calls {
  uint32_t size;
  uint32_t reserved;
  taceva_status (*set)(void *handle, taceva_text scene, uint64_t timeout_ns, taceva_error *error); /* [owner & open] a scene of the manifest */
} taceva_sensor_lighting_calls;

#ifdef __cplusplus
}
#endif
#endif
