#include "services/vendors/inproc/dispatcher.hpp"

#include <utility>

namespace roci::services::vendors::inproc {

Dispatcher::Dispatcher() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

void Dispatcher::post(Endpoint endpoint, std::function<void()> callback) {
  const std::lock_guard lock(mutex_);
  jobs_.push_back({endpoint, std::move(callback)});
  changed_.notify_all();
}

void Dispatcher::remove(Endpoint endpoint) {
  std::unique_lock lock(mutex_);
  std::erase_if(jobs_, [endpoint](const Job& job) { return job.endpoint == endpoint; });
  changed_.wait(lock, [this, endpoint] { return running_ != endpoint; });
}

void Dispatcher::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !jobs_.empty(); })) {
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    running_ = job.endpoint;
    lock.unlock();
    job.callback();
    job.callback = nullptr;
    lock.lock();
    running_ = 0;
    changed_.notify_all();
  }
}

}  // namespace roci::services::vendors::inproc
