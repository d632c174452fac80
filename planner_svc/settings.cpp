#include "planner_svc/settings.hpp"

#include <cmath>

#include "core/mission/mission_file.hpp"
#include "core/mission/model_text.hpp"

namespace roci::planner {

Settings read_settings(const std::filesystem::path& mission) {
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
