#include "planner_svc/temporal_pddl/cli/read_model.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "core/pddl/check.hpp"
#include "core/pddl/forbidden.hpp"
#include "core/pddl/parser.hpp"

namespace roci::planner::temporal_pddl::cli {

using temporal::Verdict;

namespace {

constexpr std::size_t kAtOnce = 16384;  // bytes

// Collects what is wrong with the files, one after the other.
class ModelFaults {
 public:
  template <typename Read>
  void attempt(Read read) {
    try {
      read();
    } catch (const pddl::ParseError& error) {
      add(error);
    }
  }

  void add(const pddl::ParseError& error) {
    text_ += (text_.empty() ? "" : "\n") + std::string(error.what());
    unsupported_ = unsupported_ || error.unsupported();
    findings_.insert(findings_.end(), error.diagnostics().begin(), error.diagnostics().end());
  }

  void throw_findings() const {
    if (findings_.empty()) return;
    throw ModelRefused(text_, findings_, unsupported_ ? Verdict::unsupported : Verdict::invalid_input);
  }

 private:
  std::string text_;
  std::vector<pddl::Diagnostic> findings_;
  bool unsupported_ = false;
};

}  // namespace

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw pddl::ParseError({path, {}, "cannot be read", "check the path and its permissions"});
  }
  std::string text;
  for (std::size_t size = 0; file;) {  // a pipe does not tell how much it has
    text.resize(std::max<std::size_t>(size + kAtOnce, size * 3 / 2));
    file.read(text.data() + size, static_cast<std::streamsize>(text.size() - size));
    size += static_cast<std::size_t>(file.gcount());
    if (!file) text.resize(size);
  }
  return text;
}

Model read_model(const std::string& domain, const std::string& problem, pddl::Strictness strictness) {
  ModelFaults faults;
  std::optional<pddl::Domain> read;
  faults.attempt([&] { read = pddl::load_domain(read_file(domain), domain, strictness); });
  Model model;
  faults.attempt([&] {
    const std::string text = read_file(problem);
    // Without its domain, only its form can be told.
    model.problem = read ? pddl::load_problem(text, problem, *read, strictness)
                         : pddl::parse_problem(text, problem, strictness);
  });
  faults.throw_findings();
  model.domain = std::move(*read);
  if (auto forbidden = pddl::forbidden_effects(model.domain, model.problem); !forbidden.empty())
    faults.add(pddl::ParseError(std::move(forbidden)));
  faults.throw_findings();
  return model;
}

std::vector<pddl::Diagnostic> warnings_of(const Model& model) {
  std::vector<pddl::Diagnostic> all = model.domain.warnings;
  all.insert(all.end(), model.problem.warnings.begin(), model.problem.warnings.end());
  return all;
}

}  // namespace roci::planner::temporal_pddl::cli
