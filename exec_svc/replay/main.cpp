// roci-replay makes a run of the executive again, from its journal. docs/exit-codes.md has its exit codes.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/mission/mission_file.hpp"
#include "core/mission/service_list.hpp"
#include "exec_svc/archive/archive.hpp"
#include "exec_svc/journal/format.hpp"
#include "exec_svc/journal/round_trips.hpp"
#include "exec_svc/journal/run_replay.hpp"

namespace {

namespace fs = std::filesystem;
using roci::exec::journal::Journal;
using roci::exec::journal::JournalError;
using roci::exec::journal::replay_run;
using roci::exec::journal::RunReplay;
using roci::exec::mission::read_mission;

enum ExitCode { kSame = 0, kDiverged = 1, kBadUsage = 2, kNoJournal = 3 };

struct Options {
  fs::path journal;
  fs::path mission;
  bool json = false;
};

fs::path journal_file(const fs::path& given) {
  const fs::path file = fs::is_directory(given) ? given / "journal.sqlite" : given;
  if (!fs::is_regular_file(file))
    throw JournalError("there is no journal " + file.string() +
                       "; give a run folder, or one of the journals in it");
  return file;
}

nlohmann::json as_json(const RunReplay& run) {
  nlohmann::json out{{"turns", run.turns},
                     {"decisions", run.decisions},
                     {"restarts", run.restarts},
                     {"from_s", roci::temporal::to_seconds(run.from)},
                     {"until_s", roci::temporal::to_seconds(run.until)},
                     {"same", !run.divergence.has_value()},
                     {"trace_sha256", run.trace_sha256},
                     {"replayed_sha256", run.replayed_sha256}};
  if (run.divergence) {
    out["divergence"] = {{"time_s", roci::temporal::to_seconds(run.divergence->time)},
                         {"expected", run.divergence->expected},
                         {"got", run.divergence->got}};
  }
  return out;
}

void print(const RunReplay& run) {
  std::cout << run.turns << " steps with " << run.decisions << " decisions, mission time "
            << roci::temporal::to_text(run.from) << " to " << roci::temporal::to_text(run.until) << ", "
            << run.restarts << " restarts\n";
  if (!run.divergence) {
    std::cout << "the same decisions; trace " << run.replayed_sha256 << "\n";
    return;
  }
  const auto or_nothing = [](const std::string& text) { return text.empty() ? "nothing more" : text; };
  std::cout << "diverges at " << roci::temporal::to_text(run.divergence->time)
            << "\n  journaled: " << or_nothing(run.divergence->expected)
            << "\n  now:       " << or_nothing(run.divergence->got) << "\n";
}

// Reads the mission as the executive that wrote the journal read it.
roci::exec::mission::MissionModel mission_of(const Journal& journal, const Options& options) {
  const fs::path mission = options.mission.empty() ? fs::path(journal.text("mission")) : options.mission;
  if (mission.empty()) throw JournalError("the journal names no mission; give its folder with --mission");
  const std::string file = options.mission.empty() ? journal.text("mission_file") : "";
  const auto root = roci::mission::load_mission_file(mission);
  roci::exec::mission::ExecutiveRole role;
  if (root.find("services"))
    role =
        roci::exec::mission::role_of(roci::mission::read_service_list(root), journal.text("executive"), "");
  return read_mission(file.empty() ? mission : fs::path(file), role);
}

int replay(const Options& options) {
  const Journal journal(journal_file(options.journal));
  const std::int64_t format = journal.number("format", 0);
  if (format == 0) throw JournalError(options.journal.string() + " holds no inputs of a run");
  if (format != roci::exec::journal::kInputFormat)
    throw JournalError(options.journal.string() + " holds inputs of format " + std::to_string(format) +
                       ", this roci-replay repeats format " +
                       std::to_string(roci::exec::journal::kInputFormat) +
                       "; repeat the run with the version that flew it");
  roci::exec::mission::MissionModel model = mission_of(journal, options);
  model.executive.round_trips = roci::exec::journal::round_trips_of(journal.text("round_trips"));
  const RunReplay run = replay_run(journal, model);
  if (run.turns == 0) throw JournalError(options.journal.string() + " holds no inputs of a run");
  if (options.json) {
    std::cout << as_json(run).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  } else {
    print(run);
  }
  return run.divergence ? kDiverged : kSame;
}

int complain(const std::exception& error, int code) {
  std::cerr << "roci-replay: " << error.what() << "\n";
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Repeats a run from the inputs in its journal and compares every decision", "roci-replay");
  app.add_option("journal", options.journal, "Run folder, or its journal.sqlite")->required();
  app.add_option("--mission", options.mission, "Mission folder (default: the one of the run)");
  app.add_flag("--json", options.json, "Print JSON");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSame : kBadUsage;
  }
  try {
    return replay(options);
  } catch (const roci::mission::FileError& error) {
    return complain(error, kBadUsage);
  } catch (const std::exception& error) {
    return complain(error, kNoJournal);
  }
}
