#include "planner_svc/utility_htn/checking/schedule_checker.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/checking/course.hpp"
#include "planner_svc/utility_htn/checking/parts.hpp"
#include "planner_svc/utility_htn/checking/version.hpp"

namespace roci::planner::utility_htn::checking {

namespace {

// Takes one schedule apart for check_downlinks(), and tells what does not even fit the plan.
class Reading {
 public:
  // With `plan_is_new`, the plan was told in the same step; what has happened since may have moved an older one.
  // What is committed stays in the plan as it was told, wherever it is expected now.
  Reading(Question& question, const std::map<std::string, engine::DataProduct>& on_board, bool plan_is_new,
          Faults& out)
      : question_(question), on_board_(on_board), plan_is_new_(plan_is_new), out_(out) {
    for (const Block& block : question.plan)
      for (const Step& step : block.steps) add(block.request, step);
  }

  // What has begun of a chain that was broken off still generates and sends.
  void add(model::TaskIndex request, const Step& step) {
    const model::Task& task = question_.network.tasks[step.task];
    if (task.downlinks) downlinks_[step.id] = &step;
    if (end_of(question_, step) <= question_.now && !step.due) return;
    for (const model::Product& product : task.products)
      promised_[question_.network.tasks[request].id + "/" + task.id + "/" + product.name].push_back(
          {&step, product.name});
  }

  void read(const engine::DownlinkSchedule& schedule) {
    for (const engine::ScheduledDownlink& one : schedule.downlinks) read(one);
    for (const engine::UnsentProduct& one : schedule.left_out) {
      if (one.why.empty()) out_.push_back("product '" + one.data.id + "' is left out without a reason");
      read(one.data, std::nullopt).reported = true;
    }
    for (const engine::UnsentProduct& one : schedule.late) {
      const auto late = std::ranges::find(question_.downlinks.products, one.data.id, &Product::id);
      if (late == question_.downlinks.products.end())
        out_.push_back("product '" + one.data.id + "' is late, but goes with no downlink");
      else
        late->reported = true;
    }
    for (const auto& [id, product] : on_board_)
      if (std::ranges::find(question_.downlinks.products, id, &Product::id) ==
          question_.downlinks.products.end())
        out_.push_back("product '" + id + "' waits on board and stands nowhere");
    for (const auto& [id, step] : downlinks_)
      if (!told_.contains(id) && !step->due && step->start > question_.now)
        out_.push_back("downlink " + name(question_, *step) + " is planned and not in the schedule");
  }

 private:
  void read(const engine::ScheduledDownlink& told) {
    const auto id = step_named(told.activity);
    const auto found = id ? downlinks_.find(*id) : downlinks_.end();
    if (found == downlinks_.end()) {
      out_.push_back("'" + told.activity + "' is no downlink of the plan");
      return;
    }
    const Step& step = *found->second;
    told_.insert(step.id);
    const bool waits = step.start > question_.now && !step.due;
    const bool moved = told.start != step.start || told.end != end_of(question_, step);
    if (moved && waits && plan_is_new_ && !step.committed)
      out_.push_back("downlink '" + told.activity + "' has other times than in the plan");
    const auto w = static_cast<std::uint32_t>(question_.downlinks.windows.size());
    Window& window = question_.downlinks.windows.emplace_back();
    window.id = told.activity;
    window.under_way = told.start < question_.now;
    window.start = std::max(told.start, question_.now);
    window.latest_end = window.start + (told.end - told.start);
    window.bytes_per_s = parameter(question_, "rate_bytes_per_s", 0);
    const model::Task& task = question_.network.tasks[step.task];
    window.power_w = std::max(0.0, model::draw(question_.network, task, question_.values));
    window.energy_limit_j = parameter(question_, "downlink_limit_j", window.energy_limit_j);
    window.sol = static_cast<std::uint32_t>(sol_of(question_, told.start));
    std::uint64_t bytes = 0;
    for (const engine::ScheduledProduct& product : told.products) {
      read(product, w);
      bytes += product.bytes;
    }
    if (bytes != told.bytes)
      out_.push_back("downlink '" + told.activity + "' is told to carry " + std::to_string(told.bytes) +
                     " bytes, and its products have " + std::to_string(bytes));
    // The first one may be what the radio is just sending.
    const auto behind = told.products.begin() + (window.under_way && !told.products.empty() ? 1 : 0);
    if (!std::ranges::is_sorted(behind, told.products.end(), {}, &engine::ScheduledProduct::tier))
      out_.push_back("downlink '" + told.activity + "' does not send tiers in their order");
  }

  Product& read(const engine::ScheduledProduct& told, std::optional<std::uint32_t> window) {
    Product& product = question_.downlinks.products.emplace_back();
    product.id = told.id;
    product.tier = static_cast<model::Tier>(told.tier);
    product.bytes = told.bytes;
    product.window = window;
    told.exists ? read_existing(told, product) : read_promised(told, product);
    return product;
  }

  void read_existing(const engine::ScheduledProduct& told, Product& product) {
    const auto known = on_board_.find(told.id);
    if (known == on_board_.end()) {
      out_.push_back("product '" + told.id + "' is said to exist, and does not wait on board");
      product.created = question_.now;
      return;
    }
    product.created = std::min(known->second.created, question_.now);
    if (known->second.bytes != told.bytes || known->second.tier != told.tier)
      out_.push_back("product '" + told.id + "' has another size or tier than its owner says");
  }

  // Products of one name stand in the schedule with numbers; which is whose does not matter.
  void read_promised(const engine::ScheduledProduct& told, Product& product) {
    const auto blank = told.id.rfind(' ');
    auto found = promised_.find(told.id);
    if (found == promised_.end() && blank != std::string::npos) found = promised_.find(told.id.substr(0, blank));
    if (found == promised_.end() || found->second.empty()) {
      out_.push_back("product '" + told.id + "' is promised by nothing in the plan");
      product.created = question_.now;
      return;
    }
    const Promise promise = found->second.front();
    found->second.erase(found->second.begin());
    product.step = promise.step->id;
    product.name = promise.name;
    product.created = end_of(question_, *promise.step);
    if (!promise.step->due) return;
    // Of what is late the engine alone knows when it expects the end.
    product.created = product.window ? std::max(product.created, question_.downlinks.windows[*product.window].start)
                                     : temporal::no_bound;
  }

  struct Promise {
    const Step* step;
    std::string name;
  };

  Question& question_;
  const std::map<std::string, engine::DataProduct>& on_board_;
  bool plan_is_new_;
  Faults& out_;
  std::map<std::uint64_t, const Step*> downlinks_;         // of the plan
  std::map<std::string, std::vector<Promise>> promised_;   // in the order of the plan, by id in a schedule
  std::set<std::uint64_t> told_;
};

// Numbers of broken chains and their requests stand in one order.
model::TaskIndex request_of(const Version& version, const Step& step) {
  const auto number = static_cast<std::uint32_t>(step.id >> 32U);
  const auto at = std::distance(version.broken.begin(), version.broken.find(number));
  return version.broken_off[static_cast<std::size_t>(at)];
}

}  // namespace

std::vector<std::string> ScheduleChecker::faults(const model::Network& network,
                                                 const engine::StepInputs& inputs,
                                                 const engine::StepOutput& output) {
  hear(inputs);
  Faults out;
  std::set<std::uint64_t> kept;
  for (const temporal::PlanActivity& activity : plan_.activities)
    if (const auto step = step_named(activity.id)) kept.insert(*step);
  if (output.delta) {
    const temporal::FlexiblePlan* const from = history_.version(output.delta->from_version);
    temporal::FlexiblePlan next = from != nullptr ? *from : temporal::FlexiblePlan{};
    if (std::string fault = temporal::apply(*output.delta, next); !fault.empty()) return {fault};
    plan_ = next;
    history_.keep(std::move(next));
  }
  if (output.schedule) schedule_ = output.schedule;
  if ((!output.delta && !output.schedule) || !schedule_ || !schedule_->limited) return {};
  ++checked_;
  Version version = version_of(network, plan_, &progress_, inputs.now);
  if (!version.faults.empty()) return version.faults;
  Question question{.network = network, .values = version.values, .plan = std::move(version.blocks)};
  question.now = inputs.now;
  question.downlinks.generated = generated_;
  question.downlinks.kept = std::move(kept);
  if (const double limit = parameter(question, "sol_limit_j", -1); limit >= 0)
    for (const engine::ScheduledDownlink& one : schedule_->downlinks)
      question.downlinks.sol_energy_j[static_cast<std::uint32_t>(sol_of(question, one.start))] = limit;
  Reading reading(question, on_board_, output.delta.has_value(), out);
  for (const Step& step : version.rests) reading.add(request_of(version, step), step);
  reading.read(*schedule_);
  check_downlinks(question, out);
  return out;
}

void ScheduleChecker::hear(const engine::StepInputs& inputs) {
  if (inputs.executed) {
    plan_ = *inputs.executed;
    history_.keep(plan_);
  }
  for (const engine::StepStatus& step : inputs.steps) progress_[step.activity] = step.progress;
  for (const engine::DataProduct& product : inputs.products) {
    if (const auto step = step_named(product.source)) generated_.emplace(*step, product.kind);
    if (product.fate == engine::DataFate::stored)
      on_board_[product.id] = product;
    else
      on_board_.erase(product.id);
  }
}

}  // namespace roci::planner::utility_htn::checking
