// doubting-planner: the planner that is shipped, but for one thing: it calls every problem with the word "taboo" in it
// invalid, as an engine with a fault of its own might.
#include <algorithm>
#include <utility>

#include "planner_svc/engine_host_service.hpp"
#include "planner_svc/engines.hpp"
#include "services/process/service_main.hpp"

namespace roci::planner {
namespace {

constexpr char kEngine[] = "temporal_pddl";

class DoubtingEngine final : public engine::AnsweringEngine {
 public:
  explicit DoubtingEngine(std::unique_ptr<engine::AnsweringEngine> engine) : engine_(std::move(engine)) {}

  engine::Answer answer(const engine::Request& request, const engine::Limits& limits,
                        engine::FunctionSource& functions) override {
    if (request.problem_text.find("taboo") != std::string::npos)
      return engine::without_plan(temporal::Verdict::invalid_input, "a word of the problem is taboo");
    return engine_->answer(request, limits, functions);
  }

 private:
  std::unique_ptr<engine::AnsweringEngine> engine_;
};

const engine::Table& doubting_engines() {
  static const engine::Table table = [] {
    engine::Table out{*engines().find(kEngine)};
    engine::TableEntry& entry = out.at(kEngine);
    entry.make = engine::MakeAnswering([make = std::get<engine::MakeAnswering>(entry.make)] {
      return std::make_unique<DoubtingEngine>(make());
    });
    return out;
  }();
  return table;
}

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  return host_engines(node, settings, doubting_engines());
}

}  // namespace
}  // namespace roci::planner

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "planner_svc", roci::planner::make_service);
}
