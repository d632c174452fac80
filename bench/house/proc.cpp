#include "bench/house/proc.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace roci::bench::house {
namespace {

std::string file(pid_t process, const char* name) {
  std::ifstream in("/proc/" + std::to_string(process) + "/" + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

double pss_mb(const std::string& rollup) {
  const std::size_t at = rollup.find("\nPss:");
  return at == std::string::npos ? 0 : std::stod(rollup.substr(at + 5)) / 1024;
}

}  // namespace

ProcessFigures figures_of(pid_t process) {
  ProcessFigures out;
  const std::string stat = file(process, "stat");
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return out;
  // These are the fields of proc(5) after the name, from the third one (state) on.
  std::istringstream fields(stat.substr(name_end + 2));
  std::string field;
  for (int number = 3; number <= 20 && fields >> field; ++number) {
    if (number == 14 || number == 15)
      out.cpu_s += std::stod(field) / static_cast<double>(sysconf(_SC_CLK_TCK));
    if (number == 20) out.threads = std::stoi(field);
  }
  out.pss_mb = pss_mb(file(process, "smaps_rollup"));
  return out;
}

ProcessFigures figures_of(const std::vector<pid_t>& processes) {
  ProcessFigures out;
  for (const pid_t process : processes) {
    const ProcessFigures one = figures_of(process);
    out.pss_mb += one.pss_mb;
    out.cpu_s += one.cpu_s;
    out.threads += one.threads;
  }
  return out;
}

}  // namespace roci::bench::house
