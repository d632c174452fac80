// Opening transports: which are there, and what is said when one is not or when its options make no sense.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "services/process/domain_claim.hpp"
#include "services/transport/plug_ins.hpp"
#include "services/vendors/peers.hpp"

namespace roci::services {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& open) {
  try {
    open();
  } catch (const transport::TransportError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Loader, NamesWhatIsInstalledWhenAskedForSomethingElse) {
  EXPECT_THAT(transport::installed_transports(),
              AllOf(Contains("inproc"), Contains("fastdds"), Contains("cyclonedds")));
  for (const auto* vendor : {"opendds", "", "../inproc", "inproc/"}) {
    EXPECT_THAT(refusal([vendor] { transport::open_transport(vendor, {}); }),
                AllOf(HasSubstr("cyclonedds, fastdds, inproc"), HasSubstr("--dds"), HasSubstr(vendor)));
  }
}

TEST(Loader, LooksIntoThePluginPathFirst) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "roci_plugins";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "libroci_transport_broken.so") << "no shared object";
  setenv("ROCI_PLUGIN_PATH", (":/nowhere:" + folder.string()).c_str(), 1);
  EXPECT_THAT(transport::installed_transports(), AllOf(Contains("broken"), Contains("inproc")));
  EXPECT_THAT(refusal([] { transport::open_transport("broken", {}); }),
              HasSubstr("libroci_transport_broken.so"));
  EXPECT_EQ(transport::open_transport("inproc", {})->vendor(), "inproc");
  unsetenv("ROCI_PLUGIN_PATH");
  std::filesystem::remove_all(folder);
}

TEST(Loader, RefusesAddressesThatAreNotThisHosts) {
  for (const auto* vendor : {"fastdds", "cyclonedds"}) {
    EXPECT_THAT(refusal([vendor] { transport::open_transport(vendor, {.address = "192.0.2.1"}); }),
                AllOf(HasSubstr("192.0.2.1"), HasSubstr("--address")));
    EXPECT_THAT(refusal([vendor] { transport::open_transport(vendor, {.address = "127.0.0.2"}); }),
                HasSubstr("--address"));
    EXPECT_THAT(refusal([vendor] { transport::open_transport(vendor, {.address = "localhost"}); }),
                HasSubstr("--address"));
    EXPECT_THAT(refusal([vendor] { transport::open_transport(vendor, {.peers = {"ground"}}); }),
                HasSubstr("--peers"));
    EXPECT_THAT(refusal([vendor] { transport::open_transport(vendor, {.vendor_xml = "/nowhere.xml"}); }),
                HasSubstr("/nowhere.xml"));
  }
}

TEST(Loader, PeersStayOnTheirSideOfTheLoopback) {
  EXPECT_THAT(vendors::peers_of({}), ElementsAre("127.0.0.1"));
  EXPECT_THAT(vendors::peers_of({.address = "10.77.0.1"}), ElementsAre("10.77.0.1"));
  EXPECT_THAT(vendors::peers_of({.address = "10.77.0.1", .peers = {"10.77.0.2", "10.77.0.1", "10.77.0.2"}}),
              ElementsAre("10.77.0.1", "10.77.0.2"));
  EXPECT_THAT(vendors::peers_of({.address = "127.0.0.2", .peers = {"10.77.0.2", "127.0.0.1"}}),
              ElementsAre("127.0.0.2", "127.0.0.1"));
}

TEST(DomainClaim, ClaimsAreDistinctAndEnd) {
  int freed = 0;
  {
    const process::DomainClaim first, second;
    EXPECT_NE(first.id(), second.id());
    EXPECT_GE(first.id(), 1);
    EXPECT_LE(first.id(), 100);
    freed = first.id();
  }
  EXPECT_EQ(process::DomainClaim().id(), freed);
}

TEST(DomainClaim, LeavesOutADomainWhoseFirstParticipantHasLeft) {
  for (const std::string vendor : {"fastdds", "cyclonedds"}) {
    int domain = 0;
    std::unique_ptr<transport::Transport> second;
    {
      const process::DomainClaim claim;
      domain = claim.id();
      const auto first = transport::open_transport("fastdds", {.domain = domain});
      second = transport::open_transport(vendor, {.domain = domain});
    }
    EXPECT_NE(process::DomainClaim().id(), domain) << vendor;
  }
}

}  // namespace
}  // namespace roci::services
