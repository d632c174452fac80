#include "planner_svc/utility_htn/adapter/fit.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <string_view>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"

namespace roci::planner::utility_htn::adapter {

using temporal::FlexiblePlan, temporal::PlanActivity, temporal::Token;

namespace {

template <class Items, class Member>
bool has(const Items& items, std::string_view name, Member member) {
  return std::ranges::find(items, name, member) != items.end();
}

// Returns whether the network has what a token remembers, and a value of it.
bool remembers(const model::Network& network, const Token& token) {
  const std::string_view name = token.timeline;
  const std::string_view rest = name.substr(std::min(name.size(), name.find('.') + 1));
  if (name.starts_with("done.") || name.starts_with("withdrawn.") || name.starts_with("contingent."))
    return has(network.tasks, rest, &model::Task::id);
  if (name.starts_with("failed.")) {
    const auto* const times = std::get_if<double>(&token.held);
    return has(network.tasks, rest, &model::Task::id) && times != nullptr && is_count(*times);
  }
  if (name.starts_with("parameter.")) {
    const auto known = std::ranges::find(network.parameters, rest, &model::Parameter::name);
    const auto* const value = std::get_if<double>(&token.held);
    return known != network.parameters.end() && value != nullptr && known->permits(*value);
  }
  if (name == kLastBlock) {
    const auto* const number = std::get_if<double>(&token.held);
    return number != nullptr && is_count(*number);
  }
  if (!name.starts_with("internal.")) return true;
  const auto known = std::ranges::find(network.timelines, rest, &temporal::timelines::Definition::name);
  return known != network.timelines.end() && number_of(*known, token.held).has_value();
}

std::uint32_t number_of_block(const Token& token) {
  const auto* const held = std::get_if<temporal::State>(&token.held);
  std::uint32_t out = 0;
  if (held != nullptr && held->arguments.size() == 1) {
    const std::string& text = held->arguments.front();
    std::from_chars(text.data(), text.data() + text.size(), out);
  }
  return out;
}

}  // namespace

Fitted fit(const model::Network& network, const flattening::Chains& chains, const FlexiblePlan& plan) {
  Fitted out;
  out.plan = plan;
  std::map<std::uint32_t, std::map<std::size_t, std::string>> links;  // by block: what the plan has of it
  for (const PlanActivity& activity : plan.activities)
    if (const auto id = task_of(activity.id))
      links[cycle::block_of(*id)][cycle::link_of(*id)] = activity.id.substr(0, activity.id.rfind('#'));
  std::map<std::uint32_t, bool> known;  // blocks that the network has
  const auto fits = [&](const Token& token) {
    if (token.start_point == temporal::origin_point) return remembers(network, token);
    const std::uint32_t number = number_of_block(token);
    out.last_block = std::max(out.last_block, number);
    const auto* const held = std::get_if<temporal::State>(&token.held);
    return known[number] =
               held != nullptr && std::ranges::any_of(chains.chains, [&](const flattening::Chain& chain) {
                 return chain.name == held->name && network.tasks[chain.task].id == token.timeline &&
                        std::ranges::all_of(links[number], [&](const auto& link) {
                          return link.first < chain.links.size() &&
                                 network.tasks[chain.links[link.first].task].id == link.second;
                        });
               });
  };
  std::erase_if(out.plan.tokens, [&](const Token& token) { return !fits(token); });
  std::erase_if(out.plan.activities, [&](const PlanActivity& activity) {
    const auto id = task_of(activity.id);
    if (!id || known[cycle::block_of(*id)]) return false;
    out.gone.push_back(activity);
    return true;
  });
  out.foreign = out.plan.tokens.size() != plan.tokens.size();
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
