#include "planner_svc/utility_htn/cli/cycle.hpp"

#include <charconv>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "core/mission/findings.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/checking/schedule_checker.hpp"
#include "planner_svc/utility_htn/cli/words.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn::cli {

using adapter::UtilityEngine;
using engine::RecordedEngine, engine::RecordedStep, engine::StepOutcome, engine::StepRecordReader;

namespace {

// Larger than any record that a planner writes.
constexpr std::uintmax_t kMostRecordBytes = 1ULL << 30U;

model::Network network_of(const std::string& packed) {
  mission::Findings findings;
  auto network = reading::take_network(packed, "network of the record", findings);
  if (network) return std::move(*network);
  std::string text = "its network cannot be used";
  for (const mission::Finding& finding : findings.sorted()) text += "; " + finding.text();
  throw std::invalid_argument(text);
}

UtilityEngine engine_of(const RecordedEngine& recorded) {
  if (recorded.engine != "utility_htn")
    throw std::invalid_argument("it is a record of the engine '" + recorded.engine +
                                "'; roci-network plans those of utility_htn again");
  engine::Setup setup;
  setup.engine = recorded.engine;
  setup.robot = recorded.robot;
  setup.resolvers = recorded.resolvers;
  return {setup, network_of(recorded.model)};
}

// An engine beside the checker of what it tells of downlinks.
class Flight {
 public:
  explicit Flight(const RecordedEngine& recorded)
      : engine_(engine_of(recorded)), network_(network_of(recorded.model)) {}

  void step(const engine::StepInputs& inputs, ReplannedCycle& out) {
    engine::StepOutput output;
    try {
      output = engine_.step(inputs);
    } catch (const std::exception& error) {
      out.now = engine::outcome_of({}, error.what());
      return;
    }
    if (!(output.model == model_)) {
      model_ = output.model;
      network_ = network_of(engine_.packed_model());
    }
    out.downlink_faults = checker_.faults(network_, inputs, output);
    out.now = engine::outcome_of(output);
  }
  std::uint64_t schedules() const { return checker_.checked(); }

 private:
  UtilityEngine engine_;
  model::Network network_;
  engine::ModelName model_;
  checking::ScheduleChecker checker_;
};

bool has_something(const StepOutcome& outcome) { return outcome != StepOutcome{}; }

std::string hexadecimal(std::uint64_t value) {
  char digits[16];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value, 16).ptr;
  std::string out(std::begin(digits), end);
  return std::string(16 - out.size(), '0') + out;
}

std::string version_text(const StepOutcome& outcome) {
  if (!outcome.fault.empty()) return "failed: " + outcome.fault;
  if (outcome.version == 0) return "no version";
  return "version " + std::to_string(outcome.version) + ", checksum " + hexadecimal(outcome.delta);
}

std::string text_of(const ReplannedCycle& one) {
  std::string out = "cycle " + std::to_string(one.number) + ", step " + std::to_string(one.step) + ", at " +
                    temporal::to_text(one.at) + ": " + version_text(one.now) + "\n";
  if (!one.now.account.empty()) out += "  " + one.now.account + "\n";
  for (const std::string& fault : one.downlink_faults) out += "  downlinks: " + fault + "\n";
  if (one.as_flown()) return out;
  return out + "  differs from the flight: " + version_text(*one.flown) + "\n  " + one.flown->account + "\n";
}

nlohmann::ordered_json to_json(const StepOutcome& outcome) {
  nlohmann::ordered_json out = {{"account", outcome.account}, {"version", outcome.version}};
  if (outcome.version != 0) out["checksum"] = hexadecimal(outcome.delta);
  if (!outcome.fault.empty()) out["fault"] = outcome.fault;
  return out;
}

nlohmann::ordered_json to_json(const ReplannedCycle& one) {
  nlohmann::ordered_json out = {{"cycle", one.number},
                                {"step", one.step},
                                {"time_us", one.at.count()},
                                {"as_flown", one.as_flown()},
                                {"now", to_json(one.now)}};
  if (!one.downlink_faults.empty()) out["downlink_faults"] = one.downlink_faults;
  if (!one.as_flown()) out["flown"] = to_json(*one.flown);
  return out;
}

std::string summary_text(const Replanned& all) {
  return std::to_string(all.cycles) + " cycles in " + std::to_string(all.steps) + " steps, " +
         std::to_string(all.versions) + " versions: " +
         (all.differing == 0 ? "all as flown"
                             : std::to_string(all.differing) + " cycles differ from the flight") +
         "; " + std::to_string(all.schedules) + " schedules of downlinks: " +
         (all.faulty == 0 ? "no fault" : "faults in " + std::to_string(all.faulty) + " cycles") +
         (all.cut_short ? "; the record's last entry is cut short" : "") + "\n";
}

}  // namespace

Replanned plan_again(std::string_view record, std::uint64_t until,
                     const std::function<void(const ReplannedCycle&)>& told) {
  StepRecordReader reader(record);
  Flight flight(reader.engine());
  Replanned out;
  while (until == 0 || out.cycles < until) {
    std::optional<RecordedStep> next = reader.next();
    if (!next) break;
    ++out.steps;
    ReplannedCycle one{.number = out.cycles + 1,
                       .step = out.steps,
                       .at = next->inputs.now,
                       .flown = std::move(next->outcome)};
    flight.step(next->inputs, one);
    if (has_something(one.now) || (one.flown && has_something(*one.flown))) {
      ++out.cycles;
      out.versions += one.now.version != 0 ? 1 : 0;
      out.differing += one.as_flown() ? 0 : 1;
      out.faulty += one.downlink_faults.empty() ? 0 : 1;
      told(one);
    }
    if (!one.now.fault.empty()) break;  // an engine that has failed is made anew
  }
  out.schedules = flight.schedules();
  out.cut_short = reader.cut_short();
  return out;
}

ExitCode cycle(const std::filesystem::path& record, std::uint64_t until, const Output& output) {
  std::error_code error;
  std::ifstream in(record, std::ios::binary);
  const std::uintmax_t bytes = std::filesystem::file_size(record, error);
  if (error || !in || bytes > kMostRecordBytes) {
    output.errors << record.string() << ": "
                  << (error || !in ? "cannot be read; check the path and its permissions"
                                   : "is larger than any record of a planner")
                  << '\n';
    return wrong_use;
  }
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  try {
    nlohmann::ordered_json cycles = nlohmann::ordered_json::array();
    const Replanned all = plan_again(whole, until, [&](const ReplannedCycle& one) {
      if (output.json)
        cycles.push_back(to_json(one));
      else
        output.out << text_of(one);
    });
    if (output.json)
      output.out << nlohmann::ordered_json{{"cycles", cycles},
                                           {"steps", all.steps},
                                           {"versions", all.versions},
                                           {"differing", all.differing},
                                           {"schedules", all.schedules},
                                           {"faulty", all.faulty},
                                           {"cut_short", all.cut_short}}
                        .dump(2)
                 << '\n';
    else
      output.out << summary_text(all);
    return all.differing == 0 && all.faulty == 0 ? done : faulty;
  } catch (const engine::StepRecordError& fault) {
    output.errors << record.string() << ": " << fault.what() << '\n';
  } catch (const std::invalid_argument& fault) {
    output.errors << record.string() << ": " << fault.what() << '\n';
  }
  return faulty;
}

}  // namespace roci::planner::utility_htn::cli
