#include "sim_svc/radio.hpp"

#include <algorithm>

namespace roci::sim {

Radio::Radio(std::uint64_t seed) : noise_(seed, "radio") {}

Ending Radio::begin(const Task& task, Time now, Surroundings& around) {
  const RadioParameters& radio = around.robot.radio;
  const std::string& id = task.arguments.at("image");
  const auto image = around.images.find(id);
  if (image == around.images.end())
    return Failure{"no-image", "no image '" + id + "' is on board; take it first"};
  const auto window = std::find_if(around.windows.begin(), around.windows.end(),
                                   [&](const Window& w) { return w.timeline == radio.window; });
  if (window == around.windows.end() || !window->is_open(now)) {
    return Failure{"no-contact", radio.window + " is closed; send in the next window"};
  }
  const double rate = radio.rate_bit_s * std::max(0.1, 1 + radio.rate_noise * noise_.normal());
  const Time sent = now + seconds(8.0 * static_cast<double>(image->second.bytes) / rate);
  const Time closes = window->next_change(now).value_or(sent);
  transfer_ = Transfer{id, std::min(sent, closes), closes < sent};
  power_w_ = radio.power_w;
  return std::nullopt;
}

std::optional<Time> Radio::next_change() const {
  if (!transfer_) return std::nullopt;
  return transfer_->end;
}

Ending Radio::finish(Surroundings& around) {
  const Transfer done = *std::move(transfer_);
  transfer_.reset();
  if (done.cut_off) return Failure{"contact-lost", "the window closed before the image was sent"};
  Image& image = around.images.at(done.image);
  image.sent = true;
  around.out.push_back(image);
  return std::nullopt;
}

}  // namespace roci::sim
