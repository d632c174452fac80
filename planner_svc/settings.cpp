#include "planner_svc/settings.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/mission/mission_file.hpp"
#include "core/mission/model_text.hpp"

namespace roci::planner {

namespace {

constexpr std::int64_t kMostThreads = 64;

void read_resolvers(const roci::mission::Entry& planner, const engine::Table& table, Settings& out) {
  if (const auto threads = planner.find("threads")) {
    if (threads->integer() < 1 || threads->integer() > kMostThreads)
      threads->fail("a search runs on 1 to " + std::to_string(kMostThreads) + " threads");
    out.threads = static_cast<std::size_t>(threads->integer());
  }
  const auto list = planner.find("resolvers");
  if (!list) return;
  const auto engine = table.find(out.engine);
  std::string known;
  if (engine != table.end())
    for (const std::string& name : engine->second.resolvers) known += (known.empty() ? "" : ", ") + name;
  if (known.empty())
    list->fail("engine '" + out.engine + "' has no resolvers to choose from; take 'resolvers' out");
  for (const roci::mission::Entry& one : list->items()) {
    out.resolvers.push_back(one.text());
    if (std::ranges::find(engine->second.resolvers, out.resolvers.back()) == engine->second.resolvers.end())
      one.fail("engine '" + out.engine + "' has no resolver '" + out.resolvers.back() + "'; write some of " +
               known);
  }
  if (out.resolvers.empty()) list->fail("there is no resolver in it; write some of " + known);
  try {
    if (engine->second.check_resolvers) engine->second.check_resolvers(out.resolvers);
  } catch (const std::invalid_argument& fault) {
    list->fail(fault.what());
  }
}

}  // namespace

Settings read_settings(const std::filesystem::path& mission, const engine::Table& table) {
  Settings out;
  const auto root = roci::mission::load_mission_file(mission);
  if (const auto model = root.find("model")) {
    out.model = roci::mission::model_text(*model);
    out.model_file = model->resolve(model->text());
  }
  if (const auto ground = root.find("ground"))
    if (const auto uploads = ground->find("uploads")) out.uploads = uploads->texts();
  const auto planner = root.find("planner");
  if (!planner) return out;
  out.engine = planner->text_or("engine", "");
  out.keep_steps = planner->truth_or("keep_steps", out.keep_steps);
  read_resolvers(*planner, table, out);
  out.function_timeout = temporal::seconds(planner->number_or("function_timeout_s", 20));
  if (const auto budget = planner->find("budget")) {
    if (const auto improvement = budget->find("improvement")) {
      const double evaluations = improvement->number();
      if (!(evaluations >= 0) || evaluations > 1e12 || evaluations != std::floor(evaluations))
        improvement->fail(
            "'improvement' counts evaluations: write a whole number, 0 for the first plan as it is");
      out.improvement = static_cast<std::uint64_t>(evaluations);
    }
  }
  if (const auto functions = planner->find("functions")) {
    const auto mode = engine::functions_mode_named(functions->text());
    if (!mode)
      functions->fail("'" + functions->text() +
                      "' is no way to ask for function values; write eager, lazy or two_accuracy");
    out.functions = *mode;
  }
  if (const auto simulated = planner->find("simulated")) {
    simulated->allow_only({"base_s", "per_evaluation_s"});
    out.simulated_base_s = simulated->number_or("base_s", out.simulated_base_s);
    out.simulated_per_evaluation_s = simulated->number_or("per_evaluation_s", out.simulated_per_evaluation_s);
  }
  return out;
}

}  // namespace roci::planner
