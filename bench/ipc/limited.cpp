// roci-bench-limited REPORT SECONDS MEGABYTES COMMAND ARGUMENTS...
// It runs a command under limits of CPU time and address space. REPORT gets "STATUS CPU_SECONDS PEAK_KIB",
// where STATUS is the exit code, or the negated signal.
//
// It is a small process of its own, because the kernel counts what the parent had in memory at the fork as
// part of the child's peak, which Python makes large. It ends with the code of the command, or 128 and the
// signal.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr int kUsageError = 64;
constexpr int kCannotRun = 127;

void limit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  setrlimit(resource, &value);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fputs("usage: roci-bench-limited REPORT SECONDS MEGABYTES COMMAND ARGUMENTS...\n", stderr);
    return kUsageError;
  }
  const rlim_t most_seconds = std::strtoul(argv[2], nullptr, 10);
  const rlim_t most_bytes = std::strtoul(argv[3], nullptr, 10) << 20;
  std::signal(SIGXCPU, SIG_IGN);  // sent to both, it ends the command alone
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXCPU, SIG_DFL);
    limit(RLIMIT_CPU, most_seconds, most_seconds + 1);
    limit(RLIMIT_AS, most_bytes, most_bytes);
    limit(RLIMIT_CORE, 0, 0);
    execvp(argv[4], argv + 4);
    std::perror(argv[4]);
    std::_Exit(kCannotRun);
  }
  int ended = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &ended, 0, &usage) != child) {
    std::perror("roci-bench-limited");
    return kCannotRun;
  }
  const int status = WIFSIGNALED(ended) ? -WTERMSIG(ended) : WEXITSTATUS(ended);
  std::FILE* report = std::fopen(argv[1], "w");
  if (!report) {
    std::perror(argv[1]);
    return kCannotRun;
  }
  std::fprintf(report, "%d %.6f %ld\n", status, seconds(usage.ru_utime) + seconds(usage.ru_stime),
               usage.ru_maxrss);
  std::fclose(report);
  return status < 0 ? 128 - status : status;
}
