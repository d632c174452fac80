#include "sim_svc/world/thermal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roci::sim::world {

using temporal::Time;
using temporal::to_seconds;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLongest = 1e9;  // s; what comes later never comes

double after(double from_k, double towards_k, double seconds, double tau_s) {
  return towards_k + (from_k - towards_k) * std::exp(-seconds / tau_s);
}

}  // namespace

Thermal::Thermal(ThermalParameters parameters)
    : parameters_(std::move(parameters)), zones_(parameters_.zones.size()) {
  for (std::size_t i = 0; i < zones_.size(); ++i) set_out(i, parameters_.zones[i].start_k, Time{});
}

std::size_t Thermal::index(std::string_view zone) const {
  const auto found = std::ranges::find(parameters_.zones, zone, &ZoneParameters::name);
  return static_cast<std::size_t>(found - parameters_.zones.begin());
}

bool Thermal::has(std::string_view zone) const { return index(zone) < zones_.size(); }

double Thermal::loss_w_k(std::size_t i) const {
  return parameters_.zones[i].loss_w_k * parameters_.loss_factor;
}

double Thermal::tau_s(std::size_t i) const { return parameters_.zones[i].capacity_j_k / loss_w_k(i); }

double Thermal::waste_w(std::size_t i) const {
  double out = 0;
  for (const auto& [who, watts] : zones_[i].waste_w) out += watts;
  return out * parameters_.waste_factor;
}

double Thermal::goal_k(std::size_t i) const {
  return zones_[i].holders.empty() ? parameters_.zones[i].keep_k : parameters_.zones[i].work_k;
}

// From the thermostat's temperature the heater gives what holds it. If that is less than nothing, or more than it has,
// the temperature goes on.
Thermal::Leg Thermal::held_at(std::size_t i, double kelvin) const {
  const double loss = loss_w_k(i);
  const double needed = loss * (kelvin - parameters_.surroundings_k) - waste_w(i);
  const double most = parameters_.zones[i].heater_w;
  if (needed >= 0 && needed <= most) return {kelvin, kelvin, needed};
  const double given = std::clamp(needed, 0.0, most);
  return {kelvin, parameters_.surroundings_k + (given + waste_w(i)) / loss, given};
}

void Thermal::set_out(std::size_t i, double from_k, Time now) {
  Zone& zone = zones_[i];
  const double goal = goal_k(i);
  const double given = from_k < goal ? parameters_.zones[i].heater_w : 0;
  zone.since = now;
  zone.first = {from_k, parameters_.surroundings_k + (given + waste_w(i)) / loss_w_k(i), given};
  zone.then = held_at(i, goal);
  const double left = (from_k - zone.first.towards_k) / (goal - zone.first.towards_k);
  if (from_k == goal) {
    zone.first_s = 0;
  } else {
    // What goes the other way, or ends before the goal, does not reach it.
    zone.first_s = left > 1 ? tau_s(i) * std::log(left) : kNever;
  }
}

double Thermal::temperature_k(std::size_t i, Time t) const {
  const Zone& zone = zones_[i];
  const double s = to_seconds(t - zone.since);
  if (s < zone.first_s) return after(zone.first.from_k, zone.first.towards_k, s, tau_s(i));
  return after(zone.then.from_k, zone.then.towards_k, s - zone.first_s, tau_s(i));
}

double Thermal::temperature_k(std::string_view zone, Time t) const { return temperature_k(index(zone), t); }

bool Thermal::in_range(std::string_view zone, Time t) const {
  const ZoneParameters& parameters = parameters_.zones[index(zone)];
  const double kelvin = temperature_k(zone, t);
  return kelvin >= parameters.least_k && kelvin <= parameters.most_k;
}

double Thermal::heater_j(std::string_view name, Time from, Time to) const {
  const Zone& zone = zones_[index(name)];
  const double begin = to_seconds(from - zone.since), end = to_seconds(to - zone.since);
  const double turn = std::clamp(zone.first_s, begin, end);
  return zone.first.heater_w * (turn - begin) + zone.then.heater_w * (end - turn);
}

double Thermal::peak_power_w() const {
  double out = 0;
  for (const ZoneParameters& one : parameters_.zones) out += one.heater_w;
  return out;
}

void Thermal::hold(std::string_view zone, const void* who, Time now) {
  const std::size_t i = index(zone);
  auto& holders = zones_[i].holders;
  if (std::ranges::find(holders, who) != holders.end()) return;
  const double kelvin = temperature_k(i, now);
  holders.push_back(who);
  set_out(i, kelvin, now);
}

void Thermal::release(std::string_view zone, const void* who, Time now) {
  const std::size_t i = index(zone);
  const double kelvin = temperature_k(i, now);
  const bool held = std::erase(zones_[i].holders, who) > 0;
  const bool warmed = std::erase_if(zones_[i].waste_w, [&](const auto& one) { return one.first == who; }) > 0;
  if (held || warmed) set_out(i, kelvin, now);
}

bool Thermal::held(std::string_view zone) const { return !zones_[index(zone)].holders.empty(); }

void Thermal::set_waste(std::string_view zone, const void* who, double watts, Time now) {
  const std::size_t i = index(zone);
  auto& all = zones_[i].waste_w;
  const auto known = std::ranges::find(all, who, &std::pair<const void*, double>::first);
  if ((known == all.end() ? 0 : known->second) == watts) return;
  const double kelvin = temperature_k(i, now);
  if (known == all.end())
    all.emplace_back(who, watts);
  else
    known->second = watts;
  set_out(i, kelvin, now);
}

std::optional<Time> Thermal::ready_at(std::string_view name, Time now) const {
  const std::size_t i = index(name);
  const Zone& zone = zones_[i];
  const double work_k = parameters_.zones[i].work_k;
  if (temperature_k(i, now) >= work_k) return now;
  if (zone.holders.empty() || zone.first_s > kLongest) return std::nullopt;
  const Time ready =
      zone.since + temporal::Duration(static_cast<std::int64_t>(std::ceil(zone.first_s * 1e6)));
  if (ready <= now) return std::nullopt;  // it was, and the heater cannot hold it
  return ready;
}

void Thermal::set_surroundings(double kelvin, Time now) {
  std::vector<double> temperatures;
  for (std::size_t i = 0; i < zones_.size(); ++i) temperatures.push_back(temperature_k(i, now));
  parameters_.surroundings_k = kelvin;
  for (std::size_t i = 0; i < zones_.size(); ++i) set_out(i, temperatures[i], now);
}

void Thermal::add_heat(std::string_view zone, double joules, Time now) {
  const std::size_t i = index(zone);
  set_out(i, std::max(0.0, temperature_k(i, now) + joules / parameters_.zones[i].capacity_j_k), now);
}

std::map<std::string, double> Thermal::memory(Time now) const {
  std::map<std::string, double> out;
  for (std::size_t i = 0; i < zones_.size(); ++i) out[parameters_.zones[i].name] = temperature_k(i, now);
  return out;
}

void Thermal::restore(const std::map<std::string, double>& temperatures, Time at) {
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    const auto known = temperatures.find(parameters_.zones[i].name);
    if (known != temperatures.end()) set_out(i, std::max(0.0, known->second), at);
  }
}

}  // namespace roci::sim::world
