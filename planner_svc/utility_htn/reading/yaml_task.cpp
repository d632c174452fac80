#include "planner_svc/utility_htn/reading/yaml_task.hpp"

#include <array>
#include <limits>

#include "core/words/nearest_word.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::reading {

using model::Amount, model::Decomposition, model::Impact, model::Measure, model::Task, model::Tier;
using temporal::ImpactKind, temporal::ImpactWhen, temporal::PlanCommand;
using temporal::timelines::Kind, temporal::timelines::Phase;

namespace {

template <typename Word>
Word word_of(const Source& source, const std::vector<Word>& all) {
  const std::string text = source.text();
  std::string listed;
  std::vector<std::string> known;
  for (const Word word : all) {
    if (model::to_text(word) == text) return word;
    known.emplace_back(model::to_text(word));
    listed += (listed.empty() ? "" : ", ") + known.back();
  }
  source.fail("expected one of " + listed + ", not '" + text + "'" + words::did_you_mean(text, known));
}

PlanCommand read_command(const Source& source) {
  source.entry().allow_only({"owner", "robot", "component", "command", "arguments", "answer_within_s"});
  PlanCommand out;
  out.owner = source.at("owner").text();
  out.robot = source.text_or("robot", "");
  out.subsystem = source.text_or("component", "");
  out.command_name = source.at("command").text();
  if (const auto arguments = source.find("arguments"))
    for (const auto& [name, value] : arguments->fields()) out.arguments.push_back({name, value.text()});
  if (const auto within = source.find("answer_within_s")) out.answer_within = within->seconds();
  return out;
}

// Reads one effect: set, add, take or rate.
Impact read_impact(temporal::timelines::Index timeline, const Source& source, const Vocabulary& vocabulary) {
  source.entry().allow_only({"timeline", "set", "add", "take", "rate", "at"});
  Impact out;
  out.timeline = timeline;
  const auto& definition = vocabulary.network->timelines.at(timeline);
  const auto set = source.find("set"), add = source.find("add"), take = source.find("take"),
             rate = source.find("rate");
  if (set.has_value() + add.has_value() + take.has_value() + rate.has_value() != 1)
    source.fail("expected one of set, add, take, rate");
  if (set && definition.kind == Kind::state) {
    out.amount.constant = vocabulary.state(definition, set->text(), *set);
  } else {
    out.amount = vocabulary.amount(set ? *set : add ? *add : take ? *take : *rate);
  }
  out.kind = set ? ImpactKind::assign : rate ? ImpactKind::rate : ImpactKind::delta;
  out.moment = take || rate ? ImpactWhen::during : ImpactWhen::at_end;
  if (const auto at = source.find("at")) {
    const std::string word = at->text();
    if (take) at->fail("what is taken is taken while the task runs; leave 'at' out, or write 'add'");
    if (word != "start" && word != "end" && word != "during") at->fail("expected start, end or during");
    out.moment = word == "start" ? ImpactWhen::at_start
                 : word == "end" ? ImpactWhen::at_end
                                 : ImpactWhen::during;
  }
  return out;
}

// A mapping from timelines to effects, or a list of effects that name theirs.
void read_impacts(const Source& source, const Vocabulary& vocabulary, Expansion& expansion, Task& out) {
  if (source.entry().is_sequence()) {
    for (const Source& one : source.items()) {
      expansion.spend(source, 1);
      one.entry().attempt([&] {
        out.impacts.push_back(read_impact(vocabulary.timelines.index(one.at("timeline")), one, vocabulary));
      });
    }
    return;
  }
  for (const auto& [name, effects] : source.raw_fields()) {
    expansion.spend(source, 1);
    effects.entry().attempt([&, &raw = name, &all = effects] {
      const auto timeline = vocabulary.timelines.index(all.filled(raw), all);
      for (const Source& one : all.one_or_more()) {
        expansion.spend(source, 1);
        out.impacts.push_back(read_impact(timeline, one, vocabulary));
      }
    });
  }
}

std::vector<Amount> read_utility(const Source& source, const Vocabulary& vocabulary) {
  std::vector<Amount> out;
  for (const auto& [rank, score] : source.fields()) {
    const std::uint32_t index = vocabulary.ranks.index(rank, score);
    if (out.size() <= index) out.resize(index + 1);
    out[index] = vocabulary.amount(score);
  }
  return out;
}

temporal::RankVector read_scores(const Source& source, const Vocabulary& vocabulary) {
  std::vector<double> out;
  for (const auto& [rank, score] : source.fields()) {
    const std::uint32_t index = vocabulary.ranks.index(rank, score);
    if (out.size() <= index) out.resize(index + 1);
    out[index] = score.number();
  }
  return temporal::RankVector(std::move(out));
}

model::Product read_product(const std::string& name, const Source& source, const Vocabulary& vocabulary) {
  source.entry().allow_only({"tier", "bytes", "utility"});
  model::Product out;
  out.name = name;
  if (const auto tier = source.find("tier"))
    out.tier = word_of(*tier, std::vector{Tier::critical, Tier::decisional, Tier::mandatory, Tier::residual});
  out.bytes = vocabulary.amount(source.at("bytes"));
  if (const auto utility = source.find("utility")) out.utility = read_scores(*utility, vocabulary);
  return out;
}

model::Control read_control(const Source& source, const Vocabulary& vocabulary) {
  source.entry().allow_only({"wait_s", "answer_within_s", "retries", "may_skip", "skip_if"});
  model::Control out;
  if (const auto wait = source.find("wait_s")) out.wait_timeout = wait->seconds();
  if (const auto within = source.find("answer_within_s")) out.answer_within = within->seconds();
  if (const auto retries = source.find("retries"))
    out.retries = static_cast<std::uint32_t>(retries->count(std::numeric_limits<std::uint32_t>::max()));
  out.may_skip = source.truth_or("may_skip", false);
  out.skip_if = vocabulary.constraints(source.find("skip_if"), Phase::pre);
  return out;
}

std::vector<model::TaskIndex> read_tasks(const std::optional<Source>& source, const Vocabulary& vocabulary) {
  std::vector<model::TaskIndex> out;
  if (!source) return out;
  for (const Source& one : source->one_or_more()) out.push_back(vocabulary.tasks.index(one));
  return out;
}

void read_failure(const Source& source, const Vocabulary& vocabulary, Task& out) {
  source.entry().allow_only({"respond", "request", "withdraw"});
  if (const auto respond = source.find("respond")) out.response = read_command(*respond);
  if (!source.find("request") && !source.find("withdraw")) return;
  out.contingency = {read_tasks(source.find("request"), vocabulary),
                     read_tasks(source.find("withdraw"), vocabulary)};
}

void read_learns(const Source& source, const Vocabulary& vocabulary, Task& out) {
  source.entry().allow_only({"duration_s", "energy", "power", "values"});
  for (const Measure measure : {Measure::duration_s, Measure::energy, Measure::power}) {
    const auto parameters = source.find(model::to_text(measure));
    if (!parameters) continue;
    for (const Source& one : parameters->one_or_more())
      out.learns.push_back({measure, vocabulary.parameters.index(one), {}});
  }
  const auto values = source.find(model::to_text(Measure::value));
  if (!values) return;
  for (const auto& [result, parameters] : values->fields())
    for (const Source& one : parameters.one_or_more())
      out.learns.push_back({Measure::value, vocabulary.parameters.index(one), result});
}

model::Subtask read_subtask(const Source& source, const Vocabulary& vocabulary) {
  model::Subtask out;
  if (!source.entry().is_mapping()) {
    out.task = vocabulary.tasks.index(source);
    return out;
  }
  source.entry().allow_only({"task", "after_s", "within_s"});
  out.task = vocabulary.tasks.index(source.at("task"));
  if (const auto after = source.find("after_s")) out.shortest_gap = after->seconds();
  if (const auto within = source.find("within_s")) out.longest_gap = within->seconds();
  return out;
}

Decomposition read_decomposition(const std::string& name, const Source& source, const Vocabulary& vocabulary,
                                 Expansion& expansion) {
  Decomposition out;
  out.name = name;
  std::optional<Source> subtasks;
  if (source.entry().is_sequence()) {
    subtasks = source;
  } else {
    source.entry().allow_only({"for", "when", "sequence"});
    out.when = vocabulary.constraints(source.find("when"), Phase::pre);
    subtasks = source.at("sequence");
  }
  for (const Source& one : subtasks->items()) {
    expansion.spend(*subtasks, 1);
    one.entry().attempt([&] { out.subtasks.push_back(read_subtask(one, vocabulary)); });
  }
  if (subtasks->items().empty()) subtasks->fail("decomposition '" + name + "' is empty; list its subtasks");
  return out;
}

void read_constraints(const Source& source, const Vocabulary& vocabulary, Task& out) {
  static constexpr std::array<std::pair<const char*, Phase>, 3> phases{
      {{"pre", Phase::pre}, {"maintenance", Phase::maintenance}, {"post", Phase::post}}};
  for (const auto& [key, phase] : phases) {
    const auto more = vocabulary.constraints(source.find(key), phase);
    out.constraints.insert(out.constraints.end(), more.begin(), more.end());
  }
}

void read_times(const Source& source, Task& out) {
  if (const auto start = source.find("start_s")) out.preferred_start = start->seconds();
  out.fixed = source.truth_or("fixed", false);
  const auto window = source.find("window_s");
  if (!window) return;
  const auto bounds = window->items();
  if (bounds.size() != 2) window->fail("expected [opens, closes]");
  out.opens = bounds[0].seconds();
  out.closes = bounds[1].seconds();
}

}  // namespace

Task read_task(const std::string& id, const Source& source, const Vocabulary& vocabulary,
               Expansion& expansion, bool is_template) {
  source.entry().allow_only({"for",         "name",      "template", "priority",      "batch",      "start_s",
                             "fixed",       "window_s",  "command",  "commands",      "duration_s", "pre",
                             "maintenance", "post",      "impacts",  "control",       "on_failure", "utility",
                             "products",    "downlinks", "learns",   "decompositions"});
  Task out;
  out.id = id;
  out.name = source.text_or("name", "");
  out.is_template = source.truth_or("template", is_template);
  const double priority = source.number_or("priority", 0);
  if (priority < -1e9 || priority > 1e9 || priority != static_cast<std::int32_t>(priority))
    source.at("priority").fail("expected a whole number of at most 1000000000");
  out.priority = static_cast<std::int32_t>(priority);
  if (const auto batch = source.find("batch")) out.batch = vocabulary.batches.index(*batch);
  read_times(source, out);
  if (const auto command = source.find("command")) out.commands.push_back(read_command(*command));
  if (const auto commands = source.find("commands"))
    for (const Source& one : commands->items()) {
      expansion.spend(*commands, 1);
      out.commands.push_back(read_command(one));
    }
  out.duration = vocabulary.amount_or(source, "duration_s", 0);
  read_constraints(source, vocabulary, out);
  expansion.spend(source, 1 + out.constraints.size());
  if (const auto impacts = source.find("impacts")) read_impacts(*impacts, vocabulary, expansion, out);
  if (const auto control = source.find("control")) out.control = read_control(*control, vocabulary);
  if (const auto failure = source.find("on_failure")) read_failure(*failure, vocabulary, out);
  if (const auto utility = source.find("utility")) out.utility = read_utility(*utility, vocabulary);
  if (const auto products = source.find("products"))
    for (const auto& [name, product] : products->fields()) {
      expansion.spend(*products, 1);
      product.entry().attempt([&, &key = name, &value = product] {
        out.products.push_back(read_product(key, value, vocabulary));
      });
    }
  out.downlinks = source.truth_or("downlinks", false);
  if (const auto learns = source.find("learns")) read_learns(*learns, vocabulary, out);
  if (const auto decompositions = source.find("decompositions")) {
    if (decompositions->fields().empty()) decompositions->fail("it has no decomposition; list one at least");
    expansion.each_field(*decompositions, [&](const std::string& name, const Source& value) {
      out.decompositions.push_back(read_decomposition(name, value, vocabulary, expansion));
    });
  }
  return out;
}

}  // namespace roci::planner::utility_htn::reading
