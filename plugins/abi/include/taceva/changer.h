/* A changer, since minor 2: brings one of its items into place, such as a specimen under the robot or a unit of a sensor. */
#ifndef TACEVA_CHANGER_H
#define TACEVA_CHANGER_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The host halts the robot while the changer moves. The changer calls `take` once, after its motion has ended and before `bring` returns. The
 * text is the name of the item in place by its own sensors, or `name` without sensors. After an error or an interrupt, the changer stops. */
typedef struct taceva_changer_calls {
  taceva_device_calls device;
  taceva_status (*bring)(void *handle, taceva_text name, uint64_t timeout_ns, taceva_take_text take, void *context, taceva_error *error); /* [owner & open] */
} taceva_changer_calls;

#ifdef __cplusplus
}
#endif
#endif
