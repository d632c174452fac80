#include "services/launch/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

namespace roci::launch {
namespace {

constexpr int kCannotRun = 127;

// Between fork and exec: async-signal-safe calls only. A process group of its own keeps the terminal's Ctrl-C
// away; the launcher passes it on in the right order.
[[noreturn]] void become(const char* program, char* const* arguments, int log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotRun);
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(program, arguments);
  _exit(kCannotRun);
}

}  // namespace

std::string to_string(const Ending& ending) {
  if (ending.exited) return "ended with code " + std::to_string(ending.code);
  return std::string("was ended by ") + strsignal(ending.code);
}

Child::Child(const std::filesystem::path& program, std::vector<std::string> arguments,
             const std::filesystem::path& log) {
  const int log_file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log_file < 0) throw std::system_error(errno, std::generic_category(), "cannot write " + log.string());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const std::string path = program.string();
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(path.c_str(), pointers.data(), log_file, parent);
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

}  // namespace roci::launch
