/* A lighting in C++17: see device.hpp. Exported with TACEVA_LIGHTINGS(id, version, needs, class...). */
#ifndef TACEVA_LIGHTING_HPP
#define TACEVA_LIGHTING_HPP

#include "device.hpp"
#include "lighting.h"

namespace taceva {
class lighting : public device {
 public:
  /* Returns once the light holds. The host refuses scenes that the manifest does not list; so does this, with INVALID_ARGUMENT. */
  virtual void set(std::string_view scene, deadline until) = 0;
};

template <> struct [[gnu::visibility("hidden")]] kind_of<lighting> {
  static constexpr std::string_view id = TACEVA_LIGHTING_FACTORY;
  static taceva_status set(void *handle, taceva_text scene, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(scene.data || scene.length == 0, "a scene that is no text");
      device_calls::begun<lighting>(handle).set(std::string_view(scene.data, scene.length), device_calls::after(timeout_ns));
    });
  }
  static constexpr taceva_lighting_calls calls = {{sizeof(taceva_lighting_calls), 0, device_calls::close, device_calls::interrupt, nullptr}, set};
};
}  // namespace taceva

/* Exports a plugin with these lightings, which needs `needs`: a need a line, "" for nothing. */
#define TACEVA_LIGHTINGS(id, version, needs, ...) TACEVA_EXPORTED(taceva::lighting, id, version, needs, __VA_ARGS__)
#endif
