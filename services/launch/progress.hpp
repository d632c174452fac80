// The progress line shows the user a run while it flies, from an observer node: mission time, phase, goals,
// the last event.
#pragma once

#include <map>
#include <string>

#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::services::launch {

/// Follows a run and shows it.
class Progress {
 public:
  /// `shown` asks for a line on standard error that is rewritten on a terminal, else for one line a change.
  /// Errors are always told, each on a line of its own.
  Progress(services::Node&, bool shown);
  ~Progress();  ///< Ends the line.
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show();  ///< Draws what has changed; the line is cut to the terminal's width.
  void end();   ///< Ends the line, so that what is printed next begins another one.
  /// Sends an event of the launcher itself to all consoles and to the line.
  void report(v1::Severity, const std::string& code, const std::string& text);

 private:
  void take(const v1::Event&);
  std::string line() const;

  services::Node& node_;
  services::Publisher<v1::Event> events_;
  bool shown_;
  bool terminal_;
  std::map<std::string, v1::MissionStatus> statuses_;  // by executive
  std::string last_event_;
  std::string drawn_;
};

}  // namespace roci::services::launch
