#include "planner_svc/utility_htn/delivery/delivery.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner_svc/utility_htn/delivery/first_fit.hpp"

namespace roci::planner::utility_htn::delivery {
namespace {

using model::DataProduct, model::Tier;
using temporal::RankVector, temporal::Time;

// The search asks for every candidate: a question that CBC cannot answer soon is answered with "no".
constexpr downlink::Effort kOfOneQuestion{.most_nodes = 50, .most_variables = 500};

// The Downlink Manager counts in whole steps of a millionth.
constexpr double kHighestScore = 1e6;

// A product that takes longer is sent by no downlink; its time shall not exceed what mission time can count.
constexpr double kLongestSending_s = 1e9;

double sending_s(const DataProduct& product, const downlink::Window& window) {
  return std::min(static_cast<double>(product.bytes) / window.bytes_per_s, kLongestSending_s);
}

// Sums of the same joules in another order differ in their last digits.
bool exceeds(double joules, double limit) { return joules > limit * (1 + 1e-9) + 1e-9; }

RankVector sane(const RankVector& utility) {
  std::vector<double> scores(utility.scores().begin(), utility.scores().end());
  for (double& score : scores) score = std::isfinite(score) ? std::clamp(score, 0.0, kHighestScore) : 0.0;
  return RankVector(scores);
}

// Several tasks of one kind in a chain generate products of one name.
void make_unique(std::vector<DataProduct>& products, std::set<std::string>& names) {
  for (DataProduct& product : products) {
    const std::string name = product.id;
    for (int copy = 2; !names.insert(product.id).second; ++copy)
      product.id = name + " " + std::to_string(copy);
  }
}

// Returns the indices of products in the order in which those of one downlink go.
std::vector<std::size_t> sending_order(const std::vector<DataProduct>& products) {
  std::vector<std::size_t> out(products.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::ranges::sort(out, [&](std::size_t a, std::size_t b) {
    const DataProduct& one = products[a];
    const DataProduct& other = products[b];
    if (one.tier != other.tier) return one.tier < other.tier;
    if (one.utility != other.utility) return one.utility > other.utility;
    if (one.created != other.created) return one.created < other.created;
    return one.id < other.id;
  });
  return out;
}

}  // namespace

// What waits or will be there, and the downlinks that are not over, in order of their starts.
struct Delivery::Question {
  std::vector<DataProduct> standing{};
  std::vector<DataProduct> candidates{};
  std::vector<downlink::Window> windows{};
  std::vector<search::PlannedDownlink> downlinks{};  // by window
  std::size_t existing = 0;                          // so many of `standing` exist, the first ones
  downlink::Limits limits{};
  // What the radio is just sending, by window: it goes whatever is planned, and its room is taken off the window.
  std::map<std::size_t, DataProduct> sending{};

  // Returns whether some window may not be used whole.
  bool limits_bind() const {
    std::map<std::uint32_t, double> joules;
    for (const downlink::Window& window : windows) {
      joules[window.sol] += Rules::joules(window);
      if (Rules::joules(window) > window.energy_limit_j) return true;
    }
    return std::ranges::any_of(limits.sol_energy_j,
                               [&](const auto& limit) { return joules[limit.first] > limit.second; });
  }
};

bool Delivery::hear(Existing product, Time now) {
  product.data.utility = sane(product.data.utility);
  const auto id = [](const Existing& existing) -> const std::string& { return existing.data.id; };
  const auto at = std::ranges::lower_bound(existing_, product.data.id, {}, id);
  const auto index = at - existing_.begin();
  if (at != existing_.end() && at->data.id == product.data.id) {
    if (product.request >= network_.tasks.size()) product.request = at->request;
    if (*at == product) return false;
    if (at->fate == Fate::stored && product.fate != Fate::stored) last_sent_ = std::max(last_sent_, now);
    *at = std::move(product);
  } else {
    if (product.fate == Fate::sent || product.fate == Fate::received) last_sent_ = std::max(last_sent_, now);
    existing_.insert(at, std::move(product));
    products_.insert(products_.begin() + index, assessor::ExistingProduct{});
  }
  const Existing& newest = existing_[static_cast<std::size_t>(index)];
  products_[static_cast<std::size_t>(index)] = {newest.data.id, newest.task, newest.request,
                                                newest.data.utility};
  return true;
}

void Delivery::replaced(const model::Network& before) {
  rules_ = Rules(network_);
  const auto same = [&](model::TaskIndex task) {
    if (task >= before.tasks.size()) return static_cast<model::TaskIndex>(network_.tasks.size());
    const auto found = std::ranges::find(network_.tasks, before.tasks[task].id, &model::Task::id);
    return static_cast<model::TaskIndex>(found - network_.tasks.begin());
  };
  for (std::size_t i = 0; i < existing_.size(); ++i) {
    products_[i].task = existing_[i].task = same(existing_[i].task);
    products_[i].request = existing_[i].request = same(existing_[i].request);
  }
}

void Delivery::executed(temporal::timelines::TaskId activity, model::TaskIndex task, Time start, Time end,
                        const model::Values& values) {
  if (!rules_.has_rate() || !network_.tasks[task].downlinks) return;
  const downlink::Window window = rules_.window({task, start, end}, values);
  const Spent here{window.sol, Rules::joules(window)};
  if (executed_.emplace(activity, here).second) spent_[here.sol] += here.joules;
}

std::map<std::uint32_t, double> Delivery::spent(
    const std::function<bool(temporal::timelines::TaskId)>& told, Time now, const model::Values& values) const {
  if (!rules_.has_rate() || !std::isfinite(rules_.sol_limit_j(values))) return {};
  std::map<std::uint32_t, double> out = spent_;
  for (const auto& [activity, here] : executed_)
    if (told(activity)) out[here.sol] -= here.joules;
  std::erase_if(out, [&](const auto& one) { return one.first < sol_of(now, values) || one.second <= 0; });
  return out;
}

void Delivery::resume(const std::map<std::uint32_t, double>& spent) {
  for (const auto& [sol, joules] : spent) spent_[sol] += joules;
}

namespace {

bool waits_for_downlink(const Existing& one) {
  return one.fate == Fate::stored && one.data.tier != model::Tier::residual;
}

}  // namespace

temporal::Duration Delivery::transmission(const std::set<model::TaskIndex>& requests,
                                          const model::Values& values, temporal::Duration longest) const {
  const double rate = rules_.bytes_per_s(values);
  if (rate <= 0) return temporal::Duration{0};
  std::vector<DataProduct> waiting;
  for (const Existing& one : existing_)
    if (waits_for_downlink(one) && requests.contains(one.request)) waiting.push_back(one.data);
  const double most_s = std::min(temporal::to_seconds(longest), kLongestSending_s);
  double bytes = 0, taken_s = 0;
  for (const std::size_t p : sending_order(waiting)) {
    const double with_it = bytes + static_cast<double>(waiting[p].bytes);
    const double takes_s = std::ceil(with_it / rate);
    if (takes_s > most_s) continue;
    bytes = with_it;
    taken_s = takes_s;
  }
  return temporal::seconds(taken_s);
}

std::set<model::TaskIndex> Delivery::requests_with_data() const {
  std::set<model::TaskIndex> out;
  for (const Existing& one : existing_)
    if (waits_for_downlink(one)) out.insert(one.request);
  return out;
}

// Returns the joules that a downlink that starts then may take.
double Delivery::left_for(Time start, std::span<const search::PlannedDownlink> others,
                          const model::Values& values) const {
  const std::uint32_t sol = rules_.sol_of(start, values);
  double left = rules_.sol_limit_j(values) - spent_in(sol);
  for (const search::PlannedDownlink& other : others)
    if (const downlink::Window window = rules_.window(other, values); window.sol == sol)
      left -= Rules::joules(window);
  return std::max(0.0, std::min(left, rules_.downlink_limit_j(values)));
}

temporal::Duration Delivery::longest(model::TaskIndex task, Time start,
                                     std::span<const search::PlannedDownlink> others,
                                     const model::Values& values) const {
  return lasting(task, left_for(start, others, values), values);
}

// Returns the joules that a downlink may take that is the only one of its sol.
double Delivery::limit_alone_j(const model::Values& values) const {
  return std::min(rules_.sol_limit_j(values), rules_.downlink_limit_j(values));
}

temporal::Duration Delivery::longest_alone(model::TaskIndex task, const model::Values& values) const {
  return lasting(task, limit_alone_j(values), values);
}

temporal::Duration Delivery::lasting(model::TaskIndex task, double joules,
                                     const model::Values& values) const {
  const double power = model::draw(network_, network_.tasks[task], values);
  if (power <= 0 || !std::isfinite(joules)) return temporal::no_bound;
  return temporal::seconds(std::floor(joules / power));
}

bool Delivery::permits(model::TaskIndex task, Time start, temporal::Duration length,
                       std::span<const search::PlannedDownlink> others, const model::Values& values) const {
  return !exceeds(Rules::joules(rules_.window({task, start, start + length}, values)),
                  left_for(start, others, values));
}

bool Delivery::permits_alone(model::TaskIndex task, temporal::Duration length,
                             const model::Values& values) const {
  return !exceeds(Rules::joules(rules_.window({task, Time{0}, length}, values)), limit_alone_j(values));
}

std::set<std::uint32_t> Delivery::overdrawn_sols(std::span<const search::PlannedDownlink> downlinks,
                                                 const model::Values& values) const {
  std::set<std::uint32_t> out;
  const double limit = rules_.sol_limit_j(values);
  if (!rules_.has_rate() || !std::isfinite(limit)) return out;
  std::map<std::uint32_t, double> joules;
  for (const search::PlannedDownlink& one : downlinks) {
    const downlink::Window window = rules_.window(one, values);
    joules[window.sol] += Rules::joules(window);
  }
  for (const auto& [sol, sum] : joules)
    if (exceeds(sum + spent_in(sol), limit)) out.insert(sol);
  return out;
}

RankVector Delivery::received() const {
  RankVector out;
  for (const Existing& product : existing_)
    if (product.fate == Fate::received) out += product.data.utility;
  return out;
}

void Delivery::join(search::Problem& problem, Time now) {
  problem.products = products_;
  if (!rules_.has_rate()) return;
  problem.downlink = [this, &values = problem.values, now](const search::PlannedData& planned) {
    return admits(planned, values, now);
  };
  problem.later = [this, &values = problem.values](const search::PlannedData& planned) {
    return next_sol(planned, values);
  };
}

Delivery::Question Delivery::question(const search::PlannedData& planned, const model::Values& values,
                                      Time now) const {
  Question out;
  for (const Existing& product : existing_)
    if (product.fate == Fate::stored) out.standing.push_back(product.data);
  out.existing = out.standing.size();
  // What was to be generated by now either was, and was heard, or never will be.
  for (std::size_t i = 0; i < planned.products.size(); ++i) {
    if (planned.products[i].created <= now) continue;
    (i < planned.committed_products ? out.standing : out.candidates).push_back(planned.products[i]);
  }
  std::ranges::copy_if(planned.downlinks, std::back_inserter(out.downlinks),
                       [&](const search::PlannedDownlink& one) { return one.end > now; });
  std::ranges::stable_sort(out.downlinks, {}, &search::PlannedDownlink::start);
  for (const search::PlannedDownlink& one : out.downlinks) {
    downlink::Window& window = out.windows.emplace_back(rules_.window(one, values));
    window.id = network_.tasks[one.task].id;
    if (one.start >= now) continue;
    // One that runs has only what is left of its time: the product that it is sending it began with
    // when the last one was sent.
    const double before = Rules::joules(window);
    window.start = std::clamp(last_sent_, window.start, window.latest_end);
    window.energy_limit_j = std::max(0.0, window.energy_limit_j - (before - Rules::joules(window)));
  }
  const double limit = rules_.sol_limit_j(values);
  keep_what_is_sent(out, now);
  if (std::isfinite(limit)) {
    for (const downlink::Window& window : out.windows)
      out.limits.sol_energy_j[window.sol] = std::max(0.0, limit - spent_in(window.sol));
  }
  return out;
}

// The radio does not break off what it has begun. If it takes longer than what is left,
// other data must not have that room.
void Delivery::keep_what_is_sent(Question& question, Time now) const {
  for (std::size_t w = 0; w < question.windows.size(); ++w) {
    const search::PlannedDownlink& running = question.downlinks[w];
    if (running.start >= now) continue;
    const auto told = told_.find(running.id);
    const std::vector<std::string> order =
        told != told_.end() ? told->second : sent_by(running, question, question.windows[w]);
    const auto exists = question.standing.begin() + static_cast<std::ptrdiff_t>(question.existing);
    for (const std::string& id : order) {
      const auto found = std::find_if(question.standing.begin(), exists,
                                      [&](const DataProduct& one) { return one.id == id; });
      if (found == exists) continue;
      downlink::Window& window = question.windows[w];
      const double before = Rules::joules(window);
      const double takes_s = sending_s(*found, window);
      window.latest_end = std::max(window.start, window.latest_end - temporal::seconds(takes_s));
      window.energy_limit_j = std::max(0.0, window.energy_limit_j - (before - Rules::joules(window)));
      question.sending.emplace(w, std::move(*found));
      question.standing.erase(found);
      --question.existing;
      break;
    }
  }
}

// What a schedule that another planner has told lets a downlink send that runs, as far as it is known.
// It goes on whoever plans.
std::vector<std::string> Delivery::sent_by(const search::PlannedDownlink& downlink, const Question& question,
                                           const downlink::Window& left) const {
  std::vector<std::string> out;
  if (has_told_) return out;
  const double room = temporal::to_seconds(downlink.end - downlink.start) * left.bytes_per_s;
  const std::vector<DataProduct> exist(
      question.standing.begin(), question.standing.begin() + static_cast<std::ptrdiff_t>(question.existing));
  for (const std::size_t p : sending_order(exist))
    if (static_cast<double>(exist[p].bytes) <= room && exist[p].created <= left.start)
      out.push_back(exist[p].id);
  return out;
}

// Returns the joules of what was executed in a sol.
double Delivery::spent_in(std::uint32_t sol) const {
  const auto spent = spent_.find(sol);
  return spent == spent_.end() ? 0.0 : spent->second;
}

// A limit that is broken already, since it was lowered, only refuses what would add to it.
bool Delivery::keeps_limits(const search::PlannedData& planned, const model::Values& values) const {
  const double one = rules_.downlink_limit_j(values);
  const double all = rules_.sol_limit_j(values);
  if (!std::isfinite(one) && !std::isfinite(all)) return true;
  std::map<std::uint32_t, double> joules;
  std::set<std::uint32_t> added;
  for (std::size_t i = 0; i < planned.downlinks.size(); ++i) {
    const downlink::Window window = rules_.window(planned.downlinks[i], values);
    joules[window.sol] += Rules::joules(window);
    if (i < planned.committed_downlinks) continue;
    if (Rules::joules(window) > one) return false;
    added.insert(window.sol);
  }
  return std::ranges::all_of(added, [&](std::uint32_t sol) { return joules[sol] + spent_in(sol) <= all; });
}

std::optional<Time> Delivery::next_sol(const search::PlannedData& planned,
                                       const model::Values& values) const {
  const std::set<std::uint32_t> overdrawn = overdrawn_sols(planned.downlinks, values);
  std::optional<std::uint32_t> first;
  for (std::size_t i = planned.committed_downlinks; i < planned.downlinks.size(); ++i) {
    const downlink::Window window = rules_.window(planned.downlinks[i], values);
    if (Rules::joules(window) > window.energy_limit_j) return std::nullopt;
    if (overdrawn.contains(window.sol)) first = std::min(first.value_or(window.sol), window.sol);
  }
  return first ? std::optional(rules_.end_of_sol(*first, values)) : std::nullopt;
}

bool Delivery::admits(const search::PlannedData& planned, const model::Values& values, Time now) {
  if (!keeps_limits(planned, values)) {
    ++counts_.limits;
    return false;
  }
  Question asked = question(planned, values, now);
  if (asked.candidates.empty()) {
    ++counts_.nothing_to_send;
    return true;
  }
  const bool only_residual = std::ranges::all_of(
      asked.candidates, [](const DataProduct& product) { return product.tier == Tier::residual; });
  if (!only_residual && !asked.limits_bind() && first_fit(asked.standing, asked.candidates, asked.windows)) {
    ++counts_.first_fit;
    return true;
  }
  std::set<std::string> names;
  make_unique(asked.standing, names);
  make_unique(asked.candidates, names);
  downlink::Manager manager(kOfOneQuestion);
  const bool admitted = manager.admits(asked.standing, asked.windows, asked.limits, asked.candidates);
  counts_.manager.certificate += manager.counts().certificate;
  counts_.manager.solver += manager.counts().solver;
  counts_.manager.open += manager.counts().open;
  return admitted;
}

Schedule Delivery::schedule(const search::PlannedData& planned, const model::Values& values, Time now) const {
  Schedule out;
  if (!rules_.has_rate()) return out;
  Question asked = question(planned, values, now);
  std::vector<DataProduct> all = std::move(asked.standing);
  std::ranges::move(asked.candidates, std::back_inserter(all));
  std::set<std::string> names;
  make_unique(all, names);
  for (std::size_t p = 0; p < all.size(); ++p)
    out.products[all[p].id] = {p < asked.existing, all[p].bytes, all[p].tier};
  const downlink::Assignment found = downlink::Manager().assign(all, asked.windows, asked.limits);
  const std::vector<std::size_t> order = sending_order(all);
  for (std::size_t w = 0; w < asked.windows.size(); ++w) {
    const search::PlannedDownlink& planned_one = asked.downlinks[w];
    const downlink::Load& load = found.loads[w];
    Downlink& added = out.downlinks.emplace_back(Downlink{planned_one.task,
                                                          planned_one.start,
                                                          planned_one.end,
                                                          load.bytes,
                                                          load.duration,
                                                          load.energy_j,
                                                          {},
                                                          planned_one.id});
    if (const auto sending = asked.sending.find(w); sending != asked.sending.end()) {
      const DataProduct& product = sending->second;
      const double takes_s = sending_s(product, asked.windows[w]);
      added.bytes += product.bytes;
      added.takes += temporal::seconds(takes_s);
      added.energy_j += takes_s * asked.windows[w].power_w;
      added.products.push_back(product.id);
      out.products[product.id] = {true, product.bytes, product.tier};
    }
    for (const std::size_t p : order)
      if (found.window[p] == w) added.products.push_back(all[p].id);
  }
  for (const downlink::LeftOut& one : found.left_out) out.left_out.push_back({all[one.product].id, one.why});
  for (const downlink::Late& one : found.late) out.late.push_back({all[one.product].id, one.why});
  return out;
}

}  // namespace roci::planner::utility_htn::delivery
