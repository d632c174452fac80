// This file puts the key of a sample in words, for records that people read.
#pragma once

#include <initializer_list>
#include <string>

namespace roci::services::node {

inline std::string words_of(std::initializer_list<std::string> parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : " ") + part;
  return out;
}

/// Returns the key members of a contract type in their order, separated by blanks, or an empty text for a type that
/// has none of those keys.
template <class T>
std::string key_words(const T& sample) {
  if constexpr (requires { sample.commander(), sample.epoch(), sample.activity(), sample.attempt(); })
    return words_of({sample.commander(), std::to_string(sample.epoch()), sample.activity(),
                     std::to_string(sample.attempt())});
  else if constexpr (requires { sample.executive(), sample.issuer(), sample.id(); })
    return words_of({sample.executive(), sample.issuer(), sample.id()});
  else if constexpr (requires { sample.planner(), sample.issuer(), sample.id(); })
    return words_of({sample.planner(), sample.issuer(), sample.id()});
  else if constexpr (requires { sample.issuer(), sample.id(); })
    return words_of({sample.issuer(), sample.id()});
  else if constexpr (requires { sample.found_by(), sample.id(); })
    return words_of({sample.found_by(), sample.id()});
  else if constexpr (requires { sample.executive(), sample.id(); })
    return words_of({sample.executive(), sample.id()});
  else if constexpr (requires { sample.executive(), sample.activity(); })
    return words_of({sample.executive(), sample.activity()});
  else if constexpr (requires { sample.module_name(), sample.owner(), sample.functions(); })
    return words_of({sample.module_name(), sample.owner()});
  else if constexpr (requires { sample.robot(), sample.id(); })
    return words_of({sample.robot(), sample.id()});
  else if constexpr (requires { sample.timeline(); })
    return sample.timeline();
  else if constexpr (requires { sample.author(); })
    return sample.author();
  else if constexpr (requires { sample.executive(); })
    return sample.executive();
  else if constexpr (requires { sample.product_kind(), sample.id(); })
    return sample.id();
  else
    return {};
}

}  // namespace roci::services::node
