#include "tests/unit/exec_svc/standby/pair_world.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::testing {

using journal::Position;
using standby::Lease;
using standby::LeaseSettings;
using standby::Member;
using standby::Moment;
using standby::Role;

namespace {

constexpr Moment kStep = std::chrono::milliseconds(10);

bool contains(const std::vector<Line>& lines, const std::string& text) {
  return std::ranges::any_of(lines, [&](const Line& line) { return line.text == text; });
}

}  // namespace

PairWorld::PairWorld(std::uint64_t seed, const LeaseSettings& settings) : random_(seed), settings_(settings) {
  start(Member::first);
  start(Member::second);
}

void PairWorld::start(Member member, bool superseded) {
  Process& process = at(member);
  process.lease = std::make_unique<Lease>(member, settings_, process.disk.persisted_term, superseded, now_);
  process.paused = false;
  process.unsent.clear();
  process.late.reset();
  process.other.reset();
}

void PairWorld::kill(Member member) {
  at(member).lease.reset();
  at(member).unsent.clear();
}

void PairWorld::resume(Member member) {
  Process& process = at(member);
  process.paused = process.stops_before_sending = false;
  if (const auto late = std::exchange(process.late, std::nullopt); late && process.lease)
    command(member, *late);
}

void PairWorld::run(Moment time) {
  for (const Moment end = now_ + time; now_ < end;) step();
}

void PairWorld::step() {
  now_ += kStep;
  for (const Member member : {Member::first, Member::second}) act(member);
}

void PairWorld::post(Message message) {
  if (network.cut || static_cast<int>(random_() % 100) < network.loss_percent) return;
  message.due = now_ + Moment(static_cast<std::int64_t>(random_() % (network.longest_delay.count() + 1)));
  under_way_.push_back(std::move(message));
}

void PairWorld::act(Member member) {
  Process& process = at(member);
  if (!process.lease || process.paused) return;
  std::vector<Message> mine;
  std::erase_if(under_way_, [&](const Message& message) {
    if (message.to != member || message.due > now_) return false;
    mine.push_back(message);
    return true;
  });
  for (const Message& message : mine) take(member, message);
  const bool by_right =
      process.lease->message(process.disk.newest()).entitled && !process.disk.persisted_term.alone;
  const Lease::Turn turn = process.lease->turn(process.disk.newest(), now_);
  process.disk.persisted_term = process.lease->persisted_term();
  if (turn.change != Lease::Change::none) process.last_change = turn.change;
  if (turn.change == Lease::Change::stand_down) return start(member, process.lease->superseded());
  if (turn.change == Lease::Change::lead && by_right) check_right(process);
  if (turn.doubtful) ledger_.clear();  // it plans anew, and lacks what it lacks
  if (turn.change == Lease::Change::lead) lead(member);
  if (turn.speak) post({{}, other(member), process.lease->message(process.disk.newest()), 0, {}, {}, false});
  if (process.lease->role() != Role::leading) return;
  work(member);
  feed(member);
  send_unsent(member);
}

void PairWorld::take(Member member, const Message& message) {
  Process& process = at(member);
  if (message.message) {
    process.lease->hear(*message.message, now_);
    process.other = message.message;
    return;
  }
  if (process.lease->role() == Role::leading || message.leader < process.lease->epoch()) return;
  process.lease->hear_leader(message.leader, now_);
  if (message.whole) {
    // Goals that only this one knew are asked for again.
    for (const Line& line : std::exchange(process.disk.lines, message.lines)) {
      if (line.text.starts_with("goal ") && !contains(process.disk.lines, line.text))
        replan_wanted_.insert(std::stoi(line.text.substr(5)));
    }
  } else if (message.after == process.disk.newest()) {
    process.disk.lines.insert(process.disk.lines.end(), message.lines.begin(), message.lines.end());
  }
  post({{}, other(member), process.lease->message(process.disk.newest()), 0, {}, {}, false});
}

// As after a restart: the owner is asked with the new epoch, and what was decided is sent again.
void PairWorld::lead(Member member) {
  ++leads_;
  Process& process = at(member);
  process.fed = process.disk.newest();
  command(member, {{}, "query"});
  process.unsent.assign(process.disk.lines.begin(), process.disk.lines.end());
  commit(process, "lead");
}

void PairWorld::commit(Process& process, const std::string& text) {
  const Position at{process.lease->epoch(), process.disk.newest().sequence + 1};
  process.disk.lines.push_back({at, text});
  process.unsent.push_back({at, text});
}

// Who leads because the last leader said that it may has all that an owner ever carried out.
void PairWorld::check_right(const Process& process) {
  for (const Position& done : ledger_) {
    if (std::ranges::find(process.disk.lines, done, &Line::at) == process.disk.lines.end())
      faults.push_back("a leader by right lacks " + std::to_string(done.epoch) + ":" +
                       std::to_string(done.sequence));
  }
}

void PairWorld::work(Member member) {
  Process& process = at(member);
  for (const int goal : replan_wanted_) {
    const std::string text = "goal " + std::to_string(goal);
    if (!contains(process.disk.lines, text)) commit(process, text);
  }
  if (random_() % 20 == 0) commit(process, "command");
}

void PairWorld::feed(Member member) {
  Process& process = at(member);
  if (!process.other || process.other->role == Role::leading) return;
  const Position has = process.other->has;
  const auto& lines = process.disk.lines;
  const auto known = std::ranges::find(lines, has, &Line::at);
  const bool whole = known == lines.end() && has != Position{};
  if (now_ - process.fed_at > std::chrono::milliseconds(300) || process.fed < has) {
    process.fed = has;
    process.fed_at = now_;
  } else if (whole) {
    return;
  }
  const auto from = whole ? lines.begin() : std::ranges::upper_bound(lines, process.fed, {}, &Line::at);
  if (from == lines.end()) return;
  const Position after = from == lines.begin() ? Position{} : std::prev(from)->at;
  post({{}, other(member), std::nullopt, process.lease->epoch(), after, {from, lines.end()}, whole});
  process.fed = lines.back().at;
}

void PairWorld::send_unsent(Member member) {
  Process& process = at(member);
  while (!process.unsent.empty() && process.lease->may_send(process.unsent.front().at, now_)) {
    if (std::exchange(process.stops_before_sending, false)) {
      process.paused = true;
      process.late = process.unsent.front();
      process.unsent.pop_front();
      return;
    }
    command(member, process.unsent.front());
    process.unsent.pop_front();
  }
}

void PairWorld::command(Member member, const Line& decision) {
  const std::uint64_t epoch = at(member).lease->epoch();
  if (decision.text.starts_with("goal ")) {
    const int goal = std::stoi(decision.text.substr(5));
    acknowledged_.insert(goal);
    replan_wanted_.erase(goal);
    return;
  }
  if (epoch < owner_epoch_) {
    ++refused_;
    return at(member).lease->refused(owner_epoch_);
  }
  owner_epoch_ = epoch;
  const auto [commander, fresh] = commanders_.try_emplace(epoch, member);
  if (commander->second != member) faults.push_back("two leaders of epoch " + std::to_string(epoch));
  if (decision.text == "command" && ledger_.insert(decision.at).second) ++carried_out_;
}

std::optional<Member> PairWorld::leader() const {
  for (const Member member : {Member::first, Member::second}) {
    const Process& process = members_[index(member)];
    if (process.lease && !process.paused && process.lease->role() == Role::leading) return member;
  }
  return std::nullopt;
}

bool PairWorld::copy_is_near() const {
  const auto& first = members_[0].disk.lines;
  const auto& second = members_[1].disk.lines;
  const auto [a, b] = std::ranges::mismatch(first, second);
  return (a == first.end() || b == second.end()) && first.end() - a <= 3 && second.end() - b <= 3;
}

bool PairWorld::has_goal(Member member, int goal) const {
  return contains(disk(member).lines, "goal " + std::to_string(goal));
}

}  // namespace roci::exec::testing
