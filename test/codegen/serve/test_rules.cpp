// SPDX-License-Identifier: MIT
// Who may ask: everything that is not this page at this machine is refused, one header at a time.
#include <set>
#include <string>

#include <unity.h>

#include "serve/rules.hpp"
#include "serve/token.hpp"

using namespace lqg::serve;

namespace {

const Door door = {4711, "0123456789abcdef0123456789abcdef"};

Asked good(const std::string& method = "GET") {
  Asked asked;
  asked.method = method;
  asked.target = "/" + door.token + "/state?since=3";
  asked.host = "127.0.0.1:4711";
  if (method == "POST") asked.content_type = "application/json";
  return asked;
}

int status(const Asked& asked) {
  const auto refusal = refuse(asked, door);
  return refusal ? refusal->status : 200;
}

void test_the_page_itself_is_served() {
  TEST_ASSERT_EQUAL_INT(200, status(good()));
  TEST_ASSERT_EQUAL_INT(200, status(good("POST")));
  Asked asked = good("POST");
  asked.origin = "http://127.0.0.1:4711";
  asked.site = "same-origin";
  TEST_ASSERT_EQUAL_INT(200, status(asked));
  asked.host = "localhost:4711";
  asked.origin = "http://localhost:4711";
  TEST_ASSERT_EQUAL_INT(200, status(asked));
}

void test_names_that_were_made_to_lead_here_are_refused() {
  for (const char* host : {"evil.example:4711", "evil.example", "127.0.0.1", "localhost", "127.0.0.1:4712", "",
                           "127.0.0.1:4711.evil.example", "localhost.evil.example:4711", "[::1]:4711", "0.0.0.0:4711",
                           "127.0.0.1:04711", "127.0.0.1:4711 ", "127.1:4711"}) {
    Asked asked = good();
    asked.host = host;
    TEST_ASSERT_EQUAL_INT_MESSAGE(403, status(asked), host);
  }
  Asked twice = good();
  twice.hosts = 2;
  TEST_ASSERT_EQUAL_INT(403, status(twice));
}

void test_other_pages_are_refused() {
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:4711", "http://127.0.0.1:4712",
                             "http://localhost:4711", "http://127.0.0.1:4711/"}) {
    Asked asked = good("POST");
    asked.origin = origin;
    TEST_ASSERT_EQUAL_INT_MESSAGE(403, status(asked), origin);
  }
  for (const char* site : {"cross-site", "same-site"}) {
    Asked asked = good();
    asked.site = site;
    TEST_ASSERT_EQUAL_INT_MESSAGE(403, status(asked), site);
  }
}

void test_an_address_that_was_typed_opens_the_page_and_changes_nothing() {
  Asked asked = good();
  asked.site = "none";
  TEST_ASSERT_EQUAL_INT(200, status(asked));
  asked = good("POST");
  asked.site = "none";
  TEST_ASSERT_EQUAL_INT(403, status(asked));
}

void test_every_wrong_token_is_refused() {
  for (std::size_t i = 0; i < door.token.size(); ++i) {
    std::string token = door.token;
    token[i] = token[i] == 'f' ? '0' : 'f';
    Asked asked = good();
    asked.target = "/" + token + "/";
    TEST_ASSERT_EQUAL_INT(403, status(asked));
  }
  for (const std::string& target :
       {std::string("/"), std::string(""), std::string("*"), std::string("/favicon.ico"), door.token + "/",
        "//" + door.token + "/", "/" + door.token + "0/", "/" + door.token.substr(1) + "/", "/x/" + door.token,
        "http://127.0.0.1:4711/" + door.token + "/"}) {
    Asked asked = good();
    asked.target = target;
    TEST_ASSERT_EQUAL_INT_MESSAGE(403, status(asked), target.c_str());
  }
}

void test_other_methods_and_forms_are_refused() {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "HEAD", "CONNECT", "TRACE", "get", ""}) {
    Asked asked = good(method);
    TEST_ASSERT_EQUAL_INT_MESSAGE(405, status(asked), method);
  }
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data",
                           "application/jsonp", "text/plain; application/json"}) {
    Asked asked = good("POST");
    asked.content_type = type;
    TEST_ASSERT_EQUAL_INT_MESSAGE(415, status(asked), type);
  }
}

void test_path_and_query_stand_behind_the_token() {
  TEST_ASSERT_EQUAL_STRING("/state", path_of(good()).c_str());
  TEST_ASSERT_EQUAL_STRING("since=3", query_of(good()).c_str());
  Asked asked = good();
  asked.target = "/" + door.token;
  TEST_ASSERT_EQUAL_STRING("", path_of(asked).c_str());
  asked.target = "/" + door.token + "?a/b";
  TEST_ASSERT_EQUAL_STRING("", path_of(asked).c_str());
}

void test_tokens_are_long_and_each_is_another() {
  std::set<std::string> tokens;
  for (int i = 0; i < 1000; ++i) tokens.insert(random_token());
  TEST_ASSERT_EQUAL_UINT(1000, tokens.size());
  for (const std::string& token : tokens) {
    TEST_ASSERT_EQUAL_UINT(32, token.size());
    TEST_ASSERT_TRUE(token.find_first_not_of("0123456789abcdef") == token.npos);
  }
  TEST_ASSERT_TRUE(is_same_secret("abc", "abc"));
  TEST_ASSERT_FALSE(is_same_secret("abc", "abd"));
  TEST_ASSERT_FALSE(is_same_secret("abc", "ab"));
  TEST_ASSERT_FALSE(is_same_secret("", "a"));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_the_page_itself_is_served);
  RUN_TEST(test_names_that_were_made_to_lead_here_are_refused);
  RUN_TEST(test_other_pages_are_refused);
  RUN_TEST(test_an_address_that_was_typed_opens_the_page_and_changes_nothing);
  RUN_TEST(test_every_wrong_token_is_refused);
  RUN_TEST(test_other_methods_and_forms_are_refused);
  RUN_TEST(test_path_and_query_stand_behind_the_token);
  RUN_TEST(test_tokens_are_long_and_each_is_another);
  return UNITY_END();
}
