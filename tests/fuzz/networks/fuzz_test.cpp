// Whatever stands in a network file, of either form, it is taken and can be used,
// or refused with its place; nothing else comes out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <string>

#include "core/bytes/crc_32.hpp"
#include "core/bytes/little_endian.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "planner_svc/utility_htn/reading/yaml.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/missions/mutate.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
namespace reading = planner::utility_htn::reading;
using planner::utility_htn::model::Network;

// What was taken can be flattened, costed and written; what was not has a fault with a place.
void use(const std::optional<Network>& network, const mission::Findings& findings) {
  if (!network) {
    ASSERT_GT(findings.errors(), 0U);
    for (const auto& finding : findings.all()) ASSERT_FALSE(finding.file.empty()) << finding.what;
    return;
  }
  const auto chains = planner::utility_htn::flattening::flatten(*network);
  const auto values = planner::utility_htn::model::priors(*network);
  for (const auto& chain : chains.chains) planner::utility_htn::flattening::cost(*network, chain, values);
  ASSERT_TRUE(reading::parse_binary(reading::to_binary(*network)) == *network);
}

class FuzzNetworks : public testing::Test {
 protected:
  FuzzNetworks() : folder_(fs::temp_directory_path() / ("roci-fuzz-networks-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/europa", folder_, fs::copy_options::recursive);
    // A key that these networks do not use.
    std::string text = read_bytes(folder_ / "lander.yaml");
    const std::string measured = "power: \"collect_w_{site}\"";
    const std::size_t place = text.find(measured);
    EXPECT_NE(place, std::string::npos);
    text.insert(place + measured.size(), ", values: {depth: \"collect_s_{site}\"}");
    write_bytes(folder_ / "lander.yaml", text);
  }
  ~FuzzNetworks() override { fs::remove_all(folder_); }

  fs::path folder_;
  std::mt19937_64 random_{11};
};

TEST_F(FuzzNetworks, ADamagedFileIsTakenOrRefusedWithItsPlace) {
  for (const char* name : {"network-bsm1.yaml", "lander.yaml", "model.yaml", "earth.yaml"}) {
    const std::string whole = read_bytes(folder_ / name);
    for (int round = 0; round < rounds(40); ++round) {
      const std::string text = damage(whole, random_);
      write_bytes(folder_ / name, text);
      mission::Findings findings;
      ASSERT_NO_FATAL_FAILURE(use(reading::load_network(folder_ / "network-bsm1.yaml", findings), findings))
          << name << ":\n"
          << text;
    }
    write_bytes(folder_ / name, whole);
  }
}

// The checksum is made anew, so that damages come as far as the fields.
TEST_F(FuzzNetworks, DamagedBytesAreTakenOrRefusedWithTheirOffset) {
  const std::string whole = reading::to_binary(reading::load_network(folder_ / "network-bsm1.yaml"));
  for (int round = 0; round < rounds(1500); ++round) {
    std::string bytes = damaged(whole.substr(0, whole.size() - 4), random_);
    bytes::append_little_endian(bytes, bytes::crc_32(bytes), reading::kChecksumBytes);
    mission::Findings findings;
    ASSERT_NO_FATAL_FAILURE(use(reading::take_network(bytes, "up.bin", findings), findings))
        << "round " << round;
  }
}

}  // namespace
}  // namespace roci::fuzz
