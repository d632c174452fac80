// Downlinks by the formulas of appendix A.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "planner_svc/utility_htn/checking/course.hpp"
#include "planner_svc/utility_htn/checking/parts.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using model::Tier;

std::string words(Tier tier) {
  if (tier == Tier::critical) return "Critical";
  if (tier == Tier::decisional) return "Decisional";
  return tier == Tier::mandatory ? "Mandatory" : "Residual";
}

std::string name(const Product& product) { return words(product.tier) + " product '" + product.id + "'"; }

bool more(double value, double limit) { return value > limit * (1 + 1e-9) + 1e-9; }

// Says which limit of a window so many bytes break; empty: none.
std::string breaks(const Window& window, double bytes) {
  if (bytes == 0) return "";
  if (!(window.bytes_per_s > 0)) return "has no rate";
  const double seconds = bytes / window.bytes_per_s;
  if (more(seconds, temporal::to_seconds(window.latest_end - window.start)))
    return "would go on when Earth is no longer in view";
  if (more(seconds, window.heat_limit_s)) return "would overheat the radio";
  if (more(seconds * window.power_w, window.energy_limit_j))
    return "takes more than the energy limit of one downlink";
  return "";
}

double joules(const Window& window, double bytes) {
  return bytes == 0 || !(window.bytes_per_s > 0) ? 0 : bytes / window.bytes_per_s * window.power_w;
}

std::vector<double> loads(const Downlinks& downlinks, bool with_residual) {
  std::vector<double> out(downlinks.windows.size(), 0);
  for (const Product& product : downlinks.products) {
    if (!product.window || (!with_residual && product.tier == Tier::residual)) continue;
    out[*product.window] += static_cast<double>(product.bytes);
  }
  return out;
}

double sol_energy(const Downlinks& downlinks, const std::vector<double>& bytes, std::uint32_t sol) {
  double out = 0;
  for (std::size_t w = 0; w < bytes.size(); ++w) {
    if (downlinks.windows[w].sol == sol) out += joules(downlinks.windows[w], bytes[w]);
  }
  return out;
}

void check_limits(const Downlinks& downlinks, Faults& out) {
  const std::vector<double> bytes = loads(downlinks, true);
  for (std::size_t w = 0; w < bytes.size(); ++w) {
    const std::string what = breaks(downlinks.windows[w], bytes[w]);
    if (!what.empty())
      out.push_back("downlink '" + downlinks.windows[w].id + "' with " + number(bytes[w]) + " bytes " + what);
  }
  for (const auto& [sol, limit] : downlinks.sol_energy_j) {
    const double total = sol_energy(downlinks, bytes, sol);
    if (more(total, limit)) {
      out.push_back("the downlinks of sol " + std::to_string(sol) + " take " + number(total) + " J of the " +
                    number(limit) + " J that they may");
    }
  }
}

void check_tiers(const Downlinks& downlinks, Faults& out) {
  const std::vector<double> urgent = loads(downlinks, false);
  for (const Product& product : downlinks.products) {
    if (product.window && downlinks.windows[*product.window].start < product.created) {
      out.push_back(name(product) + " goes with '" + downlinks.windows[*product.window].id +
                    "', before it is created");
    }
    if (product.reported) continue;
    if (!product.window) out.push_back(name(product) + " is not sent, and nothing says why");
    if (product.tier != Tier::critical && product.tier != Tier::decisional) continue;
    for (std::size_t w = 0; product.window && w < *product.window; ++w) {
      if (downlinks.windows[w].under_way || downlinks.windows[w].start < product.created) continue;
      out.push_back(name(product) + " does not go with the first window after its creation, '" +
                    downlinks.windows[w].id + "', and nothing says why");
      break;
    }
  }
  for (const Product& product : downlinks.products) {
    if (product.window || product.tier == Tier::residual) continue;
    for (std::size_t w = 0; w < downlinks.windows.size(); ++w) {
      if (downlinks.windows[w].under_way || downlinks.windows[w].start < product.created) continue;
      std::vector<double> with = urgent;
      with[w] += static_cast<double>(product.bytes);
      const auto limit = downlinks.sol_energy_j.find(downlinks.windows[w].sol);
      const bool sol_allows = limit == downlinks.sol_energy_j.end() ||
                              !more(sol_energy(downlinks, with, limit->first), limit->second);
      if (!breaks(downlinks.windows[w], with[w]).empty() || !sol_allows) continue;
      out.push_back(name(product) + " is not sent although '" + downlinks.windows[w].id +
                    "' has room for it" +
                    (urgent == loads(downlinks, true) ? "" : " but for Residual products"));
      break;
    }
  }
}

// What planned steps will generate stands in the list as the network says, and has its downlink.
void check_sources(const Question& question, Faults& out) {
  const auto& products = question.downlinks.products;
  std::set<std::string> ids;
  for (const Product& product : products) {
    if (!ids.insert(product.id).second)
      out.push_back("product '" + product.id + "' stands in the downlinks twice");
  }
  for (const Block& block : question.plan) {
    for (const Step& step : block.steps) {
      if (end_of(question, step) <= question.now || step.due) continue;
      for (const model::Product& promised : question.network.tasks[step.task].products) {
        const auto count = std::ranges::count_if(products, [&](const Product& product) {
          return product.step == step.id && product.name == promised.name;
        });
        const std::string what = "'" + promised.name + "' of " + name(question, step);
        if (question.downlinks.generated.contains({step.id, promised.name})) {
          if (count != 0) out.push_back("product " + what + " is promised although it is there already");
          continue;
        }
        if (count != 1) {
          out.push_back("product " + what + " stands in the downlinks " + std::to_string(count) + " times");
          continue;
        }
        const Product& found = *std::ranges::find_if(products, [&](const Product& product) {
          return product.step == step.id && product.name == promised.name;
        });
        if (found.created != end_of(question, step))
          out.push_back("product " + what + " is not created when that ends");
        if (found.tier != promised.tier)
          out.push_back("product " + what + " has another tier than in the network");
        const double bytes = std::max(0.0, model::evaluate(promised.bytes, question.values));
        if (std::abs(static_cast<double>(found.bytes) - bytes) > 1)
          out.push_back("product " + what + " has another size than in the network");
        const bool may_be_left_out = step.committed || question.downlinks.kept.contains(step.id);
        if (!may_be_left_out && !found.window && found.tier != Tier::residual) {
          out.push_back(name(question, step) + " is planned although its product '" + promised.name +
                        "' is not sent");
        }
      }
    }
  }
}

}  // namespace

double parameter(const Question& question, const std::string& name, double otherwise) {
  const auto& all = question.network.parameters;
  const auto found = std::ranges::find(all, name, &model::Parameter::name);
  return found == all.end() ? otherwise : question.values[static_cast<std::size_t>(found - all.begin())];
}

std::int64_t sol_of(const Question& question, temporal::Time time) {
  const double sol_s = std::max(1.0, parameter(question, "sol_s", 86'400));
  return static_cast<std::int64_t>(temporal::to_seconds(time) / sol_s);
}

// What is not committed keeps the limits. A downlink of what has begun that takes more than one of them by itself goes
// on as long as the network says: no sol is better for it than another.
void check_sessions(const Question& question, Faults& out) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double of_one = parameter(question, "downlink_limit_j", kNone);
  const double of_sol = parameter(question, "sol_limit_j", kNone);
  if (parameter(question, "rate_bytes_per_s", 0) <= 0) return;
  std::map<std::int64_t, double> taken;
  std::map<std::int64_t, const Step*> judged;  // one of each sol
  const auto take = [&](const Step& step, bool is_new) {
    const model::Task& task = question.network.tasks[step.task];
    if (!task.downlinks) return;
    const double seconds = temporal::to_seconds(end_of(question, step) - step.start);
    const double joules = seconds * std::max(0.0, model::draw(question.network, task, question.values));
    const std::int64_t sol = sol_of(question, step.start);
    taken[sol] += joules;
    const bool longer = seconds > model::duration_s(task, question.values) + 1e-3;
    const bool goes_on = !is_new && !longer && (more(joules, of_one) || more(joules, of_sol));
    if (step.committed || goes_on) return;
    judged[sol] = &step;
    if (more(joules, of_one))
      out.push_back("downlink " + name(question, step) + " takes " + number(joules) + " J of the " +
                    number(of_one) + " J that one may");
  };
  for (const Block& block : question.plan) {
    const bool is_new = std::ranges::none_of(block.steps, [](const Step& step) { return step.committed; });
    for (const Step& step : block.steps) take(step, is_new);
  }
  for (const Step& step : question.rests) take(step, false);
  for (const Step& step : question.sent) take(step, false);
  for (const auto& [sol, step] : judged)
    if (more(taken[sol], of_sol))
      out.push_back("downlinks of sol " + std::to_string(sol) + ", " + name(question, *step) +
                    " among them, take " + number(taken[sol]) + " J of the " + number(of_sol) +
                    " J that they may");
}

void check_downlinks(const Question& question, Faults& out) {
  check_sources(question, out);
  check_limits(question.downlinks, out);
  check_tiers(question.downlinks, out);
}

}  // namespace roci::planner::utility_htn::checking
