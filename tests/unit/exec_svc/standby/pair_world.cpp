#include "tests/unit/exec_svc/standby/pair_world.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "exec_svc/goals/goal_merge.hpp"

namespace roci::exec::testing {

using goals::GoalRecord;
using goals::GoalState;
using journal::Position;
using standby::Lease;
using standby::LeaseReport;
using standby::LeaseSettings;
using standby::Member;
using standby::Moment;
using standby::Role;

namespace {

constexpr int kRounds = 4;  // of a step in which every message comes: asked, answered, acted on, copied
constexpr char kCommander[] = "exec_svc";

std::string owner_name(int owner) { return "owner-" + std::to_string(owner); }
int owner_of(int goal) { return goal % PairWorld::kOwners; }
std::string name_of(Member member) { return member == Member::first ? "first" : "second"; }

std::set<std::string> owner_names() {
  std::set<std::string> out;
  for (int owner = 0; owner < PairWorld::kOwners; ++owner) out.insert(owner_name(owner));
  return out;
}

GoalRecord new_goal(int number) {
  GoalRecord out;
  out.request.key = {"ground", std::to_string(number)};
  out.request.kind = "photo";
  return out;
}

int number_of(const GoalRecord& goal) { return std::stoi(goal.request.key.id); }

}  // namespace

void Disk::write(Line line) {
  if (line.goal) goals[line.number] = *line.goal;
  lines.push_back(std::move(line));
}

PairWorld::PairWorld(std::uint64_t seed, const LeaseSettings& settings, Bug bug)
    : random_(seed), settings_(settings), bug_(bug) {
  start(Member::first);
  start(Member::second);
}

Moment PairWorld::clock(Member member) const {
  return now_ + std::chrono::seconds(member == Member::first ? 100 : 5);
}

Moment PairWorld::owner_clock() const { return now_ + std::chrono::seconds(3600); }

bool PairWorld::reaches(Member member, int owner) const { return !network.owner_cut[index(member)][owner]; }

void PairWorld::start(Member member, bool superseded) {
  Process& process = at(member);
  const std::set<std::string> owners = bug_ == Bug::no_owner_leases ? std::set<std::string>{} : owner_names();
  process.lease.emplace(member, settings_, process.disk.persisted_term, superseded, clock(member), owners);
  process.paused = false;
  process.unsent.clear();
  process.waiting.clear();
  process.late.reset();
  process.owner_heard.clear();
  process.other.reset();
  process.told_alone.reset();
}

void PairWorld::kill(Member member) {
  at(member).lease.reset();
  at(member).unsent.clear();
  at(member).waiting.clear();
}

void PairWorld::lose_disk(Member member) {
  at(member).disk = {};
  std::erase_if(acknowledged_, [&](const auto& one) { return !one.second.held && one.second.by == member; });
  for (auto& [goal, one] : acknowledged_)
    if (!one.recall_held && one.by == member) one.recalled = false;
}

void PairWorld::resume(Member member) {
  Process& process = at(member);
  process.paused = process.stops_before_sending = false;
  if (const auto late = std::exchange(process.late, std::nullopt); late && process.lease) send(member, *late);
}

void PairWorld::run(Moment time) {
  for (const Moment end = now_ + time; now_ < end;) step();
}

void PairWorld::step() {
  now_ += step_;
  for (int i = 0; i < (eager_ ? kRounds : 1); ++i) round();
}

void PairWorld::round() {
  deliver_to_owners();
  for (const Member member : {Member::first, Member::second}) act(member);
  check_dispatchers();
}

// Whether or not they can know of each other.
void PairWorld::check_dispatchers() {
  if (commands(Member::first) && commands(Member::second)) faults.push_back("two dispatch");
}

bool PairWorld::commands(Member member) const {
  const Process& process = members_[index(member)];
  return process.lease && process.lease->may_command(clock(member));
}

void PairWorld::post(Message message, bool cut) {
  if (cut || static_cast<int>(random_() % 100) < network.loss_percent) return;
  message.due = now_ + Moment(static_cast<std::int64_t>(random_() % (network.longest_delay.count() + 1)));
  under_way_.push_back(std::move(message));
}

void PairWorld::deliver_to_owners() {
  std::vector<Message> mine;
  std::erase_if(under_way_, [&](const Message& message) {
    if (message.to_owner < 0 || message.due > now_) return false;
    mine.push_back(message);
    return true;
  });
  for (const Message& message : mine) {
    Owner& owner = owners_[message.to_owner];
    const auto& request = *message.request;
    const auto grant = owner.leases.ask({kCommander, name_of(request.member), request.epoch, request.wanted,
                                         request.leads, request.term, request.said},
                                        owner.epoch, owner_clock());
    LeaseReport report;
    report.owner = owner_name(message.to_owner);
    if (!grant.member.empty()) report.holder = grant.member == "first" ? Member::first : Member::second;
    report.epoch = grant.epoch;
    report.newest_epoch = std::max(owner.epoch, owner.leases.newest_led(kCommander));
    report.echo = grant.echo;
    report.term = grant.term;
    for (const Member member : {Member::first, Member::second}) {
      Message out;
      out.to = member;
      out.report = report;
      post(std::move(out), !reaches(member, message.to_owner));
    }
  }
}

// Who starts hears what the other member and the owners said last; nobody has taken all else.
void PairWorld::keep_newest(Member dead) {
  std::set<std::string> heard;
  std::vector<Message> kept;
  for (auto message = under_way_.rbegin(); message != under_way_.rend(); ++message) {
    const bool arrived = message->to_owner < 0 && message->to == dead && message->due <= now_;
    const bool latched = message->message || message->report;
    const std::string who = message->report ? message->report->owner : "member";
    if (!arrived || (latched && heard.insert(who).second)) kept.push_back(std::move(*message));
  }
  under_way_.assign(std::make_move_iterator(kept.rbegin()), std::make_move_iterator(kept.rend()));
}

void PairWorld::act(Member member) {
  Process& process = at(member);
  if (!process.lease) return keep_newest(member);
  if (process.paused) return;
  std::vector<Message> mine;
  std::erase_if(under_way_, [&](const Message& message) {
    if (message.to_owner >= 0 || message.to != member || message.due > now_) return false;
    mine.push_back(message);
    return true;
  });
  for (const Message& message : mine) take(member, message);
  if (bug_ == Bug::silent_owner_not_held) {
    std::set<std::string> living;
    for (const auto& [owner, heard] : process.owner_heard)
      if (clock(member) - heard <= settings_.term) living.insert(owner);
    process.lease->require(living.empty() ? owner_names() : living);
  }
  const Lease::Turn turn = process.lease->turn(process.disk.newest(), clock(member));
  process.disk.persisted_term = process.lease->persisted_term();
  if (turn.change != Lease::Change::none) process.last_change = turn.change;
  if (turn.change == Lease::Change::stand_down) return start(member, process.lease->superseded());
  const bool by_right = turn.reason.starts_with("the leader of epoch");
  if (turn.change == Lease::Change::lead && by_right) check_right(process);
  if (turn.change == Lease::Change::lead) lead(member, turn.doubtful);
  if (turn.speak) speak(member);
  if (process.lease->role() != Role::leading) return;
  hear_ground(member);
  work(member);
  feed(member);
  send_unsent(member);
}

void PairWorld::speak(Member member) {
  Process& process = at(member);
  Message message;
  message.to = other(member);
  message.message = process.lease->message(process.disk.newest());
  post(std::move(message), network.cut);
  for (int owner = 0; owner < kOwners; ++owner) {
    Message request;
    request.to_owner = owner;
    request.request = process.lease->request();
    post(std::move(request), !reaches(member, owner));
  }
  if (process.lease->role() == Role::leading) return;
  for (const auto& [number, goal] : process.disk.apart) {
    Message out;
    out.to = other(member);
    out.handed_over = goal;
    post(std::move(out), network.cut);
  }
}

void PairWorld::take(Member member, const Message& message) {
  Process& process = at(member);
  if (message.report) {
    process.owner_heard[message.report->owner] = clock(member);
    return process.lease->hear(*message.report, clock(member));
  }
  if (message.message) {
    process.lease->hear(*message.message, clock(member));
    process.other = message.message;
    return;
  }
  const bool leads = process.lease->role() == Role::leading;
  if (message.handed_over) {
    if (leads) merge(process, *message.handed_over);
    return;
  }
  if (leads || message.leader < process.lease->epoch()) return;
  process.lease->hear_leader(message.leader, clock(member));
  Disk& disk = process.disk;
  if (message.whole) {
    if (bug_ != Bug::goals_not_merged) {
      for (const auto& [number, goal] : disk.goals) {
        const auto [known, is_new] = disk.apart.try_emplace(number, goal);
        if (const auto both = goals::merged(known->second, goal)) known->second = *both;
      }
    }
    disk.lines.clear();
    disk.goals.clear();
    for (const Line& line : message.lines) disk.write(line);
  } else if (message.after == disk.newest()) {
    for (const Line& line : message.lines) disk.write(line);
  }
  std::erase_if(disk.apart, [&](const auto& one) {
    const auto known = disk.goals.find(one.first);
    return known != disk.goals.end() && !goals::merged(known->second, one.second);
  });
  Message receipt;
  receipt.to = other(member);
  receipt.message = process.lease->message(disk.newest());
  post(std::move(receipt), network.cut);
}

// As after a restart: what was decided is sent again under its key; in doubt all is planned anew.
void PairWorld::lead(Member member, bool doubtful) {
  ++leads_;
  Process& process = at(member);
  process.leads_in = process.lease->epoch();
  process.fed = process.disk.newest();
  process.commanded.clear();
  process.unsent.clear();
  for (const Line& line : process.disk.lines) {
    if (line.word == Word::lead_in_doubt) {  // what was commanded before was forgotten
      process.commanded.clear();
      process.unsent.clear();
    }
    if (line.word != Word::command || doubtful) continue;
    process.commanded.insert(line.number);
    if (!is_final(process.disk.goals.at(line.number).state)) process.unsent.push_back(line);
  }
  commit(process, doubtful ? Word::lead_in_doubt : Word::lead);
  for (const auto& [number, goal] : process.disk.goals)  // the ground is told where it all stands
    process.unsent.push_back(
        {process.disk.newest(), Word::status, number, std::make_shared<GoalRecord>(goal)});
  for (const auto& [number, goal] : std::exchange(process.disk.apart, {})) merge(process, goal);
}

void PairWorld::commit(Process& process, Word word, int number, const std::optional<GoalRecord>& goal) {
  const Position at{process.leads_in, process.disk.newest().sequence + 1};
  const Line line{at, word, number, goal ? std::make_shared<GoalRecord>(*goal) : nullptr};
  process.disk.write(line);
  process.unsent.push_back(line);
}

void PairWorld::merge(Process& process, const GoalRecord& theirs) {
  const int number = number_of(theirs);
  GoalRecord record = theirs;
  if (bug_ == Bug::recall_not_merged) record.request.recalled = false;
  if (bug_ == Bug::recall_not_merged && record.state == GoalState::recalled)
    record.state = GoalState::pending;
  const auto known = process.disk.goals.find(number);
  if (known != process.disk.goals.end()) {
    const auto both = goals::merged(known->second, record);
    if (!both) return;
    record = *both;
  }
  commit(process, Word::merge, number, record);
}

// Who leads because the last leader said that it may has all that an owner ever carried out in that one's epochs.
void PairWorld::check_right(const Process& process) {
  for (const Owner& owner : owners_) {
    for (const Position& done : owner.done) {
      if (std::ranges::find(process.disk.lines, done, &Line::at) == process.disk.lines.end() &&
          done.epoch >= process.disk.newest().epoch)
        faults.push_back("a leader by right lacks " + std::to_string(done.epoch) + ":" +
                         std::to_string(done.sequence));
    }
  }
}

void PairWorld::hear_ground(Member member) {
  if (network.ground_cut[index(member)]) return;
  Process& process = at(member);
  for (const Wish& wish : wishes_) {
    const auto known = process.disk.goals.find(wish.goal);
    const bool is_new = known == process.disk.goals.end();
    if (wish.what == Word::goal) {
      if (is_new) commit(process, Word::goal, wish.goal, new_goal(wish.goal));
      continue;
    }
    if (is_new) continue;
    GoalRecord record = known->second;
    if (wish.what == Word::recall) {
      if (record.request.recalled) continue;
      record.request.recalled = true;
      ++record.revision;
      if (!is_final(record.state)) record.state = GoalState::recalled;
    } else {
      if (record.request.priority >= wish.goal || is_final(record.state)) continue;
      record.request.priority = wish.goal;
      ++record.revision;
    }
    commit(process, wish.what, wish.goal, record);
  }
}

void PairWorld::work(Member member) {
  Process& process = at(member);
  std::vector<std::pair<int, std::optional<GoalRecord>>> decided;  // a record: done
  for (const auto& [number, goal] : process.disk.goals) {
    if (is_final(goal.state)) continue;
    if (effects(number) > 0 && reaches(member, owner_of(number))) {
      GoalRecord done = goal;
      done.state = GoalState::achieved;
      decided.emplace_back(number, done);
    } else if (!process.commanded.contains(number) && reaches(member, owner_of(number)) &&
               (eager_ || random_() % 50 == 0)) {
      process.commanded.insert(number);
      decided.emplace_back(number, std::nullopt);
    }
  }
  for (const auto& [number, done] : decided)
    commit(process, done ? Word::done : Word::command, number, done);
}

void PairWorld::feed(Member member) {
  Process& process = at(member);
  if (!process.other || process.other->role == Role::leading) return;
  const Position has = process.other->has;
  const auto& lines = process.disk.lines;
  const auto known = std::ranges::find(lines, has, &Line::at);
  const bool whole = known == lines.end() && has != Position{};
  const bool again = now_ - process.fed_at > std::chrono::milliseconds(300) && (!eager_ || has < process.fed);
  if (again || process.fed < has) {
    process.fed = has;
    process.fed_at = now_;
  } else if (whole) {
    return;
  }
  const auto from = whole ? lines.begin() : std::ranges::upper_bound(lines, process.fed, {}, &Line::at);
  if (from == lines.end()) return;
  Message out;
  out.to = other(member);
  out.leader = process.lease->epoch();
  out.after = from == lines.begin() ? Position{} : std::prev(from)->at;
  out.lines = {from, lines.end()};
  out.whole = whole;
  post(std::move(out), network.cut);
  process.fed = lines.back().at;
}

void PairWorld::send_unsent(Member member) {
  Process& process = at(member);
  const auto now = clock(member);
  if (process.told_alone && process.lease->held_by_both(*process.told_alone)) {
    for (auto& [goal, one] : acknowledged_) {
      if (one.by != member || !process.disk.goals.contains(goal)) continue;
      one.held = true;
      one.recall_held = one.recall_held || one.recalled;
    }
    process.told_alone.reset();
  }
  while (!process.waiting.empty() && process.lease->may_command(now)) {
    send(member, process.waiting.front());
    process.waiting.pop_front();
  }
  while (!process.unsent.empty()) {
    const Line line = process.unsent.front();
    const bool early = bug_ == Bug::acknowledges_early && line.word != Word::command;
    if (!early && !process.lease->may_send(line.at, now)) return;
    if (line.word == Word::command && !process.lease->may_command(now)) {
      const auto since = process.lease->unleased_since();
      if (!since || now - *since < settings_.term) return;
      process.unsent.pop_front();
      process.waiting.push_back(line);
      continue;
    }
    process.unsent.pop_front();
    if (line.word == Word::command && std::exchange(process.stops_before_sending, false)) {
      process.paused = true;
      process.late = line;
      return;
    }
    send(member, line);
  }
}

void PairWorld::send(Member member, const Line& line) {
  Process& process = at(member);
  if (line.word == Word::command) return command(member, line);
  const bool told_here = line.word == Word::recall;  // else the other executive was told
  if (line.goal && line.goal->request.recalled && (told_here || bug_ != Bug::recall_lets_waiting_go))
    std::erase_if(process.waiting, [&](const Line& other) { return other.number == line.number; });
  if (line.goal) acknowledge(member, line);
}

void PairWorld::acknowledge(Member member, const Line& line) {
  if (network.ground_cut[index(member)]) return;
  const int number = line.number;
  Process& process = at(member);
  const bool held = process.lease->held_by_both(line.at) || bug_ == Bug::acknowledges_early;
  if (!held) process.told_alone = line.at;
  Acknowledged& known = acknowledged_[number];
  const bool news = line.goal->revision >= known.revision;
  if (news)
    known = {line.goal->revision, line.goal->request.recalled || known.recalled,
             (line.goal->request.recalled && held) || known.recall_held, held, member};
  std::erase_if(wishes_, [&](const Wish& wish) {
    if (wish.goal != number) return false;
    if (wish.what == Word::goal) return true;
    return wish.what == Word::recall ? line.goal->request.recalled
                                 : line.goal->request.priority >= wish.goal || is_final(line.goal->state);
  });
}

void PairWorld::command(Member member, const Line& line) {
  const int goal = line.number;
  Owner& owner = owners_[owner_of(goal)];
  if (!reaches(member, owner_of(goal))) return;
  const std::uint64_t epoch = at(member).lease->epoch();
  if (!owner.leases.admits(kCommander, epoch, owner_clock()) || epoch < owner.epoch) {
    ++refused_;
    return at(member).lease->refused(
        std::max(owner.epoch, owner.leases.grant(kCommander, owner_clock()).epoch));
  }
  owner.epoch = epoch;
  const auto [commander, fresh] = commanders_.try_emplace(epoch, member);
  if (commander->second != member) faults.push_back("two leaders of epoch " + std::to_string(epoch));
  if (!owner.done.insert(line.at).second) return;
  ++carried_out_;
  if (++effects_[goal] > 1) faults.push_back("goal " + std::to_string(goal) + " was flown twice");
  if (acknowledged_.contains(goal) && acknowledged_.at(goal).recall_held)
    faults.push_back("goal " + std::to_string(goal) + " was flown after its recall");
}

std::optional<Member> PairWorld::leader() const {
  for (const Member member : {Member::first, Member::second}) {
    const Process& process = members_[index(member)];
    if (process.lease && !process.paused && process.lease->role() == Role::leading) return member;
  }
  return std::nullopt;
}

bool PairWorld::copy_is_near() const {
  if (!members_[0].disk.apart.empty() || !members_[1].disk.apart.empty()) return false;
  const auto& first = members_[0].disk.lines;
  const auto& second = members_[1].disk.lines;
  const auto [a, b] = std::ranges::mismatch(first, second, {}, &Line::at, &Line::at);
  return (a == first.end() || b == second.end()) && first.end() - a <= 3 && second.end() - b <= 3;
}

std::set<int> PairWorld::acknowledged_goals() const {
  std::set<int> out;
  for (const auto& [goal, one] : acknowledged_) out.insert(goal);
  return out;
}

std::vector<std::string> PairWorld::lost() const {
  std::vector<std::string> out;
  const auto leading = leader();
  for (const auto& [goal, one] : acknowledged_) {
    const std::string name = "goal " + std::to_string(goal);
    if (!leading || !disk(*leading).goals.contains(goal)) {
      out.push_back(name);
      continue;
    }
    const GoalRecord& record = disk(*leading).goals.at(goal);
    if (record.revision < one.revision) out.push_back("a change of " + name);
    // Of a goal that was achieved before it was recalled the leader's wish counts (goal_merge.hpp).
    const bool ended = record.state == GoalState::recalled || record.state == GoalState::achieved;
    if (one.recalled && !ended) out.push_back("the recall of " + name);
  }
  return out;
}

}  // namespace roci::exec::testing
