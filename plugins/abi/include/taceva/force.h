/* A transducer of force, and optionally torque. */
#ifndef TACEVA_FORCE_H
#define TACEVA_FORCE_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Force in N and torque in N mm on the gel, as in C++, Rust and Python. Components that the manifest does not list as `axes` are 0. */
typedef struct taceva_wrench {
  double force_n[3];
  double torque_n_mm[3];
} taceva_wrench;

/* `read` waits for the next reading. It returns OUT_OF_RANGE for a clipped force. */
typedef struct taceva_force_calls {
  taceva_device_calls device;
  taceva_status (*start)(void *handle, uint64_t timeout_ns, taceva_error *error); /* [owner & open] idempotent */
  taceva_status (*read)(void *handle, taceva_wrench *wrench, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error); /* [owner & started] */
  taceva_status (*stop)(void *handle, taceva_error *error);                       /* [owner & open] idempotent */
  /* Since minor 4. [owner & open] Number of readings lost between device and plugin since the opening, by the numbers of the device. A reading
   * that a newer one replaced is not lost. NULL, or NOT_FOUND, if they are not counted. */
  taceva_status (*lost)(void *handle, uint64_t *lost, taceva_error *error);
} taceva_force_calls;

#ifdef __cplusplus
}
#endif
#endif
