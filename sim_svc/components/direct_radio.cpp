#include "sim_svc/components/direct_radio.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Fate;
using world::Product;
using world::Surroundings;
using world::Tier;

namespace {

constexpr Time kNoBound = Time::max();

// A planned product is named <request>/<task>/<kind>, and a second one of the same name has a number behind it.
std::string_view kind_of(std::string_view planned) {
  planned.remove_prefix(planned.rfind('/') + 1);
  return planned.substr(0, planned.find(' '));
}

}  // namespace

DirectRadio::DirectRadio(DirectRadioSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)), noise_(std::move(noise)) {}

std::vector<std::string> DirectRadio::zones() const {
  if (settings_.zone.empty()) return {};
  return {settings_.zone};
}

State DirectRadio::state() const {
  if (!run_) return {"idle", {}};
  if (run_->command == "prepare") return {"preparing", {}};
  if (!run_->working) return {"waiting", {}};
  return {run_->command == "send" ? "sending" : "receiving", {}};
}

Ending DirectRadio::begin(const world::Task& task, Time now, Surroundings& around) {
  results_.clear();
  Run run;
  run.key = task.key;
  run.command = task.command;
  run.latest_end = task.latest_end.value_or(kNoBound);
  run.look_at = now;
  const double usual_s = task.command == "prepare" ? settings_.prepare_s : settings_.receive_s;
  if (task.command != "send")
    run.work_s = usual_s * settings_.duration_factor * noise_.factor(settings_.duration_noise);
  run.hollow = hollow_.take(task.command);
  run_ = std::move(run);
  if (around.body.thermal && !settings_.zone.empty()) around.body.thermal->hold(settings_.zone, this, now);
  around.effects.push_back({task.command, task.key.activity});
  return std::nullopt;
}

std::optional<Time> DirectRadio::next_change() const {
  if (!run_) return std::nullopt;
  if (run_->look_at) return run_->look_at;
  Time best = kNoBound;
  const auto consider = [&](std::optional<Time> candidate) {
    if (candidate && *candidate > run_->at) best = std::min(best, *candidate);
  };
  if (needs_contact()) consider(run_->turn);
  if (!run_->working) {
    consider(run_->warm);
    consider(run_->latest_end);
  } else if (run_->transfer) {
    best = std::min(best, end_of(*run_->transfer));
    consider(run_->latest_end);
    consider(run_->session_end);
  } else {
    best = std::min(best, run_->work_end);
  }
  if (best == kNoBound) return std::nullopt;
  return best;
}

Ending DirectRadio::finish(Surroundings& around) {
  const Time now = *next_change();
  const Ending ending = go_on(now, around);
  if (run_) set_waste(now, around.body);
  return ending;
}

void DirectRadio::look_around(Time now, const Surroundings& around) {
  const auto& windows = around.environment.windows;
  const auto window = std::ranges::find(windows, settings_.window, &world::Window::timeline);
  in_contact_ = window != windows.end() && window->is_open(now);
  run_->turn = window == windows.end() ? std::nullopt : window->next_change(now);
  run_->at = now;
  run_->look_at.reset();
  const bool heated = around.body.thermal && !settings_.zone.empty();
  run_->warm = heated ? around.body.thermal->ready_at(settings_.zone, now) : now;
}

Ending DirectRadio::go_on(Time now, Surroundings& around) {
  look_around(now, around);
  if (!run_->working) {
    const bool warm = run_->warm && *run_->warm <= now;
    const bool contact = !needs_contact() || in_contact_;
    if (!warm || !contact) {
      const bool never =
          run_->latest_end == kNoBound && ((!warm && !run_->warm) || (!contact && !run_->turn));
      if (!never && now < run_->latest_end) return std::nullopt;
      if (contact)
        return end(Failure{"too-cold", settings_.zone + " did not become warm enough"}, now, around);
      return end(Failure{"no-contact", settings_.window + " did not open; send in the next one"}, now,
                 around);
    }
    run_->working = true;
    run_->work_end = now + temporal::seconds(run_->work_s);
    const auto lasts = schedule_.lasts.find(run_->key.activity);
    if (lasts != schedule_.lasts.end())
      run_->session_end = now + lasts->second;
    else if (settings_.session_s > 0 && !named())
      run_->session_end = now + temporal::seconds(settings_.session_s);
  }
  if (run_->command == "send") return go_on_sending(now, around);
  if (now >= run_->work_end) return end(std::nullopt, now, around);
  if (needs_contact() && !in_contact_)
    return end(Failure{"contact-lost", settings_.window + " closed before all was received"}, now, around);
  return std::nullopt;
}

Ending DirectRadio::go_on_sending(Time now, Surroundings& around) {
  if (run_->transfer && end_of(*run_->transfer) <= now) note_sent(now, around);
  const bool cut_off = run_->transfer.has_value();
  const Choice next =
      cut_off ? Choice{around.body.data->find(run_->transfer->product)} : next_product(around.body);
  const Product* left = next.product;
  if (!left) return end(std::nullopt, now, around);
  // Whether it belongs to this downlink; otherwise it fills what is left of it.
  const bool due = left->tier == Tier::critical || !(cut_off ? run_->transfer->name : next.name).empty();
  const std::string unsent = "before '" + left->id + "' was sent";
  if (!in_contact_ && !due && !cut_off) return end(std::nullopt, now, around);
  if (!in_contact_) return end(Failure{"contact-lost", settings_.window + " closed " + unsent}, now, around);
  if (now >= run_->latest_end && due)
    return end(Failure{"out-of-time", "the downlink's time was over " + unsent}, now, around);
  if (now >= run_->latest_end || (now >= run_->session_end && !due)) return end(std::nullopt, now, around);
  if (!cut_off)
    run_->transfer = Transfer{left->id, next.name, static_cast<double>(left->bytes),
                              noise_.factor(settings_.rate_noise), now};
  return std::nullopt;
}

void DirectRadio::note_sent(Time now, Surroundings& around) {
  const Transfer done = *std::exchange(run_->transfer, std::nullopt);
  const Product* product = around.body.data->find(done.product);
  if (!product) return;
  run_->names_sent.insert(done.name);
  ++run_->products;
  run_->bytes += static_cast<double>(product->bytes);
  if (run_->hollow) {
    run_->hollow_sent.insert(done.product);
    return;
  }
  around.out.push_back(*around.body.data->set_fate(done.product, Fate::sent));
  around.effects.push_back({"downlink", done.product});
  arriving_[done.product] = now + temporal::seconds(settings_.light_time_s);
}

Ending DirectRadio::end(Ending ending, Time now, Surroundings& around) {
  if (run_->command == "send")
    results_ = {{"products", static_cast<double>(run_->products)}, {"bytes", run_->bytes}};
  halt(now, around);
  return ending;
}

void DirectRadio::halt(Time now, Surroundings& around) {
  if (around.body.thermal && !settings_.zone.empty()) around.body.thermal->release(settings_.zone, this, now);
  run_.reset();
}

const std::vector<std::string>* DirectRadio::named() const {
  const auto found = schedule_.products.find(run_->key.activity);
  return found == schedule_.products.end() ? nullptr : &found->second;
}

bool DirectRadio::open(const Product& product) const {
  return product.fate == Fate::stored && !run_->hollow_sent.contains(product.id);
}

DirectRadio::Choice DirectRadio::next_product(const world::Body& body) const {
  if (!body.data) return {};
  const Product* best = nullptr;  // of the most urgent tier the oldest
  for (const Product& one : body.data->products())
    if (open(one) && (!best || one.tier < best->tier)) best = &one;
  if (!best || best->tier == Tier::critical || !named()) return {best};
  const Choice next = next_named(*body.data);
  return next.product || run_->session_end == kNoBound ? next : Choice{best};
}

DirectRadio::Choice DirectRadio::next_named(const world::DataStore& store) const {
  const auto& names = *named();
  for (const std::string& name : names) {
    const Product* existing = store.find(name);
    if (existing && open(*existing)) return {existing, name};
    if (existing || name.find('/') == std::string::npos || run_->names_sent.contains(name)) continue;
    for (const Product& one : store.products())
      if (open(one) && one.kind == kind_of(name) && std::ranges::find(names, one.id) == names.end())
        return {&one, name};
  }
  return {};
}

double DirectRadio::rate_byte_s(const Transfer& transfer) const {
  return settings_.rate_byte_s * rate_factor_ * transfer.rate_noise;
}

Time DirectRadio::end_of(const Transfer& transfer) const {
  return transfer.since + temporal::seconds(transfer.bytes / rate_byte_s(transfer));
}

void DirectRadio::change_rate(double factor, Time now) {
  if (run_ && run_->transfer) {
    Transfer& transfer = *run_->transfer;
    const double gone = rate_byte_s(transfer) * temporal::to_seconds(now - transfer.since);
    transfer.bytes = std::max(0.0, transfer.bytes - gone);
    transfer.since = now;
  }
  rate_factor_ = factor;
}

void DirectRadio::surroundings_changed(Time now, Surroundings&) {
  if (run_) run_->look_at = now;
}

void DirectRadio::settle(Time now, world::Body& body) {
  if (!run_ || run_->working || !body.thermal || settings_.zone.empty()) return;
  const auto warm = body.thermal->ready_at(settings_.zone, now);
  const bool was_warm = run_->warm && *run_->warm <= now;
  if (warm && was_warm) return;
  run_->warm = warm;
}

std::optional<Time> DirectRadio::next_routine() const {
  std::optional<Time> best;
  for (const auto& [product, at] : arriving_)
    if (!best || at < *best) best = at;
  return best;
}

void DirectRadio::run_routine(Time now, bool, Surroundings& around) {
  for (auto one = arriving_.begin(); one != arriving_.end();) {
    if (one->second > now) {
      ++one;
      continue;
    }
    if (around.body.data)
      if (auto product = around.body.data->set_fate(one->first, Fate::received))
        around.out.push_back(std::move(*product));
    one = arriving_.erase(one);
  }
}

double DirectRadio::power_w() const {
  if (!run_) return 0;
  if (!run_->working) return settings_.wait_w;
  if (run_->command == "prepare") return settings_.prepare_w;
  return run_->command == "send" ? settings_.send_w : settings_.receive_w;
}

double DirectRadio::energy_j(Time from, Time to) const { return power_w() * temporal::to_seconds(to - from); }

double DirectRadio::peak_power_w() const {
  if (!run_) return 0;
  return std::max({settings_.wait_w, settings_.prepare_w, settings_.send_w, settings_.receive_w});
}

void DirectRadio::set_waste(Time now, world::Body& body) const {
  if (body.thermal && !settings_.zone.empty())
    body.thermal->set_waste(settings_.zone, this, settings_.waste_share * power_w(), now);
}

world::Memory DirectRadio::memory() const {
  world::Memory out;
  for (const auto& [product, at] : arriving_) out[product] = static_cast<double>(at.count());
  return out;
}

void DirectRadio::restore(const world::Memory& memory) {
  for (const auto& [product, at] : memory)
    if (const auto* count = std::get_if<double>(&at); count && *count >= 0 && *count < 1e18)
      arriving_[product] = Time(static_cast<std::int64_t>(*count));
}

}  // namespace roci::sim::components
