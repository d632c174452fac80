#include "tests/scenario/flight.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>

namespace roci::scenario {

Ended run(const std::string& command) {
  const std::string line = "PATH=" ROCI_BINARY_DIR "/bin:$PATH; " + command;
  FILE* pipe = popen(line.c_str(), "r");
  if (pipe == nullptr) return {};
  Ended out;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    out.output.append(buffer.data(), count);
  const int status = pclose(pipe);
  out.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return out;
}

Flight fly(const std::string& mission, const std::string& dds, std::uint64_t seed, const std::string& more) {
  const Ended ended = run("roci-launch " + mission + " --dds " + dds + " --seed " + std::to_string(seed) +
                          " --speed max --headless --json " + more);
  Flight out{ended.exit_code, nlohmann::json::object()};
  const auto end = ended.output.find_last_not_of('\n');
  if (end == std::string::npos) return out;
  const auto begin = ended.output.rfind('\n', end);
  const std::string last = ended.output.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
  out.summary = nlohmann::json::parse(last, nullptr, false);
  if (out.summary.is_discarded()) out.summary = nlohmann::json::object();
  return out;
}

}  // namespace roci::scenario
