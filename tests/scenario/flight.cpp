#include "tests/scenario/flight.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

#include "exec_svc/journal/journal.hpp"

namespace roci::scenario {

Ended run(const std::string& command) {
  const std::string line = "PATH=${ROCI_BIN:-" ROCI_BINARY_DIR "/bin}:$PATH; " + command;
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
  return {ended.exit_code, last_line_as_json(ended.output)};
}

std::string reference_trace(const std::string& mission, const std::string& more) {
  return fly(mission, "inproc", 1, more).summary.value("trace_sha256", "no trace");
}

nlohmann::json last_line_as_json(const std::string& output) {
  const auto end = output.find_last_not_of('\n');
  if (end == std::string::npos) return nlohmann::json::object();
  const auto begin = output.rfind('\n', end);
  const std::string last = output.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
  auto parsed = nlohmann::json::parse(last, nullptr, false);
  return parsed.is_object() ? parsed : nlohmann::json::object();
}

std::map<std::string, Step> steps_of(const std::string& output) {
  std::map<std::string, Step> out;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find('\t');
    const auto second = line.find('\t', first + 1);
    if (second == std::string::npos) continue;
    out[line.substr(0, first)] = {std::stoi(line.substr(first + 1)),
                                  nlohmann::json::parse(line.substr(second + 1), nullptr, false)};
  }
  return out;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void edit(const std::filesystem::path& file, const std::string& right, const std::string& wrong) {
  std::string text = text_of(file);
  const std::size_t at = text.find(right);
  ASSERT_NE(at, std::string::npos) << right << " does not stand in " << file;
  text.replace(at, right.size(), wrong);
  std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> deeds_of(const std::filesystem::path& run_folder) {
  std::vector<std::string> out;
  std::ifstream in(run_folder / "effects.jsonl");
  for (std::string line; std::getline(in, line);) {
    const auto deed = nlohmann::json::parse(line);
    out.push_back(deed.value("kind", "") + " " + deed.value("object", ""));
  }
  return out;
}

std::vector<std::string> journaled_events(const std::filesystem::path& journal) {
  std::vector<std::string> out;
  exec::journal::Journal(journal, exec::journal::Durability::process)
      .for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
        if (kind == "event") out.emplace_back(text);
      });
  return out;
}

}  // namespace roci::scenario
