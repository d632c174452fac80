// A connection says where a program joins a run, and over which vendor. It comes from the command line, the
// environment, a host's network file and the mission file, in this order of precedence.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::process {

/// Holds what one source says; what it does not say is left to the next one.
struct ConnectionFlags {
  std::optional<std::string> dds;      ///< --dds, ROCI_DDS, dds: in the network and mission files
  std::optional<int> domain;           ///< --domain, ROCI_DOMAIN, domain:
  std::optional<std::string> address;  ///< --address, ROCI_ADDRESS, address:
  /// Holds --peers, ROCI_PEERS (separated by commas) or peers: (a list).
  std::optional<std::string> peers;
  std::optional<std::filesystem::path> network;  ///< --network, ROCI_NETWORK: the network file
  /// Holds --secure[=KEYS], ROCI_SECURE or secure: (kDefaultKeys or a key folder).
  std::optional<std::string> secure{};
};

/// Stands for the key folder that security::default_key_folder() says.
inline constexpr char kDefaultKeys[] = "default";

/// Declares, for CLI11, the flag of every command line that joins runs: --secure alone stands for kDefaultKeys.
inline constexpr char kSecureFlag[] = "--secure{default}";
inline constexpr char kSecureHelp[] =
    "Join with certificates or not at all (or ROCI_SECURE); --secure=KEYS names the key folder (default: "
    "$ROCI_KEYS, else "
    "~/.config/rocinante/keys)";

/// Holds what is needed to open a transport and to join a run.
struct Connection {
  std::string dds;
  std::string run{};  // identity of the run, where it is known; else the first that is heard
  transport::TransportOptions transport;
  std::filesystem::path network{};  ///< network file that it was read from; empty: none
  std::filesystem::path keys{};     ///< key folder of a secure run; empty: the run is plain
};

using Environment = std::function<std::optional<std::string>(const char* name)>;
Environment process_environment();

/// Joins what the sources say; `mission` is a mission folder, or empty. Throws mission::FileError for a bad file,
/// and std::invalid_argument for a bad flag or variable, or for a secure run with a vendor's own XML, which would
/// decide itself what is secured.
Connection resolve_connection(const ConnectionFlags&, const Environment&,
                              const std::filesystem::path& mission);

/// Returns the options with which `service` opens a transport, in a secure run with its credentials, which are
/// checked here; a certificate that soon runs out writes a line in the log. Throws security::KeyError, which is
/// a std::invalid_argument, with the remedy.
transport::TransportOptions admitted(const Connection&, const std::string& service);

/// Turns "a,b,c" into {"a", "b", "c"}; empty parts are left out.
std::vector<std::string> split_list(const std::string&);

}  // namespace roci::services::process
