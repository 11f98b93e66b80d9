/* A force transducer in C++17: see device.hpp. Exported with TACEVA_FORCES(id, version, needs, class...). */
#ifndef TACEVA_FORCE_HPP
#define TACEVA_FORCE_HPP

#include "device.hpp"
#include "ext/numbered.h"
#include "ext/tare.h"
#include "force.h"

namespace taceva {
class force : public device {
 public:
  virtual void next_reading(taceva_wrench &into, taceva_stamp &stamp, deadline until) = 0; /* N and N mm; `into` and `stamp` are 0 before the call */
};

/* Abilities: further base classes of a transducer. The first two need `tare = true` or `numbered = true` in its manifest. */
struct can_tare {
  virtual ~can_tare() = default;
  virtual void zero(deadline until) = 0; /* returns once the zero takes effect */
};
struct can_number {
  virtual ~can_number() = default;
  virtual uint64_t sequence() = 0; /* number of the last reading, assigned by the device */
};
struct can_count_lost {
  virtual ~can_count_lost() = default;
  virtual uint64_t lost() = 0; /* readings lost between device and plugin since the opening */
};

template <> struct [[gnu::visibility("hidden")]] kind_of<force> {
  static constexpr std::string_view id = TACEVA_FORCE_FACTORY;
  template <class Ability> static Ability *able(void *handle) { return dynamic_cast<Ability *>(static_cast<device *>(handle)); }
  static taceva_status read(void *handle, taceva_wrench *wrench, taceva_stamp *stamp, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      force &it = device_calls::begun<force>(handle);
      device_calls::expect(wrench && stamp, "`wrench` or `stamp` is NULL");
      device_calls::expect(device_calls::is_started(it), "it is not started");
      *wrench = {}, *stamp = {};
      it.next_reading(*wrench, *stamp, device_calls::after(timeout_ns));
    });
  }
  static taceva_status zero(void *handle, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(device_calls::is_started(device_calls::begun<force>(handle)), "it is not started");
      able<can_tare>(handle)->zero(device_calls::after(timeout_ns));
    });
  }
  static taceva_status sequence(void *handle, uint64_t *number, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(number, "`sequence` is NULL");
      *number = able<can_number>(handle)->sequence();
    });
  }
  static taceva_status lost(void *handle, uint64_t *number, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      device_calls::expect(number, "`lost` is NULL");
      can_count_lost *it = able<can_count_lost>(handle);
      if (!it) throw failure(TACEVA_NOT_FOUND, "it counts no lost readings");
      *number = it->lost();
    });
  }
  static constexpr taceva_tare_calls tares = {sizeof(taceva_tare_calls), 0, zero};
  static constexpr taceva_numbered_calls numbers = {sizeof(taceva_numbered_calls), 0, sequence};
  static const void *extension(void *handle, taceva_text name) noexcept {
    const std::string_view said(name.data, name.length);
    if (said == TACEVA_TARE && able<can_tare>(handle)) return &tares;
    if (said == TACEVA_NUMBERED && able<can_number>(handle)) return &numbers;
    return nullptr;
  }
  static constexpr taceva_force_calls calls = {
      {sizeof(taceva_force_calls), 0, device_calls::close, device_calls::interrupt, extension}, device_calls::start, read, device_calls::stop, lost};
};
}  // namespace taceva

/* Exports a plugin with these transducers, with `needs`: one need per line, "" for none. */
#define TACEVA_FORCES(id, version, needs, ...) TACEVA_EXPORTED(taceva::force, id, version, needs, __VA_ARGS__)
#endif
