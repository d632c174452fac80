#include "services/vendors/cyclonedds/credentials.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

namespace roci::services::vendors::cyclonedds {
namespace {

namespace fs = std::filesystem;

// The vendor looks for its plug-ins where the loader does, but Debian puts them into a folder beside the library.
fs::path plug_in(const std::string& name) {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_domain), &library) == 0 ||
      library.dli_fname == nullptr)
    throw transport::TransportError("the library of Cyclone DDS is not found");
  const fs::path folder = fs::path(library.dli_fname).parent_path();
  for (const fs::path& place : {folder / "libddsc0debian", folder}) {
    const fs::path file = place / ("libdds_security_" + name + ".so");
    std::error_code error;
    if (fs::is_regular_file(file, error)) return file;
  }
  throw transport::TransportError(
      "Cyclone DDS has no plug-in libdds_security_" + name + ".so in " + folder.string() +
      "; install libddsc0debian of Debian 12, or choose another transport with --dds");
}

}  // namespace

void add_credentials(const transport::Credentials& own, dds_qos_t* qos) {
  const auto add = [qos](const std::string& name, const std::string& value) {
    dds_qset_prop(qos, name.c_str(), value.c_str());
  };
  const auto library = [&add](const std::string& part, const std::string& file, const std::string& name) {
    add("dds.sec." + part + ".library.path", plug_in(file));
    add("dds.sec." + part + ".library.init", "init_" + name);
    add("dds.sec." + part + ".library.finalize", "finalize_" + name);
  };
  const auto file = [](const fs::path& path) { return "file:" + path.string(); };
  library("auth", "auth", "authentication");
  library("access", "ac", "access_control");
  library("crypto", "crypto", "crypto");
  add("dds.sec.auth.identity_ca", file(own.identity_authority));
  add("dds.sec.auth.identity_certificate", file(own.certificate));
  add("dds.sec.auth.private_key", file(own.private_key));
  add("org.eclipse.cyclonedds.sec.auth.crl", file(own.revoked));
  add("dds.sec.access.permissions_ca", file(own.permissions_authority));
  add("dds.sec.access.governance", file(own.governance));
  add("dds.sec.access.permissions", file(own.permissions));
}

}  // namespace roci::services::vendors::cyclonedds
