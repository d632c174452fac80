#include "services/process/run_record.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json to_json(const RunRecord& run) {
  return {{"pid", run.pid},
          {"domain", run.domain},
          {"mission", run.mission.string()},
          {"scenario", run.scenario},
          {"dds", run.dds},
          {"address", run.address},
          {"peers", run.peers},
          {"run_folder", run.run_folder.string()},
          {"clock", run.clock},
          {"started_unix_us", run.started_unix_us}};
}

std::optional<RunRecord> read(const fs::path& file) {
  std::ifstream in(file);
  const json record = json::parse(in, nullptr, false);
  if (record.is_discarded()) return std::nullopt;
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
    return run;
  } catch (const json::exception&) {
    return std::nullopt;  // of another version
  }
}

bool lives(std::int64_t pid) { return kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM; }

}  // namespace

fs::path runtime_folder() {
  const char* xdg = std::getenv("XDG_RUNTIME_DIR");
  const fs::path folder = xdg != nullptr && *xdg != '\0'
                              ? fs::path(xdg) / "rocinante"
                              : fs::path("/tmp/rocinante-" + std::to_string(getuid()));
  if (fs::create_directories(folder)) fs::permissions(folder, fs::perms::owner_all);
  return folder;
}

PublishedRun::PublishedRun(const fs::path& folder, const RunRecord& run)
    : file_(folder / ("run-" + std::to_string(run.pid) + ".json")) {
  const fs::path unfinished = fs::path(file_).concat(".new");
  std::ofstream(unfinished) << to_json(run).dump(2) << '\n';
  fs::rename(unfinished, file_);
}

PublishedRun::~PublishedRun() {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

std::vector<RunRecord> find_runs(const fs::path& folder) {
  std::vector<RunRecord> runs;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".json") continue;
    if (auto run = read(entry.path()); run && lives(run->pid)) runs.push_back(std::move(*run));
  }
  std::ranges::sort(runs, std::greater<>{}, &RunRecord::started_unix_us);
  return runs;
}

}  // namespace roci::services::process
