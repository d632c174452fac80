// A Child is one child process: its output goes to a log file, and it dies with this process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace roci::services::launch {

/// Says how a process ended.
struct Ending {
  bool exited = false;  ///< It ended by itself, with `code`; otherwise the signal `code` ended it.
  int code = 0;
};

/// Says the ending in words.
std::string to_string(const Ending&);

/// Owns one running process.
class Child {
 public:
  /// Runs `program` with `arguments` (the name first) in this process's environment and `more` of it
  /// ("NAME=value"); appends its output to `log`, or to nothing where the disk takes no writes. The child inherits no
  /// other open file or socket. Throws std::system_error. Call it on the main thread, with whose end the child dies.
  Child(const std::filesystem::path& program, std::vector<std::string> arguments,
        const std::filesystem::path& log, const std::vector<std::string>& more = {});
  ~Child();  ///< Kills the child if it still runs.
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::optional<Ending> ending();  ///< There is none while the child runs.
  void signal(int number);
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  std::optional<Ending> ending_;
};

}  // namespace roci::services::launch
