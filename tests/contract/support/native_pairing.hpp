// Our transports with participants that are not ours: a program on a vendor's own API with the
// vendor's own generated types.
#pragma once

#include <algorithm>
#include <string>

#include "tests/contract/support/pairing.hpp"

namespace roci::services::contract {

// Each vendor's own program with each of our transports, in both directions.
inline const auto kEveryNativePairing =
    testing::Values(Pairing{"native-fastdds", "fastdds"}, Pairing{"native-fastdds", "cyclonedds"},
                    Pairing{"native-cyclonedds", "fastdds"}, Pairing{"native-cyclonedds", "cyclonedds"},
                    Pairing{"fastdds", "native-fastdds"}, Pairing{"cyclonedds", "native-fastdds"},
                    Pairing{"fastdds", "native-cyclonedds"}, Pairing{"cyclonedds", "native-cyclonedds"});

// Names of tests hold no dashes.
inline std::string native_pairing_name(const testing::TestParamInfo<Pairing>& info) {
  std::string name = name_of(info.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace roci::services::contract
