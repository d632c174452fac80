#include "services/security/x509.hpp"

#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509v3.h>

#include <ctime>
#include <stdexcept>

namespace roci::services::security {
namespace {

namespace fs = std::filesystem;

using Bio = std::unique_ptr<BIO, Free<&BIO_free_all>>;
using Message = std::unique_ptr<PKCS7, Free<&PKCS7_free>>;
using Number = std::unique_ptr<BIGNUM, Free<&BN_free>>;
using Integer = std::unique_ptr<ASN1_INTEGER, Free<&ASN1_INTEGER_free>>;
using Time = std::unique_ptr<ASN1_TIME, Free<&ASN1_TIME_free>>;

constexpr int kSmime = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;

[[noreturn]] void fail(const std::string& what) {
  char why[256] = "";
  if (const unsigned long code = ERR_get_error(); code != 0) ERR_error_string_n(code, why, sizeof why);
  ERR_clear_error();
  throw std::runtime_error("cannot " + what + (*why == '\0' ? "" : ": " + std::string(why)));
}

void require(bool done, const char* what) {
  if (!done) fail(what);
}

Bio memory(const std::string& text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

std::string text_of(BIO* memory) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(memory, &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

template <class Write>
std::string written(const char* what, Write write) {
  const Bio out(BIO_new(BIO_s_mem()));
  require(write(out.get()), what);
  return text_of(out.get());
}

template <class Thing, class Read>
Thing read_file(const fs::path& file, const char* what, Read read) {
  const Bio in(BIO_new_file(file.c_str(), "r"));
  if (!in) fail("open " + file.string());
  Thing thing(read(in.get()));
  if (!thing) fail("read " + file.string() + " as " + what);
  return thing;
}

void extend(X509& certificate, X509& issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value);
  require(extension != nullptr && X509_add_ext(&certificate, extension, -1) == 1, "extend a certificate");
  X509_EXTENSION_free(extension);
}

void number_and_date(X509& certificate, const Validity& validity) {
  const Number serial(BN_new());
  require(BN_rand(serial.get(), 127, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
              BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(&certificate)) != nullptr,
          "number a certificate");
  X509_set_version(&certificate, X509_VERSION_3);
  ASN1_TIME_set(X509_getm_notBefore(&certificate), validity.begin);
  ASN1_TIME_set(X509_getm_notAfter(&certificate), validity.end);
}

std::int64_t unix_s(const ASN1_TIME* time) {
  std::tm utc{};
  require(ASN1_TIME_to_tm(time, &utc) == 1, "read a date");
  return timegm(&utc);
}

std::string hexadecimal(const ASN1_INTEGER* number) {
  const Number value(ASN1_INTEGER_to_BN(number, nullptr));
  char* digits = BN_bn2hex(value.get());
  std::string text(digits);
  OPENSSL_free(digits);
  return text;
}

}  // namespace

Key make_key() {
  Key key(EVP_EC_gen("prime256v1"));
  require(key != nullptr, "make a key");
  return key;
}

Signer make_authority(const std::string& name, const Validity& validity) {
  Signer made{make_key(), Certificate(X509_new())};
  X509& own = *made.certificate;
  number_and_date(own, validity);
  X509_NAME* subject = X509_get_subject_name(&own);
  const auto add = [subject](const char* field, const std::string& value) {
    X509_NAME_add_entry_by_txt(subject, field, V_ASN1_UTF8STRING,
                               reinterpret_cast<const unsigned char*>(value.data()),
                               static_cast<int>(value.size()), -1, 0);
  };
  add("O", "Rocinante");
  add("CN", name);
  require(X509_set_issuer_name(&own, subject) == 1 && X509_set_pubkey(&own, made.key.get()) == 1,
          "name an authority");
  extend(own, own, NID_basic_constraints, "critical,CA:TRUE");
  extend(own, own, NID_key_usage, "critical,digitalSignature,keyCertSign,cRLSign");
  require(X509_sign(&own, made.key.get(), EVP_sha256()) > 0, "sign an authority");
  return made;
}

Certificate issue(const Signer& authority, const certificate::Subject& subject, const Key& key,
                  const Validity& validity) {
  Certificate made(X509_new());
  number_and_date(*made, validity);
  const auto der = subject.der();
  const unsigned char* at = der.data();
  const std::unique_ptr<X509_NAME, Free<&X509_NAME_free>> name(
      d2i_X509_NAME(nullptr, &at, static_cast<long>(der.size())));
  require(name && X509_set_subject_name(made.get(), name.get()) == 1 &&
              X509_set_issuer_name(made.get(), X509_get_subject_name(authority.certificate.get())) == 1 &&
              X509_set_pubkey(made.get(), key.get()) == 1,
          "name a certificate");
  extend(*made, *authority.certificate, NID_basic_constraints, "critical,CA:FALSE");
  extend(*made, *authority.certificate, NID_key_usage, "critical,digitalSignature,keyAgreement");
  require(X509_sign(made.get(), authority.key.get(), EVP_sha256()) > 0, "sign a certificate");
  return made;
}

RevocationList make_revocation_list(const Signer& authority, const std::vector<Revoked>& revoked) {
  RevocationList list(X509_CRL_new());
  X509_CRL_set_version(list.get(), X509_CRL_VERSION_2);
  X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(authority.certificate.get()));
  X509_CRL_set1_lastUpdate(list.get(), X509_get0_notBefore(authority.certificate.get()));
  X509_CRL_set1_nextUpdate(list.get(), X509_get0_notAfter(authority.certificate.get()));
  for (const Revoked& entry : revoked) {
    BIGNUM* raw = nullptr;
    require(BN_hex2bn(&raw, entry.serial.c_str()) > 0, "read a serial number");
    const Number number(raw);
    const Integer serial(BN_to_ASN1_INTEGER(number.get(), nullptr));
    const Time since(ASN1_TIME_set(nullptr, entry.since));
    X509_REVOKED* line = X509_REVOKED_new();
    X509_REVOKED_set_serialNumber(line, serial.get());
    X509_REVOKED_set_revocationDate(line, since.get());
    require(X509_CRL_add0_revoked(list.get(), line) == 1, "revoke a certificate");
  }
  X509_CRL_sort(list.get());
  require(X509_CRL_sign(list.get(), authority.key.get(), EVP_sha256()) > 0,
          "sign the list of revoked certificates");
  return list;
}

std::string signed_document(const Signer& authority, const std::string& text) {
  const Bio in = memory(text);
  const Message message(
      PKCS7_sign(authority.certificate.get(), authority.key.get(), nullptr, in.get(), kSmime));
  require(message != nullptr, "sign a document");
  return written("write a signed document",
                 [&](BIO* out) { return SMIME_write_PKCS7(out, message.get(), in.get(), kSmime) == 1; });
}

std::string verified_document(const std::string& message, const X509& authority) {
  const Bio in = memory(message);
  BIO* raw = nullptr;
  const Message read(SMIME_read_PKCS7(in.get(), &raw));
  const Bio content(raw);
  require(read != nullptr, "read a signed document");
  const std::unique_ptr<X509_STORE, Free<&X509_STORE_free>> store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), const_cast<X509*>(&authority));
  return written("verify a document", [&](BIO* out) {
    return PKCS7_verify(read.get(), nullptr, store.get(), content.get(), out, PKCS7_TEXT) == 1;
  });
}

std::string to_pem(const Key& key) {
  return written("write a key", [&](BIO* out) {
    return PEM_write_bio_PKCS8PrivateKey(out, key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1;
  });
}

std::string to_pem(const X509& certificate) {
  return written("write a certificate", [&](BIO* out) { return PEM_write_bio_X509(out, &certificate) == 1; });
}

std::string to_pem(const X509_CRL& list) {
  return written("write a list", [&](BIO* out) { return PEM_write_bio_X509_CRL(out, &list) == 1; });
}

Key read_key(const fs::path& file) {
  return read_file<Key>(file, "a private key",
                        [](BIO* in) { return PEM_read_bio_PrivateKey(in, nullptr, nullptr, nullptr); });
}

Certificate read_certificate(const fs::path& file) {
  return read_file<Certificate>(file, "a certificate",
                                [](BIO* in) { return PEM_read_bio_X509(in, nullptr, nullptr, nullptr); });
}

RevocationList read_revocation_list(const fs::path& file) {
  return read_file<RevocationList>(file, "a list of revoked certificates", [](BIO* in) {
    return PEM_read_bio_X509_CRL(in, nullptr, nullptr, nullptr);
  });
}

std::string serial_of(const X509& certificate) { return hexadecimal(X509_get0_serialNumber(&certificate)); }

std::vector<std::uint8_t> subject_der(const X509& certificate) {
  unsigned char* bytes = nullptr;
  const int size = i2d_X509_NAME(X509_get_subject_name(&certificate), &bytes);
  require(size > 0, "encode a subject name");
  std::vector<std::uint8_t> out(bytes, bytes + size);
  OPENSSL_free(bytes);
  return out;
}

Validity validity_of(const X509& certificate) {
  return {unix_s(X509_get0_notBefore(&certificate)), unix_s(X509_get0_notAfter(&certificate))};
}

bool is_signed_by(const X509& certificate, const X509& authority) {
  const bool good = X509_verify(const_cast<X509*>(&certificate), X509_get0_pubkey(&authority)) == 1;
  ERR_clear_error();
  return good;
}

bool is_signed_by(const X509_CRL& list, const X509& authority) {
  const bool good = X509_CRL_verify(const_cast<X509_CRL*>(&list), X509_get0_pubkey(&authority)) == 1;
  ERR_clear_error();
  return good;
}

bool belongs_to(const X509& certificate, const Key& key) {
  const bool good = X509_check_private_key(const_cast<X509*>(&certificate), key.get()) == 1;
  ERR_clear_error();
  return good;
}

bool is_revoked(const X509& certificate, const X509_CRL& list) {
  X509_REVOKED* entry = nullptr;
  auto* const serial = const_cast<ASN1_INTEGER*>(X509_get0_serialNumber(&certificate));
  return X509_CRL_get0_by_serial(const_cast<X509_CRL*>(&list), &entry, serial) == 1;
}

}  // namespace roci::services::security
