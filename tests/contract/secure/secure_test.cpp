// Secure participants in processes of their own, on each vendor and mixed: who has a certificate with the right rights
// is heard, and nobody else. The goal is a topic that the ground (`roci`) and science_svc may write,
// and the executive may read.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "services/node.hpp"
#include "services/node/node_impl.hpp"
#include "services/publisher.hpp"
#include "services/security/documents.hpp"
#include "services/security/key_folder.hpp"
#include "services/security/private_file.hpp"
#include "tests/contract/hostile/participant.hpp"
#include "tests/contract/secure/key_ring.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/peers.hpp"

namespace roci::services::contract {
namespace {

using testing::Contains;
using testing::Not;

constexpr std::chrono::seconds kPatience{30};

class Secure : public testing::TestWithParam<Pairing> {
 protected:
  ChildProcess certified(const std::string& vendor, const std::string& role,
                         const std::string& service) const {
    return with_keys(vendor, role, service, ring_.path());
  }
  ChildProcess with_keys(const std::string& vendor, const std::string& role, const std::string& service,
                         const std::string& keys) const {
    return ChildProcess(peer_command(vendor, role, domain_.id()), peer_keys(keys, service));
  }
  ChildProcess outsider(const std::string& vendor, const std::string& role) const {
    return ChildProcess(peer_command(vendor, role, domain_.id()), {"PEER_PARTITION=roci.team"});
  }

  // Two others find each other and speak, and `listener`, who was there before, hears them, too.
  void let_two_others_meet(ChildProcess* listener = nullptr) const {
    ChildProcess writer = certified(GetParam().writer, "goal-writer", "roci");
    ChildProcess reader = certified(GetParam().reader, "goal-reader", "exec_svc");
    writer.send("write ground later 1");
    ASSERT_TRUE(reader.wait_for("goal ground later 1", kPatience));
    if (listener != nullptr) {
      ASSERT_TRUE(listener->wait_for("goal ground later 1", kPatience));
    }
  }

  // A writer that opened, and that a certified reader does not hear.
  void expect_unheard(ChildProcess& thief) const {
    ASSERT_TRUE(thief.wait_for("ready", kPatience));
    thief.send("write ground theft 1");
    ChildProcess reader = certified(GetParam().reader, "goal-reader", "exec_svc");
    let_two_others_meet(&reader);
    EXPECT_THAT(reader.lines(), Not(Contains("goal ground theft 1")));
  }

  process::DomainClaim domain_;
  KeyRing ring_;
};

TEST_P(Secure, CertifiedParticipantsHearEachOtherAndOutsidersSeeNobody) {
  ChildProcess spy = outsider(GetParam().reader, "goal-reader");
  ChildProcess liar = outsider(GetParam().writer, "goal-writer");
  liar.send("write ground lie 1");
  ChildProcess writer = certified(GetParam().writer, "goal-writer", "roci");
  writer.send("write ground photo 1");
  ChildProcess reader = certified(GetParam().reader, "goal-reader", "exec_svc");
  ASSERT_TRUE(reader.wait_for("goal ground photo 1", kPatience));
  let_two_others_meet();
  // The two outsiders alone see each other.
  ASSERT_TRUE(spy.wait_for("goal ground lie 1", kPatience));
  EXPECT_THAT(spy.lines(), Not(Contains("goal ground photo 1")));
  EXPECT_THAT(spy.lines(), Not(Contains("goal ground later 1")));
  EXPECT_THAT(spy.lines(), Not(Contains("matched 2")));
  EXPECT_THAT(liar.lines(), Not(Contains("matched 2")));
  writer.send("dispose ground photo");
  ASSERT_TRUE(reader.wait_for("disposed ground photo", kPatience));
  EXPECT_THAT(reader.lines(), Not(Contains("goal ground lie 1")));
  EXPECT_EQ(writer.finish(), 0);
}

// Whoever ends the handshake packs that end behind what only the end makes readable, as Cyclone DDS does now and then.
TEST_P(Secure, AHandshakeEndsWhateverItsEndIsPackedWith) {
  const auto packing = [&](const std::string& vendor, const std::string& role, const std::string& service) {
    auto environment = peer_keys(ring_.path(), service);
    environment.emplace_back("LD_PRELOAD=" ROCI_PACKED_FINAL);
    return ChildProcess(peer_command(vendor, role, domain_.id()), environment);
  };
  ChildProcess reader = packing(GetParam().reader, "goal-reader", "exec_svc");
  ChildProcess writer = packing(GetParam().writer, "goal-writer", "roci");
  writer.send("write ground photo 1");
  EXPECT_TRUE(reader.wait_for("goal ground photo 1", kPatience));
}

// Whom nobody heard for longer than its lease, while it heard all others, shakes hands anew.
class OnceUnheard : public Secure {
 protected:
  ChildProcess mutable_one(const std::string& vendor, const std::string& role,
                           const std::string& service) const {
    auto environment = peer_keys(ring_.path(), service);
    environment.emplace_back("LD_PRELOAD=" ROCI_MUTE);
    environment.emplace_back("ROCI_MUTE=" + silence_.string());
    return ChildProcess(peer_command(vendor, role, domain_.id()), environment);
  }
  // `other` of the two hears nothing of the mute one until it has given it up.
  void expect_heard_after_silence(ChildProcess& writer, ChildProcess& reader, ChildProcess& other) const {
    writer.send("write ground photo 1");
    ASSERT_TRUE(reader.wait_for("goal ground photo 1", kPatience));
    std::ofstream{silence_};
    ASSERT_TRUE(other.wait_for("matched 0", kPatience));
    std::filesystem::remove(silence_);
    writer.send("write ground again 1");
    EXPECT_TRUE(reader.wait_for("goal ground again 1", 2 * kPatience));
  }
  const std::filesystem::path silence_ = ring_.path() + "/silence";
};

TEST_P(OnceUnheard, AWriterIsHeardAgain) {
  ChildProcess reader = certified(GetParam().reader, "goal-reader", "exec_svc");
  ChildProcess writer = mutable_one(GetParam().writer, "goal-writer", "roci");
  expect_heard_after_silence(writer, reader, reader);
}

TEST_P(OnceUnheard, AReaderHearsAgain) {
  ChildProcess reader = mutable_one(GetParam().reader, "goal-reader", "exec_svc");
  ChildProcess writer = certified(GetParam().writer, "goal-writer", "roci");
  expect_heard_after_silence(writer, reader, writer);
}

INSTANTIATE_TEST_SUITE_P(Vendors, OnceUnheard, kEveryNetworkPairing, pairing_name);

// Its own library refuses it, with the documents that it was given.
// They stand outside the encryption, so whoever has no key can send them: to a reader that nobody has met, and to a pair
// that has shaken hands.
TEST_P(Secure, StatisticsInTheMiddleOfAMessageAreNotRead) {
  constexpr std::uint32_t kLoopback = 0x7f000001;
  const hostile::Participant attacker(kLoopback, domain_.id(), hostile::kEprosima, 1, "");
  ChildProcess reader = certified(GetParam().reader, "goal-reader", "exec_svc");
  ASSERT_TRUE(reader.wait_for("ready", kPatience));
  attacker.send_statistics_in_the_middle();
  ChildProcess writer = certified(GetParam().writer, "goal-writer", "roci");
  writer.send("write ground photo 1");
  ASSERT_TRUE(reader.wait_for("goal ground photo 1", kPatience));
  attacker.send_statistics_in_the_middle();
  writer.send("write ground photo 2");
  EXPECT_TRUE(reader.wait_for("goal ground photo 2", kPatience));
  EXPECT_EQ(writer.finish(), 0);
  EXPECT_EQ(reader.finish(), 0);
}

TEST_P(Secure, ACertificateWithTheWrongRightsOpensNoWriter) {
  ChildProcess thief = certified(GetParam().writer, "goal-writer", "pathplan_svc");
  EXPECT_EQ(thief.finish(), 2);
  EXPECT_THAT(thief.lines(), Not(Contains("ready")));
}

// Its own library has been made to let it write; everybody else's does not take it.
TEST_P(Secure, ACertificateWithTheWrongRightsIsNotHeardByOthers) {
  auto environment = peer_keys(ring_.path(), "pathplan_svc");
  environment.emplace_back("LD_PRELOAD=" ROCI_LAWLESS);
  ChildProcess thief(peer_command("fastdds", "goal-writer", domain_.id()), environment);
  expect_unheard(thief);
}

// Its governance says that nobody needs a right; all must have the same.
TEST_P(Secure, AParticipantWithAnotherGovernanceIsNotHeard) {
  const std::string keys = ring_.stolen_copy("lax");
  std::string lax = security::governance();
  const std::string rule = "<enable_write_access_control>true";
  lax.replace(lax.find(rule), rule.size(), "<enable_write_access_control>false");
  const security::Signer authority{security::read_key(keys + "/authority/permissions.key"),
                                   security::read_certificate(keys + "/permissions_authority.pem")};
  security::write_private(keys + "/governance.p7s", security::signed_document(authority, lax));
  ChildProcess thief = with_keys(GetParam().writer, "goal-writer", "pathplan_svc", keys);
  expect_unheard(thief);
}

// With the keys, the documents and the list of revoked certificates of before.
TEST_P(Secure, ARevokedCertificateIsNotHeardByOthers) {
  const std::string keys = ring_.stolen_copy("before");
  ring_.authority().revoke("science_svc", "", KeyRing::now_s());
  ChildProcess thief = with_keys(GetParam().writer, "goal-writer", "science_svc", keys);
  expect_unheard(thief);
}

TEST_P(Secure, AnExpiredCertificateOpensNothing) {
  ring_.authority().renew("roci", 1, KeyRing::now_s() - 10 * 24 * 3600);
  ChildProcess late = certified(GetParam().writer, "goal-writer", "roci");
  EXPECT_EQ(late.finish(), 2);
  EXPECT_THAT(late.lines(), Not(Contains("ready")));
}

// science_svc may write goals, but not in the name of the ground.
TEST_P(Secure, ASampleInTheNameOfAnotherServiceIsRefused) {
  transport::TransportOptions options{.domain = domain_.id(), .participant = "exec_svc"};
  options.credentials = security::files_of(ring_.path(), "exec_svc", GetParam().reader);
  node::NodeOptions own;
  own.name = "exec_svc";
  own.run = "";
  own.clock = clock::ClockMode::live;
  Node node(own, transport::open_transport(GetParam().reader, options));
  std::vector<std::string> heard;
  subscribe(node, topics::goal,
            [&heard](const v1::Goal& goal) { heard.push_back(goal.issuer() + "/" + goal.id()); });
  ChildProcess science = certified(GetParam().writer, "goal-writer", "science_svc");
  science.send("write roci-1-2 forged 1");
  science.send("write ground forged 1");
  science.send("write science_svc find 1");
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (heard.empty() && std::chrono::steady_clock::now() < end)
    node.spin_once(std::chrono::milliseconds(50));
  EXPECT_THAT(heard, testing::ElementsAre("science_svc/find"));
  EXPECT_EQ(node.impl().rejected.count(topics::goal.name, node::SampleRejection::another_name), 2U);
}

INSTANTIATE_TEST_SUITE_P(Vendors, Secure, kEveryNetworkPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
