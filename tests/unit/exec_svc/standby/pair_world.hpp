// Two members of a pair, a bad network between them, an owner of commands and somebody who asks for goals:
// what the rules of the lease promise, watched at every step. Wall time goes on in steps of 10 ms.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/standby/lease.hpp"

namespace roci::exec::testing {

// A journal of which each commit is one line.
struct Line {
  journal::Position at;
  std::string text;  // "goal 7", "command" or "lead"
  bool operator==(const Line&) const = default;
};

// What survives the death of a member.
struct Disk {
  standby::PersistedTerm persisted_term;
  std::vector<Line> lines;
  journal::Position newest() const { return lines.empty() ? journal::Position{} : lines.back().at; }
};

struct Network {
  int loss_percent = 0;
  standby::Moment longest_delay{0};
  bool cut = false;  // between the members; the owner hears both
};

class PairWorld {
 public:
  PairWorld(std::uint64_t seed, const standby::LeaseSettings& settings);

  void run(standby::Moment time);

  Network network;
  void kill(standby::Member member);
  void start(standby::Member member) { start(member, false); }
  void pause(standby::Member member) { at(member).paused = true; }
  void resume(standby::Member member);
  bool alive(standby::Member member) const { return members_[index(member)].lease != nullptr; }
  bool paused(standby::Member member) const { return members_[index(member)].paused; }
  void lose_disk(standby::Member member) { at(member).disk = {}; }
  void drop_messages() { under_way_.clear(); }
  void ask_for_a_goal() { replan_wanted_.insert(++goals_); }
  // It is paused between looking at its lease and sending, the next time; resumed, it sends first.
  void stop_before_sending(standby::Member member) { at(member).stops_before_sending = true; }

  std::optional<standby::Member> leader() const;  // the one that leads and is neither dead nor paused
  const Disk& disk(standby::Member member) const { return members_[index(member)].disk; }
  standby::Lease::Change last_change(standby::Member member) const {
    return members_[index(member)].last_change;
  }
  standby::Moment now() const { return now_; }
  int leads() const { return leads_; }
  std::size_t acknowledged() const { return acknowledged_.size(); }
  std::size_t carried_out() const { return carried_out_; }
  std::size_t refused() const { return refused_; }
  standby::Lease& lease(standby::Member member) { return *at(member).lease; }
  // One journal is the other but for its newest lines, three at most.
  bool copy_is_near() const;
  bool has_goal(standby::Member member, int goal) const;
  const std::set<int>& acknowledged_goals() const { return acknowledged_; }

  std::vector<std::string> faults;  // what must never be

 private:
  struct Process {
    Disk disk;
    std::unique_ptr<standby::Lease> lease;  // none: dead
    bool paused = false;
    bool stops_before_sending = false;
    std::deque<Line> unsent;
    std::optional<Line> late;
    std::optional<standby::LeaseMessage> other;  // newest word of the other, as far as the copy is concerned
    journal::Position fed;                       // up to which lines are under way
    standby::Moment fed_at{0};
    standby::Lease::Change last_change = standby::Lease::Change::none;
  };
  struct Message {
    standby::Moment due;
    standby::Member to;
    std::optional<standby::LeaseMessage> message;
    std::uint64_t leader = 0;  // of the lines
    journal::Position after;   // none of the sender's lines before them: the whole journal
    std::vector<Line> lines;
    bool whole = false;
  };
  static std::size_t index(standby::Member member) { return member == standby::Member::first ? 0 : 1; }
  static standby::Member other(standby::Member member) {
    return member == standby::Member::first ? standby::Member::second : standby::Member::first;
  }
  Process& at(standby::Member member) { return members_[index(member)]; }
  void start(standby::Member member, bool superseded);
  void step();
  void act(standby::Member member);
  void take(standby::Member member, const Message& message);
  void lead(standby::Member member);
  void work(standby::Member member);
  void feed(standby::Member member);
  void check_right(const Process& process);
  void commit(Process& process, const std::string& text);
  void send_unsent(standby::Member member);
  void command(standby::Member member, const Line& decision);
  void post(Message message);

  std::mt19937_64 random_;
  standby::LeaseSettings settings_;
  standby::Moment now_{0};
  Process members_[2];
  std::vector<Message> under_way_;
  int goals_ = 0;
  std::set<int> replan_wanted_;  // not acknowledged yet: their issuer asks again
  std::set<int> acknowledged_;
  std::uint64_t owner_epoch_ = 0;
  std::map<std::uint64_t, standby::Member> commanders_;  // by epoch
  std::set<journal::Position> ledger_;  // commands carried out, by their place in the journal
  std::size_t carried_out_ = 0;
  std::size_t refused_ = 0;
  int leads_ = 0;
};

}  // namespace roci::exec::testing
