// This file has what the authority needs of X.509 (RFC 5280) and S/MIME (RFC 8551), on OpenSSL. Keys are of the curve
// prime256v1, the one that both DDS vendors take; signatures are ECDSA with SHA-256. All functions throw
// std::runtime_error with OpenSSL's own words when it refuses.
#pragma once

#include <openssl/evp.h>
#include <openssl/x509.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "services/certificate/subject.hpp"
#include "services/security/documents.hpp"

namespace roci::services::security {

/// Lets a std::unique_ptr release an OpenSSL object by `free`.
template <auto free>
struct Free {
  void operator()(auto* thing) const { free(thing); }
};
using Key = std::unique_ptr<EVP_PKEY, Free<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Free<&X509_free>>;
using RevocationList = std::unique_ptr<X509_CRL, Free<&X509_CRL_free>>;

/// Holds a key with the certificate of its owner.
struct Signer {
  Key key;
  Certificate certificate;
};

Key make_key();
/// Makes an authority that certifies itself, with the common name `name`.
Signer make_authority(const std::string& name, const Validity&);
/// Makes the certificate of a service over the public half of `key`, with a random serial number.
Certificate issue(const Signer& authority, const certificate::Subject&, const Key& key, const Validity&);

/// Names a revoked certificate by its serial number, in hexadecimal digits.
struct Revoked {
  std::string serial;
  std::int64_t since = 0;  ///< seconds since 1970
};
/// Makes a list that is valid for as long as its authority: both vendors refuse everybody under a list that has
/// run out.
RevocationList make_revocation_list(const Signer& authority, const std::vector<Revoked>&);

/// Signs a text as an S/MIME message of type text/plain, as DDS Security 1.1 (9.4.1.2) wants it.
std::string signed_document(const Signer& authority, const std::string& text);
/// Returns the text of such a message if `authority` signed it; throws otherwise.
std::string verified_document(const std::string& message, const X509& authority);

std::string to_pem(const Key&);
std::string to_pem(const X509&);
std::string to_pem(const X509_CRL&);
/// Read PEM files; they throw, too, if the file cannot be read.
Key read_key(const std::filesystem::path&);
Certificate read_certificate(const std::filesystem::path&);
RevocationList read_revocation_list(const std::filesystem::path&);

std::string serial_of(const X509&);
std::vector<std::uint8_t> subject_der(const X509&);
Validity validity_of(const X509&);
bool is_signed_by(const X509&, const X509& authority);
bool is_signed_by(const X509_CRL&, const X509& authority);
bool belongs_to(const X509&, const Key&);
bool is_revoked(const X509&, const X509_CRL&);

}  // namespace roci::services::security
