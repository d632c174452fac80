#include "planner_svc/answering_host_service.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <utility>

#include "core/mission/service_list.hpp"
#include "planner_svc/engine/checked_answer.hpp"
#include "planner_svc/wire_service.hpp"
#include "services/clock/wall.hpp"
#include "services/node/make_event.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::planner {

using engine::Answer, engine::FunctionCall, engine::FunctionValue, engine::Limits;
using services::Node;
using temporal::Duration, temporal::Verdict;

namespace {

std::uint32_t peak_resident_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint32_t>(usage.ru_maxrss);
}

// Of several planners of a mission each has a folder of its own.
std::filesystem::path records_folder(const Node& node, const services::RunSettings& run) {
  if (run.run_folder.empty()) return {};
  const auto list =
      run.mission.empty() ? mission::ServiceList{} : mission::load_service_list_if_any(run.mission);
  return run.run_folder / list.file_name(node.options().name, "planner_calls");
}

}  // namespace

AnsweringHost::AnsweringHost(Node& node, const services::RunSettings& run, const Settings& settings,
                             const engine::Table& table)
    : node_(node),
      settings_(settings),
      table_(table),
      records_(records_folder(node, run)),
      events_(services::advertise(node, services::topics::event)),
      owners_(node, settings.function_timeout) {
  services::serve(node, services::topics::plan_request,
                  [this](const v1::PlanRequest& request, services::Responder<v1::PlanReply> responder) {
                    take(request, responder);
                  });
  node.on_peer_change([this](const services::health::PeerChange& change) {
    if (!change.alive) abandon_calls_of(change.service);
  });
}

AnsweringHost::~AnsweringHost() {
  cancelled_ = true;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  answered_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void AnsweringHost::take(const v1::PlanRequest& request,
                         const services::Responder<v1::PlanReply>& responder) {
  const std::uint64_t number = ++taken_;
  try {
    queue_.push_back({number, request.header().sender(), from_wire(request),
                      Duration(request.budget().wall_us()), responder});
    queue_.back().request.improvement = settings_.improvement;
    queue_.back().request.functions = settings_.functions;
    queue_.back().request.resolvers = settings_.resolvers;
    queue_.back().request.threads = settings_.threads;
  } catch (const services::wire::WireError& error) {
    return responder.reply(to_wire(engine::without_plan(Verdict::invalid_input, error.what())));
  }
  responder.on_cancel([this, number] { cancel(number); });
  start_next();
}

void AnsweringHost::start_next() {
  if (job_ || queue_.empty()) return;
  job_ = std::move(queue_.front());
  queue_.pop_front();
  if (worker_.joinable()) worker_.join();
  cancelled_ = false;
  work_ = node_.begin_work();
  worker_ = std::thread([this] { run(); });
}

// On the thread, until it returns.
void AnsweringHost::run() {
  const auto begun = services::clock::wall_now();
  const Duration limit = job_->wall_limit;
  Limits limits;
  if (limit.count() > 0 && is_live())
    limits.out_of_time = [begun, limit] { return services::clock::wall_now() - begun > limit; };
  limits.cancelled = [this] { return cancelled_.load(std::memory_order_relaxed); };
  Answer answer = answer_checked(table_, job_->request, limits, *this);
  const double wall_s = std::chrono::duration<double>(services::clock::wall_now() - begun).count();
  node_.post_work_result(work_, [this, answer = std::move(answer), wall_s] { finish(answer, wall_s); });
}

// FunctionSource, on the thread: one batch is one request to the module's owner.
std::vector<FunctionValue> AnsweringHost::evaluate(std::span<const FunctionCall> calls,
                                                   const std::function<bool()>&) {
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

bool AnsweringHost::is_live() const { return node_.options().clock == services::clock::ClockMode::live; }

// Nobody waits for these answers any more.
void AnsweringHost::abandon_calls_of(const std::string& client) {
  std::erase_if(queue_, [&client](const Job& job) { return job.client == client; });
  if (job_ && job_->client == client) cancel_job();
}

// Its caller gets an answer all the same.
void AnsweringHost::cancel(std::uint64_t number) {
  const auto queued = std::ranges::find(queue_, number, &Job::number);
  if (queued != queue_.end()) {
    queued->responder.reply(cancelled_reply());
    queue_.erase(queued);
  } else if (job_ && job_->number == number) {
    cancel_job();
  }
}

void AnsweringHost::cancel_job() {
  cancelled_ = true;
  if (owners_.forget()) resume({});
  if (!answering_) return;
  node_.cancel(*answering_);
  answer_job(cancelled_reply());
}

void AnsweringHost::ask(const std::vector<FunctionCall>& calls) {
  if (cancelled_) return resume({});
  owners_.ask(calls, job_->request, [this](std::vector<FunctionValue> values) { resume(std::move(values)); });
}

// The thread goes on with these values.
void AnsweringHost::resume(std::vector<FunctionValue> values) {
  work_ = node_.begin_work();
  {
    const std::lock_guard lock(mutex_);
    values_ = std::move(values);
  }
  answered_.notify_all();
}

void AnsweringHost::finish(const Answer& answer, double wall_s) {
  v1::PlanReply reply = to_wire(answer);
  reply.statistics().wall_s(wall_s);
  reply.statistics().peak_rss_kb(peak_resident_kb());
  records_.keep(answer, wall_s);
  for (const std::string& warning : answer.warnings)
    if (told_warnings_.size() < kMostWarnings && told_warnings_.insert(warning).second)
      report("planner.warning", warning);
  if (answer.verdict != Verdict::solved && answer.verdict != Verdict::cancelled)
    report("planner.verdict",
           std::string("planning ended as ") + to_string(answer.verdict) + ": " + answer.reason);
  answering_ =
      node_.after(simulated_time_of(answer), [this, reply = std::move(reply)] { answer_job(reply); });
}

// In simulation a call takes time by the stated model, so that nothing depends on the speed of this machine.
Duration AnsweringHost::simulated_time_of(const Answer& answer) const {
  if (is_live() || answer.verdict == Verdict::cancelled) return Duration{0};
  return temporal::seconds(settings_.simulated_base_s + settings_.simulated_per_evaluation_s *
                                                            static_cast<double>(answer.statistics.evaluated));
}

void AnsweringHost::answer_job(const v1::PlanReply& reply) {
  answering_.reset();
  job_->responder.reply(reply);
  job_.reset();
  start_next();
}

void AnsweringHost::report(const std::string& code, const std::string& text) {
  events_.write(services::node::make_event(v1::SEVERITY_WARNING, code, text));
}

}  // namespace roci::planner
