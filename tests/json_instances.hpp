// nlohmann::json is compiled once for all tests (json_instances.cpp): each source that reads or prints JSON compiled its
// parser and printer again, which was a sixth of the time that tests took to build.
#pragma once

#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Declares, or with an empty WHERE defines, what of the library is instantiated; INPUT is what text is read from.
#define ROCI_JSON_PARSER(WHERE, INPUT)                                                     \
  WHERE template class nlohmann::detail::lexer<nlohmann::json, INPUT>;                     \
  WHERE template class nlohmann::detail::parser<nlohmann::json, INPUT>;                    \
  WHERE template bool nlohmann::detail::parser<nlohmann::json, INPUT>::sax_parse_internal( \
      nlohmann::detail::json_sax_dom_parser<nlohmann::json>*);                             \
  WHERE template bool nlohmann::detail::parser<nlohmann::json, INPUT>::sax_parse_internal( \
      nlohmann::detail::json_sax_dom_callback_parser<nlohmann::json>*);
#define ROCI_JSON_INSTANCES(WHERE)                                                               \
  WHERE template class nlohmann::basic_json<>;                                                   \
  WHERE template class nlohmann::detail::serializer<nlohmann::json>;                             \
  WHERE template class nlohmann::detail::json_sax_dom_parser<nlohmann::json>;                    \
  WHERE template class nlohmann::detail::json_sax_dom_callback_parser<nlohmann::json>;           \
  WHERE template class std::vector<nlohmann::json>;                                              \
  WHERE template class std::map<std::string, nlohmann::json, std::less<>>;                       \
  ROCI_JSON_PARSER(WHERE, nlohmann::detail::iterator_input_adapter<const char*>)                 \
  ROCI_JSON_PARSER(WHERE, nlohmann::detail::iterator_input_adapter<std::string::const_iterator>) \
  ROCI_JSON_PARSER(WHERE, nlohmann::detail::input_stream_adapter)

ROCI_JSON_INSTANCES(extern)
