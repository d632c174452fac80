#include "ground_console/cli/watch/plan_rows.hpp"

#include <algorithm>

#include "ground_console/cli/levels.hpp"
#include "ground_console/cli/plan_table.hpp"
#include "ground_console/cli/watch/axis.hpp"

namespace roci::console::cli::watch {
namespace {

enum class Course { waiting, mixed, over };

Course course_of(const v1::StepStatus* step) {
  if (step == nullptr || step->state() == v1::ACTIVITY_WAITING) return Course::waiting;
  const bool runs = step->state() == v1::ACTIVITY_DISPATCHED || step->state() == v1::ACTIVITY_RUNNING;
  return runs ? Course::mixed : Course::over;
}

// Those below a row stand right behind it, deeper in.
class Tree {
 public:
  explicit Tree(const lib::MissionView& view) {
    const bool layered = has_levels(*view.plan());
    const auto start = [&](const v1::PlanActivity* one) {
      return layered ? span_of(*one, view.step(one->id()), view.now_us()).from : std::int64_t{0};
    };
    for (const auto& [activity, depth] : in_levels(view.plan()->activities(), start))
      rows_.push_back({activity, depth, 0});
    hidden_.resize(rows_.size());
    for (const PlanRow& row : rows_) whole_.push_back(course_of(view.step(row.activity->id())));
    end_.resize(rows_.size());
    for (std::size_t i = rows_.size(); i-- > 0;) {
      end_[i] = i + 1;
      while (end_[i] < rows_.size() && rows_[end_[i]].depth > rows_[i].depth) {
        if (whole_[end_[i]] != whole_[i]) whole_[i] = Course::mixed;
        end_[i] = end_[end_[i]];
      }
    }
    shown_ = rows_.size();
  }

  std::size_t shown() const { return shown_; }

  // Folds activities of one course until so many rows are left, the highest ones that are of that course as a whole.
  void fold(Course course, bool latest_first, std::size_t room) {
    std::vector<std::size_t> whole;
    for (std::size_t i = 0; i < rows_.size();) {
      const bool takes = whole_[i] == course && end_[i] > i + 1;
      if (takes) whole.push_back(i);
      i = takes ? end_[i] : i + 1;
    }
    if (latest_first) std::ranges::reverse(whole);
    for (const std::size_t i : whole) {
      if (shown_ <= room) return;
      for (std::size_t below = i + 1; below < end_[i]; ++below) hide(below);
      rows_[i].folded = end_[i] - i - 1;
    }
  }

  // Leaves out what is over, the oldest first.
  std::size_t drop(std::size_t room) {
    std::size_t gone = 0;
    for (std::size_t i = 0; i < rows_.size() && shown_ > room; ++i) {
      if (hidden_[i] || whole_[i] != Course::over) continue;
      gone += rows_[i].folded + 1;
      hide(i);
    }
    return gone;
  }

  std::vector<PlanRow> rows() const {
    std::vector<PlanRow> out;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!hidden_[i]) out.push_back(rows_[i]);
    return out;
  }

 private:
  void hide(std::size_t row) {
    if (!hidden_[row]) --shown_;
    hidden_[row] = true;
  }

  std::vector<PlanRow> rows_;
  std::vector<bool> hidden_;
  std::vector<Course> whole_;     // of each with all below it
  std::vector<std::size_t> end_;  // the row behind the last one below it
  std::size_t shown_ = 0;
};

}  // namespace

PlanRows plan_rows(const lib::MissionView& view, std::size_t room) {
  PlanRows out;
  if (view.plan() == nullptr) return out;
  Tree tree(view);
  tree.fold(Course::over, false, room);
  tree.fold(Course::waiting, true, room);
  out.gone = tree.drop(room);
  out.rows = tree.rows();
  if (out.rows.size() <= room) return out;
  for (std::size_t i = room; i < out.rows.size(); ++i) out.more += out.rows[i].folded + 1;
  out.rows.resize(room);
  return out;
}

}  // namespace roci::console::cli::watch
