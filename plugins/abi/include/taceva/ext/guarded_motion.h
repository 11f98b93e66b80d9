/* Extension of a robot: it stops by itself at a force. */
#ifndef TACEVA_EXT_GUARDED_MOTION_H
#define TACEVA_EXT_GUARDED_MOTION_H

#include "../robot.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TACEVA_GUARDED_MOTION "taceva.robot.guarded-motion/1"

typedef struct taceva_guarded_stop {
  uint32_t size;
  uint32_t is_guarded; /* 0: it arrived; 1: it stopped at the guard, at `pose` */
  taceva_pose pose;
  taceva_stamp stamp;
} taceva_guarded_stop;

typedef struct taceva_guarded_motion_calls {
  uint32_t size;
  uint32_t reserved;
  /* [owner & open] Moves like `move_to` and `wait`, and stops when the magnitude of the force reaches `guard_n`, N. */
  taceva_status (*move_guarded)(void *handle, const taceva_motion *motion, double guard_n, taceva_guarded_stop *stop,
                                uint64_t timeout_ns, taceva_error *error);
} taceva_guarded_motion_calls;

#ifdef __cplusplus
}
#endif
#endif
