/* Base of every device in C++17. An exception ends a call with a status and a message, and another thread can interrupt a wait. The interface
 * itself is C.
 *
 * Derive from `taceva::sensor` (sensor.hpp), `taceva::force` (force.hpp), `taceva::robot` (robot.hpp), `taceva::lighting` (lighting.hpp) or
 * `taceva::changer` (changer.hpp). Define `static constexpr const char *table`, the [[provides]] table of plugin.toml without its header. Open the
 * device in a constructor from `const taceva::arguments &` and close it in the destructor. Export the classes with the macro of their header. */
#ifndef TACEVA_DEVICE_HPP
#define TACEVA_DEVICE_HPP

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "plugin.h"

namespace taceva {
using deadline = std::chrono::steady_clock::time_point; /* time by which a call must end */

/* Ends a call with a status, and with a fault if the device stopped by itself. Any other exception is a bug and gives INTERNAL. */
struct failure : std::runtime_error {
  failure(taceva_status status, const std::string &why, taceva_fault fault = TACEVA_FAULT_NONE)
      : runtime_error(why), status(status < 0 ? status : TACEVA_INTERNAL), fault(fault) {}
  taceva_status status;
  taceva_fault fault;
};

/* Arguments of a device, checked by the host against the manifest. */
struct arguments {
  const taceva_args *list;
  const taceva_arg *find(std::string_view key) const { /* NULL if not given */
    for (size_t at = 0; list && at < list->count; at++)
      if (std::string_view(list->items[at].key.data, list->items[at].key.length) == key) return &list->items[at];
    return nullptr;
  }
  const taceva_arg &at(const std::string &key) const {
    if (const taceva_arg *found = find(key)) return *found;
    throw failure(TACEVA_INVALID_ARGUMENT, "`" + key + "` is not given");
  }
};

/* A device gets one call at a time, from any thread. Only `interrupt`, and `halt` of a robot, may run concurrently with another call. */
class device {
 public:
  virtual ~device() = default;
  virtual void start(deadline) {} /* called only while stopped */
  virtual void stop() {}          /* called only while started; at the latest before the destructor */
  virtual void interrupt() noexcept { /* ends `rest_until`; override it to end a wait inside a library */
    std::lock_guard<std::mutex> lock(mutex_);
    interrupts_ += 1;
    bell_.notify_all();
  }

 protected:
  /* Waits until `at`. Throws TIMEOUT if `until` comes first, and INTERRUPTED if the call was interrupted. */
  void rest_until(std::chrono::steady_clock::time_point at, deadline until) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (bell_.wait_until(lock, std::min(at, until), [this] { return interrupts_ != seen_; }))
      throw failure(TACEVA_INTERRUPTED, "it was interrupted");
    if (until < at) throw failure(TACEVA_TIMEOUT, "nothing came in time");
  }

 private:
  friend struct device_calls;
  std::mutex mutex_;
  std::condition_variable bell_;
  uint64_t interrupts_ = 0, seen_ = 0; /* an interrupt before a call has no effect on it */
  bool is_started_ = false;
};

/* Tables of each kind, defined in its header: the id of its factory, and the calls on a device. */
template <class Kind> struct kind_of;

/* Common functions of all tables. No exception leaves them. Each plugin in a process has its own copy. */
struct [[gnu::visibility("hidden")]] device_calls {
  static taceva_status say(taceva_error *error, taceva_status status, std::string_view why, taceva_fault fault = TACEVA_FAULT_NONE) noexcept {
    const size_t head = offsetof(taceva_error, message);
    if (!error || error->size <= head) return status;
    size_t length = std::min({why.size(), size_t{error->size} - head - 1, size_t{TACEVA_MESSAGE_SIZE - 1}});
    while (length > 0 && length < why.size() && (why[length] & 0xc0) == 0x80) length -= 1; /* not within a character */
    std::memcpy(error->message, why.data(), length);
    error->message[length] = '\0';
    if (error->size >= offsetof(taceva_error, fault) + sizeof fault) error->fault = fault;
    return status;
  }
  template <class Work> static taceva_status guarded(taceva_error *error, Work work) noexcept {
    try {
      return work(), TACEVA_OK;
    } catch (const failure &it) {
      return say(error, it.status, it.what(), it.fault);
    } catch (const std::exception &it) {
      return say(error, TACEVA_INTERNAL, it.what());
    } catch (...) {
      return say(error, TACEVA_INTERNAL, "the exception is not a std::exception");
    }
  }
  static void expect(bool holds, const char *why) { if (!holds) throw failure(TACEVA_INVALID_ARGUMENT, why); }
  static deadline after(uint64_t timeout_ns) { /* at most a year, which the clock can represent */
    return std::chrono::steady_clock::now() + std::chrono::nanoseconds(std::min(timeout_ns, uint64_t{31'536'000} * 1'000'000'000));
  }
  template <class Kind> static Kind &begun(void *handle) {
    device &it = *static_cast<device *>(handle);
    std::lock_guard<std::mutex> lock(it.mutex_);
    it.seen_ = it.interrupts_;
    return static_cast<Kind &>(it);
  }
  static bool is_started(const device &it) { return it.is_started_; }
  static taceva_status start(void *handle, uint64_t timeout_ns, taceva_error *error) noexcept {
    return guarded(error, [&] { if (device &it = begun<device>(handle); !it.is_started_) it.start(after(timeout_ns)), it.is_started_ = true; });
  }
  static taceva_status stop(void *handle, taceva_error *error) noexcept {
    return guarded(error, [&] { if (device &it = begun<device>(handle); it.is_started_) it.stop(), it.is_started_ = false; });
  }
  static void interrupt(void *handle) noexcept { static_cast<device *>(handle)->interrupt(); }
  static void close(void *handle) noexcept { stop(handle, nullptr), delete static_cast<device *>(handle); }
  /* Classes of `Kind` among `All`, numbered from 0. */
  template <class Kind, class... All> struct drivers {
    template <class Work> static bool nth(uint32_t driver, Work work) {
      uint32_t at = 0;
      bool found = false;
      auto one = [&](auto *none) {
        using Class = std::remove_pointer_t<decltype(none)>;
        if constexpr (std::is_base_of_v<Kind, Class>) { if (at++ == driver) found = true, work(none); }
      };
      (one(static_cast<All *>(nullptr)), ...);
      return found;
    }
    static taceva_status describe(uint32_t driver, const taceva_args *, taceva_take_text take, void *context, taceva_error *error) noexcept {
      auto hand = [&](auto *none) { std::string_view said = std::remove_pointer_t<decltype(none)>::table; take(context, {said.data(), said.size()}); };
      return nth(driver, hand) ? TACEVA_OK : say(error, TACEVA_NOT_FOUND, "no such driver");
    }
    static taceva_status open(uint32_t driver, const taceva_args *args, taceva_rig *, taceva_device *into, taceva_error *error) noexcept {
      return guarded(error, [&] {
        auto make = [&](auto *none) { *into = {static_cast<device *>(new std::remove_pointer_t<decltype(none)>(arguments{args})), &kind_of<Kind>::calls.device}; };
        if (!nth(driver, make)) throw failure(TACEVA_NOT_FOUND, "no such driver");
      });
    }
    static constexpr uint32_t count = (uint32_t{std::is_base_of_v<Kind, All>} + ... + 0u);
    static constexpr taceva_factory table = {sizeof(taceva_factory), count, describe, nullptr, open};
  };
  /* Factory of `Kind`; NULL if `id` differs or no class is of this kind. */
  template <class Kind, class... All> static const void *of_kind(std::string_view id) noexcept {
    using all = drivers<Kind, All...>;
    return all::count > 0 && id == kind_of<Kind>::id ? &all::table : nullptr;
  }
};
}  // namespace taceva

/* Exports a plugin of one kind of device: TACEVA_EXPORTED(taceva::force, "org.example.scale", "1.0.0", "", scale). `needs` has one need per line. */
#define TACEVA_EXPORTED(kind, id, version, needs, ...)                                                                           \
  static const void *taceva_factory_of(taceva_text name) {                                                                       \
    return taceva::device_calls::of_kind<kind, __VA_ARGS__>(std::string_view(name.data, name.length));                           \
  }                                                                                                                              \
  TACEVA_EXPORTED_BY(taceva_factory_of, id, version, needs)
/* As TACEVA_EXPORTED, with a given factory function. It calls `of_kind` for each of its kinds. */
#define TACEVA_EXPORTED_BY(factory, id, version, needs)                                                                          \
  extern "C" TACEVA_EXPORT const taceva_plugin taceva_plugin_v1;                                                                 \
  constexpr taceva_plugin taceva_plugin_v1 = {                                                                                   \
      TACEVA_MAGIC, sizeof taceva_plugin_v1, TACEVA_ABI_MAJOR, TACEVA_ABI_MINOR, {id, sizeof id - 1}, {version, sizeof version - 1}, \
      nullptr, nullptr, factory, nullptr, nullptr, nullptr, {needs, sizeof needs - 1}}
#endif
