// A C++ sensor that throws all kinds of exceptions, and a host that calls it through the C tables. Prints one line per call.
#include <taceva/sensor.hpp>

#include <cstdio>
#include <thread>
#include <vector>

using namespace std::chrono_literals;

namespace {
int alive = 0; // number of existing sensors
std::vector<std::string> told; // names of the functions that ran

class wild : public taceva::sensor {
 public:
  static constexpr const char *table = "kind = \"sensor\"\nkey = \"wild\"\n";

  explicit wild(const taceva::arguments &given) : sensor(TACEVA_RGB16, 2, 1) {
    const taceva_arg *way = given.find("way");
    way_ = way ? std::string(way->text.data, way->text.length) : "well";
    if (way_ == "no device") throw taceva::failure(TACEVA_NOT_FOUND, "no camera is plugged in");
    if (way_ == "no gain") (void)given.at("gain");
    alive += 1;
  }
  ~wild() override { alive -= 1; }
  void start(taceva::deadline) override { told.push_back("start"); }
  void stop() override {
    told.push_back("stop");
    if (way_ == "stop throws") throw std::runtime_error("it does not stop");
  }
  void next_frame(taceva_frame &into, taceva::deadline until) override {
    if (way_ == "failure") throw taceva::failure(TACEVA_DISCONNECTED, "the cable is out");
    if (way_ == "success") throw taceva::failure(TACEVA_OK, "a failure that claims success");
    if (way_ == "exception") throw std::out_of_range("row 7 of 3");
    if (way_ == "memory") throw std::bad_alloc();
    if (way_ == "whatever") throw 7;
    if (way_ == "long") {
      std::string why(502, 'x');
      throw std::runtime_error(why + "\xc3\xa9\xc3\xa9"); // é at the end of the message buffer
    }
    if (way_ == "wait") rest_until(std::chrono::steady_clock::now() + 1h, until);
    std::memset(into.buffer, 9, into.length);
    into.stamp.valid_ns = 5;
  }

 private:
  std::string way_;
};

class second : public wild {
 public:
  using wild::wild;
  static constexpr const char *table = "key = \"second\"\n";
};
}  // namespace

TACEVA_SENSORS("org.example.wild", "1.2.3", wild, second);

namespace {
taceva_text text(const char *of) { return {of, std::strlen(of)}; }

const taceva_factory &sensors() {
  return *static_cast<const taceva_factory *>(taceva_plugin_v1.factory(text(TACEVA_SENSOR_FACTORY)));
}

void print(const char *what, taceva_status status, const taceva_error &error) {
  std::printf("%s: %d %zu %.40s\n", what, status, std::strlen(error.message), error.message);
}

taceva_error empty() {
  taceva_error error{};
  error.size = sizeof error;
  return error;
}

/* Opens the sensor, captures a frame and closes the sensor. */
void try_way(const char *way, uint64_t timeout_ns = 1'000'000, bool is_started = true, uint64_t room = 12) {
  taceva_arg item{text("way"), text(way), 0, 0, TACEVA_ARG_TEXT, 0};
  taceva_args args{&item, 1};
  taceva_device device{};
  taceva_error error = empty();
  if (taceva_status status = sensors().open(0, &args, nullptr, &device, &error)) return print(way, status, error);
  auto calls = reinterpret_cast<const taceva_sensor_calls *>(device.calls);
  if (is_started) calls->start(device.handle, 1'000'000, &error), calls->start(device.handle, 1'000'000, &error);
  uint8_t bytes[12] = {};
  taceva_frame frame{};
  frame.size = sizeof frame, frame.buffer = bytes, frame.buffer_length = room;
  calls->device.interrupt(device.handle);  // without a pending call
  print(way, calls->capture(device.handle, &frame, timeout_ns, &error), error);
  if (!std::strcmp(way, "well") && is_started && room == 12)
    std::printf("%ux%u of %u, %u bytes to %u, picture %u at %u\n", frame.width, frame.height, frame.format,
                static_cast<unsigned>(frame.length), bytes[11], static_cast<unsigned>(frame.sequence),
                static_cast<unsigned>(frame.stamp.valid_ns));
  calls->device.close(device.handle);
}

void interrupted() {
  taceva_arg item{text("way"), text("wait"), 0, 0, TACEVA_ARG_TEXT, 0};
  taceva_args args{&item, 1};
  taceva_device device{};
  taceva_error error = empty();
  sensors().open(0, &args, nullptr, &device, &error);
  auto calls = reinterpret_cast<const taceva_sensor_calls *>(device.calls);
  calls->start(device.handle, 0, &error);
  std::thread other([&] {
    std::this_thread::sleep_for(50ms);
    calls->device.interrupt(device.handle);
  });
  uint8_t bytes[12];
  taceva_frame frame{};
  frame.size = sizeof frame, frame.buffer = bytes, frame.buffer_length = sizeof bytes;
  print("interrupted", calls->capture(device.handle, &frame, UINT64_MAX, &error), error);
  other.join();
  calls->device.close(device.handle);
}
}  // namespace

int main() {
  for (auto way : {"well", "no device", "no gain", "failure", "success", "exception", "memory", "whatever", "long", "stop throws", "wait"}) try_way(way);
  try_way("well", 1'000'000, false);
  try_way("well", 1'000'000, true, 11);
  interrupted();
  taceva_error error = empty();
  print("third", sensors().open(2, nullptr, nullptr, nullptr, &error), error);
  sensors().describe(1, nullptr, [](void *, taceva_text of) { std::printf("%.*s", static_cast<int>(of.length), of.data); }, nullptr, &error);
  std::printf("others: %d\n", taceva_plugin_v1.factory(text(TACEVA_FORCE_FACTORY)) != nullptr);
  taceva_error tiny{};
  tiny.size = offsetof(taceva_error, message) + 4;
  print("tiny", sensors().open(9, nullptr, nullptr, nullptr, &tiny), tiny);
  print("none", sensors().open(9, nullptr, nullptr, nullptr, nullptr), tiny);
  std::printf("%d alive, %zu starts and stops\n", alive, told.size());
}
