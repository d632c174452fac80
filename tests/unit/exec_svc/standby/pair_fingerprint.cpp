// Which worlds of a pair go on alike. Each epoch and each line adds to the numbers of a world though nothing else is new,
// so numbers count as far as rules can tell them apart: those to come follow on the newest ones, and of old ones the
// order alone is left.
#include <algorithm>
#include <functional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/pseudorandom/split_mix.hpp"
#include "tests/unit/exec_svc/standby/pair_world.hpp"

namespace roci::exec::testing {

using goals::GoalRecord;
using journal::Position;
using standby::Member;
using standby::Moment;

namespace {

constexpr std::uint64_t kEpochsBelow = 4;  // a rule compares an epoch with another plus one

std::uint64_t mixed(std::uint64_t before, std::uint64_t number) {
  return pseudorandom::finalized(before * 0x9e3779b97f4a7c15U + number + 1);
}

template <class T>
void sort_once(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class T>
std::uint64_t rank(const std::vector<T>& sorted, const T& value) {
  return static_cast<std::uint64_t>(std::ranges::lower_bound(sorted, value) - sorted.begin());
}

bool has_line(const std::vector<Line>& lines, const Position& at) {  // they rise
  const auto found = std::ranges::lower_bound(lines, at, {}, &Line::at);
  return found != lines.end() && found->at == at;
}

// What is seen of a world, one thing after the other.
class Sight {
 public:
  explicit Sight(Moment oldest) : oldest_(oldest) { things_.reserve(512); }

  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  void line(const Line& line) {
    (*this)(line.at, line.word, line.number);
    if (line.goal) goal(*line.goal);
  }
  void goal(const GoalRecord& goal) {
    (*this)(goal.state, goal.revision, goal.request.recalled, goal.request.priority);
  }

  // `end` is the last line that both journals have.
  std::uint64_t hash(std::uint64_t epochs_from, const Position& end, const std::vector<Line>& first,
                     const std::vector<Line>& second) {
    std::vector<std::uint64_t> old_epochs;
    std::vector<Position> old_positions;
    for (const Thing& thing : things_) {
      if (thing.kind != Kind::plain && thing.at.epoch < epochs_from) old_epochs.push_back(thing.at.epoch);
      if (thing.kind == Kind::position && thing.at <= end) old_positions.push_back(thing.at);
    }
    sort_once(old_epochs);
    sort_once(old_positions);
    std::uint64_t out = 0;
    for (const Thing& thing : things_) {
      out = mixed(out, static_cast<std::uint64_t>(thing.kind));
      if (thing.kind == Kind::plain) {
        out = mixed(out, thing.at.sequence);
        continue;
      }
      const std::uint64_t epoch = thing.at.epoch;
      const bool old = epoch < epochs_from;
      out = mixed(out, old ? 2 * rank(old_epochs, epoch) + 1 : 2 * (epoch - epochs_from));
      out = mixed(out, 2 * (epoch % 2) + (epoch == 0 ? 1 : 0));
      if (thing.kind == Kind::epoch) continue;
      const bool is_old = thing.at <= end;
      out = mixed(out, is_old ? rank(old_positions, thing.at) : thing.at.sequence - end.sequence);
      out = mixed(out, is_old | has_line(first, thing.at) << 1 | has_line(second, thing.at) << 2 |
                           (thing.at == Position{}) << 3);
    }
    return out;
  }

 private:
  enum class Kind { plain, epoch, position };
  struct Thing {
    Kind kind;
    Position at;  // plain: the sequence is the number
  };

  template <class T>
  void add(const T& value) {
    if constexpr (std::is_same_v<T, Position>) {
      things_.push_back({Kind::position, value});
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
      things_.push_back({Kind::epoch, {value, 0}});
    } else if constexpr (std::is_same_v<T, Moment>) {
      plain(static_cast<std::uint64_t>(std::min(value, oldest_).count()));
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      plain(std::hash<std::string_view>()(value));
    } else {
      plain(static_cast<std::uint64_t>(value));
    }
  }
  void plain(std::uint64_t number) { things_.push_back({Kind::plain, {0, number}}); }

  Moment oldest_;
  std::vector<Thing> things_;
};

}  // namespace

// A journal that is under way may take the place of one that has more lines.
std::size_t PairWorld::common_lines() const {
  const auto& first = members_[0].disk.lines;
  const auto common = [&](const std::vector<Line>& other) {
    return std::ranges::mismatch(first, other, {}, &Line::at, &Line::at).in1 - first.begin();
  };
  auto out = common(members_[1].disk.lines);
  for (const Message& message : under_way_)
    if (message.whole) out = std::min(out, common(message.lines));
  return static_cast<std::size_t>(out);
}

std::uint64_t PairWorld::fingerprint(Moment oldest) const {
  Sight see(oldest);
  const std::size_t common = common_lines();
  const auto& first = members_[0].disk.lines;
  const Position end = common == 0 ? Position{} : first[common - 1].at;
  // Of the lines of both, a new leader reads the commands since somebody led in doubt.
  const std::span both(first.data(), common);
  const auto doubted = std::ranges::find(both.rbegin(), both.rend(), Word::lead_in_doubt, &Line::word).base();
  for (const Line& line : std::span(doubted, both.end()))
    if (line.word == Word::command) see(line.at, line.number);
  for (const Member member : {Member::first, Member::second}) {
    const Process& process = members_[index(member)];
    const auto& term = process.disk.persisted_term;
    see("|", term.epoch, term.alone, term.holds);
    for (const Line& line : std::span(process.disk.lines).subspan(common)) see.line(line);
    see("/");
    for (const auto& [number, goal] : process.disk.goals) see(number), see.goal(goal);
    see("/");
    for (const auto& [number, goal] : process.disk.apart) see(number), see.goal(goal);
    see("/", process.lease.has_value());
    if (!process.lease) continue;
    process.lease->show(see, clock(member));
    if (process.other) see(process.other->has, process.other->role);
    if (process.lease->role() != standby::Role::leading) continue;
    see("/");
    for (const Line& line : process.unsent) see.line(line);
    see("/");
    for (const Line& line : process.waiting) see.line(line);
    see("/");
    for (const int goal : process.commanded) see(goal);
    see(process.leads_in, process.fed, process.told_alone.has_value(),
        process.told_alone.value_or(Position{}));
  }
  for (const Owner& owner : owners_) {
    see("|", owner.epoch);
    owner.leases.show(see, owner_clock());
    for (const Position& done : owner.done) see(done);
  }
  see("|", network.cut);
  for (const auto& links : network.owner_cut)
    for (const bool link : links) see(link);
  for (const bool link : network.ground_cut) see(link);
  for (const Wish& wish : wishes_) see(wish.what, wish.goal);
  see("/");
  for (const auto& [goal, one] : acknowledged_)
    see(goal, one.revision, one.recalled, one.recall_held, one.held, one.held ? Member::first : one.by);
  for (const auto& [goal, count] : effects_) see(goal, count);
  // No right holds for two terms.
  const auto in_time = [this](Moment age) { return std::min(age, 2 * settings_.term); };
  for (const Message& message : under_way_) {
    see("|", message.to, message.to_owner, message.leader, message.after, message.whole);
    if (const auto& said = message.message) {
      see("message", said->member, said->role, said->epoch, said->has, said->entitled, said->receipt,
          said->searching, in_time(clock(said->member) - said->said));
      // What was said to one that has died is too early for the next.
      if (alive(message.to)) see(in_time(clock(message.to) - said->echo));
    }
    if (const auto& report = message.report) {
      const Member holder = report->holder.value_or(Member::first);
      see("report", report->owner, report->holder.has_value(), holder, report->epoch, report->newest_epoch,
          std::min(clock(holder) - report->echo, report->term), report->term);
    }
    if (const auto& asked = message.request) {
      see("request", asked->member, asked->epoch, asked->wanted, asked->leads, asked->term,
          clock(asked->member) - asked->said);
    }
    for (const Line& line : message.lines)
      if (line.at > end || !has_line(first, line.at)) see.line(line);
    if (!message.lines.empty()) see(message.lines.back().at);
    if (message.handed_over) see.goal(*message.handed_over);
  }
  const std::uint64_t lowest =
      std::min(members_[0].disk.persisted_term.epoch, members_[1].disk.persisted_term.epoch);
  return see.hash(lowest > kEpochsBelow ? (lowest - kEpochsBelow) / 2 * 2 : 0, end, first,
                  members_[1].disk.lines);
}

}  // namespace roci::exec::testing
