#include "services/launch/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <iostream>

namespace roci::services::launch {
namespace {

namespace topics = services::topics;

// So many executives are shown; a mission has one for each robot.
constexpr std::size_t kExecutives = 256;

const char* phase_name(v1::MissionPhase phase) {
  constexpr std::array names{"idle", "pausing", "planning", "executing", "safe", "finished"};
  const auto index = static_cast<std::size_t>(phase);
  return index < names.size() ? names[index] : "unknown";
}

// At most so many columns of the text, one for each code point; control characters of others become "?".
std::string fitted(const std::string& text, std::size_t columns) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool begins = (byte & 0xC0U) != 0x80U;
    if (begins && columns-- == 0) break;
    out += byte < 0x20 || byte == 0x7f ? '?' : text[i];
  }
  return out;
}

std::size_t terminal_columns() {
  winsize window{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return 80;
  return window.ws_col;
}

std::string clock_text(temporal::Time time) {
  const auto s = std::chrono::duration_cast<std::chrono::seconds>(time).count();
  return fmt::format("{:02}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

Progress::Progress(services::Node& node, bool shown)
    : node_(node),
      events_(services::advertise(node, topics::event)),
      shown_(shown),
      terminal_(isatty(STDERR_FILENO) == 1) {
  services::subscribe(node, topics::mission_status, [this](const v1::MissionStatus& status) {
    if (statuses_.size() < kExecutives || statuses_.contains(status.executive()))
      statuses_[status.executive()] = status;
  });
  services::subscribe(node, topics::event, [this](const v1::Event& event) { take(event); });
}

Progress::~Progress() {
  if (shown_ && terminal_ && !drawn_.empty()) std::cerr << '\n';
}

void Progress::take(const v1::Event& event) {
  if (event.severity_level() == v1::SEVERITY_DEBUG) return;
  last_event_ = event.code() + ": " + event.text();
  if (event.severity_level() != v1::SEVERITY_ERROR) return;
  std::cerr << (shown_ && terminal_ ? "\r\x1b[K" : "")
            << clock_text(temporal::Time(event.header().stamp_us())) << "  " << last_event_ << std::endl;
  drawn_.clear();
}

void Progress::report(v1::Severity severity, const std::string& code, const std::string& text) {
  v1::Event event;
  event.severity_level(severity);
  event.code(code);
  event.text(text);
  events_.write(event);
  take(event);
}

std::string Progress::line() const {
  std::string phases;
  std::string plans;
  std::uint32_t achieved = 0, open = 0, dropped = 0, failed = 0;
  for (const auto& [executive, status] : statuses_) {
    phases += (phases.empty() ? "" : "/") + std::string(phase_name(status.phase()));
    plans += (plans.empty() ? "" : "/") + std::to_string(status.plan_version());
    achieved += status.goals_achieved();
    open += status.goals_open();
    dropped += status.goals_dropped();
    failed += status.goals_failed();
  }
  return fmt::format("{}  goals: {} achieved, {} open, {} dropped, {} failed  plan {}  {}",
                     phases.empty() ? "idle" : phases, achieved, open, dropped, failed,
                     plans.empty() ? "0" : plans, last_event_);
}

void Progress::show() {
  if (!shown_) return;
  const std::string time = clock_text(node_.now());
  std::string text = line();
  if (terminal_) {
    text = fitted(time + "  " + text, terminal_columns() - 1);  // the last column would wrap
    if (text == drawn_) return;
    std::cerr << '\r' << text << "\x1b[K" << std::flush;
  } else {
    if (text == drawn_) return;
    std::cerr << time << "  " << text << '\n';
  }
  drawn_ = std::move(text);
}

}  // namespace roci::services::launch
