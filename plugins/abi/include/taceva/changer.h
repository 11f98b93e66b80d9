/* A changer, since minor 2: brings one of the things that it holds into place, a specimen under the robot or a unit of a sensor. */
#ifndef TACEVA_CHANGER_H
#define TACEVA_CHANGER_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The robot is halted while it moves. `take` is called once, before `bring` succeeds and after nothing of the changer moves any more, with the
 * name of what is in place: what its own signals say, or `name` where it has none. After an error or an interrupt it comes to stand. */
typedef struct taceva_changer_calls {
  taceva_device_calls device;
  taceva_status (*bring)(void *handle, taceva_text name, uint64_t timeout_ns, taceva_take_text take, void *context, taceva_error *error); /* [owner & open] */
} taceva_changer_calls;

#ifdef __cplusplus
}
#endif
#endif
