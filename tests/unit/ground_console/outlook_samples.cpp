#include "tests/unit/ground_console/outlook_samples.hpp"

#include <string>
#include <utility>
#include <vector>

namespace roci::console::testing {
namespace {

constexpr std::int64_t kHour = 3'600'000'000;

v1::ScheduledProduct data(const std::string& id, std::uint64_t bytes, v1::DataTier tier, bool exists = true) {
  v1::ScheduledProduct out;
  out.id(id);
  out.exists(exists);
  out.bytes(bytes);
  out.tier(tier);
  return out;
}

v1::ScheduledDownlink downlink(const std::string& activity, std::int64_t start_us, std::int64_t lasts_us,
                               std::vector<v1::ScheduledProduct> products) {
  constexpr std::int64_t kBytesPerS = 6'250;
  v1::ScheduledDownlink out;
  out.activity(activity);
  out.start_us(start_us);
  out.end_us(start_us + lasts_us);
  for (const v1::ScheduledProduct& one : products) out.bytes(out.bytes() + one.bytes());
  out.takes_us(static_cast<std::int64_t>(out.bytes()) * 1'000'000 / kBytesPerS);
  out.energy_j(static_cast<double>(out.takes_us()) / 1e6 * 100);
  out.products(std::move(products));
  return out;
}

v1::UnsentProduct unsent(v1::ScheduledProduct what, const std::string& why) {
  v1::UnsentProduct out;
  out.data(std::move(what));
  out.why(why);
  return out;
}

v1::UtilityRank rank(const std::string& name, const std::string& meaning) {
  v1::UtilityRank out;
  out.name(name);
  out.meaning(meaning);
  return out;
}

std::vector<v1::UtilityRank> ranks() {
  return {
      rank("mission", "a sample where the science subway map leads"),
      rank("analysis",
           "tasks: Science Analyze; data on Earth: summary_1_0, raw_1_0, summary_1_1, raw_1_1 and 14 more"),
      rank("pre_collection", "data on Earth: trench_0, trench_1, trench_2"),
      rank("default", "tasks: Seismometer; data on Earth: panorama, quakes")};
}

v1::ChainOutlook chain(const std::string& request, const std::string& title, v1::ChainStage stage,
                       double start_h, double end_h, std::vector<double> predicted,
                       std::vector<double> executed, double cost_j) {
  v1::ChainOutlook out;
  out.request(request);
  out.title(title);
  out.chain(request + "/whole");
  out.block(static_cast<std::uint32_t>(start_h));
  out.stage(stage);
  out.start_us(static_cast<std::int64_t>(start_h * kHour));
  out.end_us(static_cast<std::int64_t>(end_h * kHour));
  out.predicted(std::move(predicted));
  out.executed(std::move(executed));
  out.cost_j(cost_j);
  return out;
}

v1::ProductOutlook product(v1::ScheduledProduct what, const std::string& request, v1::ProductFate fate,
                           std::vector<double> predicted, std::vector<double> executed) {
  v1::ProductOutlook out;
  out.data(std::move(what));
  out.request(request);
  out.fate(fate);
  out.predicted(std::move(predicted));
  out.executed(std::move(executed));
  return out;
}

v1::EnergyPoint energy(double hours, const std::string& activity, double spent_j) {
  constexpr double kNow = 61e6;
  v1::EnergyPoint out;
  out.at_us(static_cast<std::int64_t>(hours * kHour));
  out.activity(activity);
  out.predicted_j(kNow - spent_j);
  out.worst_j(std::max(0.0, kNow - 1.1 * spent_j));
  out.best_j(kNow - 0.9 * spent_j);
  return out;
}

v1::SubwayTarget target(const std::string& task, double visual, double chance, v1::SignatureOutcome outcome,
                        bool planned = false, bool closed = false) {
  v1::SubwayTarget out;
  out.task(task);
  out.visual(visual);
  out.estimated(visual * chance);
  out.outcome(outcome);
  out.planned(planned);
  out.closed(closed);
  return out;
}

v1::SubwaySite site(const std::string& name, double by_vision, double chance,
                    std::vector<v1::SubwayTarget> targets) {
  v1::SubwaySite out;
  out.name(name);
  out.by_vision(by_vision);
  out.chance(chance);
  out.targets(std::move(targets));
  return out;
}

template <class Sample>
void made(Sample& out) {
  out.robot("lander");
  out.version(7);
  out.plan_version(12);
  out.made_us(90 * kHour);
  out.network("rsm1");
  out.network_version(3);
  out.ranks(ranks());
}

}  // namespace

v1::DownlinkSchedule schedule_of_a_lander() {
  v1::DownlinkSchedule out;
  made(out);
  out.limited(true);
  out.downlinks(
      {downlink(
           "downlink#31.3", 92 * kHour, kHour / 2,
           {data("lab-0001", 400'000, v1::TIER_CRITICAL), data("lab-0002", 2'500'000, v1::TIER_DECISIONAL),
            data("cam-0007", 8'000'000, v1::TIER_MANDATORY)}),
       downlink("downlink#32.6", 130 * kHour, kHour,
                {data("sample_2_0/science_analyze/summary_2_0", 2'500'000, v1::TIER_DECISIONAL, false),
                 data("sample_2_0/science_analyze/raw_2_0", 9'000'000, v1::TIER_MANDATORY, false),
                 data("seis-0003", 6'000'000, v1::TIER_RESIDUAL)}),
       downlink("downlink#33.3", 176 * kHour, kHour / 2, {})});
  out.left_out(
      {unsent(data("lab-0003", 30'000'000, v1::TIER_RESIDUAL),
              "what the others leave of the downlinks is 8.25 MB at most in one, it has 30 MB"),
       unsent(data("cam-0009", 60'000'000, v1::TIER_MANDATORY),
              "it is larger than every downlink after its creation: the largest carries 22.5 MB until Earth "
              "sets; it stays on board until a longer downlink is planned")});
  out.late({unsent(data("lab-0002", 2'500'000, v1::TIER_DECISIONAL),
                   "it should go with downlink#30.3, which higher tiers fill")});
  return out;
}

v1::MissionOutlook outlook_of_a_lander() {
  v1::MissionOutlook out;
  made(out);
  out.received({0, 0.5, 0.3});
  out.chains({chain("sample_1_0", "Sample(1, 0)", v1::CHAIN_DONE, 20, 44, {1, 0.82}, {0, 0.9}, 9.1e6),
              chain("sample_1_1", "Sample(1, 1)", v1::CHAIN_RUNNING, 60, 92, {1, 0.7}, {0, 0.1}, 4.2e6),
              chain("excavate_2", "Open site 2", v1::CHAIN_COMMITTED, 93, 110, {0, 0, 0.3}, {}, 12.5e6),
              chain("sample_2_0", "Sample(2, 0)", v1::CHAIN_PLANNED, 112, 131, {1, 0.44}, {}, 4.4e6),
              chain("panorama_4", "Panorama", v1::CHAIN_FAILED, 50, 51, {0, 0, 0, 0.1}, {}, 0.2e6),
              chain("panorama_5", "Panorama", v1::CHAIN_PLANNED, 140, 141, {0, 0, 0, 0.1}, {}, 0.2e6)});
  out.products({product(data("lab-0001", 400'000, v1::TIER_CRITICAL), "sample_1_1", v1::PRODUCT_STORED,
                        {0, 0.1}, {0, 0.1}),
                product(data("cam-0001", 3'000'000, v1::TIER_DECISIONAL), "sample_1_0", v1::PRODUCT_RECEIVED,
                        {0, 0, 0.3}, {0, 0, 0.3}),
                product(data("lab-0000", 9'000'000, v1::TIER_MANDATORY), "sample_1_0", v1::PRODUCT_RECEIVED,
                        {0, 0.6}, {0, 0.5}),
                product(data("cam-0003", 3'000'000, v1::TIER_MANDATORY), "panorama_3", v1::PRODUCT_LOST,
                        {0, 0, 0, 0.1}, {0, 0, 0, 0.1}),
                product(data("sample_2_0/science_analyze/raw_2_0", 9'000'000, v1::TIER_MANDATORY, false),
                        "sample_2_0", v1::PRODUCT_STORED, {0, 0.6}, {})});
  out.budget("lander.battery");
  out.capacity_j(90e6);
  out.energy({energy(90, "", 0), energy(92, "downlink#31.3", 1.6e6), energy(110, "excavate#32.0", 18e6),
              energy(116, "collect#33.1", 22e6), energy(131, "downlink#33.6", 31e6),
              energy(141, "downlink#34.1", 39e6), energy(177, "downlink#35.3", 57e6)});
  out.most_samples(3);
  out.sites({site("site_2", 0.6, 0.52,
                  {target("sample_2_0", 0.9, 0.52, v1::SIGNATURE_UNKNOWN, true),
                   target("sample_2_1", 0.7, 0.52, v1::SIGNATURE_UNKNOWN),
                   target("sample_2_2", 0.5, 0.52, v1::SIGNATURE_UNKNOWN)}),
             site("site_1", 0.7, 0.5,
                  {target("sample_1_0", 0.9, 0.5, v1::SIGNATURE_POSITIVE, false, true),
                   target("sample_1_1", 0.8, 0.5, v1::SIGNATURE_NEGATIVE, true),
                   target("sample_1_2", 0.4, 0.5, v1::SIGNATURE_UNKNOWN, false, true)}),
             site("site_0", 0.4, 0.36,
                  {target("sample_0_0", 0.5, 0.36, v1::SIGNATURE_UNKNOWN),
                   target("sample_0_1", 0.8, 0.36, v1::SIGNATURE_UNKNOWN),
                   target("sample_0_2", 0.3, 0.36, v1::SIGNATURE_UNKNOWN)})});
  out.next_target("sample_2_1");
  return out;
}

}  // namespace roci::console::testing
