#include "planner_svc/utility_htn/cli/commands.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>

#include "core/mission/finding_json.hpp"
#include "core/mission/finding_report.hpp"
#include "planner_svc/utility_htn/cli/chain_table.hpp"
#include "planner_svc/utility_htn/cli/first_plan.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "planner_svc/utility_htn/reading/yaml.hpp"

namespace roci::planner::utility_htn::cli {

using mission::Findings;
using model::Network;

namespace {

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

bool readable(const std::filesystem::path& file, const Output& output) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error) && std::ifstream(file)) return true;
  output.errors << file.string() << ": cannot be read; check the path and its permissions\n";
  return false;
}

ExitCode write(const std::string& bytes, const std::filesystem::path& to, const Output& output) {
  std::ofstream out(to, std::ios::binary);
  if (out << bytes && out.flush()) return done;
  output.errors << to.string() << ": cannot be written; check that the folder exists\n";
  return wrong_use;
}

// The network, or nothing after its faults were told.
std::optional<Network> load(const std::filesystem::path& file, const Output& output) {
  Findings findings;
  auto network = reading::load_network(file, findings);
  output.errors << mission::report(findings);
  return network;
}

void require_requested(const Network& network, const std::string& task) {
  const auto found = std::ranges::find(network.tasks, task, &model::Task::id);
  if (found == network.tasks.end())
    throw std::invalid_argument("there is no task '" + task + "'; roci-network chains lists those there are");
  if (found->is_template)
    throw std::invalid_argument("'" + task + "' is a template, for which nobody asks by itself; name a task");
}

// "battery=250000": a parameter, or the first value of a timeline; of a state timeline the state's name.
WhatIf what_if(const Network& network, const std::vector<std::string>& changes) {
  WhatIf out;
  for (const std::string& change : changes) {
    const std::size_t equals = std::min(change.find('='), change.size());
    const std::string name = change.substr(0, equals);
    const std::string text = change.substr(std::min(equals + 1, change.size()));
    const auto timeline = std::ranges::find(network.timelines, name, &temporal::timelines::Definition::name);
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = !text.empty() && error == std::errc{} && rest == text.data() + text.size();
    if (timeline == network.timelines.end()) {
      const bool known = std::ranges::find(network.parameters, name, &model::Parameter::name) !=
                         network.parameters.end();
      if (!is_number && known) throw std::invalid_argument("'" + change + "' is not NAME=NUMBER");
      out.values[name] = value;
      continue;
    }
    const auto state = std::ranges::find(timeline->states, text);
    if (state != timeline->states.end())
      value = static_cast<double>(state - timeline->states.begin());
    else if (!is_number || !timeline->states.empty())
      throw std::invalid_argument("'" + change + "' is no value of the timeline '" + name + "'");
    out.initial[name] = value;
  }
  return out;
}

}  // namespace

ExitCode check(const std::filesystem::path& file, const Output& output) {
  if (!readable(file, output)) return wrong_use;
  Findings findings;
  const auto network = reading::load_network(file, findings);
  const std::size_t errors = findings.errors(), warnings = findings.size() - errors;
  if (output.json) {
    const nlohmann::ordered_json json = {{"usable", network.has_value()},
                                         {"errors", errors},
                                         {"warnings", warnings},
                                         {"findings", to_json(findings)}};
    output.out << json.dump(2) << '\n';
    return network ? done : faulty;
  }
  output.out << mission::report(findings);
  if (!network) {
    output.out << counted(errors, "error") << ", " << counted(warnings, "warning") << '\n';
    return faulty;
  }
  std::size_t requested = 0;
  for (const model::Task& task : network->tasks) requested += task.is_template ? 0 : 1;
  output.out << "network '" << network->name << "', version " << network->version << ": "
             << counted(requested, "requested task") << ", "
             << counted(network->tasks.size() - requested, "template") << ", "
             << counted(network->timelines.size(), "timeline") << ", "
             << counted(network->parameters.size(), "parameter") << ", "
             << counted(flattening::flatten(*network).chains.size(), "chain") << "; no error, "
             << counted(warnings, "warning") << '\n';
  return done;
}

ExitCode chains(const std::filesystem::path& file, const Output& output) {
  if (!readable(file, output)) return wrong_use;
  const auto network = load(file, output);
  if (!network) return faulty;
  const flattening::Chains all = flattening::flatten(*network);
  output.out << (output.json ? chain_json(*network, all) + "\n" : chain_table(*network, all));
  return done;
}

ExitCode explain(const std::filesystem::path& file, const std::vector<std::string>& tasks,
                 const std::vector<std::string>& changes, const Output& output) {
  if (!readable(file, output)) return wrong_use;
  const auto network = load(file, output);
  if (!network) return faulty;
  try {
    for (const std::string& task : tasks) require_requested(*network, task);
    const FirstPlan plan = first_plan(*network, what_if(*network, changes));
    output.out << (output.json ? plan_json(*network, plan) + "\n" : plan_text(*network, plan, tasks));
    return done;
  } catch (const std::invalid_argument& error) {
    output.errors << file.string() << ": " << error.what() << '\n';
    return wrong_use;
  }
}

ExitCode pack(const std::filesystem::path& file, const std::filesystem::path& to, const Output& output) {
  if (!readable(file, output)) return wrong_use;
  const auto network = load(file, output);
  if (!network) return faulty;
  const std::string bytes = reading::to_binary(*network);
  const ExitCode code = write(bytes, to, output);
  if (code == done) output.out << to.string() << ": " << bytes.size() << " bytes\n";
  return code;
}

ExitCode unpack(const std::filesystem::path& file, const std::filesystem::path& to, const Output& output) {
  if (!readable(file, output)) return wrong_use;
  const auto network = load(file, output);
  if (!network) return faulty;
  if (!to.empty()) return write(reading::to_yaml(*network), to, output);
  output.out << reading::to_yaml(*network);
  return done;
}

}  // namespace roci::planner::utility_htn::cli
