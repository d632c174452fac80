// A program under test in a process of its own, spoken to in lines over its standard input and output.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace roci::services::contract {

class ChildProcess {
 public:
  // `environment`: "NAME=value" added to this process's own. Throws std::system_error.
  explicit ChildProcess(const std::vector<std::string>& command,
                        const std::vector<std::string>& environment = {});
  // Kills the program if it still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void send(const std::string& line);
  // Reads until `line` comes (or has come before); false at the end of the output or at the deadline.
  bool wait_for(const std::string& line, std::chrono::milliseconds deadline = std::chrono::seconds(20));
  // Reads until there is something new; false at the end of the output or at the deadline.
  bool wait_for_more(std::chrono::milliseconds deadline = std::chrono::seconds(20));
  const std::vector<std::string>& lines() const { return lines_; }

  // Ends its input and waits: its exit code, or minus the signal that ended it.
  int finish();
  void kill();  // SIGKILL, no chance to say good-bye
  pid_t pid() const { return pid_; }

 private:
  bool read_more(int timeout_ms);

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  std::string partial_;
  std::vector<std::string> lines_;
};

/// The most memory that a process has had, in bytes.
std::size_t peak_memory(pid_t process);

}  // namespace roci::services::contract
