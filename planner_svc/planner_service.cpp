#include "planner_svc/planner_service.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "core/mission/entry.hpp"
#include "planner_svc/call_record.hpp"
#include "planner_svc/planning_call.hpp"
#include "services/clock/wall.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {
namespace {

using services::Duration;
using services::Node;

struct Settings {
  Duration function_timeout = std::chrono::seconds(20);
  double simulated_base_s = 0.5;
  double simulated_per_evaluation_s = 0.0005;
};

Settings read_settings(const std::filesystem::path& mission) {
  Settings out;
  const auto planner = mission::Entry::load(mission / "mission.yaml").find("planner");
  if (!planner) return out;
  out.function_timeout = temporal::seconds(planner->number_or("function_timeout_s", 20));
  if (const auto simulated = planner->find("simulated")) {
    simulated->allow_only({"base_s", "per_evaluation_s"});
    out.simulated_base_s = simulated->number_or("base_s", out.simulated_base_s);
    out.simulated_per_evaluation_s = simulated->number_or("per_evaluation_s", out.simulated_per_evaluation_s);
  }
  return out;
}

FunctionOutcome outcome_from_wire(v1::FunctionOutcome outcome, double number) {
  switch (outcome) {
    case v1::FUNCTION_VALUE:
      return std::isfinite(number) ? FunctionOutcome::value : FunctionOutcome::not_a_number;
    case v1::FUNCTION_UNREACHABLE:
      return FunctionOutcome::unreachable;
    case v1::FUNCTION_UNKNOWN_OBJECT:
      return FunctionOutcome::unknown_object;
    case v1::FUNCTION_WRONG_ARITY:
      return FunctionOutcome::wrong_arity;
    case v1::FUNCTION_UNKNOWN_FUNCTION:
    case v1::FUNCTION_FAILED:
      return FunctionOutcome::unavailable;
  }
  return FunctionOutcome::unavailable;
}

// What the owner means by an outcome that has no name of its own here.
std::string detail_of(v1::FunctionOutcome outcome) {
  if (outcome == v1::FUNCTION_UNKNOWN_FUNCTION) return "it does not know this function";
  if (outcome == v1::FUNCTION_FAILED) return "it failed to compute the value";
  return "";
}

FunctionOutcome outcome_of(services::CallStatus failure) {
  if (failure == services::CallStatus::timeout) return FunctionOutcome::late;
  if (failure == services::CallStatus::owner_lost) return FunctionOutcome::owner_lost;
  return FunctionOutcome::unavailable;
}

std::uint32_t peak_resident_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint32_t>(usage.ru_maxrss);
}

// One planning call at a time, on a thread of its own. The thread never touches the node: it hands the loop a
// function whenever it stops to wait (for values) or has ended.
class PlannerService final : public services::Service, private FunctionSource {
 public:
  PlannerService(Node& node, const services::RunSettings& settings)
      : node_(node),
        settings_(read_settings(settings.mission)),
        records_(settings.run_folder.empty() ? "" : settings.run_folder / "planner_calls"),
        events_(services::advertise(node, services::topics::event)),
        functions_(node, services::topics::function_call) {
    services::subscribe(node, services::topics::function_offer,
                        [this](const v1::FunctionOffer& offer) { offers_[offer.module_name()] = offer; });
    services::serve(node, services::topics::plan_request,
                    [this](const v1::PlanRequest& request, services::Responder<v1::PlanReply> responder) {
                      const std::uint64_t number = ++taken_;
                      queue_.push_back({number, request, responder});
                      responder.on_cancel([this, number] { cancel(number); });
                      start_next();
                    });
    node.on_peer_change([this](const services::PeerChange& change) {
      if (!change.alive) abandon_calls_of(change.service);
    });
  }

  ~PlannerService() override {
    cancelled_ = true;
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    answered_.notify_all();
    if (worker_.joinable()) worker_.join();
  }

 private:
  struct Job {
    std::uint64_t number = 0;
    v1::PlanRequest request;
    services::Responder<v1::PlanReply> responder;
  };

  void start_next() {
    if (job_ || queue_.empty()) return;
    job_ = std::move(queue_.front());
    queue_.pop_front();
    if (worker_.joinable()) worker_.join();
    cancelled_ = false;
    work_ = node_.begin_work();
    worker_ = std::thread([this] { run(); });
  }

  // On the worker thread, until it returns.
  void run() {
    const v1::PlanRequest& request = job_->request;
    PlanningCall call;
    call.engine = request.engine();
    call.domain_text = request.domain_text();
    call.problem_text = request.problem_text();
    call.evaluations = request.budget().work();
    call.memory_bytes = static_cast<std::size_t>(request.budget().memory_mb()) << 20U;
    const auto begun = services::wall::now();
    const Duration limit(request.budget().wall_us());
    if (limit.count() > 0 && node_.options().clock == services::ClockMode::live) {
      call.out_of_time = [begun, limit] { return services::wall::now() - begun > limit; };
    }
    call.cancelled = [this] { return cancelled_.load(std::memory_order_relaxed); };
    PlanningAnswer answer = answer_call(call, *this);
    const double wall_s = std::chrono::duration<double>(services::wall::now() - begun).count();
    node_.post_work_result(work_, [this, answer = std::move(answer), wall_s] { finish(answer, wall_s); });
  }

  // FunctionSource, on the worker thread: one batch is one request to the module's owner.
  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>&) override {
    if (calls.empty()) return {};
    {
      const std::lock_guard lock(mutex_);
      answer_.reset();
    }
    node_.post_work_result(
        work_, [this, batch = std::vector<FunctionCall>(calls.begin(), calls.end())] { ask(batch); });
    std::unique_lock lock(mutex_);
    answered_.wait(lock, [this] { return answer_.has_value() || stopping_; });
    return answer_ ? std::move(*answer_) : std::vector<FunctionValue>{};
  }

  // From here on: on the loop.

  // Nobody waits for these answers any more.
  void abandon_calls_of(const std::string& client) {
    std::erase_if(queue_, [&client](const Job& job) { return job.request.header().sender() == client; });
    if (job_ && job_->request.header().sender() == client) cancel_job();
  }

  // Its caller gets an answer all the same.
  void cancel(std::uint64_t number) {
    const auto queued = std::ranges::find(queue_, number, &Job::number);
    if (queued != queue_.end()) {
      queued->responder.reply(cancelled_reply());
      queue_.erase(queued);
    } else if (job_ && job_->number == number) {
      cancel_job();
    }
  }

  void cancel_job() {
    cancelled_ = true;
    if (asking_) resume({});
    if (!answering_) return;
    node_.cancel(*answering_);
    answer_job(cancelled_reply());
  }

  static v1::PlanReply cancelled_reply() {
    v1::PlanReply reply;
    reply.verdict_code(v1::VERDICT_CANCELLED);
    reply.reason("cancelled by the caller");
    return reply;
  }

  void ask(const std::vector<FunctionCall>& calls) {
    if (cancelled_) return resume({});
    const auto offer = offers_.find(calls.front().module);
    if (offer == offers_.end())
      return resume(all(calls, FunctionOutcome::unavailable, {}, no_offer(calls.front())));
    v1::FunctionRequest request;
    request.module_name(calls.front().module);
    request.objects(job_->request.objects());
    request.batches({batch_of(calls, request.objects())});
    const Provenance asked{offer->second.owner(), std::to_string(offer->second.model_version()), node_.now()};
    asking_ = ++asked_;
    functions_.call(
        std::move(request), offer->second.owner(), settings_.function_timeout,
        [this, calls, asked, number = asked_](const services::CallResult<v1::FunctionReply>& result) {
          if (asking_ == number) resume(values_of(calls, asked, result));
        });
  }

  std::string no_offer(const FunctionCall& call) const {
    std::string offered;
    for (const auto& [module_name, offer] : offers_) offered += (offered.empty() ? "" : ", ") + module_name;
    return "no service offers module '" + call.module +
           "'; offered are: " + (offered.empty() ? "none" : offered);
  }

  // Arguments that are no objects of the request are constants of the domain; their owner knows them by name.
  static v1::FunctionBatch batch_of(const std::vector<FunctionCall>& calls,
                                    std::vector<v1::PlanObject>& objects) {
    std::map<std::string, std::uint32_t> index;
    for (std::size_t i = 0; i < objects.size(); ++i)
      index.emplace(objects[i].name(), static_cast<std::uint32_t>(i));
    v1::FunctionBatch batch;
    batch.function(calls.front().function);
    batch.arity(static_cast<std::uint32_t>(calls.front().arguments.size()));
    for (const FunctionCall& call : calls) {
      for (const std::string& argument : call.arguments) {
        const auto [found, added] = index.emplace(argument, static_cast<std::uint32_t>(objects.size()));
        if (added) {
          objects.emplace_back();
          objects.back().name(argument);
        }
        batch.tuples().push_back(found->second);
      }
    }
    return batch;
  }

  // `asked`: who was asked, by which offer, when.
  std::vector<FunctionValue> values_of(const std::vector<FunctionCall>& calls, const Provenance& asked,
                                       const services::CallResult<v1::FunctionReply>& result) {
    if (result.status != services::CallStatus::ok)
      return all(calls, outcome_of(result.status), asked, result.message);
    const v1::FunctionReply& reply = result.reply;
    const bool whole = reply.results().size() == 1 && reply.results()[0].numbers().size() == calls.size() &&
                       reply.results()[0].outcomes().size() == calls.size();
    if (!whole) {
      return all(calls, FunctionOutcome::unavailable, asked,
                 "it answered with another number of values than asked for");
    }
    std::vector<FunctionValue> values;
    const Provenance provenance{reply.owner(), std::to_string(reply.model_version()),
                                Duration(reply.computed_us())};
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const double number = reply.results()[0].numbers()[i];
      const v1::FunctionOutcome outcome = reply.results()[0].outcomes()[i];
      values.push_back({outcome_from_wire(outcome, number), number, provenance, detail_of(outcome)});
    }
    tuples_ += calls.size();
    return values;
  }

  static std::vector<FunctionValue> all(const std::vector<FunctionCall>& calls, FunctionOutcome outcome,
                                        const Provenance& asked, const std::string& detail) {
    return std::vector<FunctionValue>(calls.size(), FunctionValue{outcome, 0, asked, detail});
  }

  // The thread goes on with these values.
  void resume(std::vector<FunctionValue> values) {
    asking_.reset();
    work_ = node_.begin_work();
    {
      const std::lock_guard lock(mutex_);
      answer_ = std::move(values);
    }
    answered_.notify_all();
  }

  void finish(const PlanningAnswer& answer, double wall_s) {
    v1::PlanReply reply;
    reply.verdict_code(static_cast<v1::Verdict>(answer.verdict));
    reply.reason(answer.reason);
    if (answer.plan) reply.solution(services::wire::to_wire(*answer.plan));
    reply.statistics().expanded(answer.statistics.expanded);
    reply.statistics().evaluated(answer.statistics.evaluated);
    reply.statistics().bytes_per_state(answer.statistics.bytes_per_state);
    reply.statistics().function_tuples(tuples_);
    reply.statistics().wall_s(wall_s);
    reply.statistics().peak_rss_kb(peak_resident_kb());
    tuples_ = 0;
    records_.keep(job_->request.problem_text(), answer, wall_s);
    if (answer.verdict != PlanningVerdict::solved && answer.verdict != PlanningVerdict::cancelled) {
      report(std::string("planning ended as ") + to_string(answer.verdict) + ": " + answer.reason);
    }
    answering_ =
        node_.after(simulated_time_of(answer), [this, reply = std::move(reply)] { answer_job(reply); });
  }

  // In simulation a call takes time by the stated model, so that nothing depends on the speed of this
  // machine.
  Duration simulated_time_of(const PlanningAnswer& answer) const {
    if (node_.options().clock == services::ClockMode::live || answer.verdict == PlanningVerdict::cancelled)
      return Duration{0};
    return temporal::seconds(settings_.simulated_base_s +
                             settings_.simulated_per_evaluation_s *
                                 static_cast<double>(answer.statistics.evaluated));
  }

  void answer_job(const v1::PlanReply& reply) {
    answering_.reset();
    job_->responder.reply(reply);
    job_.reset();
    start_next();
  }

  void report(const std::string& text) {
    v1::Event event;
    event.severity_level(v1::SEVERITY_WARNING);
    event.code("planner.verdict");
    event.text(text);
    events_.write(std::move(event));
  }

  Node& node_;
  Settings settings_;
  CallRecords records_;
  services::Publisher<v1::Event> events_;
  services::Client<v1::FunctionRequest, v1::FunctionReply> functions_;
  std::map<std::string, v1::FunctionOffer> offers_;
  std::deque<Job> queue_;
  std::uint64_t taken_ = 0;  // requests so far
  std::optional<Job> job_;
  std::optional<Node::TimerId> answering_;  // set once the job's answer is known
  std::uint64_t tuples_ = 0;
  std::uint64_t asked_ = 0;              // requests for values so far
  std::optional<std::uint64_t> asking_;  // the one under way

  // Shared with the worker.
  Node::WorkId work_ = 0;
  std::thread worker_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable answered_;
  std::optional<std::vector<FunctionValue>> answer_;
  bool stopping_ = false;
};

}  // namespace

std::unique_ptr<services::Service> make_service(Node& node, const services::RunSettings& settings) {
  return std::make_unique<PlannerService>(node, settings);
}

}  // namespace roci::planner
