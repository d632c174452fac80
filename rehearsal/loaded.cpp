#include "rehearsal/loaded.hpp"

#include <dlfcn.h>

#include <string>
#include <string_view>

#include "services/process/service_program.hpp"

namespace roci::rehearsal {

namespace fs = std::filesystem;

services::MakeService* load_service(const fs::path& program) {
  const fs::path file = program.string() + ".so";
  const auto refuse = [&](const std::string& why) { throw NotLoadable(file.string() + ": " + why); };
  if (std::error_code error; !fs::is_regular_file(file, error))
    refuse("there is no such file, so that a rehearsal in one process cannot start " + program.string() +
           "; build the program with rocinante_service() (docs/sdk.md), or fly with roci-launch");
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) refuse(std::string("cannot be loaded: ") + dlerror());
  const auto* found = static_cast<const services::process::ServiceProgram*>(
      dlsym(library, services::process::kServiceProgramSymbol));
  if (found == nullptr)
    refuse("holds no service; name it with ROCI_SERVICE_PROGRAM (services/process/service_program.hpp)");
  if (found->contract != std::string_view(ROCI_ANNOUNCEMENT) ||
      found->compiler != std::string_view(__VERSION__))
    refuse("was built with another Rocinante or another compiler than this program; build it anew");
  return found->make;
}

}  // namespace roci::rehearsal
