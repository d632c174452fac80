#include "exec_svc/standby/orders_apart.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "exec_svc/orders/order.hpp"

namespace roci::exec::standby {

using journal::Journal;
using orders::OrderStage;
using temporal::Time;

namespace {

constexpr std::string_view kGiven = "order ";
constexpr std::string_view kStage = "ordered ";
constexpr std::string_view kStageNumber = " stage=";

// Holds a line of the trace about orders, without the time before it.
struct Line {
  Time at;
  std::string_view text;
};

void each_line(const Journal& journal, const std::function<void(const Line&)>& visit) {
  journal.for_each([&](Time time, std::string_view kind, std::string_view text) {
    const std::size_t space = text.find(' ');
    if (kind != "trace" || space == std::string_view::npos) return;
    text.remove_prefix(space + 1);
    if (text.starts_with(kGiven) || text.starts_with(kStage)) visit({time, text});
  });
}

// Returns the key and the stage of "ordered KEY stage=N …".
std::optional<std::pair<std::string, OrderStage>> stage_of(std::string_view text) {
  if (!text.starts_with(kStage)) return std::nullopt;
  text.remove_prefix(kStage.size());
  const std::size_t end = text.find(kStageNumber);
  if (end == std::string_view::npos || end + kStageNumber.size() >= text.size()) return std::nullopt;
  const char digit = text[end + kStageNumber.size()];
  if (digit < '0' || digit > '3') return std::nullopt;
  return std::pair(std::string(text.substr(0, end)), static_cast<OrderStage>(digit - '0'));
}

}  // namespace

std::vector<TakenOrder> taken_orders(const Journal& journal) {
  std::vector<TakenOrder> out;
  std::vector<std::string> given;  // "KEY KIND TARGET", whose stage is not told yet
  std::map<std::string, std::size_t> known;
  std::set<std::string> refused;
  each_line(journal, [&](const Line& line) {
    if (line.text.starts_with(kGiven)) return given.emplace_back(line.text.substr(kGiven.size())), void();
    const auto stage = stage_of(line.text);
    if (!stage) return;
    const auto& [key, reached] = *stage;
    if (reached == OrderStage::refused) refused.insert(key);
    if (!known.try_emplace(key, out.size()).second) return;
    const auto order = std::ranges::find_if(given, [&](const std::string& text) {
      return text.size() > key.size() && text.starts_with(key) && text[key.size()] == ' ';
    });
    out.push_back({key, order == given.end() ? "" : order->substr(key.size() + 1), line.at});
    if (out.back().what.ends_with(' ')) out.back().what.pop_back();  // it has no target
    if (order != given.end()) given.erase(order);
  });
  std::erase_if(out, [&](const TakenOrder& order) { return refused.contains(order.key); });
  return out;
}

std::vector<TakenOrder> unknown_orders(std::vector<TakenOrder> taken, const Journal& successor) {
  if (taken.empty()) return taken;
  Time first{std::numeric_limits<Time::rep>::max()};
  std::set<std::string, std::less<>> known;
  successor.for_each([&](Time time, std::string_view kind, std::string_view) {
    if (kind == "trace") first = std::min(first, time);
  });
  each_line(successor, [&](const Line& line) {
    if (const auto stage = stage_of(line.text)) known.insert(stage->first);
  });
  std::erase_if(taken,
                [&](const TakenOrder& order) { return known.contains(order.key) || order.at < first; });
  return taken;
}

}  // namespace roci::exec::standby
