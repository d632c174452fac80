// The table of topics by the name under which users of the SDK include it.
#pragma once

#include "services/topics/topics.hpp"
