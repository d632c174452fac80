// This part of the reactor acts on the orders of the ground. What an order changes for good stands in the
// mission's authority, values and uploads.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "exec_svc/orders/order_book.hpp"
#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/running_plan.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

/// Obeys each order once, and answers it with its stages.
class GroundOrders {
 public:
  /// All arguments must outlive this object.
  GroundOrders(MissionState& state, RunningPlan& plan, Safing& safing)
      : state_(&state), plan_(&plan), safing_(&safing) {}

  /// Obeys the orders among the inputs, before the plan hears of the step. Values that the ground sets become
  /// observations among the inputs, and orders that answer decisions become answers.
  void obey(temporal::Time now, ReactorInputs& inputs);
  /// Reports at the end of a step what has been applied by now.
  void settle();

  const orders::OrderBook& book() const { return book_; }
  /// Returns the values of the ground's timelines, as they were set.
  const std::map<std::string, temporal::Value>& values() const { return values_; }
  /// Gives the executive again, after a restore, what the ground has set for it.
  void reinstate();

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    orders::OrderBook::fields(archive, self.book_);
    archive(self.values_, self.uploads_, self.dropped_, self.awaited_answers_, self.safe_due_);
  }

 private:
  /// Says what becomes of an order at once.
  struct Ruling {
    orders::OrderStage stage = orders::OrderStage::applied;
    std::string reason{};
  };
  static Ruling refused(std::string reason) { return {orders::OrderStage::refused, std::move(reason)}; }

  Ruling rule(temporal::Time now, const orders::Order& order, ReactorInputs& inputs);
  Ruling hold(const orders::Order& order);
  Ruling release(const orders::Order& order);
  Ruling approve(const orders::Order& order);
  Ruling set_value(const orders::Order& order, ReactorInputs& inputs);
  Ruling set_level(const orders::Order& order);
  Ruling upload(const orders::Order& order);
  Ruling drop(const orders::Order& order);
  Ruling relaunch(temporal::Time now);
  Ruling command(temporal::Time now, const orders::Order& order);
  Ruling make_safe(temporal::Time now, const orders::Order& order);

  std::string fault_of_commanding() const;
  std::string fault_of_rest() const;
  std::string fault_of_waiting(const std::string& activity) const;
  void plan_if_none_runs(const std::string& reason);
  void move(const orders::IssuedKey& key, const Ruling& ruling);
  bool stopped() const;

  MissionState* state_;
  RunningPlan* plan_;
  Safing* safing_;
  orders::OrderBook book_;
  std::map<std::string, temporal::Value> values_;
  std::map<std::string, std::string> uploads_;        ///< newest text, by target
  std::map<std::string, orders::IssuedKey> dropped_;  ///< activities that the next relaunch leaves out
  std::vector<orders::IssuedKey> awaited_answers_;    ///< orders that answer a decision
  std::vector<orders::IssuedKey> safe_due_;           ///< orders to make safe, until the robot is
};

}  // namespace roci::exec::reactor
