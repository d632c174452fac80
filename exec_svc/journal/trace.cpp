#include "exec_svc/journal/trace.hpp"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace roci::exec::journal {

struct Trace::Digest {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~Digest() { EVP_MD_CTX_free(context); }
};

Trace::Trace() : digest_(std::make_unique<Digest>()) {
  if (digest_->context == nullptr || EVP_DigestInit_ex(digest_->context, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available from libcrypto");
  }
}

Trace::~Trace() = default;

void Trace::add(std::string_view line) {
  EVP_DigestUpdate(digest_->context, line.data(), line.size());
  EVP_DigestUpdate(digest_->context, "\n", 1);
}

std::string Trace::sha256() const {
  Digest copy;
  EVP_MD_CTX_copy_ex(copy.context, digest_->context);
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int size = 0;
  EVP_DigestFinal_ex(copy.context, bytes.data(), &size);
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (unsigned int i = 0; i < size; ++i) {
    out += kDigits[bytes[i] >> 4];
    out += kDigits[bytes[i] & 15];
  }
  return out;
}

}  // namespace roci::exec::journal
