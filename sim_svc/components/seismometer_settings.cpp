#include "sim_svc/components/seismometer_settings.hpp"

namespace roci::sim::components {

namespace {

constexpr double kMostQuakes = 8640;  // each is drawn

}  // namespace

SeismometerSettings read_seismometer_settings(setup::Settings& in) {
  SeismometerSettings out;
  out.start_s = in.number("start_s", out.start_s);
  out.park_s = in.number("park_s", out.park_s);
  out.switch_w = in.number("switch_w", out.switch_w);
  out.record_w = in.number("record_w", out.record_w);
  out.duration_noise = in.share("duration_noise", out.duration_noise);
  out.duration_factor = in.number("duration_factor", out.duration_factor, 1e-3);
  out.quakes_per_day = in.number("quakes_per_day", out.quakes_per_day);
  if (out.quakes_per_day > kMostQuakes)
    in.find("quakes_per_day")->fail("is more than one in ten seconds; correct the number");
  out.quiet_share = in.share("quiet_share", out.quiet_share);
  out.reference_s = in.number("reference_s", out.reference_s, 1);
  if (const auto products = in.find("products")) out.products = read_products(*products, "park", {});
  apply_data_factor(in, out.products);
  return out;
}

}  // namespace roci::sim::components
