#include "sim_svc/components/direct_radio_settings.hpp"

namespace roci::sim::components {

DirectRadioSettings read_direct_radio_settings(setup::Settings& in) {
  DirectRadioSettings out;
  out.zone = in.text("zone", out.zone);
  out.window = in.text("window", out.window);
  out.prepare_s = in.number("prepare_s", out.prepare_s);
  out.prepare_w = in.number("prepare_w", out.prepare_w);
  out.rate_byte_s = in.number("rate_byte_s", out.rate_byte_s, 1e-3);
  out.rate_noise = in.share("rate_noise", out.rate_noise);
  out.send_w = in.number("send_w", out.send_w);
  out.receive_s = in.number("receive_s", out.receive_s);
  out.receive_w = in.number("receive_w", out.receive_w);
  out.wait_w = in.number("wait_w", out.wait_w);
  out.waste_share = in.share("waste_share", out.waste_share);
  out.duration_noise = in.share("duration_noise", out.duration_noise);
  out.duration_factor = in.number("duration_factor", out.duration_factor, 1e-3);
  out.session_s = in.number("session_s", out.session_s);
  out.light_time_s = in.number("light_time_s", out.light_time_s);
  return out;
}

}  // namespace roci::sim::components
