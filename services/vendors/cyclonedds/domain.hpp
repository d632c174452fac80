// Cyclone DDS configures a domain, not a participant; these are the domains of this process.
#pragma once

extern "C" {
#include <dds/dds.h>
}

#include <memory>
#include <string>

#include "services/transport/transport.hpp"
#include "services/vendors/guard/guard.hpp"

namespace roci::services::vendors::cyclonedds {

/// Returns our settings as XML: UDP unicast on options.address alone.
std::string configuration(const transport::TransportOptions&);

/// Holds a configured domain of this process, with the guard before it.
class Domain {
 public:
  /// Opens a domain with `config`, XML or the path of a file with it; the guard gets the part of `options`
  /// that `config` cannot say.
  Domain(const transport::TransportOptions& options, std::string config);
  ~Domain();
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

  const std::string& config() const { return config_; }
  const guard::Guard& guard() const { return *guard_; }
  /// Returns whether its participants have credentials: one guard stands before all of them.
  bool secure() const { return secure_; }

 private:
  const std::shared_ptr<guard::Guard> guard_;
  const std::string config_;
  const bool secure_;
  const dds_entity_t handle_;
};

/// Returns the domain that the participants of this process share; they must agree on its configuration.
/// Throws TransportError.
std::shared_ptr<Domain> join_domain(const transport::TransportOptions&);

}  // namespace roci::services::vendors::cyclonedds
