/* A simulated robot. Its tip moves along a straight line at the requested speed, in slices of 2 ms. */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <taceva/robot.h>

#include "waiting.h"

#define SLICE_NS 2000000u
#define SPEED_MAX_M_PER_S 0.1

typedef struct {
  waiting waiting;
  atomic_int is_halted; /* set from any thread, and kept until `clear_halt` */
  atomic_int is_interrupted; /* set from any thread; cleared at the start of `wait` */
  taceva_pose at;
  taceva_motion accepted;
  int is_accepted;
  uint64_t token;
} robot;

static void close_robot(void *handle) {
  robot *it = handle;
  waiting_close(&it->waiting);
  free(it);
}

static void interrupt_robot(void *handle) {
  robot *it = handle;
  atomic_store(&it->is_interrupted, 1);
  waiting_interrupt(&it->waiting);
}

static void stamp_now(taceva_stamp *stamp) { stamp->valid_ns = stamp->received_ns = host->now_ns(host->context); }

static taceva_status pose(void *handle, taceva_pose *into, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  (void)timeout_ns;
  if (!into || !stamp) return failed(error, TACEVA_INVALID_ARGUMENT, "`pose` or `stamp` is NULL");
  *into = ((robot *)handle)->at;
  stamp_now(stamp);
  return TACEVA_OK;
}

/* Accepts a motion, which `wait` executes. Positions are in m. The workspace is 40 x 20 x 20 mm. */
static taceva_status move_to(void *handle, const taceva_motion *motion, uint64_t *token, taceva_error *error) {
  robot *it = handle;
  if (!motion || motion->size < sizeof *motion || !token) return failed(error, TACEVA_INVALID_ARGUMENT, "`motion` or `token` is NULL, or `motion` is too short");
  const taceva_pose *to = &motion->target;
  double turn = to->qw * to->qw + to->qx * to->qx + to->qy * to->qy + to->qz * to->qz;
  if (!isfinite(to->x) || !isfinite(to->y) || !isfinite(to->z) || !(fabs(turn - 1) < 1e-6))
    return failed(error, TACEVA_INVALID_ARGUMENT, "expected a finite place and a unit quaternion");
  if (!isfinite(motion->speed_m_per_s) || motion->speed_m_per_s <= 0) return failed(error, TACEVA_INVALID_ARGUMENT, "expected a speed above 0");
  if (atomic_load(&it->is_halted)) return failed(error, TACEVA_INTERRUPTED, "it is halted");
  if (fabs(to->x) > 0.02 || fabs(to->y) > 0.01 || fabs(to->z) > 0.01) return failed(error, TACEVA_OUT_OF_RANGE, "the target is outside the workspace");
  if (motion->speed_m_per_s > SPEED_MAX_M_PER_S) return failed(error, TACEVA_OUT_OF_RANGE, "the speed exceeds 100 mm/s");
  it->accepted = *motion;
  it->is_accepted = 1;
  *token = ++it->token;
  return TACEVA_OK;
}

/* Moves the tip. The tip stands still whenever this call ends, here after at most one slice. */
static taceva_status wait_for(void *handle, uint64_t token, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) {
  robot *it = handle;
  if (!stamp) return failed(error, TACEVA_INVALID_ARGUMENT, "`stamp` is NULL");
  if (!it->is_accepted || token != it->token) return failed(error, TACEVA_INVALID_ARGUMENT, "no motion with this token was accepted");
  it->is_accepted = 0;
  atomic_store(&it->is_interrupted, 0);
  taceva_pose from = it->at, to = it->accepted.target;
  double dx = to.x - from.x, dy = to.y - from.y, dz = to.z - from.z;
  double length_m = sqrt(dx * dx + dy * dy + dz * dz);
  uint64_t begun_ns = host->now_ns(host->context);
  uint64_t latest_ns = timeout_ns < UINT64_MAX - begun_ns ? begun_ns + timeout_ns : UINT64_MAX;
  for (double part = 0; part < 1;) {
    uint64_t now_ns = host->now_ns(host->context);
    if (atomic_load(&it->is_halted)) return failed(error, TACEVA_INTERRUPTED, "it is halted");
    if (atomic_load(&it->is_interrupted)) return failed(error, TACEVA_INTERRUPTED, "it was interrupted");
    taceva_status status = wait_until(&it->waiting, now_ns + SLICE_NS, latest_ns > now_ns ? latest_ns - now_ns : 0, error);
    if (status != TACEVA_OK) return status;
    double gone_m = (double)(host->now_ns(host->context) - begun_ns) * 1e-9 * it->accepted.speed_m_per_s;
    part = gone_m < length_m ? gone_m / length_m : 1;
    it->at.x = from.x + part * dx;
    it->at.y = from.y + part * dy;
    it->at.z = from.z + part * dz;
  }
  it->at = to;
  stamp_now(stamp);
  return TACEVA_OK;
}

/* Called from any thread, also while `wait` moves the tip. */
static taceva_status halt(void *handle, taceva_error *error) {
  robot *it = handle;
  (void)error;
  atomic_store(&it->is_halted, 1);
  waiting_interrupt(&it->waiting);
  return TACEVA_OK;
}

static taceva_status clear_halt(void *handle, uint64_t timeout_ns, taceva_error *error) {
  (void)timeout_ns, (void)error;
  atomic_store(&((robot *)handle)->is_halted, 0);
  return TACEVA_OK;
}

static const taceva_robot_calls calls = {
    {sizeof calls, 0, close_robot, interrupt_robot, NULL}, pose, move_to, wait_for, halt, clear_halt,
};

taceva_status open_robot(uint32_t driver, const taceva_args *args, taceva_rig *rig, taceva_device *device, taceva_error *error) {
  (void)args, (void)rig;
  if (driver != 0) return failed(error, TACEVA_NOT_FOUND, "there is one robot");
  robot *it = calloc(1, sizeof *it);
  if (!it) return failed(error, TACEVA_INTERNAL, "no memory");
  waiting_open(&it->waiting);
  it->at.qw = 1;
  device->handle = it;
  device->calls = &calls.device;
  return TACEVA_OK;
}
