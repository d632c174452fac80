#include "planner_svc/planner_service.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "planner_svc/call_record.hpp"
#include "planner_svc/function_owners_service.hpp"
#include "planner_svc/settings.hpp"
#include "planner_svc/temporal_pddl/adapter/planning_call.hpp"
#include "planner_svc/wire_service.hpp"
#include "services/clock/wall.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"

namespace roci::planner {
namespace {

using services::Node;
using temporal::Duration;
using temporal_pddl::adapter::answer_call;
using temporal_pddl::adapter::PlanningAnswer;
using temporal_pddl::adapter::PlanningCall;

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
        settings_(read_settings(settings.mission_file())),
        records_(settings.run_folder.empty() ? "" : settings.run_folder / "planner_calls"),
        events_(services::advertise(node, services::topics::event)),
        owners_(node, settings_.function_timeout) {
    services::serve(node, services::topics::plan_request,
                    [this](const v1::PlanRequest& request, services::Responder<v1::PlanReply> responder) {
                      const std::uint64_t number = ++taken_;
                      queue_.push_back({number, request, responder});
                      responder.on_cancel([this, number] { cancel(number); });
                      start_next();
                    });
    node.on_peer_change([this](const services::health::PeerChange& change) {
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
    PlanningCall call = from_wire(job_->request);
    const auto begun = services::clock::wall_now();
    const Duration limit(job_->request.budget().wall_us());
    if (limit.count() > 0 && is_live())
      call.out_of_time = [begun, limit] { return services::clock::wall_now() - begun > limit; };
    call.cancelled = [this] { return cancelled_.load(std::memory_order_relaxed); };
    PlanningAnswer answer = answer_call(call, *this);
    const double wall_s = std::chrono::duration<double>(services::clock::wall_now() - begun).count();
    node_.post_work_result(work_, [this, call = std::move(call), answer = std::move(answer), wall_s] {
      finish(call, answer, wall_s);
    });
  }

  // FunctionSource, on the worker thread: one batch is one request to the module's owner.
  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>&) override {
    if (calls.empty()) return {};
    {
      const std::lock_guard lock(mutex_);
      values_.reset();
    }
    node_.post_work_result(
        work_, [this, batch = std::vector<FunctionCall>(calls.begin(), calls.end())] { ask(batch); });
    std::unique_lock lock(mutex_);
    answered_.wait(lock, [this] { return values_.has_value() || stopping_; });
    return values_ ? std::move(*values_) : std::vector<FunctionValue>{};
  }

  // From here on: on the loop.

  bool is_live() const { return node_.options().clock == services::clock::ClockMode::live; }

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
    if (owners_.forget()) resume({});
    if (!answering_) return;
    node_.cancel(*answering_);
    answer_job(cancelled_reply());
  }

  void ask(const std::vector<FunctionCall>& calls) {
    if (cancelled_) return resume({});
    owners_.ask(calls, job_->request.objects(),
                [this](std::vector<FunctionValue> values) { resume(std::move(values)); });
  }

  // The thread goes on with these values.
  void resume(std::vector<FunctionValue> values) {
    work_ = node_.begin_work();
    {
      const std::lock_guard lock(mutex_);
      values_ = std::move(values);
    }
    answered_.notify_all();
  }

  void finish(const PlanningCall& call, const PlanningAnswer& answer, double wall_s) {
    v1::PlanReply reply = to_wire(answer);
    reply.statistics().wall_s(wall_s);
    reply.statistics().peak_rss_kb(peak_resident_kb());
    records_.keep(call, answer, wall_s);
    if (answer.verdict != temporal::Verdict::solved && answer.verdict != temporal::Verdict::cancelled) {
      report(std::string("planning ended as ") + to_string(answer.verdict) + ": " + answer.reason);
    }
    answering_ =
        node_.after(simulated_time_of(answer), [this, reply = std::move(reply)] { answer_job(reply); });
  }

  // In simulation a call takes time by the stated model, so that nothing depends on the speed of this
  // machine.
  Duration simulated_time_of(const PlanningAnswer& answer) const {
    if (is_live() || answer.verdict == temporal::Verdict::cancelled) return Duration{0};
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
  FunctionOwners owners_;
  std::deque<Job> queue_;
  std::uint64_t taken_ = 0;  // requests so far
  std::optional<Job> job_;
  std::optional<Node::TimerId> answering_;  // set once the job's answer is known

  // Shared with the worker.
  Node::WorkId work_ = 0;
  std::thread worker_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable answered_;
  std::optional<std::vector<FunctionValue>> values_;
  bool stopping_ = false;
};

}  // namespace

std::unique_ptr<services::Service> make_service(Node& node, const services::RunSettings& settings) {
  return std::make_unique<PlannerService>(node, settings);
}

}  // namespace roci::planner
