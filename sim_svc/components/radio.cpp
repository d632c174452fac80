#include "sim_svc/components/radio.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

Radio::Radio(RadioSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)), noise_(std::move(noise)) {}

State Radio::state() const { return busy() ? State{"sending", {}} : State{"idle", {}}; }

Ending Radio::begin(const world::Task& task, Time now, Surroundings& around) {
  const std::string& id = task.arguments.at("image");
  const world::Image* const image = around.body.images.find(id);
  if (image == nullptr) {
    around.body.images.note_missing(id);
    return Failure{"no-image", "no image '" + id + "' is on board; take it first"};
  }
  const auto& windows = around.environment.windows;
  const auto window = std::find_if(windows.begin(), windows.end(),
                                   [&](const world::Window& w) { return w.timeline == settings_.window; });
  if (window == windows.end() || !window->is_open(now)) {
    return Failure{"no-contact", settings_.window + " is closed; send in the next window"};
  }
  const double rate = settings_.rate_bit_s * std::max(0.1, 1 + settings_.rate_noise * noise_.normal());
  const Time sent = now + temporal::seconds(8.0 * static_cast<double>(image->bytes) / rate);
  const Time closes = window->next_change(now).value_or(sent);
  transfer_ = Transfer{id, std::min(sent, closes), closes < sent};
  return std::nullopt;
}

std::optional<Time> Radio::next_change() const {
  if (!transfer_) return std::nullopt;
  return transfer_->end;
}

Ending Radio::finish(Surroundings& around) {
  const Transfer done = *std::exchange(transfer_, std::nullopt);
  if (done.cut_off) return Failure{"contact-lost", "the window closed before the image was sent"};
  std::optional<world::Image> image = around.body.images.set_sent(done.image);
  if (!image) {
    around.body.images.note_missing(done.image);
    return Failure{"no-image", "image '" + done.image + "' is not on board any more"};
  }
  around.effects.push_back({"send", done.image});
  around.out.push_back(*std::move(image));
  return std::nullopt;
}

// What is sent already stays sent; a window that is shut before the end cuts the rest off.
void Radio::surroundings_changed(Time now, Surroundings& around) {
  if (!transfer_) return;
  const auto& windows = around.environment.windows;
  const auto window = std::ranges::find(windows, settings_.window, &world::Window::timeline);
  const Time closes = window != windows.end() && window->is_open(now) ? *window->next_change(now) : now;
  if (closes >= transfer_->end) return;
  transfer_->end = closes;
  transfer_->cut_off = true;
}

double Radio::energy_j(Time from, Time to) const {
  return busy() ? settings_.power_w * temporal::to_seconds(to - from) : 0;
}

}  // namespace roci::sim::components
