#include <algorithm>
#include <limits>

#include "core/words/nearest_word.hpp"
#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"
#include "planner_svc/utility_htn/reading/yaml.hpp"
#include "planner_svc/utility_htn/reading/yaml_task.hpp"

namespace roci::planner::utility_htn::reading {

using mission::Entry, mission::FileError, mission::Findings;
using model::Network, model::Part;
using temporal::timelines::Definition, temporal::timelines::Kind;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kMostCount = std::uint64_t{1} << 53U;

Entry load_bounded(const std::filesystem::path& file, Findings* findings) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (!error && size > model::kMostBytes)
    throw FileError(file.string() + ": the file has " + std::to_string(size) + " bytes, at most " +
                    std::to_string(model::kMostBytes) + " are permitted; make the network smaller");
  return Entry::load(file, findings);
}

// Reads the sections of a file and of those that it includes, each kind before what refers to it.
class YamlReader {
 public:
  YamlReader(const Entry& root, Findings& findings, bool may_include) : findings_(findings), root_(root) {
    root_.entry().allow_only({"format", "network", "version", "include", "constants", "sets", "ranks",
                              "batches", "budget", "exploration_bound", "cycle", "parameters", "timelines",
                              "templates", "tasks", "subway"});
    const std::size_t before = faults();
    root_.entry().attempt([&] { include(may_include); });
    files_.push_back(root_);
    mark_incomplete(before);
  }

  Read take() {
    const auto part = [&](const std::function<void()>& read) { root_.entry().attempt(read); };
    part([&] { read_constants(); });
    part([&] { read_sets(); });
    expansion_ = Expansion(sets_, findings_, unknown_);
    read_head();
    part([&] { read_parameters(); });
    part([&] { read_timelines(); });
    vocabulary_.network = &network_;
    part([&] { name_tasks(); });
    part([&] { read_all_tasks(); });
    part([&] { read_budget(); });
    part([&] { read_cycle(); });
    part([&] { read_subway(); });
    unknown_.report(findings_, Expansion::kMostFindings);
    return {std::move(network_), std::move(places_)};
  }

 private:
  std::size_t faults() const { return findings_.errors() + unknown_.failures(); }

  // What was not included may hold any name; a section whose key is misspelt is none of those that are there.
  void mark_incomplete(std::size_t before_includes) {
    const bool not_included = faults() > before_includes;
    if (faults() == 0) return;
    const auto mark = [&](std::string_view section, const std::string& kind) {
      const bool there =
          std::ranges::any_of(files_, [&](const Source& file) { return file.find(section).has_value(); });
      if (not_included || !there) unknown_.hide(kind);
    };
    for (const auto& [section, kind] :
         {std::pair{"sets", "set"}, std::pair{"parameters", "parameter"}, std::pair{"timelines", "timeline"},
          std::pair{"tasks", "task"}, std::pair{"templates", "task"}, std::pair{"ranks", "rank"},
          std::pair{"batches", "batch"}})
      mark(section, kind);
  }

  void include(bool permitted) {
    const auto format = root_.find("format");
    if (format && format->count(kMostCount) > static_cast<std::uint64_t>(kYamlFormat))
      format->fail("this form is newer than " + std::to_string(kYamlFormat) +
                   ", the newest that is read here; use a newer program");
    const auto includes = root_.find("include");
    if (!includes) return;
    if (!permitted) includes->fail("a text that came without a folder includes no files; write it in full");
    for (const Source& one : includes->one_or_more()) {
      one.entry().attempt([&] {
        const std::filesystem::path file = one.entry().resolve(one.text());
        if (!std::filesystem::is_regular_file(file))
          one.fail("no file '" + one.text() + "' beside this one; mend the name");
        const Entry entry = load_bounded(file, &findings_);
        entry.allow_only({"format", "constants", "sets", "ranks", "batches", "budget", "exploration_bound",
                          "cycle", "parameters", "timelines", "templates", "tasks", "subway"});
        files_.emplace_back(entry);
      });
    }
  }

  // The section of the file itself, or of the first that it includes.
  std::optional<Source> single(std::string_view key) const {
    if (const auto own = root_.find(key)) return own->with(constants_);
    for (const Source& file : files_)
      if (const auto found = file.find(key)) return found->with(constants_);
    return std::nullopt;
  }

  Source needed(std::string_view key) const {
    const auto found = single(key);
    if (!found) root_.fail("'" + std::string(key) + "' is missing; add it");
    return *found;
  }

  void each_section(std::string_view key, const std::function<void(const Source&)>& read) const {
    for (const Source& file : files_) {
      const auto found = file.find(key);
      if (found) found->entry().attempt([&] { read(found->with(constants_)); });
    }
  }

  void read_constants() {
    each_section("constants", [&](const Source& section) {
      for (const auto& [name, raw] : section.raw_fields()) {
        raw.entry().attempt([&, &key = name, &value = raw] {
          const bool mapping = value.entry().is_mapping();
          if (mapping) value.entry().allow_only({"value", "source"});
          const Source known = (mapping ? value.at("value") : value).with(constants_);
          const std::string text = known.text();
          const Expression number = parse_expression(text);
          const bool is_number = number.fault.empty() && number.name.empty();
          constants_[key] = is_number ? model::to_text(number.constant) : text;
        });
        constants_.try_emplace(name, "1");  // stands for one with a fault, so that what uses it is read
      }
    });
  }

  void read_sets() {
    const std::size_t before = faults();
    Expansion lists({}, findings_, unknown_);
    each_section("sets", [&](const Source& section) {
      for (const auto& [name, values] : section.fields())
        values.entry().attempt([&, &key = name, &set = values] { sets_[key] = lists.values(set); });
    });
    if (faults() > before) unknown_.hide("set");
  }

  void read_head() {
    const auto part = [&](const std::function<void()>& read) { root_.entry().attempt(read); };
    part([&] { network_.name = needed("network").text(); });
    part([&] {
      if (const auto version = single("version")) network_.version = version->count(kMostCount);
    });
    part([&] { read_names(needed("ranks"), vocabulary_.ranks, network_.ranks); });
    part([&] {
      if (const auto batches = single("batches")) read_names(*batches, vocabulary_.batches, network_.batches);
    });
    part([&] {
      if (const auto bound = single("exploration_bound"))
        network_.exploration_bound = bound->count(kMostCount);
    });
  }

  void read_names(const Source& list, Names& names, std::vector<std::string>& out) {
    const std::size_t before = faults();
    list.entry().attempt([&] {
      for (const Source& one : list.items()) {
        names.add(one.text(), one);
        out.push_back(one.text());
      }
    });
    if (faults() > before) names.mark_incomplete();
  }

  void read_parameters() {
    const std::size_t before = faults();
    each_section("parameters", [&](const Source& section) {
      expansion_.each_field(section, [&](const std::string& name, const Source& value) {
        vocabulary_.parameters.add(name, value);
        note(Part::parameter, network_.parameters.size(), value);
        model::Parameter& out = network_.parameters.emplace_back();
        out.name = name;
        value.entry().allow_only({"for", "value", "range", "source"});
        out.prior = value.at("value").number();
        const auto range = value.at("range").items();
        if (range.size() != 2) value.at("range").fail("expected [lowest, highest]");
        out.lowest = range[0].number();
        out.highest = range[1].number();
        out.source = value.text_or("source", "");
      });
    });
    if (faults() > before) vocabulary_.parameters.mark_incomplete();
  }

  void read_timeline(const Source& value, Definition& out) {
    value.entry().allow_only({"for", "kind", "states", "initial", "range", "reported"});
    static const std::vector kinds{Kind::atomic, Kind::state, Kind::claimable, Kind::cumulative,
                                   Kind::cumulative_rate};
    const Source kind = value.at("kind");
    const std::string word = kind.text();
    const auto known = std::ranges::find_if(kinds, [&](Kind one) { return model::to_text(one) == word; });
    if (known == kinds.end()) {
      std::vector<std::string> words;
      for (const Kind one : kinds) words.emplace_back(model::to_text(one));
      kind.fail("unknown kind '" + word + "'; known: atomic, state, claimable, cumulative, cumulative_rate" +
                words::did_you_mean(word, words));
    }
    out.kind = *known;
    // Who has claimed something the tasks say that run; a spacecraft reports it where it says so.
    out.reported = value.truth_or("reported", out.kind != Kind::atomic && out.kind != Kind::claimable);
    if (out.kind == Kind::state) {
      for (const Source& state : value.at("states").items()) out.states.push_back(state.text());
      const auto initial = value.find("initial");
      if (initial) out.initial = vocabulary_.state(out, initial->text(), *initial);
      if (const auto range = value.find("range")) range->fail("a state has no range; leave it out");
      return;
    }
    if (const auto states = value.find("states")) states->fail("only a timeline of kind state has states");
    if (out.kind == Kind::atomic) {
      out.lowest = 0;
      out.highest = 1;
    }
    if (const auto range = value.find("range")) {
      const auto bounds = range->items();
      if (bounds.size() != 2) range->fail("expected [lowest, highest]");
      out.lowest = bounds[0].number_or_none(-kInfinite);
      out.highest = bounds[1].number_or_none(kInfinite);
    }
    out.initial = value.number_or("initial", 0);
  }

  void read_timelines() {
    const std::size_t before = faults();
    each_section("timelines", [&](const Source& section) {
      expansion_.each_field(section, [&](const std::string& name, const Source& value) {
        vocabulary_.timelines.add(name, value);
        note(Part::timeline, network_.timelines.size(), value);
        network_.timelines.emplace_back().name = name;
        try {
          read_timeline(value, network_.timelines.back());
        } catch (const FileError&) {
          vocabulary_.timelines.mark_faulty(name);
          throw;
        }
      });
    });
    if (faults() > before) vocabulary_.timelines.mark_incomplete();
  }

  void name_tasks() {
    const std::size_t before = faults();
    for (const auto& [section_name, is_template] :
         {std::pair{"templates", true}, std::pair{"tasks", false}}) {
      each_section(section_name, [&, &templates = is_template](const Source& section) {
        expansion_.each_field(section, [&](const std::string& id, const Source& value) {
          vocabulary_.tasks.add(id, value);
          note(Part::task, named_.size(), value);
          named_.push_back({id, value, templates});
        });
      });
    }
    if (faults() > before) vocabulary_.tasks.mark_incomplete();
  }

  void read_all_tasks() {
    std::string faulty;  // place of an entry with an error, whose repetitions are passed over
    network_.tasks.resize(named_.size());
    for (std::size_t index = 0; index < named_.size(); ++index) {
      const Named& task = named_[index];
      const std::string place = task.source.entry().place();
      if (place == faulty) continue;
      expansion_.stop_at_many_findings();
      const std::size_t before = faults();
      task.source.entry().attempt([&] {
        network_.tasks[index] = read_task(task.id, task.source, vocabulary_, expansion_, task.is_template);
      });
      if (faults() > before) faulty = place;
    }
    named_.clear();
  }

  void read_budget() { network_.budget = vocabulary_.timelines.index(needed("budget")); }

  void read_cycle() {
    const Source cycle = needed("cycle");
    note(Part::network, model::kCycleOfNetwork, cycle);
    cycle.entry().allow_only(
        {"process_interval_s", "worst_cycle_s", "commit_window_s", "scheduling_window_s", "plan_end_s"});
    network_.cycle.process_interval = cycle.at("process_interval_s").seconds();
    network_.cycle.worst_cycle = cycle.at("worst_cycle_s").seconds();
    network_.cycle.commit_window = cycle.at("commit_window_s").seconds();
    if (const auto window = cycle.find("scheduling_window_s"))
      network_.cycle.scheduling_window = window->seconds();
    if (const auto end = cycle.find("plan_end_s")) network_.cycle.plan_end = end->seconds();
  }

  void read_subway() {
    const auto subway = single("subway");
    if (!subway) return;
    subway->entry().allow_only({"most_samples", "rank", "sites"});
    note(Part::network, model::kSubwayOfNetwork, *subway);
    if (const auto most = subway->find("most_samples"))
      network_.subway.most_samples =
          static_cast<std::uint32_t>(most->count(std::numeric_limits<std::uint32_t>::max()));
    if (const auto rank = subway->find("rank")) network_.subway.rank = vocabulary_.ranks.index(*rank);
    expansion_.each_field(subway->at("sites"), [&](const std::string& name, const Source& value) {
      value.entry().allow_only({"for", "value", "targets"});
      note(Part::site, network_.subway.sites.size(), value);
      model::Site& site = network_.subway.sites.emplace_back();
      site.name = name;
      site.value = vocabulary_.amount_or(value, "value", 0);
      expansion_.each_item(value.at("targets"), [&](const Source& target) {
        target.entry().allow_only({"for", "task", "signature", "visual"});
        expansion_.spend(target, 1);
        site.targets.push_back({vocabulary_.tasks.index(target.at("task")),
                                vocabulary_.timelines.index(target.at("signature")),
                                vocabulary_.amount_or(target, "visual", 0)});
      });
    });
  }

  void note(Part part, std::size_t index, const Source& source) {
    places_[{part, static_cast<std::uint32_t>(index)}] = source.entry().place();
  }

  struct Named {
    std::string id;
    Source source;
    bool is_template;
  };

  Findings& findings_;
  Source root_;
  std::vector<Source> files_;  // those included, then the file itself
  Bindings constants_;
  Sets sets_;
  UnknownNames unknown_;
  Expansion expansion_{{}, findings_, unknown_};
  Vocabulary vocabulary_{unknown_};
  Network network_;
  Places places_;
  std::vector<Named> named_;
};

Read read(const std::function<Entry()>& open, Findings& findings, bool may_include) {
  const std::size_t before = findings.errors();
  Read out;
  try {
    out = YamlReader(open(), findings, may_include).take();
  } catch (const FileError& error) {
    findings.add(error.what());
  } catch (const ReadingAborted&) {  // noted
  }
  if (findings.errors() > before) out.network.reset();
  return out;
}

}  // namespace

Read read_yaml(const std::filesystem::path& file, Findings& findings) {
  return read([&] { return load_bounded(file, &findings); }, findings, true);
}

Read parse_yaml(const std::string& text, const std::filesystem::path& name, Findings& findings) {
  const auto open = [&] {
    if (text.size() > model::kMostBytes)
      throw FileError(name.string() + ": more than " + std::to_string(model::kMostBytes) +
                      " bytes; make the network smaller");
    return Entry::parse(text, name.string(), &findings);
  };
  return read(open, findings, false);
}

}  // namespace roci::planner::utility_htn::reading
