/* Light around a sensor, in named scenes. The manifest lists them. */
#ifndef TACEVA_LIGHTING_H
#define TACEVA_LIGHTING_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct taceva_lighting_calls {
  taceva_device_calls device;
  taceva_status (*set)(void *handle, taceva_text scene, uint64_t timeout_ns, taceva_error *error); /* [owner & open] returns once the light is steady */
} taceva_lighting_calls;

#ifdef __cplusplus
}
#endif
#endif
