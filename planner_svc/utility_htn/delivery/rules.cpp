#include "planner_svc/utility_htn/delivery/rules.hpp"

#include <algorithm>
#include <string_view>

namespace roci::planner::utility_htn::delivery {
namespace {

constexpr double kDay = 86'400;

std::optional<model::ParameterIndex> parameter_named(const model::Network& network, std::string_view name) {
  const auto found = std::ranges::find(network.parameters, name, &model::Parameter::name);
  if (found == network.parameters.end()) return std::nullopt;
  return static_cast<model::ParameterIndex>(found - network.parameters.begin());
}

}  // namespace

Rules::Rules(const model::Network& network)
    : network_(&network),
      rate_(parameter_named(network, "rate_bytes_per_s")),
      downlink_limit_(parameter_named(network, "downlink_limit_j")),
      sol_limit_(parameter_named(network, "sol_limit_j")),
      sol_length_(parameter_named(network, "sol_s")) {}

double Rules::value(std::optional<model::ParameterIndex> parameter, const model::Values& values,
                    double otherwise) {
  return parameter ? std::max(0.0, values[*parameter]) : otherwise;
}

std::uint32_t Rules::sol_of(temporal::Time time, const model::Values& values) const {
  const double length = std::max(1.0, value(sol_length_, values, kDay));
  return static_cast<std::uint32_t>(std::clamp(temporal::to_seconds(time) / length, 0.0, 4e9));
}

temporal::Time Rules::end_of_sol(std::uint32_t sol, const model::Values& values) const {
  return temporal::seconds((static_cast<double>(sol) + 1) * std::max(1.0, value(sol_length_, values, kDay)));
}

downlink::Window Rules::window(const search::PlannedDownlink& planned, const model::Values& values) const {
  downlink::Window out;
  out.start = planned.start;
  out.latest_end = std::max(planned.start, planned.end);
  out.bytes_per_s = bytes_per_s(values);
  out.power_w = std::max(0.0, model::draw(*network_, network_->tasks[planned.task], values));
  out.energy_limit_j = downlink_limit_j(values);
  out.sol = sol_of(planned.start, values);
  if (out.bytes_per_s <= 0) {  // a silent radio carries nothing, at whatever rate
    out.bytes_per_s = 1;
    out.latest_end = out.start;
  }
  return out;
}

double Rules::joules(const downlink::Window& window) {
  return temporal::to_seconds(window.latest_end - window.start) * window.power_w;
}

}  // namespace roci::planner::utility_htn::delivery
