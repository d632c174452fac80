// What the generated deserialize functions ask before they take memory or believe a value (idl/bound_decoding.py puts
// the calls in). A payload comes from anybody; what it claims of itself is compared with what it holds.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/exceptions/BadParamException.h>
#include <fastcdr/exceptions/NotEnoughMemoryException.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace roci::idl {

/// Throws NotEnoughMemoryException if fewer bytes are left than `count` elements of at least `least` bytes take.
inline void check_elements(eprosima::fastcdr::Cdr& cdr, std::uint32_t count, std::size_t least) {
  auto before = cdr.getState();
  const bool there = cdr.jump(std::size_t{count} * least);
  cdr.setState(before);
  if (!there)
    throw eprosima::fastcdr::exception::NotEnoughMemoryException(
        eprosima::fastcdr::exception::NotEnoughMemoryException::NOT_ENOUGH_MEMORY_MESSAGE_DEFAULT);
}

/// The same for the sequence whose count comes next; the count stays to be read.
inline void check_count(eprosima::fastcdr::Cdr& cdr, std::size_t least) {
  auto before = cdr.getState();
  std::uint32_t count = 0;
  cdr >> count;
  check_elements(cdr, count, least);
  cdr.setState(before);
}

/// Throws BadParamException for a number that no enumerator has: `names` of them are counted from 0.
inline void check_enumerator(std::uint32_t number, std::uint32_t names) {
  if (number >= names)
    throw eprosima::fastcdr::exception::BadParamException("a number that no enumerator has");
}

template <class Enum>
void check_enumerators(const std::vector<Enum>& values, std::uint32_t names) {
  for (const Enum value : values) check_enumerator(static_cast<std::uint32_t>(value), names);
}

/// Throws BadParamException for a zero byte inside: C APIs would see a shorter text than we do.
inline void check_text(const std::string& text) {
  if (text.find('\0') != std::string::npos)
    throw eprosima::fastcdr::exception::BadParamException("text with a zero byte");
}

inline void check_text(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) check_text(text);
}

}  // namespace roci::idl
