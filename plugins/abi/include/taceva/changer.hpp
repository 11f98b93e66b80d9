/* A changer in C++17: see device.hpp. Exported with TACEVA_CHANGERS(id, version, needs, class...). */
#ifndef TACEVA_CHANGER_HPP
#define TACEVA_CHANGER_HPP

#include "changer.h"
#include "device.hpp"

namespace taceva {
class changer : public device {
 public:
  /* Brings the item `name` into place. Returns the name of the item in place after the motion: by its own sensors, or `name` without sensors.
   * Throws INVALID_ARGUMENT for an unknown name. If `rest_until` throws during the motion, stop the motion before the exception leaves. */
  virtual std::string bring(std::string_view name, deadline until) = 0;
};

template <> struct [[gnu::visibility("hidden")]] kind_of<changer> {
  static constexpr std::string_view id = TACEVA_CHANGER_FACTORY;
  static taceva_status bring(void *handle, taceva_text name, uint64_t timeout_ns, taceva_take_text take, void *context, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(name.data || name.length == 0, "`name` is NULL");
      device_calls::expect(take, "`take` is NULL");
      const std::string there = device_calls::begun<changer>(handle).bring(std::string_view(name.data, name.length), device_calls::after(timeout_ns));
      take(context, {there.data(), there.size()});
    });
  }
  static constexpr taceva_changer_calls calls = {{sizeof(taceva_changer_calls), 0, device_calls::close, device_calls::interrupt, nullptr}, bring};
};
}  // namespace taceva

/* Exports a plugin with these changers, with `needs`: one need per line, "" for none. */
#define TACEVA_CHANGERS(id, version, needs, ...) TACEVA_EXPORTED(taceva::changer, id, version, needs, __VA_ARGS__)
#endif
