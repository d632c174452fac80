// The fixture of the contract: one suite, run for every transport and for both mixed directions.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>

#include "services/domain_claim.hpp"
#include "services/transport.hpp"

namespace roci::services::contract {

struct Pairing {
  std::string writer;
  std::string reader;
};

inline std::string name_of(const Pairing& pairing) {
  return pairing.writer == pairing.reader ? pairing.writer : pairing.writer + "_to_" + pairing.reader;
}

inline void PrintTo(const Pairing& pairing, std::ostream* out) { *out << name_of(pairing); }

inline const auto kEveryPairing = testing::Values(
    Pairing{"inproc", "inproc"}, Pairing{"fastdds", "fastdds"}, Pairing{"cyclonedds", "cyclonedds"},
    Pairing{"fastdds", "cyclonedds"}, Pairing{"cyclonedds", "fastdds"});
inline const auto kEveryNetworkPairing =
    testing::Values(Pairing{"fastdds", "fastdds"}, Pairing{"cyclonedds", "cyclonedds"},
                    Pairing{"fastdds", "cyclonedds"}, Pairing{"cyclonedds", "fastdds"});

inline std::string pairing_name(const testing::TestParamInfo<Pairing>& info) { return name_of(info.param); }

// Two participants in this process: one that writes, one that reads, in a domain of their own.
class PairingTest : public testing::TestWithParam<Pairing> {
 protected:
  std::unique_ptr<Transport> open(const std::string& vendor, TransportOptions options = {}) {
    if (options.domain == 0) options.domain = domain_.id();
    options.participant = "contract";
    return open_transport(vendor, options);
  }
  std::unique_ptr<Transport> open_writing(const TransportOptions& options = {}) {
    return open(GetParam().writer, options);
  }
  std::unique_ptr<Transport> open_reading(const TransportOptions& options = {}) {
    return open(GetParam().reader, options);
  }

  DomainClaim domain_;
};

}  // namespace roci::services::contract
