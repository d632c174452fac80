#include "services/time_watch.hpp"

#include <utility>

#include "services/log/log.hpp"
#include "services/node/node_impl.hpp"

namespace roci::services {
namespace {

constexpr std::uint64_t kUnanswered = 10;  // so many questions without an answer are worth a line in the log

void add(v1::Event& event, const std::string& name, const std::string& value) {
  v1::Property property;
  property.name(name);
  property.value(value);
  event.properties().push_back(std::move(property));
}

}  // namespace

TimeWatch::TimeWatch(Node& node, TimeWatchSettings settings)
    : node_(node), settings_(std::move(settings)), judge_(settings_.bounds) {
  if (node.options().clock != clock::ClockMode::live || settings_.reference.empty()) return;
  probes_ = advertise(node, topics::time_probe);
  if (settings_.reference == node.options().name) {
    subscribe(node, topics::time_probe, [this](const v1::TimeProbe& probe) {
      if (probe.answerer().empty()) answer(probe);
    });
    return;
  }
  events_ = advertise(node, topics::event);
  subscribe(node, topics::time_probe, [this](const v1::TimeProbe& probe) {
    if (probe.asker() == node_.options().name && probe.answerer() == settings_.reference) hear(probe);
  });
  ask();
}

void TimeWatch::ask() {
  v1::TimeProbe question;
  question.asker(node_.options().name);
  question.number(++asked_);
  question.asked_us(node_.now().count());
  probes_.write(std::move(question));
  if (asked_ - heard_ == kUnanswered)
    log::warning(node_.options().name + " cannot compare its clock: " + settings_.reference +
                 ", whose clock is the mission clock, does not answer");
  node_.after(temporal::seconds(settings_.period_s * node_.options().live_scale), [this] { ask(); });
}

void TimeWatch::answer(const v1::TimeProbe& question) {
  v1::TimeProbe out = question;
  out.answerer(node_.options().name);
  out.received_us(node_.now().count());
  out.answered_us(out.received_us());
  probes_.write(std::move(out));
}

void TimeWatch::hear(const v1::TimeProbe& answer) {
  const temporal::Time now = node_.now();
  if (answer.number() <= heard_ || answer.number() > asked_) return;
  heard_ = answer.number();
  estimator_.add({temporal::Time(answer.asked_us()), temporal::Time(answer.received_us()),
                  temporal::Time(answer.answered_us()), now});
  const auto found = estimator_.estimate();
  if (!found) return;
  for (clock::ClockJudge::Change& change : judge_.judge(*found)) changes_.push_back(std::move(change));
  if (!changes_.empty() && events_.matched_readers() > 0) {
    for (const clock::ClockJudge::Change& change : changes_) report(change, *found);
    changes_.clear();
  }
  node_.impl().degraded = judge_.beyond();
}

void TimeWatch::report(const clock::ClockJudge::Change& change, const clock::ClockOffset& found) {
  const std::string text = node_.options().name + ": " + change.text + " to the mission clock of " +
                           settings_.reference +
                           (change.beyond ? "; set this host's clock (chrony, ntpd)" : "");
  v1::Event event;
  event.severity_level(change.beyond ? v1::SEVERITY_WARNING : v1::SEVERITY_INFO);
  event.code(change.code);
  event.text(text);
  add(event, "service", node_.options().name);
  add(event, "reference", settings_.reference);
  add(event, "beyond", change.beyond ? "true" : "false");
  add(event, "offset_s", std::to_string(temporal::to_seconds(found.offset)));
  add(event, "offset_bound_s", std::to_string(temporal::to_seconds(settings_.bounds.offset)));
  add(event, "drift_ppm", std::to_string(found.drift_ppm));
  add(event, "drift_bound_ppm", std::to_string(settings_.bounds.drift_ppm));
  events_.write(std::move(event));
  change.beyond ? log::warning(text) : log::info(text);
}

}  // namespace roci::services
