// One simulated device of each kind, with the C++ helpers: a sensor, a transducer, a robot, a lighting and a changer in one plugin.
#include <taceva/changer.hpp>
#include <taceva/force.hpp>
#include <taceva/lighting.hpp>
#include <taceva/robot.hpp>
#include <taceva/sensor.hpp>

using namespace std::chrono_literals;
using clock_type = std::chrono::steady_clock;

class eye : public taceva::sensor {
 public:
  static constexpr const char *table =
      "kind = \"sensor\"\nkey = \"eye\"\ntitle = \"eye\"\nsource = \"simulated\"\n"
      "frame = { width = 8, height = 6, format = \"gray8\" }\nrate_hz = 200\n";
  explicit eye(const taceva::arguments &) : sensor(TACEVA_GRAY8, 8, 6) {}
  void start(taceva::deadline) override { due_ = clock_type::now() + 5ms; }
  void next_frame(taceva_frame &into, taceva::deadline until) override {
    rest_until(due_, until);
    due_ += 5ms;
    std::fill_n(into.buffer, into.length, uint8_t{90});
    into.stamp.valid_ns = into.sequence * 5'000'000;
  }

 private:
  clock_type::time_point due_;
};

class wrist : public taceva::force, public taceva::can_tare, public taceva::can_number, public taceva::can_count_lost {
 public:
  static constexpr const char *table =
      "kind = \"force\"\nkey = \"wrist\"\ntitle = \"wrist\"\nsource = \"simulated\"\naxes = [\"Fz\"]\n"
      "rate_hz = 200\ntare = true\nnumbered = true\n[[args]]\nkey = \"load\"\ntype = \"number\"\nrange = [0, 50]\nunit = \"N\"\ndefault = 1.5\n";
  explicit wrist(const taceva::arguments &given) : load_n_(given.at("load").number) {}
  void start(taceva::deadline) override { due_ = clock_type::now() + 5ms; }
  void next_reading(taceva_wrench &into, taceva_stamp &stamp, taceva::deadline until) override {
    rest_until(due_, until);
    due_ += 5ms;
    readings_ += 1;
    into.force_n[2] = load_n_ - zero_n_;
    stamp.valid_ns = readings_ * 5'000'000;
  }
  void zero(taceva::deadline) override { zero_n_ = load_n_; }
  uint64_t sequence() override {
    if (readings_ == 0) throw taceva::failure(TACEVA_NOT_FOUND, "nothing was read yet");
    return readings_;
  }
  uint64_t lost() override { return 0; }

 private:
  clock_type::time_point due_;
  double load_n_, zero_n_ = 0;
  uint64_t readings_ = 0;
};

// A wall at 12 mm along x, which the robot strikes.
class arm : public taceva::robot, public taceva::can_expire {
 public:
  static constexpr const char *table =
      "kind = \"robot\"\nkey = \"arm\"\ntitle = \"arm\"\nsource = \"simulated\"\nguarded_motion = false\n"
      "workspace = { least_mm = [-20, -10, -10], greatest_mm = [20, 10, 10] }\nlimits = { speed_max_mm_s = 100 }\n";
  explicit arm(const taceva::arguments &) { at_.qw = 1; }
  void pose(taceva_pose &into, taceva_stamp &stamp, taceva::deadline) override { into = at_, stamp.valid_ns = now_ns(); }
  void check(const taceva_motion &to) override {
    const taceva_pose &aim = to.target;
    if (std::fabs(aim.x) > 0.02 || std::fabs(aim.y) > 0.01 || std::fabs(aim.z) > 0.01) throw taceva::failure(TACEVA_OUT_OF_RANGE, "outside the workspace");
    if (to.speed_m_per_s > 0.1) throw taceva::failure(TACEVA_OUT_OF_RANGE, "more than 100 mm/s");
  }
  void move(const taceva_motion &to, taceva_stamp &stamp, taceva::deadline until) override {
    const taceva_pose from = at_;
    const double length = std::hypot(to.target.x - from.x, to.target.y - from.y, to.target.z - from.z);
    const auto begun = clock_type::now();
    for (double part = 0; part < 1;) {
      rest_until(clock_type::now() + 2ms, until);
      const double gone = std::chrono::duration<double>(clock_type::now() - begun).count() * to.speed_m_per_s;
      part = length > 0 ? std::min(1.0, gone / length) : 1.0;
      at_.x = from.x + part * (to.target.x - from.x);
      at_.y = from.y + part * (to.target.y - from.y);
      at_.z = from.z + part * (to.target.z - from.z);
      if (at_.x > 0.012) throw taceva::failure(TACEVA_DEVICE_FAULT, "the wall", TACEVA_FAULT_COLLISION);
    }
    at_ = to.target;
    stamp.valid_ns = now_ns();
  }

  /* The simulation needs one command; a real device would repeat it ten times per second. */
  void move_expiring(const taceva_motion &to, taceva_stamp &stamp, taceva::deadline until) override { move(to, stamp, until); }

 private:
  static uint64_t now_ns() { return static_cast<uint64_t>(clock_type::now().time_since_epoch() / 1ns); }
  taceva_pose at_ = {};
};

class lamp : public taceva::lighting {
 public:
  static constexpr const char *table = "kind = \"lighting\"\nkey = \"lamp\"\ntitle = \"lamp\"\nsource = \"simulated\"\nscenes = [\"dark\", \"room\"]\n";
  explicit lamp(const taceva::arguments &) {}
  void set(std::string_view scene, taceva::deadline) override {
    if (scene != "dark" && scene != "room") throw taceva::failure(TACEVA_INVALID_ARGUMENT, "expected `dark` or `room`");
  }
};

class carousel : public taceva::changer {
 public:
  static constexpr const char *table =
      "kind = \"changer\"\nkey = \"carousel\"\ntitle = \"carousel\"\nsource = \"simulated\"\nholds = [\"sphere of radius 4 mm\", \"line grating of 1.5 mm\"]\n";
  explicit carousel(const taceva::arguments &) {}
  std::string bring(std::string_view name, taceva::deadline until) override {
    const size_t place = name == "sphere of radius 4 mm" ? 0 : name == "line grating of 1.5 mm" ? 1 : 2;
    if (place == 2) throw taceva::failure(TACEVA_INVALID_ARGUMENT, "expected a name that it holds");
    if (place != at_) rest_until(clock_type::now() + 100ms, until);
    at_ = place;
    return std::string(name);
  }

 private:
  size_t at_ = 0;
};

template <class Kind> static const void *of(std::string_view id) { return taceva::device_calls::of_kind<Kind, eye, wrist, arm, lamp, carousel>(id); }
static const void *factory(taceva_text name) {
  const std::string_view id(name.data, name.length);
  for (const void *found : {of<taceva::sensor>(id), of<taceva::force>(id), of<taceva::robot>(id), of<taceva::lighting>(id), of<taceva::changer>(id)})
    if (found) return found;
  return nullptr;
}
TACEVA_EXPORTED_BY(factory, "org.example.kinds", "1.0.0", "");
