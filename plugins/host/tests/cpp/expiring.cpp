// An arm whose controller drops a speed command after 200 ms, but never a motion to a position.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <taceva/robot.hpp>
#include <unistd.h>

using namespace std::chrono_literals;
using clock_type = std::chrono::steady_clock;

class arm : public taceva::robot, public taceva::can_expire {
 public:
  static constexpr const char *table =
      "kind = \"robot\"\nkey = \"arm\"\ntitle = \"arm\"\nsource = \"simulated\"\nguarded_motion = false\n[[args]]\nkey = \"port\"\ntype = \"whole\"\nrange = [1, 65535]\n";
  explicit arm(const taceva::arguments &given) : line_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<uint16_t>(given.at("port").whole));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(line_, reinterpret_cast<sockaddr *>(&to), sizeof to) != 0) throw taceva::failure(TACEVA_NOT_FOUND, "no controller");
    say("process " + std::to_string(getpid()));
    at_.qw = 1;
  }
  ~arm() override { close(line_); }
  void pose(taceva_pose &into, taceva_stamp &stamp, taceva::deadline) override { into = at_, stamp.valid_ns = now_ns(); }
  void move(const taceva_motion &to, taceva_stamp &stamp, taceva::deadline until) override {
    say("to " + std::to_string(to.target.x) + " " + std::to_string(to.speed_m_per_s));
    rest_until(clock_type::now() + time_of(to), until);
    at_ = to.target, stamp.valid_ns = now_ns();
  }
  void move_expiring(const taceva_motion &to, taceva_stamp &stamp, taceva::deadline until) override {
    for (const auto arrives = clock_type::now() + time_of(to); clock_type::now() < arrives;) {
      say("speed " + std::to_string(to.speed_m_per_s));
      rest_until(std::min(arrives, clock_type::now() + 50ms), until);
    }
    say("speed 0");
    at_ = to.target, stamp.valid_ns = now_ns();
  }

 private:
  void say(const std::string &words) {
    const std::string line = words + "\n";
    if (send(line_, line.data(), line.size(), MSG_NOSIGNAL) < 0) throw taceva::failure(TACEVA_DISCONNECTED, "the controller is gone");
  }
  clock_type::duration time_of(const taceva_motion &to) const {
    return std::chrono::duration_cast<clock_type::duration>(std::chrono::duration<double>(std::fabs(to.target.x - at_.x) / to.speed_m_per_s));
  }
  static uint64_t now_ns() { return static_cast<uint64_t>(clock_type::now().time_since_epoch() / 1ns); }
  int line_;
  taceva_pose at_ = {};
};

TACEVA_ROBOTS("org.example.expiring", "1.0.0", "tcp:127.0.0.1:{port}", arm);
