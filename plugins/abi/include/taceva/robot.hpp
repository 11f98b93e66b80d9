/* A robot in C++17: see device.hpp. Exported with TACEVA_ROBOTS(id, version, needs, class...).
 *
 * The base class latches a halt: it ends `rest_until` of a motion, and rejects motions until `clear_halt`. An emergency stop, a collision or a
 * workspace limit is a fault: `throw taceva::failure(TACEVA_DEVICE_FAULT, "axis 3", TACEVA_FAULT_COLLISION)`. Nothing moves after it. */
#ifndef TACEVA_ROBOT_HPP
#define TACEVA_ROBOT_HPP

#include <atomic>
#include <cmath>

#include "device.hpp"
#include "ext/expiring_motion.h"
#include "robot.h"

namespace taceva {
class robot : public device {
 public:
  virtual void pose(taceva_pose &into, taceva_stamp &stamp, deadline until) = 0;
  /* Checks target and speed of a motion: throws OUT_OF_RANGE if a limit is exceeded. Nothing moves. */
  virtual void check(const taceva_motion &) {}
  /* Moves along a straight line, and returns when the tip rests at the target. The robot must stand still whenever this call ends. */
  virtual void move(const taceva_motion &to, taceva_stamp &stamp, deadline until) = 0;
  /* [any thread] Stops the tip within 50 ms. A motion in slices of `rest_until` needs no override. */
  virtual void halt() {}
  virtual void clear_halt(deadline) {}

 private:
  friend struct kind_of<robot>;
  std::atomic<bool> is_halted_{false};
  taceva_motion accepted_ = {};
  uint64_t token_ = 0;
  bool is_accepted_ = false;
};

/* Ability: a further base class of a robot whose controller drops a command after 200 ms, unless it is repeated. */
struct can_expire {
  virtual ~can_expire() = default;
  virtual void move_expiring(const taceva_motion &to, taceva_stamp &stamp, deadline until) = 0; /* as `move`, with repeated commands until the tip rests */
};

template <> struct [[gnu::visibility("hidden")]] kind_of<robot> {
  static constexpr std::string_view id = TACEVA_ROBOT_FACTORY;
  static void unless_halted(const robot &it) { if (it.is_halted_) throw failure(TACEVA_INTERRUPTED, "it is halted"); }
  static taceva_status pose(void *handle, taceva_pose *into, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(into && stamp, "`pose` or `stamp` is NULL");
      *into = {}, *stamp = {};
      device_calls::begun<robot>(handle).pose(*into, *stamp, device_calls::after(timeout_ns));
    });
  }
  static void admit(robot &it, const taceva_motion *motion) { /* throws unless the motion may begin now */
    device_calls::expect(motion && motion->size >= sizeof *motion, "`motion` is NULL or too short");
    const taceva_pose &to = motion->target;
    const double turn = to.qw * to.qw + to.qx * to.qx + to.qy * to.qy + to.qz * to.qz;
    device_calls::expect(std::isfinite(to.x + to.y + to.z) && std::fabs(turn - 1) < 1e-6, "expected a finite target with a unit quaternion");
    device_calls::expect(std::isfinite(motion->speed_m_per_s) && motion->speed_m_per_s > 0, "expected a speed above 0");
    unless_halted(it);
    it.check(*motion);
  }
  static taceva_status move_to(void *handle, const taceva_motion *motion, uint64_t *token, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      robot &it = device_calls::begun<robot>(handle);
      device_calls::expect(token, "`token` is NULL");
      admit(it, motion);
      it.accepted_ = *motion, it.is_accepted_ = true;
      *token = ++it.token_;
    });
  }
  static taceva_status wait(void *handle, uint64_t token, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      robot &it = device_calls::begun<robot>(handle);
      device_calls::expect(stamp, "`stamp` is NULL");
      device_calls::expect(it.is_accepted_ && token == it.token_, "no such motion was accepted, or it was waited for");
      it.is_accepted_ = false;
      *stamp = {};
      unless_halted(it);
      it.move(it.accepted_, *stamp, device_calls::after(timeout_ns));
    });
  }
  static taceva_status halt(void *handle, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      robot &it = static_cast<robot &>(*static_cast<device *>(handle));
      it.is_halted_ = true;
      it.interrupt();
      it.halt();
    });
  }
  static taceva_status clear_halt(void *handle, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      robot &it = device_calls::begun<robot>(handle);
      it.clear_halt(device_calls::after(timeout_ns));
      it.is_halted_ = false;
    });
  }
  static can_expire *expiring(void *handle) { return dynamic_cast<can_expire *>(static_cast<device *>(handle)); }
  static taceva_status move_expiring(void *handle, const taceva_motion *motion, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      robot &it = device_calls::begun<robot>(handle);
      device_calls::expect(stamp, "`stamp` is NULL");
      admit(it, motion);
      *stamp = {};
      expiring(handle)->move_expiring(*motion, *stamp, device_calls::after(timeout_ns));
    });
  }
  static constexpr taceva_expiring_motion_calls expiring_calls = {sizeof(taceva_expiring_motion_calls), 0, move_expiring};
  static const void *extension(void *handle, taceva_text name) noexcept {
    return std::string_view(name.data, name.length) == TACEVA_EXPIRING_MOTION && expiring(handle) ? &expiring_calls : nullptr;
  }
  static constexpr taceva_robot_calls calls = {
      {sizeof(taceva_robot_calls), 0, device_calls::close, device_calls::interrupt, extension}, pose, move_to, wait, halt, clear_halt};
};
}  // namespace taceva

/* Exports a plugin with these robots, with `needs`: one need per line, "" for none. */
#define TACEVA_ROBOTS(id, version, needs, ...) TACEVA_EXPORTED(taceva::robot, id, version, needs, __VA_ARGS__)
#endif
