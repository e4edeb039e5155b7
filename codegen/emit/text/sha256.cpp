// SPDX-License-Identifier: MIT
#include "emit/text/sha256.hpp"

#include <mbedtls/md.h>

#include <array>
#include <stdexcept>

namespace lqg::emit {

std::string sha256(const std::string& bytes) {
  std::array<unsigned char, 32> digest{};
  if (mbedtls_md(mbedtls_md_info_from_type(MBEDTLS_MD_SHA256), reinterpret_cast<const unsigned char*>(bytes.data()),
                 bytes.size(), digest.data()) != 0)
    throw std::runtime_error("this Mbed TLS has no SHA-256");
  std::string text;
  for (const unsigned char byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace lqg::emit
