// Complaints are what the parts of the check share: a place to put faults.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "planner_svc/timeline_htn/model/check.hpp"

namespace roci::planner::timeline_htn::model {

/// Collects faults of one part of a model.
class Complaints {
 public:
  Complaints(const Model& checked, std::vector<Fault>& out) : model(checked), out_(out) {}

  void about(Part part, std::size_t index, std::size_t state = 0) {
    about_ = {part, static_cast<Index>(index), static_cast<Index>(state), false, {}, {}};
  }
  void error(std::string what, std::string remedy) { add(false, std::move(what), std::move(remedy)); }
  void warning(std::string what, std::string remedy) { add(true, std::move(what), std::move(remedy)); }

  const Model& model;

 private:
  void add(bool warning, std::string what, std::string remedy) {
    Fault fault = about_;
    fault.warning = warning;
    fault.what = std::move(what);
    fault.remedy = std::move(remedy);
    out_.push_back(std::move(fault));
  }

  std::vector<Fault>& out_;
  Fault about_;
};

/// Complains of behaviours that never end: they lead to what they achieve without coming nearer to it,
/// or nothing that they need ends.
void check_recursion(Complaints& complaints);
/// Complains of behaviours whose constraints no schedule of their subgoals fulfils, whatever their objects.
void check_time(Complaints& complaints);
/// Complains of predicted states that are none, do not follow each other or do not last as long,
/// and of what wants to change them.
void check_predictions(Complaints& complaints);

}  // namespace roci::planner::timeline_htn::model
