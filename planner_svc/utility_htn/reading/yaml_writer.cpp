#include <map>
#include <string>
#include <string_view>

#include "planner_svc/utility_htn/model/describe.hpp"
#include "planner_svc/utility_htn/reading/yaml.hpp"

namespace roci::planner::utility_htn::reading {

using model::Network, model::Task;
using temporal::ImpactKind, temporal::ImpactWhen;
using temporal::timelines::Constraint, temporal::timelines::Definition, temporal::timelines::Kind,
    temporal::timelines::Phase;

namespace {

// In quotes, with braces doubled, since a single one stands for a word.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '{' || c == '}') out += c;
    out += c;
  }
  return out + "\"";
}

std::string seconds(temporal::Duration duration) {
  if (!temporal::bounded(duration)) return "none";
  const std::int64_t micro = duration.count() % 1'000'000;
  std::string out = std::to_string(duration.count() / 1'000'000);
  if (micro == 0) return out;
  std::string digits = std::to_string(micro < 0 ? -micro : micro);
  digits.insert(0, 6 - digits.size(), '0');
  return (duration.count() < 0 && out == "0" ? "-0" : out) + "." + digits;
}

class YamlWriter {
 public:
  explicit YamlWriter(const Network& network) : network_(network) {}

  std::string take() {
    out_ = "format: " + std::to_string(kYamlFormat) + "\nnetwork: " + in_quotes(network_.name) +
           "\nversion: " + std::to_string(network_.version) + "\n";
    out_ += "ranks: " + names(network_.ranks) + "\n";
    if (!network_.batches.empty()) out_ += "batches: " + names(network_.batches) + "\n";
    out_ += "budget: " + in_quotes(network_.timelines.at(network_.budget).name) + "\n";
    out_ += "exploration_bound: " + std::to_string(network_.exploration_bound) + "\n";
    cycle();
    if (!network_.parameters.empty()) out_ += "parameters:\n";
    for (const model::Parameter& parameter : network_.parameters)
      line(1, in_quotes(parameter.name) + ": {value: " + model::to_text(parameter.prior) + ", range: [" +
                  model::to_text(parameter.lowest) + ", " + model::to_text(parameter.highest) +
                  "], source: " + in_quotes(parameter.source) + "}");
    out_ += "timelines:\n";
    for (const Definition& timeline : network_.timelines) define(timeline);
    out_ += "tasks:\n";
    for (const Task& task : network_.tasks) define(task);
    subway();
    return std::move(out_);
  }

 private:
  void line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(depth) * 2, ' ') + text + "\n";
  }

  static std::string names(const std::vector<std::string>& all) {
    std::string out = "[";
    for (const std::string& name : all) out += (out.size() == 1 ? "" : ", ") + in_quotes(name);
    return out + "]";
  }

  std::string amount(const model::Amount& amount) const {
    return in_quotes(model::to_text(amount, network_));
  }

  std::string constraints(const std::vector<Constraint>& all) const {
    std::string out = "[";
    for (const Constraint& one : all)
      out += (out.size() == 1 ? "" : ", ") + in_quotes(to_text(one, network_));
    return out + "]";
  }

  void cycle() {
    const model::CycleWindows& cycle = network_.cycle;
    out_ += "cycle: {process_interval_s: " + seconds(cycle.process_interval) +
            ", worst_cycle_s: " + seconds(cycle.worst_cycle) +
            ", commit_window_s: " + seconds(cycle.commit_window) +
            ", scheduling_window_s: " + seconds(cycle.scheduling_window) +
            ", plan_end_s: " + seconds(cycle.plan_end) + "}\n";
  }

  void define(const Definition& timeline) {
    std::string out = in_quotes(timeline.name) + ": {kind: " + std::string(model::to_text(timeline.kind));
    if (timeline.kind == Kind::state) {
      out += ", states: " + names(timeline.states) +
             ", initial: " + in_quotes(timeline.states.at(static_cast<std::size_t>(timeline.initial)));
    } else {
      out += ", initial: " + model::to_text(timeline.initial) + ", range: [" +
             model::to_text(timeline.lowest) + ", " + model::to_text(timeline.highest) + "]";
    }
    line(1, out + ", reported: " + (timeline.reported ? "true" : "false") + "}");
  }

  static std::string command(const temporal::PlanCommand& command) {
    std::string out = "{owner: " + in_quotes(command.owner) + ", command: " + in_quotes(command.command_name);
    if (!command.robot.empty()) out += ", robot: " + in_quotes(command.robot);
    if (!command.subsystem.empty()) out += ", component: " + in_quotes(command.subsystem);
    if (!command.arguments.empty()) {
      out += ", arguments: {";
      for (const temporal::Property& argument : command.arguments)
        out += (out.ends_with('{') ? "" : ", ") + in_quotes(argument.name) + ": " + in_quotes(argument.value);
      out += "}";
    }
    if (command.answer_within != temporal::no_bound)
      out += ", answer_within_s: " + seconds(command.answer_within);
    return out + "}";
  }

  std::string effect(const model::Impact& impact) const {
    const Definition& timeline = network_.timelines.at(impact.timeline);
    const bool set = impact.kind == ImpactKind::assign;
    std::string value = amount(impact.amount);
    if (set && timeline.kind == Kind::state)
      value = in_quotes(timeline.states.at(static_cast<std::size_t>(impact.amount.constant)));
    return "{timeline: " + in_quotes(timeline.name) +
           (set                               ? ", set: "
            : impact.kind == ImpactKind::rate ? ", rate: "
                                              : ", add: ") +
           value +
           (impact.moment == ImpactWhen::at_start ? ", at: start}"
            : impact.moment == ImpactWhen::at_end ? ", at: end}"
                                                  : ", at: during}");
  }

  void define(const Task& task) {
    line(1, in_quotes(task.id) + ":");
    line(2, "name: " + in_quotes(task.name));
    if (task.is_template) line(2, "template: true");
    if (task.priority != 0) line(2, "priority: " + std::to_string(task.priority));
    if (!network_.batches.empty()) line(2, "batch: " + in_quotes(network_.batches.at(task.batch)));
    if (temporal::bounded(task.preferred_start)) line(2, "start_s: " + seconds(task.preferred_start));
    if (task.fixed) line(2, "fixed: true");
    if (task.opens != temporal::Time{0} || task.closes != temporal::no_bound)
      line(2, "window_s: [" + seconds(task.opens) + ", " + seconds(task.closes) + "]");
    if (task.primitive()) {
      primitive(task);
    } else {
      decompositions(task);
    }
  }

  void primitive(const Task& task) {
    if (!task.commands.empty()) line(2, "commands:");
    for (const temporal::PlanCommand& one : task.commands) line(3, "- " + command(one));
    line(2, "duration_s: " + amount(task.duration));
    for (const auto& [key, phase] :
         {std::pair{"pre", Phase::pre}, std::pair{"maintenance", Phase::maintenance},
          std::pair{"post", Phase::post}}) {
      std::vector<Constraint> those;
      for (const Constraint& one : task.constraints)
        if (one.phase == phase) those.push_back(one);
      if (!those.empty()) line(2, std::string(key) + ": " + constraints(those));
    }
    if (!task.impacts.empty()) line(2, "impacts:");
    for (const model::Impact& impact : task.impacts) line(3, "- " + effect(impact));
    control(task.control);
    failure(task);
    std::string scores;
    for (std::size_t rank = 0; rank < task.utility.size(); ++rank)
      scores += (scores.empty() ? "" : ", ") + in_quotes(network_.ranks.at(rank)) + ": " +
                amount(task.utility[rank]);
    if (!scores.empty()) line(2, "utility: {" + scores + "}");
    products(task);
    if (task.downlinks) line(2, "downlinks: true");
    learns(task);
  }

  void control(const model::Control& control) {
    if (control == model::Control{}) return;
    std::string out = "control: {wait_s: " + seconds(control.wait_timeout) +
                      ", answer_within_s: " + seconds(control.answer_within) +
                      ", retries: " + std::to_string(control.retries);
    if (control.may_skip) out += ", may_skip: true";
    if (!control.skip_if.empty()) out += ", skip_if: " + constraints(control.skip_if);
    line(2, out + "}");
  }

  std::string tasks(const std::vector<model::TaskIndex>& all) const {
    std::vector<std::string> ids;
    for (const model::TaskIndex index : all) ids.push_back(network_.tasks.at(index).id);
    return names(ids);
  }

  void failure(const Task& task) {
    if (!task.response && !task.contingency) return;
    line(2, "on_failure:");
    if (task.response) line(3, "respond: " + command(*task.response));
    if (!task.contingency) return;
    line(3, "request: " + tasks(task.contingency->requests));
    line(3, "withdraw: " + tasks(task.contingency->withdraws));
  }

  void products(const Task& task) {
    if (!task.products.empty()) line(2, "products:");
    for (const model::Product& product : task.products) {
      std::string scores;
      for (std::size_t rank = 0; rank < product.utility.scores().size(); ++rank)
        scores += (scores.empty() ? "" : ", ") + in_quotes(network_.ranks.at(rank)) + ": " +
                  model::to_text(product.utility[rank]);
      line(3, in_quotes(product.name) + ": {tier: " + std::string(model::to_text(product.tier)) +
                  ", bytes: " + amount(product.bytes) + ", utility: {" + scores + "}}");
    }
  }

  void learns(const Task& task) {
    std::string out;
    for (const model::Measure measure :
         {model::Measure::duration_s, model::Measure::energy, model::Measure::power}) {
      std::vector<std::string> names_of;
      for (const model::Learns& one : task.learns)
        if (one.measure == measure) names_of.push_back(network_.parameters.at(one.parameter).name);
      if (!names_of.empty())
        out += (out.empty() ? "" : ", ") + std::string(model::to_text(measure)) + ": " + names(names_of);
    }
    if (const std::string values = learned_values(task); !values.empty())
      out += (out.empty() ? "" : ", ") + std::string(model::to_text(model::Measure::value)) + ": {" + values +
             "}";
    if (!out.empty()) line(2, "learns: {" + out + "}");
  }

  std::string learned_values(const Task& task) const {
    std::map<std::string, std::vector<std::string>> parameters;  // by result
    for (const model::Learns& one : task.learns)
      if (one.measure == model::Measure::value)
        parameters[one.result].push_back(network_.parameters.at(one.parameter).name);
    std::string out;
    for (const auto& [result, names_of] : parameters)
      out += (out.empty() ? "" : ", ") + in_quotes(result) + ": " + names(names_of);
    return out;
  }

  void decompositions(const Task& task) {
    line(2, "decompositions:");
    for (const model::Decomposition& decomposition : task.decompositions) {
      line(3, in_quotes(decomposition.name) + ":");
      if (!decomposition.when.empty()) line(4, "when: " + constraints(decomposition.when));
      line(4, "sequence:");
      for (const model::Subtask& subtask : decomposition.subtasks)
        line(5, "- {task: " + in_quotes(network_.tasks.at(subtask.task).id) + ", after_s: " +
                    seconds(subtask.shortest_gap) + ", within_s: " + seconds(subtask.longest_gap) + "}");
    }
  }

  void subway() {
    const model::SubwayMap& map = network_.subway;
    if (map == model::SubwayMap{}) return;
    out_ += "subway:\n";
    line(1, "most_samples: " + std::to_string(map.most_samples));
    line(1, "rank: " + in_quotes(network_.ranks.at(map.rank)));
    line(1, map.sites.empty() ? "sites: {}" : "sites:");
    for (const model::Site& site : map.sites) {
      line(2, in_quotes(site.name) + ":");
      line(3, "value: " + amount(site.value));
      line(3, "targets:");
      for (const model::Target& target : site.targets)
        line(4, "- {task: " + in_quotes(network_.tasks.at(target.task).id) +
                    ", signature: " + in_quotes(network_.timelines.at(target.signature).name) +
                    ", visual: " + amount(target.visual) + "}");
    }
  }

  const Network& network_;
  std::string out_;
};

}  // namespace

std::string to_yaml(const Network& network) { return YamlWriter(network).take(); }

}  // namespace roci::planner::utility_htn::reading
