// The files of a key folder, damaged: a service starts with what was signed for it, or says what is wrong.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "services/security/key_folder.hpp"
#include "tests/contract/secure/key_ring.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
namespace security = services::security;
using services::contract::KeyRing;

TEST(FuzzKeys, ADamagedFileIsReadOrRefused) {
  const KeyRing ring;
  std::mt19937_64 random(1);
  const auto own = security::files_of(ring.path(), "exec_svc", "fastdds");
  const fs::path book = fs::path(ring.path()) / "authority/issued.json";
  for (const fs::path& file : {own.identity_authority, own.permissions_authority, own.revoked, own.governance,
                               own.certificate, own.private_key, own.permissions, book}) {
    const std::string whole = read_bytes(file);
    for (int round = 0; round < rounds(60); ++round) {
      write_bytes(file, damaged(whole, random));
      try {
        security::checked_credentials(ring.path(), "exec_svc", "fastdds", KeyRing::now_s());
        security::read_issued(book);
      } catch (const security::KeyError&) {
      } catch (const std::exception& error) {
        FAIL() << file << " in round " << round << " lets out " << error.what();
      }
    }
    write_bytes(file, whole);
  }
  EXPECT_NO_THROW(security::checked_credentials(ring.path(), "exec_svc", "fastdds", KeyRing::now_s()));
}

}  // namespace
}  // namespace roci::fuzz
