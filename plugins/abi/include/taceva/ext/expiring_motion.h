/* Extension of a robot, since minor 2: it stands by itself where nobody renews its motion. */
#ifndef TACEVA_EXT_EXPIRING_MOTION_H
#define TACEVA_EXT_EXPIRING_MOTION_H

#include "../robot.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_EXPIRING_MOTION "taceva.robot.expiring-motion/1"

typedef struct taceva_expiring_motion_calls {
  uint32_t size;
  uint32_t reserved;
  /* [owner & open] Moves as `move_to` and `wait` do, by commands that the controller drops by itself: where the process of the plugin ends in the
   * middle of it, the robot begins to brake 200 ms later at most. */
  taceva_status (*move_expiring)(void *handle, const taceva_motion *motion, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error);
} taceva_expiring_motion_calls;

#ifdef __cplusplus
}
#endif
#endif
