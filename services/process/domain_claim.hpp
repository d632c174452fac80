// A domain claim finds a domain id that is free on this machine, so that missions and tests run side by side
// without hearing each other.
#pragma once

namespace roci::services::process {

/// Returns whether participants of this host (in this network namespace) are on the domain.
bool has_participants(int domain);

/// Holds a domain id from 1 to 100 until it is destroyed or the process ends, against every other DomainClaim
/// on this host (in this network namespace) and against participants that are there already. Children inherit
/// the claim over fork(), not over exec().
class DomainClaim {
 public:
  /// Claims a domain id. Throws TransportError when all are taken.
  DomainClaim();
  ~DomainClaim();
  DomainClaim(const DomainClaim&) = delete;
  DomainClaim& operator=(const DomainClaim&) = delete;

  int id() const { return id_; }

 private:
  int id_ = 0;
  int socket_ = -1;
};

}  // namespace roci::services::process
