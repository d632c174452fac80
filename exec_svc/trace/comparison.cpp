#include "exec_svc/trace/comparison.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace roci::exec::trace {
namespace {

/// Holds a row of neighbouring lines: [begin, end).
struct Row {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

/// Holds the lines of each side that have no partner, between two lines that have.
struct Gap {
  std::vector<std::size_t> before;
  std::vector<std::size_t> after;
};

Row lines_of_one_time(const std::vector<Line>& lines, std::size_t begin) {
  std::size_t end = begin;
  while (end < lines.size() && lines[end].time == lines[begin].time) ++end;
  return {begin, end};
}

/// Compares what two traces have at one mission time, and keeps what differs.
class Comparer {
 public:
  Comparer(Comparison& out, const TraceMap& map, const std::string& scenario) : out_(out), map_(map) {
    for (const Accepted& entry : map.accepted)
      if (entry.scenario.found_in(scenario)) accepted_.push_back(&entry);
  }

  void compare(const Row& before, const Row& after) {
    std::vector<Gap> gaps = gaps_between(before, after);
    for (const FreeOrder& order : map_.free_orders) pair_moved(gaps, order);
    for (Gap& gap : gaps) {
      accept(gap);
      keep(gap);
    }
  }

 private:
  bool same(std::size_t before, std::size_t after) const {
    return out_.before[before].text == out_.after[after].text;
  }

  /// Finds the longest common row of lines by dynamic programming (Wagner and Fischer 1974), and returns what
  /// lies between.
  std::vector<Gap> gaps_between(Row before, Row after) const {
    while (before.size() > 0 && after.size() > 0 && same(before.begin, after.begin)) {
      ++before.begin;
      ++after.begin;
    }
    while (before.size() > 0 && after.size() > 0 && same(before.end - 1, after.end - 1)) {
      --before.end;
      --after.end;
    }
    const std::size_t width = after.size() + 1;
    std::vector<std::uint32_t> longest((before.size() + 1) * width, 0);  // of the ends of both rows
    for (std::size_t i = before.size(); i-- > 0;) {
      for (std::size_t j = after.size(); j-- > 0;) {
        longest[i * width + j] = same(before.begin + i, after.begin + j)
                                     ? longest[(i + 1) * width + j + 1] + 1
                                     : std::max(longest[(i + 1) * width + j], longest[i * width + j + 1]);
      }
    }
    std::vector<Gap> gaps(1);
    for (std::size_t i = 0, j = 0; i < before.size() || j < after.size();) {
      const bool both = i < before.size() && j < after.size();
      if (both && same(before.begin + i, after.begin + j)) {
        ++i;
        ++j;
        gaps.emplace_back();
      } else if (j == after.size() || (both && longest[(i + 1) * width + j] >= longest[i * width + j + 1])) {
        gaps.back().before.push_back(before.begin + i++);
      } else {
        gaps.back().after.push_back(after.begin + j++);
      }
    }
    return gaps;
  }

  void pair_moved(std::vector<Gap>& gaps, const FreeOrder& order) const {
    const auto found_elsewhere = [&](std::size_t before) {
      const auto kind = out_.before[before].kind();
      if (std::ranges::find(order.kinds, kind) == order.kinds.end()) return false;
      for (Gap& gap : gaps) {
        const auto moved =
            std::ranges::find_if(gap.after, [&](std::size_t after) { return same(before, after); });
        if (moved == gap.after.end()) continue;
        gap.after.erase(moved);
        ++out_.uses[order.place];
        return true;
      }
      return false;
    };
    for (Gap& gap : gaps) std::erase_if(gap.before, found_elsewhere);
  }

  void accept(Gap& gap) const {
    for (const Accepted* entry : accepted_) {
      const auto accepts = [entry](const Line& line, const Pattern& pattern) {
        return line.time >= entry->since && pattern.found_in(line.text);
      };
      const auto old_line = [&](std::size_t i) { return accepts(out_.before[i], *entry->before); };
      const auto new_line = [&](std::size_t i) { return accepts(out_.after[i], *entry->after); };
      std::size_t count = 0;
      if (entry->before && entry->after) {
        count = accept_pairs(gap, old_line, new_line);
      } else if (entry->before) {
        count = std::erase_if(gap.before, old_line);
      } else {
        count = std::erase_if(gap.after, new_line);
      }
      out_.uses[entry->place] += count;
      out_.accepted += count;
    }
  }

  template <class OldLine, class NewLine>
  static std::size_t accept_pairs(Gap& gap, OldLine old_line, NewLine new_line) {
    return std::erase_if(gap.before, [&](std::size_t before) {
      if (!old_line(before)) return false;
      const auto partner = std::ranges::find_if(gap.after, new_line);
      if (partner == gap.after.end()) return false;
      gap.after.erase(partner);
      return true;
    });
  }

  void keep(const Gap& gap) {
    for (std::size_t i = 0; i < std::max(gap.before.size(), gap.after.size()); ++i) {
      Difference difference;
      if (i < gap.before.size()) difference.before = gap.before[i];
      if (i < gap.after.size()) difference.after = gap.after[i];
      out_.differences.push_back(difference);
    }
  }

  Comparison& out_;
  const TraceMap& map_;
  std::vector<const Accepted*> accepted_;  ///< Those of this scenario.
};

}  // namespace

Comparison compare(const RecordedTrace& before, const RecordedTrace& after, const TraceMap& map) {
  Comparison out;
  out.before = before.lines;
  for (Line& line : out.before) line.text = renamed(line.text, map, out.uses);
  out.after = without_additions(after.lines, map, out.uses);
  Comparer comparer(out, map, before.scenario.empty() ? after.scenario : before.scenario);
  std::size_t i = 0, j = 0;
  while (i < out.before.size() || j < out.after.size()) {
    Row old_row{i, i}, new_row{j, j};
    const bool only_new = i == out.before.size();
    const bool only_old = j == out.after.size();
    if (!only_new && (only_old || out.before[i].time <= out.after[j].time))
      old_row = lines_of_one_time(out.before, i);
    if (!only_old && (only_new || out.after[j].time <= out.before[i].time))
      new_row = lines_of_one_time(out.after, j);
    comparer.compare(old_row, new_row);
    i = old_row.end;
    j = new_row.end;
  }
  return out;
}

}  // namespace roci::exec::trace
