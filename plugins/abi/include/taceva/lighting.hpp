/* A lighting in C++17: see device.hpp. Exported with TACEVA_LIGHTINGS(id, version, needs, class...). */
#ifndef TACEVA_LIGHTING_HPP
#define TACEVA_LIGHTING_HPP

#include "device.hpp"
#include "lighting.h"

namespace taceva {
class lighting : public device {
 public:
  /* Returns once the light is steady. Throws INVALID_ARGUMENT for a scene that the manifest does not list. The host rejects such scenes too. */
  virtual void set(std::string_view scene, deadline until) = 0;
};

template <> struct [[gnu::visibility("hidden")]] kind_of<lighting> {
  static constexpr std::string_view id = TACEVA_LIGHTING_FACTORY;
  static taceva_status set(void *handle, taceva_text scene, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(scene.data || scene.length == 0, "`scene` is NULL");
      device_calls::begun<lighting>(handle).set(std::string_view(scene.data, scene.length), device_calls::after(timeout_ns));
    });
  }
  static constexpr taceva_lighting_calls calls = {{sizeof(taceva_lighting_calls), 0, device_calls::close, device_calls::interrupt, nullptr}, set};
};
}  // namespace taceva

/* Exports a plugin with these lightings, with `needs`: one need per line, "" for none. */
#define TACEVA_LIGHTINGS(id, version, needs, ...) TACEVA_EXPORTED(taceva::lighting, id, version, needs, __VA_ARGS__)
#endif
