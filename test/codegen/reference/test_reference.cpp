// SPDX-License-Identifier: MIT
// What is made from the table of keys names every key and says something of it.
#include <string>

#include <unity.h>

#include "input/keys.hpp"
#include "reference/documents.hpp"

using namespace lqg;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

std::string last_word(const std::string& path) { return path.substr(path.rfind('.') + 1); }

void test_every_key_has_a_text_of_whole_sentences() {
  for (const input::KeyRule& rule : input::key_rules()) {
    TEST_ASSERT_FALSE_MESSAGE(rule.text.empty(), rule.path.c_str());
    TEST_ASSERT_EQUAL_MESSAGE('.', rule.text.back(), rule.path.c_str());
  }
}

void test_every_key_is_on_the_page_in_the_schema_and_in_the_manual() {
  const std::string page = reference::page(), schema = reference::schema(), manual = reference::manual();
  for (const input::KeyRule& rule : input::key_rules()) {
    const bool is_table =
        rule.type == input::Type::table || rule.type == input::Type::tables || rule.type == input::Type::parameters;
    const std::string heading = "[" + rule.path + "]", name = last_word(rule.path);
    TEST_ASSERT_TRUE_MESSAGE(has(page, is_table ? heading : "\n| `" + name + "` | "), rule.path.c_str());
    TEST_ASSERT_TRUE_MESSAGE(has(schema, "\"" + name + "\": {"), rule.path.c_str());
    TEST_ASSERT_TRUE_MESSAGE(has(manual, is_table ? heading : "\n.BR " + rule.path + " "), rule.path.c_str());
    for (const std::string& word : rule.words) TEST_ASSERT_TRUE_MESSAGE(has(page, "`\"" + word + "\"`"), word.c_str());
  }
}

// Alternatives are of keys that there are, or the schema would ask for what the reader of files refuses.
void test_alternatives_are_keys() {
  for (const input::Alternatives& several : input::alternatives())
    for (const std::string& key : several.keys)
      TEST_ASSERT_NOT_NULL_MESSAGE(input::find_rule(several.table + "." + key), key.c_str());
}

// A vertical bar would end a cell.
void test_every_row_of_the_page_has_four_cells() {
  const std::string page = reference::page();
  std::size_t rows = 0;
  for (std::size_t begin = page.find("\n| "); begin != page.npos; begin = page.find("\n| ", begin + 1)) {
    const std::string row = page.substr(begin + 1, page.find('\n', begin + 1) - begin - 1);
    int bars = 0;
    for (std::size_t i = 0; i < row.size(); ++i) bars += row[i] == '|' && (i == 0 || row[i - 1] != '\\');
    TEST_ASSERT_EQUAL_INT_MESSAGE(5, bars, row.c_str());
    ++rows;
  }
  TEST_ASSERT_GREATER_THAN_size_t(input::key_rules().size(), rows);
}

}  // namespace

void setUp(void) {}
void tearDown(void) {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_every_key_has_a_text_of_whole_sentences);
  RUN_TEST(test_every_key_is_on_the_page_in_the_schema_and_in_the_manual);
  RUN_TEST(test_alternatives_are_keys);
  RUN_TEST(test_every_row_of_the_page_has_four_cells);
  return UNITY_END();
}
