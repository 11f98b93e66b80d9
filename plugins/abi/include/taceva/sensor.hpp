/* A sensor in C++17: a class whose exceptions end a call with a status and a message. What crosses stays C.
 *
 * Derive from `taceva::sensor`, say in `static constexpr const char *table` what stands below [[provides]] of plugin.toml, open the device
 * in a constructor from `const taceva::arguments &` and close it in the destructor, and export the class with TACEVA_SENSORS. */
#ifndef TACEVA_SENSOR_HPP
#define TACEVA_SENSOR_HPP

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>

#include "sensor.h"

namespace taceva {
using deadline = std::chrono::steady_clock::time_point; /* until when a call may last */

/* Ends a call with a status. Every other exception is a bug that was noticed: INTERNAL. */
struct failure : std::runtime_error {
  failure(taceva_status status, const std::string &why) : runtime_error(why), status(status < 0 ? status : TACEVA_INTERNAL) {}
  taceva_status status;
};

/* What a sensor is opened with, checked by the host against the manifest. */
struct arguments {
  const taceva_args *list;
  const taceva_arg *find(std::string_view key) const { /* NULL: it is not given */
    for (size_t at = 0; list && at < list->count; at++)
      if (std::string_view(list->items[at].key.data, list->items[at].key.length) == key) return &list->items[at];
    return nullptr;
  }
  const taceva_arg &at(const std::string &key) const {
    if (const taceva_arg *found = find(key)) return *found;
    throw failure(TACEVA_INVALID_ARGUMENT, "`" + key + "` is not given");
  }
};

/* One call at a time, from whichever thread; `interrupt` alone comes beside another. */
class sensor {
 public:
  sensor(uint32_t format, uint32_t width, uint32_t height) : format(format), width(width), height(height) {}
  virtual ~sensor() = default;
  virtual void start(deadline) {}                                  /* only when it is stopped */
  virtual void next_frame(taceva_frame &into, deadline until) = 0; /* fills `length` bytes of `buffer`, and the stamp */
  virtual void stop() {}                                           /* only when it is started; at the latest before its destructor */
  virtual void interrupt() noexcept { /* ends `rest_until`; whoever waits in a library ends that too */
    std::lock_guard<std::mutex> lock(mutex_);
    interrupts_ += 1;
    bell_.notify_all();
  }
  const uint32_t format, width, height;

 protected:
  /* Waits for `at`. TIMEOUT where `until` comes first, INTERRUPTED where somebody ended this call. */
  void rest_until(std::chrono::steady_clock::time_point at, deadline until) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (bell_.wait_until(lock, std::min(at, until), [this] { return interrupts_ != seen_; }))
      throw failure(TACEVA_INTERRUPTED, "it was interrupted");
    if (until < at) throw failure(TACEVA_TIMEOUT, "no frame came in time");
  }

 private:
  template <class...> friend struct sensor_plugin;
  std::mutex mutex_;
  std::condition_variable bell_;
  uint64_t interrupts_ = 0, seen_ = 0, frames_ = 0; /* an interrupt before a call is none of its business */
  bool is_started_ = false;
};

/* What stands in the tables of a plugin with these sensors: nothing is thrown past it, and plugins in one process share none of it. */
template <class... Sensors> struct [[gnu::visibility("hidden")]] sensor_plugin {
  static taceva_status say(taceva_error *error, taceva_status status, std::string_view why) noexcept {
    const size_t head = offsetof(taceva_error, message);
    if (!error || error->size <= head) return status;
    size_t length = std::min({why.size(), size_t{error->size} - head - 1, size_t{TACEVA_MESSAGE_SIZE - 1}});
    while (length > 0 && length < why.size() && (why[length] & 0xc0) == 0x80) length -= 1; /* not within a letter */
    std::memcpy(error->message, why.data(), length);
    error->message[length] = '\0';
    return status;
  }
  template <class Work> static taceva_status guarded(taceva_error *error, Work work) noexcept {
    try {
      return work(), TACEVA_OK;
    } catch (const failure &it) {
      return say(error, it.status, it.what());
    } catch (const std::exception &it) {
      return say(error, TACEVA_INTERNAL, it.what());
    } catch (...) {
      return say(error, TACEVA_INTERNAL, "what was thrown is no std::exception");
    }
  }
  static void expect(bool holds, const char *why) { if (!holds) throw failure(TACEVA_INVALID_ARGUMENT, why); }
  static deadline after(uint64_t timeout_ns) { /* as far as the clock reaches: a year is for ever */
    return std::chrono::steady_clock::now() + std::chrono::nanoseconds(std::min(timeout_ns, uint64_t{31'536'000} * 1'000'000'000));
  }
  static sensor &begun(void *handle) {
    sensor &it = *static_cast<sensor *>(handle);
    std::lock_guard<std::mutex> lock(it.mutex_);
    return it.seen_ = it.interrupts_, it;
  }
  static taceva_status start(void *handle, uint64_t timeout_ns, taceva_error *error) noexcept {
    return guarded(error, [&] { if (sensor &it = begun(handle); !it.is_started_) it.start(after(timeout_ns)), it.is_started_ = true; });
  }
  static taceva_status capture(void *handle, taceva_frame *frame, uint64_t timeout_ns, taceva_error *error) noexcept {
    return guarded(error, [&] {
      sensor &it = begun(handle);
      const uint64_t length = uint64_t{it.width} * it.height * (it.format == TACEVA_RGB16 ? 6 : it.format);
      expect(frame && frame->size >= sizeof *frame, "a frame of another size");
      expect(it.is_started_, "it is not started");
      expect(frame->buffer && frame->buffer_length >= length, "a buffer that is too short for a frame");
      frame->format = it.format, frame->width = it.width, frame->height = it.height, frame->flags = 0;
      frame->data = frame->buffer, frame->length = length, frame->sequence = it.frames_ + 1;
      it.next_frame(*frame, after(timeout_ns));
      it.frames_ += 1;
    });
  }
  static taceva_status stop(void *handle, taceva_error *error) noexcept {
    return guarded(error, [&] { if (sensor &it = begun(handle); it.is_started_) it.stop(), it.is_started_ = false; });
  }
  static void interrupt(void *handle) noexcept { static_cast<sensor *>(handle)->interrupt(); }
  static void close(void *handle) noexcept { stop(handle, nullptr), delete static_cast<sensor *>(handle); }
  static constexpr taceva_sensor_calls calls = {{sizeof(taceva_sensor_calls), 0, close, interrupt, nullptr}, 0, 0, start, capture, stop};
  static taceva_status describe(uint32_t driver, const taceva_args *, taceva_take_text take, void *context, taceva_error *error) noexcept {
    static constexpr std::string_view tables[] = {Sensors::table...};
    if (driver >= sizeof...(Sensors)) return say(error, TACEVA_NOT_FOUND, "no such sensor");
    return take(context, {tables[driver].data(), tables[driver].size()}), TACEVA_OK;
  }
  template <class Sensor> static sensor *make(const arguments &given) { return new Sensor(given); }
  static taceva_status open(uint32_t driver, const taceva_args *args, taceva_rig *, taceva_device *device, taceva_error *error) noexcept {
    static constexpr sensor *(*makers[])(const arguments &) = {make<Sensors>...};
    if (driver >= sizeof...(Sensors)) return say(error, TACEVA_NOT_FOUND, "no such sensor");
    return guarded(error, [&] { *device = {makers[driver]({args}), &calls.device}; });
  }
  static constexpr taceva_factory table = {sizeof(taceva_factory), sizeof...(Sensors), describe, nullptr, open};
  static const void *factory(taceva_text id) noexcept { return std::string_view(id.data, id.length) == TACEVA_SENSOR_FACTORY ? &table : nullptr; }
};
}  // namespace taceva

/* Exports a plugin with these sensors. */
#define TACEVA_SENSORS(id, version, ...)                                                                                     \
  extern "C" TACEVA_EXPORT const taceva_plugin taceva_plugin_v1;                                                             \
  constexpr taceva_plugin taceva_plugin_v1 = {                                                                               \
      TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR, {id, sizeof id - 1}, {version, sizeof version - 1}, \
      nullptr, nullptr, taceva::sensor_plugin<__VA_ARGS__>::factory, nullptr, nullptr, nullptr, {nullptr, 0}}
#endif
