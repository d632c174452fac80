#include "services/process/run_record.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/durable/durable_file.hpp"
#include "services/process/private_folder.hpp"

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
    run.run = record.value("run", "");
    run.keys = record.value("keys", "");
    run.network = record.value("network", "");
    return run;
  } catch (const json::exception&) {
    return std::nullopt;  // it is no record
  }
}

bool lives(std::int64_t pid) { return kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM; }

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

PublishedRun::PublishedRun(const fs::path& folder, const RunRecord& run)
    : file_(folder / ("run-" + std::to_string(run.pid) + ".json")) {
  durable::replace_file(file_, to_json(run).dump(2) + "\n");
}

PublishedRun::~PublishedRun() {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

std::vector<RunRecord> find_runs(const fs::path& folder) {
  std::vector<RunRecord> runs;
  for (const fs::path& file : records_in(folder)) {
    if (auto run = read(file); run && lives(run->pid)) runs.push_back(std::move(*run));
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
    if (pid != record.end() && pid->is_number_integer() && !lives(pid->get<std::int64_t>())) continue;
    out.push_back(file.string() + " is of format " + std::to_string(format_of(record)) +
                  ", this version reads up to " + std::to_string(kRunRecordFormat) +
                  "; use the programs that the run was started with");
  }
  return out;
}

}  // namespace roci::services::process
