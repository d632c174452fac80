#include "sim_svc/components/laboratory_settings.hpp"

#include <algorithm>

#include "core/words/nearest_word.hpp"
#include "sim_svc/setup/roster_file.hpp"

namespace roci::sim::components {

using mission::Entry;
using setup::Settings;

namespace {

Signature read_signature(const Entry& entry) {
  const std::string text = entry.text();
  if (text == "negative") return Signature::negative;
  if (text == "positive") return Signature::positive;
  if (text == "drawn") return Signature::drawn;
  entry.fail("unknown signature '" + text + "'; known: negative, positive, drawn" +
             words::did_you_mean(text, {"negative", "positive", "drawn"}));
}

// Reads the truths of mission.yaml, and writes over them what the scenario says of some, or with one word of all.
void read_signatures(Settings& in, LaboratorySettings& out) {
  const Entry mission = in.component().at("signatures");
  mission.each_field([&](const std::string& sample, const Entry& entry) {
    setup::check_name(sample, entry);
    out.signatures[sample] = read_signature(entry);
  });
  const Entry scenario = *in.find("signatures");
  if (scenario.place() == mission.place()) return;
  if (!scenario.is_mapping()) {
    const Signature all = read_signature(scenario);
    for (auto& [sample, truth] : out.signatures) truth = all;
    return;
  }
  std::vector<std::string> known;
  for (const auto& [sample, truth] : out.signatures) known.push_back(sample);
  scenario.each_field([&](const std::string& sample, const Entry& entry) {
    const auto found = out.signatures.find(sample);
    if (found == out.signatures.end())
      entry.fail("no sample '" + sample + "'; known: " + setup::known_names(sample, known));
    found->second = read_signature(entry);
  });
}

void read_instrument(const Entry& entry, Instrument& out) {
  entry.allow_only({"duration_s", "power_w", "heat_w"});
  out.duration_s = setup::number(entry, "duration_s", out.duration_s);
  out.power_w = setup::number(entry, "power_w", out.power_w);
  out.heat_w = setup::number(entry, "heat_w", out.heat_w);
  if (out.heat_w > out.power_w)
    entry.fail("an instrument leaves no more heat than it draws; lower heat_w, or raise power_w");
}

}  // namespace

LaboratorySettings read_laboratory_settings(Settings& in) {
  LaboratorySettings out;
  out.zone = in.text("zone", out.zone);
  for (Instrument& one : out.instruments) {
    std::string key = one.name;
    std::ranges::replace(key, '-', '_');
    if (const auto entry = in.find(key)) read_instrument(*entry, one);
  }
  out.duration_noise = in.number("duration_noise", out.duration_noise);
  out.duration_factor = in.number("duration_factor", out.duration_factor, 1e-3);
  out.power_noise = in.number("power_noise", out.power_noise);
  out.positive_share = in.share("positive_share", out.positive_share);
  out.positive_content = in.number("positive_content", out.positive_content, 0.01);
  if (const auto products = in.find("products"))
    products->each_field([&](const std::string& form, const Entry& entry) {
      out.products[form] = read_products(entry, "analyze", {"site", "target", "form"});
      apply_data_factor(in, out.products[form]);
    });
  read_signatures(in, out);
  return out;
}

}  // namespace roci::sim::components
