/* Extension of a robot, since minor 2: it stops by itself if its motion is not renewed. */
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
  /* [owner & open] Moves like `move_to` and `wait`, by commands that expire in the controller. If the process of the plugin ends during the motion,
   * the robot begins to brake within 200 ms. */
  taceva_status (*move_expiring)(void *handle, const taceva_motion *motion, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error);
} taceva_expiring_motion_calls;

#ifdef __cplusplus
}
#endif
#endif
