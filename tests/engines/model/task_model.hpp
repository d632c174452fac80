// The language of the two proof engines: tasks over timelines, line by line. It has nothing of PDDL.
//
//   task NAME OWNER SUBSYSTEM COMMAND SECONDS     # a task is one command; SECONDS: a number or MODULE.FUNCTION
//     needs TIMELINE VALUE                        # from its start to its end
//     uses TIMELINE AMOUNT                        # a number, taken at the start; it must be there
//     sets TIMELINE VALUE                         # at its end
//   goal KIND TIMELINE VALUE                      # what a goal of this kind asks for
#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::proof {

// It says "model:LINE: what is wrong; remedy".
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Held {
  std::string timeline;
  std::string value;  // a state's name
  bool operator==(const Held&) const = default;
};

struct Drawn {
  std::string timeline;
  double amount = 0;
};

struct Task {
  std::string name;
  std::string owner, subsystem, command;
  temporal::Duration duration{0};
  std::string module_name, function;  // that give the duration in seconds; empty: it stands above
  std::vector<Held> needs;
  std::vector<Drawn> uses;
  std::vector<Held> sets;
};

struct TaskModel {
  std::vector<Task> tasks;
  std::map<std::string, std::vector<Held>> goals;  // by kind

  const Task* task(const std::string& name) const;
};

// Throws ModelError.
TaskModel read_model(const std::string& text);

temporal::Condition condition_of(const std::vector<Held>& held);

// The activity that does the task for a robot; its start and its end are the points `start` and `start` + 1.
temporal::PlanActivity activity_of(const Task& task, std::string id, const std::string& robot,
                                   temporal::TimePoint start);

}  // namespace roci::planner::proof
