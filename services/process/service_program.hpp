// A user's own service stands as a program, and as a file that a rehearsal loads beside it (docs/sdk.md).
#pragma once

#include "roci_idl/contract.h"
#include "services/process/service_main.hpp"
#include "services/service.hpp"

namespace roci::services::process {

/// Says which service a file holds that a rehearsal loads, and what it was built with. The file holds code of the
/// SDK, too, so its loader must be of the same build: `contract` is ROCI_ANNOUNCEMENT, `compiler` the version of the
/// compiler.
struct ServiceProgram {
  const char* contract;
  const char* compiler;
  MakeService* make;
};

/// Names the symbol under which that file exports its ServiceProgram.
inline constexpr char kServiceProgramSymbol[] = "roci_service_program";

}  // namespace roci::services::process

/// Stands once in a program, outside of every namespace: ROCI_SERVICE_PROGRAM("drill_svc", borehole::make_service). It
/// is the program's main(), and what roci-rehearse looks for in NAME.so.
#define ROCI_SERVICE_PROGRAM(name, make)                                                                \
  extern "C" __attribute__((visibility("default")))                                                     \
  const roci::services::process::ServiceProgram roci_service_program;                                   \
  const roci::services::process::ServiceProgram roci_service_program = {ROCI_ANNOUNCEMENT, __VERSION__, \
                                                                        make};                          \
  int main(int argc, char** argv) { return roci::services::process::service_main(argc, argv, name, make); }
