/* A sensor in C++17: see device.hpp. Exported with TACEVA_SENSORS(id, version, class...). */
#ifndef TACEVA_SENSOR_HPP
#define TACEVA_SENSOR_HPP

#include "device.hpp"
#include "sensor.h"

namespace taceva {
class sensor : public device {
 public:
  sensor(uint32_t format, uint32_t width, uint32_t height) : format(format), width(width), height(height) {}
  virtual void next_frame(taceva_frame &into, deadline until) = 0; /* writes `length` bytes of `buffer`, and the stamp */
  const uint32_t format, width, height;

 private:
  friend struct kind_of<sensor>;
  uint64_t frames_ = 0;
};

template <> struct [[gnu::visibility("hidden")]] kind_of<sensor> {
  static constexpr std::string_view id = TACEVA_SENSOR_FACTORY;
  static taceva_status capture(void *handle, taceva_frame *frame, uint64_t timeout_ns, taceva_error *error) noexcept {
    return device_calls::guarded(error, [&] {
      sensor &it = device_calls::begun<sensor>(handle);
      const uint64_t length = uint64_t{it.width} * it.height * (it.format == TACEVA_RGB16 ? 6 : it.format);
      device_calls::expect(frame && frame->size >= sizeof *frame, "`frame` is NULL or too short");
      device_calls::expect(device_calls::is_started(it), "it is not started");
      device_calls::expect(frame->buffer && frame->buffer_length >= length, "the buffer is too short for a frame");
      frame->format = it.format, frame->width = it.width, frame->height = it.height, frame->flags = 0;
      frame->data = frame->buffer, frame->length = length, frame->sequence = it.frames_ + 1;
      it.next_frame(*frame, device_calls::after(timeout_ns));
      it.frames_ += 1;
    });
  }
  static constexpr taceva_sensor_calls calls = {
      {sizeof(taceva_sensor_calls), 0, device_calls::close, device_calls::interrupt, nullptr}, 0, 0, device_calls::start, capture, device_calls::stop};
};
}  // namespace taceva

/* Exports a plugin with these sensors. */
#define TACEVA_SENSORS(id, version, ...) TACEVA_EXPORTED(taceva::sensor, id, version, "", __VA_ARGS__)
#endif
