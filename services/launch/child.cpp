#include "services/launch/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>

namespace roci::services::launch {
namespace {

constexpr int kCannotRun = 127;

// Runs between fork and exec, and so makes async-signal-safe calls only. A process group of its own keeps the
// terminal's Ctrl-C away; the launcher passes it on in the right order. Nothing but the three standard descriptors is
// meant for the child: the vendors do not open their sockets close-on-exec, and who inherits them holds the launcher's
// ports.
[[noreturn]] void become(const char* program, char* const* arguments, char* const* environment, int log,
                         pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotRun);
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  execve(program, arguments, environment);
  _exit(kCannotRun);
}

// A disk that is full or read-only keeps nobody from working; what they say is heard by others, too.
bool takes_no_writes(int error) {
  return error == ENOSPC || error == EDQUOT || error == EROFS || error == EIO;
}

std::string_view name_of(std::string_view variable) { return variable.substr(0, variable.find('=')); }

// Returns this process's own environment, but for the variables that `more` sets.
std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> out = more;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const bool replaced = std::ranges::any_of(
        more, [&](const std::string& other) { return name_of(other) == name_of(*variable); });
    if (!replaced) out.emplace_back(*variable);
  }
  return out;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

std::string to_string(const Ending& ending) {
  if (ending.exited) return "ended with code " + std::to_string(ending.code);
  return std::string("was ended by ") + strsignal(ending.code);
}

Child::Child(const std::filesystem::path& program, std::vector<std::string> arguments,
             const std::filesystem::path& log, const std::vector<std::string>& more) {
  int log_file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (log_file < 0 && takes_no_writes(errno)) log_file = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (log_file < 0) throw std::system_error(errno, std::generic_category(), "cannot write " + log.string());
  const auto argument_list = pointers_to(arguments);
  auto environment = environment_with(more);
  const auto environment_list = pointers_to(environment);
  const std::string path = program.string();
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(path.c_str(), argument_list.data(), environment_list.data(), log_file, parent);
  const int error = errno;
  close(log_file);
  if (pid_ < 0) throw std::system_error(error, std::generic_category(), "cannot start " + path);
}

Child::~Child() {
  if (ending()) return;
  signal(SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::optional<Ending> Child::ending() {
  if (ending_) return ending_;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  ending_ = WIFEXITED(status) ? Ending{true, WEXITSTATUS(status)} : Ending{false, WTERMSIG(status)};
  return ending_;
}

void Child::signal(int number) {
  if (!ending_) kill(pid_, number);
}

}  // namespace roci::services::launch
