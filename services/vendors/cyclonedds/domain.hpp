// Cyclone DDS configures a domain, not a participant: the domains of this process.
#pragma once

extern "C" {
#include <dds/dds.h>
}

#include <memory>
#include <string>

#include "services/transport/transport.hpp"
#include "services/vendors/guard/guard.hpp"

namespace roci::services::vendors::cyclonedds {

/// The XML that our settings come to: UDP unicast on options.address alone.
std::string configuration(const transport::TransportOptions&);

class Domain {
 public:
  /// `config`: XML or the path of a file with it; what of `options` it does not say is for the guard.
  Domain(const transport::TransportOptions& options, std::string config);
  ~Domain();
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

  const std::string& config() const { return config_; }
  const guard::Guard& guard() const { return *guard_; }
  /// Whether its participants have credentials: one guard stands before all of them.
  bool secure() const { return secure_; }

 private:
  const std::shared_ptr<guard::Guard> guard_;
  const std::string config_;
  const bool secure_;
  const dds_entity_t handle_;
};

/// Shared by the participants of this process that are in the same domain; they must agree on its
/// configuration. Throws TransportError.
std::shared_ptr<Domain> join_domain(const transport::TransportOptions&);

}  // namespace roci::services::vendors::cyclonedds
