#include "planner_svc/utility_htn/checking/check.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "planner_svc/utility_htn/checking/course.hpp"
#include "planner_svc/utility_htn/checking/parts.hpp"

namespace roci::planner::utility_htn::checking {

std::string number(double value) {
  std::ostringstream out;
  out.precision(9);
  out << value;
  return out.str();
}

std::string name(const Question& question, const Step& step) {
  return "task '" + question.network.tasks[step.task].id + "' at " + temporal::to_text(step.start);
}

bool within(double value, double lowest, double highest) {
  const double last_digits = 1e-6 + 1e-9 * std::abs(value);
  return value >= lowest - last_digits && value <= highest + last_digits;
}

bool in_range(const Question& question, Faults& out) {
  const std::size_t faults = out.size();
  const std::size_t tasks = question.network.tasks.size();
  std::set<std::uint64_t> ids;
  for (const Block& block : question.plan) {
    if (block.request >= tasks) out.push_back("a block is of a task that the network does not have");
    for (const Step& step : block.steps) {
      if (step.task >= tasks || !question.network.tasks[step.task].primitive()) {
        out.push_back("step " + std::to_string(step.id) + " is not a primitive task of the network");
      }
      if (!ids.insert(step.id).second) out.push_back("two steps have the number " + std::to_string(step.id));
    }
  }
  for (const Observation& observation : question.observations) {
    if (observation.timeline >= question.network.timelines.size())
      out.push_back("an observation is of a timeline that the network does not have");
  }
  for (const Product& product : question.downlinks.products) {
    if (product.window && *product.window >= question.downlinks.windows.size()) {
      out.push_back("product '" + product.id + "' goes with a window that is not there");
    }
  }
  return out.size() == faults;
}

void check_commitments(const Question& question, Faults& out) {
  for (const Block& block : question.before) {
    for (const Step& old : block.steps) {
      if (!old.committed || end_of(question, old) <= question.now) continue;
      const Step* found = nullptr;
      for (const Block& here : question.plan) {
        for (const Step& step : here.steps) {
          if (step.id == old.id) found = &step;
        }
      }
      const std::string who = "committed " + name(question, old);
      if (found == nullptr) {
        out.push_back(who + " is missing from the new version");
      } else if (found->task != old.task) {
        out.push_back(who + " has become another task");
      } else if (!found->committed) {
        out.push_back(who + " is no longer committed");
      } else if (found->start != old.start && old.start >= question.now) {
        out.push_back(who + " was moved to " + temporal::to_text(found->start));
      }
    }
  }
}

void check_budget(const Question& question, Faults& out) {
  double cost = 0;
  for (const Block& block : question.plan) {
    for (const Step& step : block.steps) {
      if (step.committed) continue;
      for (const model::Impact& impact : question.network.tasks[step.task].impacts) {
        if (impact.timeline != question.network.budget) continue;
        const double amount = model::evaluate(impact.amount, question.values);
        const bool during = impact.moment == temporal::ImpactWhen::during;
        if (impact.kind == temporal::ImpactKind::delta && !during) cost -= amount;
        if (impact.kind == temporal::ImpactKind::rate && impact.moment != temporal::ImpactWhen::at_end) {
          cost -= amount * temporal::to_seconds(end_of(question, step) - step.start);
        }
      }
    }
  }
  if (!within(cost, -std::numeric_limits<double>::infinity(), question.budget)) {
    out.push_back("the plan costs " + number(cost) + ", more than the " + number(question.budget) +
                  " that are left of the budget");
  }
}

std::vector<std::string> faults(const Question& question) {
  Faults out;
  if (!in_range(question, out)) return out;
  check_blocks(question, out);
  check_times(question, out);
  check_commitments(question, out);
  check_conditions(question, out);
  check_ranges(question, out);
  check_budget(question, out);
  check_sessions(question, out);
  if (question.downlinks_told) check_downlinks(question, out);
  check_subway_map(question, out);
  return out;
}

}  // namespace roci::planner::utility_htn::checking
