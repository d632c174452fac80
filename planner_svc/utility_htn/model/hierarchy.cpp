#include "planner_svc/utility_htn/model/hierarchy.hpp"

#include <algorithm>
#include <limits>

namespace roci::planner::utility_htn::model {

namespace {

std::size_t times(std::size_t a, std::size_t b) {
  std::size_t out = 0;
  return __builtin_mul_overflow(a, b, &out) ? std::numeric_limits<std::size_t>::max() : out;
}

std::size_t plus(std::size_t a, std::size_t b) {
  std::size_t out = 0;
  return __builtin_add_overflow(a, b, &out) ? std::numeric_limits<std::size_t>::max() : out;
}

std::vector<TaskIndex> children_of(const Task& task) {
  std::vector<TaskIndex> out;
  for (const Decomposition& decomposition : task.decompositions)
    for (const Subtask& subtask : decomposition.subtasks) out.push_back(subtask.task);
  std::ranges::sort(out);
  const auto repeated = std::ranges::unique(out);
  out.erase(repeated.begin(), repeated.end());
  return out;
}

Extent extent_of(const Task& task, const std::vector<Extent>& known) {
  if (task.primitive()) return {};
  Extent out{0, 0, 0};
  for (const Decomposition& decomposition : task.decompositions) {
    std::size_t chains = 1;
    for (const Subtask& subtask : decomposition.subtasks) chains = times(chains, known[subtask.task].chains);
    std::size_t links = times(chains, decomposition.when.size());
    for (const Subtask& subtask : decomposition.subtasks) {
      const Extent& below = known[subtask.task];
      out.depth = std::max(out.depth, below.depth + 1);
      // Each way of the subtask stands in as many chains as the others have ways.
      links = plus(links, below.chains == 0 ? 0 : times(below.links, chains / below.chains));
    }
    out.chains = plus(out.chains, chains);
    out.links = plus(out.links, links);
  }
  return out;
}

// Depth first without recursion, since what came from outside may be deep.
class Walk {
 public:
  explicit Walk(const Network& network) : network_(network), state_(network.tasks.size()) {
    found_.extents.resize(network.tasks.size());
  }

  Hierarchy take() {
    for (TaskIndex index = 0; index < network_.tasks.size() && found_.cycle.empty(); ++index)
      if (state_[index] == State::unseen) visit(index);
    if (!found_.cycle.empty()) found_.extents.clear();
    return std::move(found_);
  }

 private:
  enum class State : char { unseen, open, done };
  struct Frame {
    TaskIndex task;
    std::vector<TaskIndex> children;
    std::size_t next = 0;
  };

  void visit(TaskIndex root) {
    std::vector<Frame> frames;
    const auto open = [&](TaskIndex index) {
      state_[index] = State::open;
      frames.push_back({index, children_of(network_.tasks[index])});
    };
    open(root);
    while (!frames.empty()) {
      Frame& frame = frames.back();
      if (frame.next == frame.children.size()) {
        found_.extents[frame.task] = extent_of(network_.tasks[frame.task], found_.extents);
        state_[frame.task] = State::done;
        frames.pop_back();
        continue;
      }
      const TaskIndex child = frame.children[frame.next++];
      if (state_[child] == State::unseen) {
        open(child);
      } else if (state_[child] == State::open) {
        const auto from = std::ranges::find(frames, child, &Frame::task);
        for (auto at = from; at != frames.end(); ++at) found_.cycle.push_back(at->task);
        return;
      }
    }
  }

  const Network& network_;
  std::vector<State> state_;
  Hierarchy found_;
};

}  // namespace

Hierarchy measure(const Network& network) { return Walk(network).take(); }

}  // namespace roci::planner::utility_htn::model
