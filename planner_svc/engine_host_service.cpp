#include "planner_svc/engine_host_service.hpp"

#include <optional>

#include "core/mission/service_list.hpp"
#include "planner_svc/answering_host_service.hpp"
#include "planner_svc/decision_host_service.hpp"
#include "planner_svc/settings.hpp"
#include "planner_svc/stepped_host_service.hpp"

namespace roci::planner {
namespace {

// Of several planners of a mission each has a folder of its own.
std::filesystem::path folder_of(const services::Node& node, const services::RunSettings& run,
                                const std::string& name) {
  if (run.run_folder.empty()) return {};
  const auto list =
      run.mission.empty() ? mission::ServiceList{} : mission::load_service_list_if_any(run.mission);
  return run.run_folder / list.file_name(node.options().name, name);
}

class EngineHost final : public services::Service {
 public:
  EngineHost(services::Node& node, const services::RunSettings& run, const engine::Table& table)
      : settings_(read_settings(run.mission_file(), table)), answering_(node, run, settings_, table) {
    if (engine::stepped_named(table, settings_.engine) != nullptr)
      stepped_.emplace(
          node, settings_, table.at(settings_.engine), folder_of(node, run, "networks"),
          settings_.keep_steps ? folder_of(node, run, "planner_steps") : std::filesystem::path{});
    if (const auto entry = table.find(settings_.engine); entry != table.end() && entry->second.make_resolver)
      decisions_.emplace(node, settings_,
                         entry->second.make_resolver({settings_.engine, node.options().robot, settings_.model,
                                                      settings_.model_file}));
  }

 private:
  Settings settings_;
  AnsweringHost answering_;
  std::optional<SteppedHost> stepped_;
  std::optional<DecisionHost> decisions_;
};

}  // namespace

std::unique_ptr<services::Service> host_engines(services::Node& node, const services::RunSettings& settings,
                                                const engine::Table& table) {
  return std::make_unique<EngineHost>(node, settings, table);
}

}  // namespace roci::planner
