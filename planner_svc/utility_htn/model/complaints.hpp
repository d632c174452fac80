// Complaints are what the parts of the check share: a place to put faults, and the questions that several of
// them ask.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/utility_htn/model/check.hpp"

namespace roci::planner::utility_htn::model {

/// Collects faults of one part of a network.
class Complaints {
 public:
  Complaints(const Network& checked, std::vector<Fault>& out)
      : network(checked), known(priors(checked)), out_(out) {}

  void about(Part part, std::size_t index) {
    part_ = part;
    index_ = static_cast<std::uint32_t>(index);
  }
  void error(std::string what, std::string remedy = "") {
    out_.push_back({part_, index_, false, std::move(what), std::move(remedy)});
  }
  void warning(std::string what, std::string remedy = "") {
    out_.push_back({part_, index_, true, std::move(what), std::move(remedy)});
  }

  /// Complains of a name that is none: letters, digits, '_', '.' and '-', a letter or '_' at the front.
  void name(const std::string& kind, const std::string& text);
  /// Complains of text that is too long, no UTF-8 or holds control characters.
  void text(const std::string& kind, const std::string& text);
  void more_than(const std::string& kind, std::size_t count, std::size_t most);
  void constraint(const std::string& kind, const temporal::timelines::Constraint& constraint);
  /// Complains where the amount leaves [lowest, highest] with the prior or anywhere in the range of its parameter.
  void amount(const std::string& kind, const Amount& amount, double lowest, double highest);

  const Network& network;
  const Values known;  ///< the priors

 private:
  std::vector<Fault>& out_;
  Part part_ = Part::network;
  std::uint32_t index_ = 0;
};

void check_timelines(Complaints& complaints);
void check_task(const Task& task, Complaints& complaints);
void check_hierarchy(Complaints& complaints);

}  // namespace roci::planner::utility_htn::model
