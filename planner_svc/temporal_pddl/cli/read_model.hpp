// The input side of roci-plan: two files become a model, or a refusal that says everything that is wrong with them.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/temporal/verdict.hpp"

namespace roci::planner::temporal_pddl::cli {

/// A domain and a problem without findings; their `warnings` say what in them departs from PDDL.
struct Model {
  pddl::Domain domain;
  pddl::Problem problem;
};

/// Says why files are no model; what() is one line per finding, in both files, in the order of the texts.
class ModelRefused : public std::runtime_error {
 public:
  ModelRefused(const std::string& text, std::vector<pddl::Diagnostic> findings, temporal::Verdict verdict)
      : std::runtime_error(text), findings_(std::move(findings)), verdict_(verdict) {}

  const std::vector<pddl::Diagnostic>& findings() const { return findings_; }
  /// Returns `unsupported` if the files say something that the planner does not take, else `invalid_input`.
  temporal::Verdict verdict() const { return verdict_; }

 private:
  std::vector<pddl::Diagnostic> findings_;
  temporal::Verdict verdict_;
};

/// Returns the bytes of a file. Throws ParseError with the remedy if it cannot be read.
std::string read_file(const std::string& path);

/// Reads both files. Throws ModelRefused, also for effects that no engine takes (core/pddl/forbidden.hpp).
Model read_model(const std::string& domain, const std::string& problem, pddl::Strictness strictness);

/// Returns the warnings of both files.
std::vector<pddl::Diagnostic> warnings_of(const Model& model);

}  // namespace roci::planner::temporal_pddl::cli
