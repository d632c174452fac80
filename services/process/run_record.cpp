#include "services/process/run_record.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "core/durable/durable_file.hpp"
#include "services/process/private_folder.hpp"

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFirstField = 3;   // of /proc/PID/stat behind the name, counted from 1 (proc(5))
constexpr int kStartField = 22;

json to_json(const RunRecord& run) {
  return {{"format", kRunRecordFormat},
          {"pid", run.pid},
          {"domain", run.domain},
          {"mission", run.mission.string()},
          {"scenario", run.scenario},
          {"dds", run.dds},
          {"address", run.address},
          {"peers", run.peers},
          {"run_folder", run.run_folder.string()},
          {"clock", run.clock},
          {"started_unix_us", run.started_unix_us},
          {"pid_started", run.pid_started},
          {"run", run.run},
          {"keys", run.keys.string()},
          {"network", run.network.string()}};
}

// A record that names no version is of version 1.
int format_of(const json& record) {
  const auto found = record.find("format");
  return found != record.end() && found->is_number_integer() ? found->get<int>() : 1;
}

std::optional<RunRecord> read(const fs::path& file) {
  std::ifstream in(file);
  const json record = json::parse(in, nullptr, false);
  if (!record.is_object() || format_of(record) > kRunRecordFormat) return std::nullopt;
  try {
    RunRecord run;
    run.pid = record.at("pid");
    run.domain = record.at("domain");
    run.mission = record.at("mission").get<std::string>();
    run.scenario = record.at("scenario");
    run.dds = record.at("dds");
    run.address = record.at("address");
    run.peers = record.at("peers").get<std::vector<std::string>>();
    run.run_folder = record.at("run_folder").get<std::string>();
    run.clock = record.at("clock");
    run.started_unix_us = record.at("started_unix_us");
    run.pid_started = record.value("pid_started", std::uint64_t{0});
    run.run = record.value("run", "");
    run.keys = record.value("keys", "");
    run.network = record.value("network", "");
    return run;
  } catch (const json::exception&) {
    return std::nullopt;  // it is no record
  }
}

bool is_process(std::int64_t pid) { return kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM; }

// Another process may have the number of a launcher that was killed.
bool lives(const RunRecord& run) {
  return is_process(run.pid) && (run.pid_started == 0 || run.pid_started == start_of_process(run.pid));
}

std::vector<fs::path> records_in(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".json") out.push_back(entry.path());
  }
  return out;
}

}  // namespace

fs::path runtime_folder() {
  const char* xdg = std::getenv("XDG_RUNTIME_DIR");
  const fs::path folder = xdg != nullptr && *xdg != '\0'
                              ? fs::path(xdg) / "rocinante"
                              : fs::path("/tmp/rocinante-" + std::to_string(geteuid()));
  make_private_folder(folder);
  return folder;
}

std::string stat_field(std::int64_t pid, int field) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(stat, text);
  const std::size_t name_end = text.rfind(')');  // a name may have blanks and brackets
  if (name_end == std::string::npos) return "";
  std::istringstream fields(text.substr(name_end + 1));
  std::string word;
  for (int at = kFirstField; at <= field; ++at)
    if (!(fields >> word)) return "";
  return word;
}

std::uint64_t start_of_process(std::int64_t pid) {
  return std::strtoull(stat_field(pid, kStartField).c_str(), nullptr, 10);
}

PublishedRun::PublishedRun(const fs::path& folder, const RunRecord& run)
    : file_(folder / ("run-" + std::to_string(run.pid) + ".json")) {
  std::error_code ignored;
  for (const fs::path& file : records_in(folder))
    if (const auto other = read(file); other && !lives(*other)) fs::remove(file, ignored);
  durable::replace_file(file_, to_json(run).dump(2) + "\n");
}

PublishedRun::~PublishedRun() {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

std::vector<RunRecord> find_runs(const fs::path& folder) {
  std::vector<RunRecord> runs;
  for (const fs::path& file : records_in(folder)) {
    if (auto run = read(file); run && lives(*run)) runs.push_back(std::move(*run));
  }
  std::ranges::sort(runs, std::greater<>{}, &RunRecord::started_unix_us);
  return runs;
}

std::vector<std::string> refused_runs(const fs::path& folder) {
  std::vector<std::string> out;
  for (const fs::path& file : records_in(folder)) {
    std::ifstream in(file);
    const json record = json::parse(in, nullptr, false);
    if (!record.is_object() || format_of(record) <= kRunRecordFormat) continue;
    const auto pid = record.find("pid");
    if (pid != record.end() && pid->is_number_integer() && !is_process(pid->get<std::int64_t>())) continue;
    out.push_back(file.string() + " is of format " + std::to_string(format_of(record)) +
                  ", this version reads up to " + std::to_string(kRunRecordFormat) +
                  "; use the programs that the run was started with");
  }
  return out;
}

}  // namespace roci::services::process
