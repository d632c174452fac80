// What a key folder is refused for, each with its remedy.
#include "services/security/key_folder.hpp"

#include <gmock/gmock.h>

#include "services/security/private_file.hpp"
#include "tests/contract/secure/key_ring.hpp"

namespace roci::services::security {
namespace {

using contract::KeyRing;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

constexpr std::int64_t kDay = 24 * 3600;

std::string refusal(const std::string& keys, const std::string& service,
                    std::int64_t now_s = KeyRing::now_s()) {
  try {
    checked_credentials(keys, service, "fastdds", now_s);
    return "";
  } catch (const KeyError& error) {
    return error.what();
  }
}

TEST(KeyFolder, WhatTheAuthorityMadeIsTaken) {
  const KeyRing ring;
  for (const std::string service : {"exec_svc", "sim_svc", "launcher", "roci"})
    EXPECT_EQ(refusal(ring.path(), service), "");
  EXPECT_THAT(expiry_warning(files_of(ring.path(), "exec_svc", "fastdds"), KeyRing::now_s()), IsEmpty());
}

TEST(KeyFolder, IsPrivate) {
  const KeyRing ring;
  EXPECT_EQ(fs::status(ring.path()).permissions(), fs::perms::owner_all);
  const auto key = files_of(ring.path(), "exec_svc", "fastdds").private_key;
  EXPECT_EQ(fs::status(key).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(key, fs::perms::group_read, fs::perm_options::add);
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), AllOf(HasSubstr("others may read"), HasSubstr("chmod go=")));
}

TEST(KeyFolder, WhatIsMissingIsNamedWithTheRemedy) {
  const KeyRing ring;
  EXPECT_THAT(refusal("/nowhere/keys", "exec_svc"),
              AllOf(HasSubstr("no key folder"), HasSubstr("roci-keys make")));
  EXPECT_THAT(refusal(ring.path(), "stranger"),
              AllOf(HasSubstr("no certificate"), HasSubstr("roci-keys make")));
  fs::remove(ring.path() + "/revoked.pem");
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), HasSubstr("revoked.pem"));
}

TEST(KeyFolder, ACertificateRunsOutInPlainWords) {
  const KeyRing ring;
  EXPECT_THAT(refusal(ring.path(), "exec_svc", KeyRing::now_s() + 366 * kDay),
              AllOf(HasSubstr("exec_svc"), HasSubstr("ran out on 20"),
                    HasSubstr("roci-keys renew exec_svc --keys ")));
  EXPECT_THAT(refusal(ring.path(), "exec_svc", KeyRing::now_s() - 2 * kDay), HasSubstr("set the clock"));
  const auto files = files_of(ring.path(), "exec_svc", "fastdds");
  EXPECT_THAT(expiry_warning(files, KeyRing::now_s() + 360 * kDay),
              AllOf(HasSubstr("days"), HasSubstr("renew exec_svc")));
  ring.authority().renew("exec_svc", 500, KeyRing::now_s());
  EXPECT_EQ(refusal(ring.path(), "exec_svc", KeyRing::now_s() + 366 * kDay), "");
}

TEST(KeyFolder, ARevokedCertificateIsRefusedAndARenewedOneTaken) {
  const KeyRing ring;
  EXPECT_EQ(ring.authority().revoke("arm_svc", "", KeyRing::now_s()), 2) << "one for each vendor";
  EXPECT_THAT(refusal(ring.path(), "arm_svc"), AllOf(HasSubstr("revoked"), HasSubstr("renew arm_svc")));
  EXPECT_EQ(refusal(ring.path(), "exec_svc"), "");
  ring.authority().renew("arm_svc", 365, KeyRing::now_s());
  EXPECT_EQ(refusal(ring.path(), "arm_svc"), "");
}

TEST(KeyFolder, AnotherHostHasKeysOfItsOwnAndNoAuthority) {
  const KeyRing ring;
  const std::string rover = ring.path() + "-rover";
  auto authority = ring.authority();
  authority.export_to(rover, "rover", {"exec_svc", "sim_svc"}, 365, KeyRing::now_s());
  EXPECT_EQ(refusal(rover, "exec_svc"), "");
  EXPECT_THAT(refusal(rover, "planner_svc"), HasSubstr("no certificate"));
  EXPECT_FALSE(fs::exists(rover + "/authority"));
  EXPECT_THROW(Authority::open(rover), KeyError);
  EXPECT_EQ(authority.revoke("exec_svc", "rover", KeyRing::now_s()), 2);
  EXPECT_EQ(refusal(ring.path(), "exec_svc"), "") << "the ground's own holds on";
  fs::copy_file(ring.path() + "/revoked.pem", rover + "/revoked.pem", fs::copy_options::overwrite_existing);
  EXPECT_THAT(refusal(rover, "exec_svc"), HasSubstr("revoked"));
}

TEST(KeyFolder, SomebodyElsesCertificateOrDocumentIsRefused) {
  const KeyRing ring, other;
  const auto own = files_of(ring.path(), "exec_svc", "fastdds"),
             planner = files_of(ring.path(), "planner_svc", "fastdds");
  const auto strange = files_of(other.path(), "exec_svc", "fastdds");
  const auto put = [](const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  };
  put(strange.governance, own.governance);
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), HasSubstr("is not signed by"));
  put(strange.certificate, own.certificate);
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), HasSubstr("not from the authority"));
  put(planner.certificate, own.certificate);
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), HasSubstr("does not belong to its private key"));
  put(planner.private_key, own.private_key);
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), HasSubstr("somebody else"));
  write_private(own.certificate, "no certificate\n");
  EXPECT_THAT(refusal(ring.path(), "exec_svc"), HasSubstr("as a certificate"));
}

// All of these are signed by the right authority, or by one that is as good.
TEST(KeyFolder, DocumentsInTheWrongPlaceAreRefused) {
  const KeyRing ring, other;
  const auto own = files_of(ring.path(), "exec_svc", "fastdds");
  const auto put = [](const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  };
  const fs::path kept = ring.path() + "/kept";
  const auto refusal_with = [&](const fs::path& strange, const fs::path& place) {
    put(place, kept);
    put(strange, place);
    const std::string text = refusal(ring.path(), "exec_svc");
    put(kept, place);
    return text;
  };
  for (const auto& [service, vendor] : {std::pair{"arm_svc", "fastdds"}, {"exec_svc", "cyclonedds"}})
    EXPECT_THAT(refusal_with(files_of(ring.path(), service, vendor).permissions, own.permissions),
                AllOf(HasSubstr(".permissions.p7s does not hold the permissions of exec_svc for fastdds"),
                      HasSubstr("roci-keys make")));
  EXPECT_THAT(refusal_with(own.governance, own.permissions), HasSubstr("does not hold the permissions"));
  EXPECT_THAT(refusal_with(own.permissions, own.governance), HasSubstr("another document"));
  EXPECT_THAT(refusal_with(files_of(other.path(), "", "").revoked, own.revoked),
              AllOf(HasSubstr("revoked.pem is not from the authority"), HasSubstr("copy revoked.pem")));
  const fs::path earlier = ring.path() + "/earlier";
  put(own.permissions, earlier);
  ring.authority().renew("exec_svc", 900, KeyRing::now_s());
  put(earlier, own.permissions);
  EXPECT_THAT(refusal(ring.path(), "exec_svc", KeyRing::now_s() + 500 * kDay),
              HasSubstr("not as long as the certificate"));
}

TEST(KeyFolder, AProgramThatIsNotOursSaysWhatItMayDo) {
  const KeyRing ring;
  auto authority = ring.authority();
  mission::ServiceList list;
  mission::ServiceEntry beacon;
  beacon.name = "beacon";
  beacon.program = "bin/beacon_driver";
  list.services.push_back(beacon);
  EXPECT_THROW(authority.learn(list), KeyError);
  list.services.back().rights = {"owner"};
  authority.learn(list);
  EXPECT_EQ(authority.issued().services.at("beacon").roles, (std::set{Role::service, Role::owner}));
  list.services.back().rights = {"king"};
  EXPECT_THROW(authority.learn(list), KeyError);
}

}  // namespace
}  // namespace roci::services::security
