// Transports are known by the name of their vendor: each is a shared object that is opened when a program
// asks for it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::transport {

/// Opens libroci_transport_<vendor>.so in a folder of ROCI_PLUGIN_PATH (colon-separated), else in
/// lib/rocinante beside the running program's bin folder. Throws TransportError naming the vendors that are
/// installed when `vendor` is unknown or missing.
std::unique_ptr<Transport> open_transport(std::string_view vendor, const TransportOptions&);
std::vector<std::string> installed_transports();

/// Returns the folders that are searched here, for the ROCI_PLUGIN_PATH of a program that stands elsewhere.
std::string plugin_path();

}  // namespace roci::services::transport
