#include "tests/engines/model/task_model.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

namespace roci::planner::proof {
namespace {

std::optional<double> number_of(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc() && end == word.data() + word.size() && value >= 0;
  return whole ? std::optional(value) : std::nullopt;
}

class Reader {
 public:
  TaskModel read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      ++number_;
      words_.clear();
      std::istringstream in(line.substr(0, line.find('#')));
      for (std::string word; in >> word;) words_.push_back(word);
      if (!words_.empty()) take();
    }
    if (model_.tasks.empty()) fail("there is no task", "add 'task NAME OWNER SUBSYSTEM COMMAND SECONDS'");
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw ModelError("model:" + std::to_string(number_) + ": " + what + "; " + remedy);
  }

  void take() {
    const std::string& word = words_.front();
    if (word == "task") return take_task();
    if (word == "goal") {
      expect(4, "goal KIND TIMELINE VALUE");
      model_.goals[words_[1]].push_back({words_[2], words_[3]});
      return;
    }
    if (word != "needs" && word != "uses" && word != "sets")
      fail("'" + word + "' is no word of this language", "it knows task, needs, uses, sets, goal");
    expect(3, word + " TIMELINE VALUE");
    if (model_.tasks.empty()) fail("'" + word + "' belongs to a task", "write its task above it");
    Task& task = model_.tasks.back();
    if (word == "uses") {
      const auto amount = number_of(words_[2]);
      if (!amount) fail("'" + words_[2] + "' is no amount", "write a number from 0 on");
      task.uses.push_back({words_[1], *amount});
    } else {
      (word == "needs" ? task.needs : task.sets).push_back({words_[1], words_[2]});
    }
  }

  void take_task() {
    expect(6, "task NAME OWNER SUBSYSTEM COMMAND SECONDS");
    if (model_.task(words_[1]) != nullptr) fail("task '" + words_[1] + "' stands twice", "rename one");
    Task task;
    task.name = words_[1];
    task.owner = words_[2];
    task.subsystem = words_[3];
    task.command = words_[4];
    const auto dot = words_[5].find('.');
    if (const auto seconds = number_of(words_[5])) {
      task.duration = temporal::seconds(*seconds);
    } else if (dot != std::string::npos) {
      task.module_name = words_[5].substr(0, dot);
      task.function = words_[5].substr(dot + 1);
    } else {
      fail("'" + words_[5] + "' is no duration", "write seconds, or MODULE.FUNCTION");
    }
    model_.tasks.push_back(std::move(task));
  }

  void expect(std::size_t count, const std::string& form) const {
    if (words_.size() != count) fail("this line has another form", "write '" + form + "'");
  }

  TaskModel model_;
  std::vector<std::string> words_;
  int number_ = 0;
};

}  // namespace

const Task* TaskModel::task(const std::string& name) const {
  const auto found = std::ranges::find(tasks, name, &Task::name);
  return found == tasks.end() ? nullptr : &*found;
}

TaskModel read_model(const std::string& text) { return Reader().read(text); }

temporal::Condition condition_of(const std::vector<Held>& held) {
  std::vector<temporal::Condition> parts;
  for (const Held& one : held)
    parts.push_back(temporal::compare(one.timeline, temporal::ConditionOp::eq, temporal::state(one.value)));
  return parts.empty() ? temporal::Condition{} : temporal::all_of(parts);
}

temporal::PlanActivity activity_of(const Task& task, std::string id, const std::string& robot,
                                   temporal::TimePoint start) {
  temporal::PlanActivity activity;
  activity.id = std::move(id);
  activity.name = task.name;
  activity.owner = task.owner;
  activity.robot = robot;
  activity.subsystem = task.subsystem;
  activity.command_name = task.command;
  activity.start_point = start;
  activity.end_point = start + 1;
  activity.duration_lower = activity.duration_upper = task.duration;
  activity.pre = activity.maintenance = condition_of(task.needs);
  for (const Drawn& drawn : task.uses)
    activity.impacts.push_back(
        {drawn.timeline, temporal::ImpactKind::delta, temporal::ImpactWhen::at_start, -drawn.amount});
  for (const Held& held : task.sets)
    activity.impacts.push_back({held.timeline, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end,
                                temporal::state(held.value)});
  return activity;
}

}  // namespace roci::planner::proof
