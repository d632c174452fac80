// The answering host answers planning calls by the engines of a table, one call at a time.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "planner_svc/call_record.hpp"
#include "planner_svc/engine/table.hpp"
#include "planner_svc/function_owners_service.hpp"
#include "planner_svc/settings.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/service.hpp"

namespace roci::planner {

/// Answers queued calls on a thread of its own, while the loop goes on. That thread never touches the node:
/// it hands the loop a function whenever it stops to wait (for values) or has ended.
class AnsweringHost final : private engine::FunctionSource {
 public:
  /// All arguments must outlive this object.
  AnsweringHost(services::Node& node, const services::RunSettings& run, const Settings& settings,
                const engine::Table& table);
  ~AnsweringHost() override;
  AnsweringHost(const AnsweringHost&) = delete;
  AnsweringHost& operator=(const AnsweringHost&) = delete;

 private:
  struct Job {
    std::uint64_t number = 0;
    std::string client;
    engine::Request request;
    temporal::Duration wall_limit{0};  // 0: none
    services::Responder<v1::PlanReply> responder;
  };

  void take(const v1::PlanRequest& request, const services::Responder<v1::PlanReply>& responder);
  void start_next();
  void run();
  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> calls,
                                              const std::function<bool()>& cancelled) override;
  bool is_live() const;
  void abandon_calls_of(const std::string& client);
  void cancel(std::uint64_t number);
  void cancel_job();
  void ask(const std::vector<engine::FunctionCall>& calls);
  void resume(std::vector<engine::FunctionValue> values);
  void finish(const engine::Answer& answer, double wall_s);
  temporal::Duration simulated_time_of(const engine::Answer& answer) const;
  void answer_job(const v1::PlanReply& reply);
  void report(const std::string& code, const std::string& text);

  services::Node& node_;
  const Settings& settings_;
  const engine::Table& table_;
  CallRecords records_;
  services::Publisher<v1::Event> events_;
  FunctionOwners owners_;
  std::deque<Job> queue_;
  std::uint64_t taken_ = 0;  // requests so far
  static constexpr std::size_t kMostWarnings = 200;
  std::set<std::string> told_warnings_;  // each is told once: every call comes with the same domain
  std::optional<Job> job_;
  std::optional<services::Node::TimerId> answering_;  // set once the job's answer is known

  // Shared with the thread.
  services::Node::WorkId work_ = 0;
  std::thread worker_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable answered_;
  std::optional<std::vector<engine::FunctionValue>> values_;
  bool stopping_ = false;
};

}  // namespace roci::planner
