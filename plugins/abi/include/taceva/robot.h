/* A robot that carries an indenter. */
#ifndef TACEVA_ROBOT_H
#define TACEVA_ROBOT_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Pose of the tip in the frame of the sensor: m, and a unit quaternion. */
typedef struct taceva_pose {
  double x, y, z;
  double qw, qx, qy, qz;
} taceva_pose;

typedef struct taceva_motion {
  uint32_t size;
  uint32_t reserved;
  taceva_pose target;
  double speed_m_per_s; /* along the path of the tip */
} taceva_motion;

/* Opening moves nothing. A call of `wait` follows each `move_to`. The tip moves along a straight line and rests at the end.
 * A halt latches: until `clear_halt`, every motion returns INTERRUPTED. After an error, the robot stands still. */
typedef struct taceva_robot_calls {
  taceva_device_calls device;
  taceva_status (*pose)(void *handle, taceva_pose *pose, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error); /* [owner & open] */
  taceva_status (*move_to)(void *handle, const taceva_motion *motion, uint64_t *token, taceva_error *error); /* [owner & open] returns when accepted; may leave the motion to `wait` */
  taceva_status (*wait)(void *handle, uint64_t token, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error); /* [owner & open] returns when the tip rests at the target */
  taceva_status (*halt)(void *handle, taceva_error *error);                                  /* [any & open] the tip rests within 50 ms; idempotent */
  taceva_status (*clear_halt)(void *handle, uint64_t timeout_ns, taceva_error *error);       /* [owner & open] */
} taceva_robot_calls;

#ifdef __cplusplus
}
#endif
#endif
