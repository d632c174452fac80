// Two members of a pair, three owners of commands and the ground, with a link between any two of them that may be cut,
// lose and delay: what the rules of the lease and of merged goals promise, watched at every step. Wall time goes on in
// steps of 10 ms; every host has a clock of its own.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/standby/lease.hpp"
#include "services/owner/commander_leases.hpp"

namespace roci::exec::testing {

enum class Word : std::uint8_t { goal, recall, change, merge, done, command, status, lead, lead_in_doubt };

// A commit of a journal: what it says of which goal, and the goal's record that it writes.
struct Line {
  journal::Position at;
  Word word;
  int number = 0;
  std::shared_ptr<const goals::GoalRecord> goal{};
};

// What survives the death of a member.
struct Disk {
  standby::PersistedTerm persisted_term;
  std::vector<Line> lines;
  std::map<int, goals::GoalRecord> goals;  // by the lines
  std::map<int, goals::GoalRecord> apart;  // of a journal that was replaced, until the leader has them
  journal::Position newest() const { return lines.empty() ? journal::Position{} : lines.back().at; }
  void write(Line line);
};

struct Network {
  int loss_percent = 0;
  standby::Moment longest_delay{0};
  bool cut = false;                                // between the members
  std::array<std::array<bool, 3>, 2> owner_cut{};  // between a member and an owner
  std::array<bool, 2> ground_cut{};                // between a member and the ground
};

// What the tests plant to see that they can fail.
enum class Bug {
  none,
  no_owner_leases,
  silent_owner_not_held,  // an owner that a member has not heard for longer than its lease counts as dead to it
  goals_not_merged,
  recall_not_merged,
  recall_lets_waiting_go,  // a command that waits for leases goes although the other executive was told to recall it
  acknowledges_early
};

class PairWorld {
 public:
  static constexpr int kOwners = 3;

  PairWorld(std::uint64_t seed, const standby::LeaseSettings& settings, Bug bug = Bug::none);

  void run(standby::Moment time);
  // For who compares worlds: nothing is left to chance, every message is there within its step, and a step takes this
  // long.
  void be_deterministic(standby::Moment step) {
    eager_ = true;
    step_ = step;
  }
  // Worlds with one fingerprint go on alike; times count as ages up to `oldest` (pair_fingerprint.cpp).
  std::uint64_t fingerprint(standby::Moment oldest) const;

  Network network;
  void kill(standby::Member member);
  void start(standby::Member member) { start(member, false); }
  void pause(standby::Member member) { at(member).paused = true; }
  void resume(standby::Member member);
  bool alive(standby::Member member) const { return members_[index(member)].lease.has_value(); }
  bool paused(standby::Member member) const { return members_[index(member)].paused; }
  // With it goes what this member alone has acknowledged.
  void lose_disk(standby::Member member);
  void restart_owner(int owner) { owners_[owner].leases = {}; }
  void drop_messages() { under_way_.clear(); }
  // The ground asks until somebody acknowledges.
  void ask_for_a_goal() { wishes_.push_back({Word::goal, ++goals_}); }
  void recall(int goal) { wishes_.push_back({Word::recall, goal}); }
  void change(int goal) { wishes_.push_back({Word::change, goal}); }
  // It is paused between looking at its lease and sending a command, the next time; resumed, it sends first.
  void stop_before_sending(standby::Member member) { at(member).stops_before_sending = true; }

  std::optional<standby::Member> leader() const;  // the one that leads and is neither dead nor paused
  bool commands(standby::Member member) const;    // it believes that it may command
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
  // One journal is the other but for its newest lines, three at most, and no goal of a replaced one is still apart.
  bool copy_is_near() const;
  bool has_goal(standby::Member member, int goal) const { return disk(member).goals.contains(goal); }
  std::set<int> acknowledged_goals() const;
  bool recall_acknowledged(int goal) const {
    return acknowledged_.contains(goal) && acknowledged_.at(goal).recalled;
  }
  int effects(int goal) const { return effects_.contains(goal) ? effects_.at(goal) : 0; }
  // What was acknowledged and the leader does not have, though every disk that has it is there.
  std::vector<std::string> lost() const;

  // Nothing is left to be acknowledged or done.
  bool settled() const { return wishes_.empty(); }

  std::vector<std::string> faults;  // what must never be

 private:
  struct Process {
    Disk disk;
    std::optional<standby::Lease> lease;  // none: dead
    bool paused = false;
    bool stops_before_sending = false;
    std::uint64_t leads_in = 0;  // its own epoch, also once it knows a later one
    std::deque<Line> unsent;
    std::deque<Line> waiting;  // commands without leases
    std::set<int> commanded;   // goals, as its plan knows
    std::optional<Line> late;
    std::map<std::string, standby::Moment> owner_heard;
    std::optional<standby::LeaseMessage>
        other;              // newest message of the other, as far as the copy is concerned
    journal::Position fed;  // up to which lines are under way
    standby::Moment fed_at{0};
    std::optional<journal::Position> told_alone;
    standby::Lease::Change last_change = standby::Lease::Change::none;
  };
  struct Owner {
    services::owner::CommanderLeases leases;
    std::uint64_t epoch = 0;           // the newest that it has taken
    std::set<journal::Position> done;  // keys
  };
  struct Message {
    standby::Moment due{0};
    standby::Member to = standby::Member::first;
    std::optional<standby::LeaseMessage> message{};
    std::optional<standby::LeaseReport> report{};  // of an owner
    std::uint64_t leader = 0;                      // of the lines
    journal::Position after{};  // none of the sender's lines before them: the whole journal
    std::vector<Line> lines{};
    bool whole = false;
    std::optional<goals::GoalRecord> handed_over{};
    int to_owner = -1;
    std::optional<standby::OwnerRequest> request{};
  };
  struct Wish {
    Word what;
    int goal;
  };
  // What the ground was told of a goal.
  struct Acknowledged {
    std::uint32_t revision = 0;
    bool recalled = false;
    bool recall_held = false;  // by both: it flies no more
    bool held = false;         // by both
    standby::Member by = standby::Member::first;
  };
  static std::size_t index(standby::Member member) { return member == standby::Member::first ? 0 : 1; }
  static standby::Member other(standby::Member member) {
    return member == standby::Member::first ? standby::Member::second : standby::Member::first;
  }
  Process& at(standby::Member member) { return members_[index(member)]; }
  // Each has its own clock.
  standby::Moment clock(standby::Member member) const;
  standby::Moment owner_clock() const;
  bool reaches(standby::Member member, int owner) const;
  void start(standby::Member member, bool superseded);
  void step();
  void round();
  void act(standby::Member member);
  void keep_newest(standby::Member dead);
  void deliver_to_owners();
  void take(standby::Member member, const Message& message);
  void speak(standby::Member member);
  void lead(standby::Member member, bool doubtful);
  void work(standby::Member member);
  void hear_ground(standby::Member member);
  void feed(standby::Member member);
  void check_right(const Process& process);
  void check_dispatchers();
  void commit(Process& process, Word word, int number = 0,
              const std::optional<goals::GoalRecord>& goal = {});
  void merge(Process& process, const goals::GoalRecord& theirs);
  void send_unsent(standby::Member member);
  void send(standby::Member member, const Line& decision);
  void command(standby::Member member, const Line& decision);
  void acknowledge(standby::Member member, const Line& line);
  void post(Message message, bool cut);
  std::size_t common_lines() const;

  std::minstd_rand random_;
  bool eager_ = false;
  standby::Moment step_ = std::chrono::milliseconds(10);
  standby::LeaseSettings settings_;
  Bug bug_;
  standby::Moment now_{0};
  Process members_[2];
  std::array<Owner, kOwners> owners_;
  std::vector<Message> under_way_;
  int goals_ = 0;
  std::vector<Wish> wishes_;
  std::map<int, Acknowledged> acknowledged_;
  std::map<int, int> effects_;                           // how often each goal was flown
  std::map<std::uint64_t, standby::Member> commanders_;  // by epoch
  std::size_t carried_out_ = 0;
  std::size_t refused_ = 0;
  int leads_ = 0;
};

}  // namespace roci::exec::testing
