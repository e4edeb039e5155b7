// SPDX-License-Identifier: MIT
// The grammar: what binds tighter, where a wrong text is wrong, and that no text exhausts the stack.
#include <unity.h>

#include "expression/bind.hpp"
#include "expression/evaluate.hpp"

using namespace lqg::expression;

namespace {

// "(a - (2 * b))": every operation in parentheses.
std::string shown(const Tree& tree) {
  switch (tree->kind) {
    case Node::Kind::number: {
      std::string text = std::to_string(tree->number);
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
      return text;
    }
    case Node::Kind::pi: return "pi";
    case Node::Kind::operation: break;
    default: return tree->name;
  }
  const std::string sign = name_of(tree->operation);
  if (function_of(sign)) {
    std::string text = sign + "(" + shown(tree->operands[0]);
    for (std::size_t i = 1; i < tree->operands.size(); ++i) text += ", " + shown(tree->operands[i]);
    return text + ")";
  }
  if (tree->operands.size() == 1) return "(" + sign + shown(tree->operands[0]) + ")";
  return "(" + shown(tree->operands[0]) + " " + sign + " " + shown(tree->operands[1]) + ")";
}

void expect_tree(const std::string& text, const std::string& expected) {
  const auto parsed = parse(text);
  if (const Fault* fault = std::get_if<Fault>(&parsed)) TEST_FAIL_MESSAGE((text + ": " + fault->message).c_str());
  TEST_ASSERT_EQUAL_STRING(expected.c_str(), shown(std::get<Tree>(parsed)).c_str());
}

void expect_fault(const std::string& text, std::size_t at, const std::string& message) {
  const auto parsed = parse(text);
  if (std::holds_alternative<Tree>(parsed)) TEST_FAIL_MESSAGE((text + " was read").c_str());
  const Fault& fault = std::get<Fault>(parsed);
  TEST_ASSERT_EQUAL_STRING_MESSAGE(message.c_str(), fault.message.c_str(), text.c_str());
  TEST_ASSERT_EQUAL_UINT_MESSAGE(at, fault.at, text.c_str());
}

void test_terms_stay_in_the_order_of_the_user_from_left_to_right() {
  expect_tree("a - b - c + d", "(((a - b) - c) + d)");
  expect_tree("a/b*c/d", "(((a / b) * c) / d)");
  expect_tree("c*b + a*b", "((c * b) + (a * b))");
}

void test_a_power_binds_tighter_than_a_sign_and_from_the_right() {
  expect_tree("-a^2", "(-(a ^ 2))");
  expect_tree("a^b^c", "(a ^ (b ^ c))");
  expect_tree("a^-b^2", "(a ^ (-(b ^ 2)))");
  expect_tree("2*a^2", "(2 * (a ^ 2))");
  expect_tree("-a*b", "((-a) * b)");
}

void test_signs_may_follow_each_other() {
  expect_tree("--a", "(-(-a))");
  expect_tree("a - -b", "(a - (-b))");
  expect_tree("+a", "a");
}

void test_numbers_are_those_of_c() {
  expect_tree("1.5e2 + .25 + 2. + 1e-1", "(((150 + 0.25) + 2) + 0.1)");
  TEST_ASSERT_EQUAL_DOUBLE(5e-324, std::get<Tree>(parse("5e-324"))->number);
}

void test_blanks_and_lines_do_not_matter() { expect_tree(" atan2 ( y,\n\tx ) ", "atan2(y, x)"); }

void test_only_pi_and_functions_are_reserved() {
  expect_tree("x*y + u*i + p*L + e + T", "(((((x * y) + (u * i)) + (p * L)) + e) + T)");
  expect_tree("sin_of + pi2 + pi", "((sin_of + pi2) + pi)");
}

void test_what_is_wrong_is_told_at_its_place() {
  expect_fault("", 0, "expected a number, a name or (, found the end");
  expect_fault("1 + ", 4, "expected a number, a name or (, found the end");
  expect_fault("1 + * 2", 4, "expected a number, a name or (, found *");
  expect_fault("2x", 1, "expected an operator or the end, found x");
  expect_fault("(a + b", 6, "expected an operator or ), found the end");
  expect_fault("a + b)", 5, "expected an operator or the end, found )");
  expect_fault("a**2", 2, "expected a number, a name or (, found *; a power is written ^");
  expect_fault("sin", 0, "sin is a function: expected ( behind it");
  expect_fault("2 + sin(1, 2)", 12, "sin takes 1 value, found 2");
  expect_fault("atan2(1)", 7, "atan2 takes 2 values, found 1");
  expect_fault("1e999", 0, "1e999 is beyond what a double can be");
  expect_fault("2*θ", 2, "expected letters of a to z, digits and signs, found θ");
  expect_fault("1 + ln(x)", 4,
               "unknown function ln: expected sqrt, sin, cos, tan, asin, acos, atan, atan2, exp, log, tanh, abs, min, "
               "max");
}

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

void test_no_text_exhausts_the_stack() {
  expect_tree(repeated("(", 100) + "a" + repeated(")", 100), "a");
  expect_fault(repeated("(", 101) + "a", 100, "more than 100 parentheses and powers within each other");
  expect_fault(repeated("2^", 101) + "a", 201, "more than 100 parentheses and powers within each other");
  expect_fault(repeated("sin(", 101) + "a", 400, "more than 100 parentheses and powers within each other");
  expect_fault(repeated("-", 4001), 0,
               "a formula of 4001 bytes; at most 4000 are read: name parts of it in [parameters]");
  const auto signs = parse(repeated("-", 3999) + "1");
  Constants<double> constants;
  TEST_ASSERT_EQUAL_DOUBLE(-1, constants(*std::get<Tree>(signs)));
  const auto sum = parse(repeated("1+", 1999) + "1");
  TEST_ASSERT_EQUAL_DOUBLE(2000, constants(*std::get<Tree>(sum)));
}

void test_formulas_within_formulas_have_an_end() {
  Tree tree = std::get<Tree>(parse("x"));
  for (int i = 0; i < deepest_tree; ++i) tree = operation(Operation::negate, {tree});
  const auto bound =
      lqg::expression::bind(tree, [](const std::string& name, std::size_t at) { return variable(name, 0, at); });
  TEST_ASSERT_TRUE(std::holds_alternative<Fault>(bound));
}

void test_a_name_without_meaning_is_told_at_its_place() {
  const auto bound = lqg::expression::bind(
      std::get<Tree>(parse("2*a + b*c")),
      [](const std::string& name, std::size_t) -> Tree { return name == "a" ? number(1) : nullptr; });
  TEST_ASSERT_EQUAL_UINT(6, std::get<Fault>(bound).at);
  TEST_ASSERT_EQUAL_STRING("unknown name b", std::get<Fault>(bound).message.c_str());
}

void test_names_and_variables_of_a_formula_are_each_found_once() {
  const Tree tree = std::get<Tree>(parse("b*a + a^2 - sin(b)"));
  const std::vector<std::string> names = names_in(tree);
  TEST_ASSERT_EQUAL_UINT(2, names.size());
  TEST_ASSERT_EQUAL_STRING("b", names[0].c_str());
  const auto bound = lqg::expression::bind(
      tree, [](const std::string& name, std::size_t at) { return variable(name, name == "a" ? 3 : 1, at); });
  const std::vector<int> variables = variables_in(std::get<Tree>(bound));
  TEST_ASSERT_EQUAL_UINT(2, variables.size());
  TEST_ASSERT_EQUAL_INT(1, variables[0]);
  TEST_ASSERT_EQUAL_INT(3, variables[1]);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_terms_stay_in_the_order_of_the_user_from_left_to_right);
  RUN_TEST(test_a_power_binds_tighter_than_a_sign_and_from_the_right);
  RUN_TEST(test_signs_may_follow_each_other);
  RUN_TEST(test_numbers_are_those_of_c);
  RUN_TEST(test_blanks_and_lines_do_not_matter);
  RUN_TEST(test_only_pi_and_functions_are_reserved);
  RUN_TEST(test_what_is_wrong_is_told_at_its_place);
  RUN_TEST(test_no_text_exhausts_the_stack);
  RUN_TEST(test_formulas_within_formulas_have_an_end);
  RUN_TEST(test_a_name_without_meaning_is_told_at_its_place);
  RUN_TEST(test_names_and_variables_of_a_formula_are_each_found_once);
  return UNITY_END();
}
