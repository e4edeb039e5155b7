// SPDX-License-Identifier: MIT
#include "serve/token.hpp"

#include <sys/random.h>
#include <unistd.h>

#include <stdexcept>

namespace lqg::serve {

std::string random_token() {
  unsigned char bytes[16];
  if (::getentropy(bytes, sizeof bytes) != 0)
    throw std::runtime_error("the operating system's random source gave nothing: no secret address can be made");
  std::string token;
  for (const unsigned char byte : bytes)
    for (const int shift : {4, 0}) token += "0123456789abcdef"[(byte >> shift) & 0xF];
  return token;
}

bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference =
        difference | static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  return difference == 0;
}

}  // namespace lqg::serve
