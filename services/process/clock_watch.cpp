#include "services/process/clock_watch.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "services/log/log.hpp"
#include "services/node/make_event.hpp"

namespace roci::services::process {
namespace {

constexpr double kPeriodS = 1;  // wall time between two looks

bool is_asked() {
  const char* asked = std::getenv(kClockWatchVariable);
  return asked != nullptr && std::string_view(asked) == "1";
}

}  // namespace

ClockWatch::ClockWatch(Node& node, const std::filesystem::path& run_folder)
    : file_(run_folder / "clock-watch") {
  const bool live = node.options().clock == clock::ClockMode::live;
  if (!live || run_folder.empty() || !clock::handed_anchor() || !is_asked()) return;
  events_ = advertise(node, topics::event);
  node.on_turn([this] { turn(); });
}

ClockWatch::~ClockWatch() {
  if (lock_ >= 0) close(lock_);
}

bool ClockWatch::is_mine() {
  if (lock_ >= 0) return true;
  const int file = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return false;
  if (flock(file, LOCK_EX | LOCK_NB) == 0) {
    lock_ = file;
  } else {
    close(file);
  }
  return lock_ >= 0;
}

void ClockWatch::turn() {
  const clock::WallTime now = clock::wall_now();
  if (now < next_) return;
  next_ = now + clock::wall_seconds(kPeriodS);
  if (!is_mine()) return;
  if (auto set = watch_.judge(unix_us(*clock::handed_anchor()), clock::unix_us())) {
    log::warning(*set);
    untold_ = std::move(set);
  }
  if (!untold_ || events_.matched_readers() == 0) return;
  events_.write(node::make_event(v1::SEVERITY_WARNING, "clock.set", *std::exchange(untold_, std::nullopt)));
}

}  // namespace roci::services::process
