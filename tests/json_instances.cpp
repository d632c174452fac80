#include "tests/json_instances.hpp"

ROCI_JSON_INSTANCES()
