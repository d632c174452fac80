#include "services/certificate/subject.hpp"

#include <openssl/x509.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "services/certificate/guid_prefix.hpp"

namespace roci::services::certificate {
namespace {

struct FreeName {
  void operator()(X509_NAME* name) const { X509_NAME_free(name); }
};

void add(X509_NAME* name, const char* field, const std::string& value) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(value.data());
  if (X509_NAME_add_entry_by_txt(name, field, V_ASN1_UTF8STRING, bytes, static_cast<int>(value.size()), -1,
                                 0) != 1)
    throw std::invalid_argument("\"" + value + "\" cannot stand in the subject name of a certificate");
}

bool is_name(std::string_view service) {
  return !service.empty() && service.size() <= 64 && std::ranges::all_of(service, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

// Whether GUIDs that begin so are in the upper half of those of secured participants, whose first bit is 1.
bool in_upper_half(const Start& start) { return (start[0] & 0x40) != 0; }

}  // namespace

std::string Subject::text() const { return "CN=" + service + ",OU=" + unit + ",O=Rocinante"; }

std::vector<std::uint8_t> Subject::der() const {
  const std::unique_ptr<X509_NAME, FreeName> name(X509_NAME_new());
  add(name.get(), "O", "Rocinante");
  add(name.get(), "OU", unit);
  add(name.get(), "CN", service);
  unsigned char* bytes = nullptr;
  const int size = i2d_X509_NAME(name.get(), &bytes);
  if (size <= 0) throw std::runtime_error("OpenSSL cannot encode the subject name " + text());
  std::vector<std::uint8_t> out(bytes, bytes + size);
  OPENSSL_free(bytes);
  return out;
}

Subject subject_of(std::string_view service, std::string_view vendor) {
  if (!is_name(service))
    throw std::invalid_argument(
        "\"" + std::string(service) +
        "\" is no name of a service: it consists of up to 64 letters, digits, '_', '-' and '.'");
  const bool upper = vendor == kVendors[0];
  for (int number = 0;; ++number) {
    Subject subject{std::string(service), std::string(vendor) + "-" + std::to_string(number)};
    if (in_upper_half(start_of(subject)) == upper) return subject;
  }
}

}  // namespace roci::services::certificate
