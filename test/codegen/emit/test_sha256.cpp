// SPDX-License-Identifier: MIT
// SHA-256 against the examples of FIPS 180-4 and, around the ends of a block, against sha256sum of GNU coreutils.
#include <unity.h>

#include "emit/text/sha256.hpp"

using lqg::emit::sha256;

namespace {

void expect(const char* digest, const std::string& message) {
  TEST_ASSERT_EQUAL_STRING(digest, sha256(message).c_str());
}

void test_sha256_of_abc() { expect("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", "abc"); }

void test_sha256_of_nothing() { expect("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855", ""); }

void test_sha256_of_448_bits() {
  expect("248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1",
         "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq");
}

void test_sha256_of_896_bits() {
  expect("cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1",
         "abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmn"
         "hijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu");
}

void test_sha256_of_a_million_a() {
  expect("cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0", std::string(1000000, 'a'));
}

void test_sha256_where_length_and_padding_just_fit_into_a_block_or_do_not() {
  expect("9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318", std::string(55, 'a'));
  expect("b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a", std::string(56, 'a'));
  expect("7d3e74a05d7db15bce4ad9ec0658ea98e3f06eeecf16b4c6fff2da457ddc2f34", std::string(63, 'a'));
  expect("ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb", std::string(64, 'a'));
  expect("31eba51c313a5c08226adf18d4a359cfdfd8d2e816b13f4af952f7ea6584dcfb", std::string(119, 'a'));
  expect("2f3d335432c70b580af0e8e1b3674a7c020d683aa5f73aaaedfdc55af904c21c", std::string(120, 'a'));
}

void test_sha256_of_bytes_that_are_no_text() {
  TEST_ASSERT_TRUE(sha256(std::string(1, '\0')) != sha256(""));
  TEST_ASSERT_TRUE(sha256(std::string("\xff\x80", 2)) != sha256(std::string("\x7f", 1)));
  TEST_ASSERT_EQUAL_size_t(64, sha256(std::string("\xff\0\x80", 3)).size());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_sha256_of_abc);
  RUN_TEST(test_sha256_of_nothing);
  RUN_TEST(test_sha256_of_448_bits);
  RUN_TEST(test_sha256_of_896_bits);
  RUN_TEST(test_sha256_of_a_million_a);
  RUN_TEST(test_sha256_where_length_and_padding_just_fit_into_a_block_or_do_not);
  RUN_TEST(test_sha256_of_bytes_that_are_no_text);
  return UNITY_END();
}
