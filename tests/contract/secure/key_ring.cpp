#include "tests/contract/secure/key_ring.hpp"

#include <unistd.h>

#include "core/mission/service_list.hpp"
#include "services/clock/wall.hpp"

namespace roci::services::contract {

namespace fs = std::filesystem;

KeyRing::KeyRing(const std::string& mission) {
  std::string made = fs::temp_directory_path() / "roci_keys_XXXXXX";
  if (mkdtemp(made.data()) == nullptr) throw std::runtime_error("cannot make " + made);
  folder_ = made;
  auto authority = security::Authority::make(path(), now_s());
  authority.learn(mission::load_service_list(mission));
  authority.issue_missing(365, now_s());
}

KeyRing::~KeyRing() {
  std::error_code none;
  fs::remove_all(folder_, none);
}

std::string KeyRing::stolen_copy(const std::string& name) const {
  fs::copy(path(), folder_ / name, fs::copy_options::recursive);
  return folder_ / name;
}

std::int64_t KeyRing::now_s() { return clock::unix_us() / 1'000'000; }

std::vector<std::string> peer_keys(const std::string& keys, const std::string& service) {
  return {"PEER_KEYS=" + keys, "PEER_SERVICE=" + service, "PEER_PARTITION=roci.team"};
}

}  // namespace roci::services::contract
