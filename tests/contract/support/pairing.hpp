// The fixture of the contract: one suite, run for every transport and for both mixed directions.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>

#include "services/process/domain_claim.hpp"
#include "services/transport/plug_ins.hpp"

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
  std::unique_ptr<transport::Transport> open(const std::string& vendor,
                                             transport::TransportOptions options = {}) {
    if (options.domain == 0) options.domain = domain_.id();
    options.participant = "contract";
    return transport::open_transport(vendor, options);
  }
  std::unique_ptr<transport::Transport> open_writing(const transport::TransportOptions& options = {}) {
    return open(GetParam().writer, options);
  }
  std::unique_ptr<transport::Transport> open_reading(const transport::TransportOptions& options = {}) {
    return open(GetParam().reader, options);
  }

  process::DomainClaim domain_;
};

}  // namespace roci::services::contract
