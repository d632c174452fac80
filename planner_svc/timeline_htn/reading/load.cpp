#include "planner_svc/timeline_htn/reading/load.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>
#include <utility>

#include "core/mission/model_text.hpp"
#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/sections.hpp"

namespace roci::planner::timeline_htn::reading {

using mission::Entry, mission::FileError, mission::Finding, mission::Findings, mission::Severity;
using model::Model, model::Part;

namespace {

const std::initializer_list<std::string_view> kKeys = {"format",     "domain",    "include", "types",
                                                       "objects",    "relations", "numbers", "components",
                                                       "behaviours", "problem"};

/// Collects the roots of all files or texts, each once.
class Roots {
 public:
  explicit Roots(Findings& findings) : findings_(findings) {}

  void add_file(const std::filesystem::path& file) {
    std::error_code error;
    const auto canonical = std::filesystem::weakly_canonical(file, error);
    if (!seen_.insert(error ? file : canonical).second) return;
    if (seen_.size() > model::kMostTexts)
      throw FileError(file.string() + ": more than " + std::to_string(model::kMostTexts) +
                      " files make up one model; join some");
    add(contents(file), file.string(), true);
  }
  void add_text(const Text& text) {
    const std::vector<mission::ModelPart> parts = mission::model_parts(text.content, text.name);
    for (const mission::ModelPart& part : parts) came_.insert(part.name);
    for (const mission::ModelPart& part : parts) {
      if (roots.size() >= model::kMostTexts)
        throw FileError(part.name + ": more than " + std::to_string(model::kMostTexts) + " texts; join some");
      add(part.text, part.name, false);
    }
  }

  std::vector<Entry> roots;

 private:
  static std::string contents(const std::filesystem::path& file) {
    std::error_code error;
    std::ifstream in(file, std::ios::binary);
    if (!in || !std::filesystem::is_regular_file(file, error))
      throw FileError(file.string() + (std::filesystem::is_directory(file, error)
                                           ? ": is a folder; name the files in it, e.g. problem.yaml"
                                           : ": cannot be read; check that the file exists"));
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::string out(error ? 0 : std::min<std::uintmax_t>(size, model::kMostBytes) + 1, '\0');
    in.read(out.data(), static_cast<std::streamsize>(out.size()));
    out.resize(static_cast<std::size_t>(in.gcount()));
    return out;
  }

  void add(const std::string& content, const std::string& name, bool may_include) {
    bytes_ += content.size();
    if (bytes_ > model::kMostBytes)
      throw FileError(name + ": the texts of the model have more than " + std::to_string(model::kMostBytes) +
                      " bytes together; make it smaller");
    const Entry root = Entry::parse(content, name, &findings_);
    root.allow_only(kKeys);
    if (const auto format = root.find("format"); format && format->integer() > kFormat)
      format->fail("this form is newer than " + std::to_string(kFormat) +
                   ", the newest that is read here; use a newer program");
    roots.push_back(root);
    const auto includes = root.find("include");
    if (!includes) return;
    for (const Entry& one : one_or_more(*includes, model::kMostTexts)) {
      if (!may_include) {
        if (!came_.contains(mission::included_name(name, one.text())))
          one.fail("a text that came without a folder includes only what came with it; send '" + one.text() +
                   "' along");
        continue;
      }
      const std::filesystem::path file = one.resolve(one.text());
      std::error_code error;
      if (!std::filesystem::is_regular_file(file, error))
        one.fail("no file '" + one.text() + "' beside this one; mend the name");
      add_file(file);
    }
  }

  Findings& findings_;
  std::set<std::filesystem::path> seen_;
  std::set<std::string> came_;  // names of texts
  std::size_t bytes_ = 0;
};

void read_sections(const std::vector<Entry>& roots, Vocabulary& vocabulary, Places& places) {
  const auto each = [&](std::string_view key, const std::function<void(const Entry&)>& read) {
    for (const Entry& root : roots)
      if (const auto section = root.find(key)) section->attempt([&] { read(*section); });
  };
  each("domain", [&](const Entry& name) {
    if (vocabulary.model.name.empty()) vocabulary.model.name = name.text();
  });
  each("types", [&](const Entry& section) { read_types(section, vocabulary); });
  each("objects", [&](const Entry& section) { read_objects(section, vocabulary); });
  each("relations", [&](const Entry& section) { declare_relations(section, vocabulary); });
  each("numbers", [&](const Entry& section) { declare_numbers(section, vocabulary); });
  each("relations", [&](const Entry& section) { read_relations(section, vocabulary); });
  each("numbers", [&](const Entry& section) { read_numbers(section, vocabulary); });
  finish_tables(vocabulary);
  each("components", [&](const Entry& section) { declare_components(section, vocabulary, places); });
  each("components", [&](const Entry& section) { define_components(section, vocabulary); });
  each("behaviours", [&](const Entry& section) { read_behaviours(section, vocabulary, places); });
  each("problem", [&](const Entry& section) { read_problem(section, vocabulary, places); });
  if (vocabulary.model.components.empty())
    roots.front().fail("the model has no component; add 'components', or the file that has them");
}

std::string subject(const model::Fault& fault, const Model& model) {
  switch (fault.part) {
    case Part::component:
      return "component '" + model.components[fault.index].name + "': ";
    case Part::state:
      return "state '" + model.components[fault.index].name + "." +
             model.components[fault.index].states[fault.state].name + "': ";
    case Part::behaviour:
      return "behaviour '" + model.behaviours[fault.index].name + "': ";
    case Part::goal:
      return "goal '" + model.problem->goals[fault.index].id + "': ";
    default:
      return "";
  }
}

// Notes what the check finds, at the place of the part, or at the model's first file.
bool note_faults(const Model& model, const std::string& file, const Places& places, Findings& findings) {
  const std::vector<model::Fault> faults = model::check(model);
  for (const model::Fault& fault : faults) {
    const auto place = places.find({fault.part, fault.index, fault.state});
    Finding finding = mission::finding_of((place == places.end() ? file : place->second) + ": .");
    finding.what = subject(fault, model) + fault.what;
    finding.remedy = fault.remedy;
    finding.severity = fault.warning ? Severity::warning : Severity::error;
    findings.add(std::move(finding));
  }
  return model::usable(faults);
}

std::optional<Model> read(const std::function<void(Roots&)>& open, Findings& findings, Problem kind) {
  const std::size_t before = findings.errors();
  Vocabulary vocabulary;
  Places places;
  try {
    Roots roots(findings);
    open(roots);
    if (roots.roots.empty()) throw FileError("model: there is no file; name one");
    if (findings.errors() == before) read_sections(roots.roots, vocabulary, places);
    if (findings.errors() > before) return std::nullopt;
    std::optional<model::Problem> left_for_later;
    if (kind == Problem::of_a_request) left_for_later = std::exchange(vocabulary.model.problem, std::nullopt);
    if (note_faults(vocabulary.model, roots.roots.front().file().string(), places, findings)) {
      if (left_for_later) vocabulary.model.problem = std::move(left_for_later);
      return std::move(vocabulary.model);
    }
  } catch (const FileError& error) {
    findings.add(error.what());
  }
  return std::nullopt;
}

}  // namespace

std::optional<Model> load_model(const std::vector<std::filesystem::path>& files, Findings& findings) {
  return read(
      [&](Roots& roots) {
        for (const auto& file : files) roots.add_file(file);
      },
      findings, Problem::whole);
}

std::optional<Model> parse_model(const std::vector<Text>& texts, Findings& findings, Problem problem) {
  return read(
      [&](Roots& roots) {
        for (const Text& text : texts) roots.add_text(text);
      },
      findings, problem);
}

std::string errors_of(const Findings& findings) {
  std::string out;
  for (const Finding& finding : findings.sorted())
    if (finding.severity == Severity::error)
      out +=
          (out.empty() ? "" : "\n") + finding.text() + (finding.remedy.empty() ? "" : "; " + finding.remedy);
  return out;
}

Model load_model(const std::vector<std::filesystem::path>& files) {
  Findings findings;
  std::optional<Model> model = load_model(files, findings);
  if (!model) throw FileError(errors_of(findings));
  return std::move(*model);
}

}  // namespace roci::planner::timeline_htn::reading
