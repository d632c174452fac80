#include "services/clock/clock_offset.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace roci::services::clock {

using temporal::Duration;
using temporal::Time;

namespace {

constexpr double kGrainUs = 1;  // of the four times, together

double us(Duration duration) { return static_cast<double>(duration.count()); }

std::string seconds_text(double us_value) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << us_value * 1e-6 << " s";
  return text.str();
}

std::string ppm_text(double ppm) {
  std::ostringstream text;
  text.precision(0);
  text << std::fixed << ppm << " ppm";
  return text.str();
}

}  // namespace

void OffsetEstimator::add(const ClockExchange& exchange) {
  const double delay = us(exchange.heard - exchange.asked) - us(exchange.answered - exchange.received);
  if (exchange.heard < exchange.asked || delay < -kGrainUs) return;
  Sample sample;
  sample.at = exchange.asked + (exchange.heard - exchange.asked) / 2;
  sample.offset_us = (us(exchange.asked - exchange.received) + us(exchange.heard - exchange.answered)) / 2;
  sample.error_us = std::max(delay, 0.0) / 2 + kGrainUs;
  if (!newest_.empty()) {
    const Sample& known = best(sample.at);
    const bool stepped = sample.at < newest_.back().at || std::abs(sample.offset_us - known.offset_us) >
                                                              sample.error_us + error_at(known, sample.at);
    if (stepped) {
      newest_.clear();
      history_.clear();
      since_history_ = 0;
    }
  }
  newest_.push_back(sample);
  if (newest_.size() > kFilter) newest_.pop_front();
  if (++since_history_ < kFilter) return;
  since_history_ = 0;
  history_.push_back(*std::ranges::min_element(newest_, {}, &Sample::error_us));
  if (history_.size() > kHistory) history_.pop_front();
}

double OffsetEstimator::error_at(const Sample& sample, Time now) {
  return sample.error_us + kFastestDriftPpm * 1e-6 * us(now - sample.at);
}

const OffsetEstimator::Sample& OffsetEstimator::best(Time now) const {
  return *std::ranges::min_element(newest_, {},
                                   [now](const Sample& sample) { return error_at(sample, now); });
}

std::optional<ClockOffset> OffsetEstimator::estimate() const {
  if (newest_.empty()) return std::nullopt;
  const Time now = newest_.back().at;
  const Sample& sample = best(now);
  ClockOffset out;
  out.offset = Duration(std::llround(sample.offset_us));
  out.error = Duration(std::llround(std::ceil(error_at(sample, now)))) + Duration(1);
  fit(out);
  return out;
}

void OffsetEstimator::fit(ClockOffset& out) const {
  if (history_.size() < 2) return;
  const double count = static_cast<double>(history_.size());
  const double origin = us(history_.front().at);
  double mean = 0;
  for (const Sample& sample : history_) mean += (us(sample.at) - origin) / count;
  double spread = 0;
  for (const Sample& sample : history_) spread += std::pow(us(sample.at) - origin - mean, 2);
  if (spread <= 0) return;
  double slope = 0;
  double error = 0;
  for (const Sample& sample : history_) {
    const double weight = (us(sample.at) - origin - mean) / spread;
    slope += weight * sample.offset_us;
    error += std::abs(weight) * sample.error_us;
  }
  out.drift_ppm = slope * 1e6;
  out.drift_error_ppm = error * 1e6;
}

std::vector<ClockJudge::Change> ClockJudge::judge(const ClockOffset& found) {
  std::vector<Change> out;
  const auto note = [&out](bool& state, bool beyond, bool within, const char* code, const std::string& figure,
                           const std::string& error, const std::string& bound) {
    if (state ? !within : !beyond) return;
    state = beyond;
    out.push_back({code, beyond,
                   figure + " (give or take " + error + "), " + (beyond ? "beyond" : "within") +
                       " the bound of " + bound});
  };
  const Duration offset = found.offset < Duration(0) ? -found.offset : found.offset;
  note(offset_beyond_, offset - found.error > bounds_.offset, offset <= bounds_.offset, "clock.offset",
       "the clock is " + seconds_text(us(offset)) + (found.offset < Duration(0) ? " behind" : " ahead"),
       seconds_text(us(found.error)), seconds_text(us(bounds_.offset)));
  const double drift = std::abs(found.drift_ppm);
  note(drift_beyond_, drift - found.drift_error_ppm > bounds_.drift_ppm,
       drift <= bounds_.drift_ppm && found.drift_error_ppm <= bounds_.drift_ppm, "clock.drift",
       "the clock runs " + ppm_text(drift) + (found.drift_ppm < 0 ? " slow" : " fast"),
       ppm_text(found.drift_error_ppm), ppm_text(bounds_.drift_ppm));
  return out;
}

}  // namespace roci::services::clock
