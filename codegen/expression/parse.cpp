// SPDX-License-Identifier: MIT
// The grammar in Boost.Spirit X3. It never goes back over what it has read, so that its actions can build the tree on a
// stack; signs are a loop of it, so that only parentheses and powers nest.
#include "expression/parse.hpp"

#include <algorithm>
#include <boost/spirit/home/x3.hpp>
#include <charconv>
#include <functional>
#include <utility>

namespace lqg::expression {

namespace {

namespace x3 = boost::spirit::x3;
using Iterator = std::string::const_iterator;

struct Sign {
  Operation operation = Operation::add;
  std::size_t at = 0;
  bool begins = false;  // no sign: where a chain of them begins
};

// What the grammar's actions build.
class Builder {
 public:
  explicit Builder(const std::string& text) : text_(text) {}

  const std::optional<Fault>& fault() const { return fault_; }
  Tree result() const { return trees_.back(); }

  bool take_number(Iterator from, Iterator to) {
    double value = 0;
    const auto [end, error] = std::from_chars(&*from, &*from + (to - from), value);
    if (error != std::errc() || end != &*from + (to - from))
      return fail(from, std::string(from, to) + " is beyond what a double can be");
    trees_.push_back(number(value, place(from)));
    return true;
  }

  bool take_name(Iterator from, Iterator to) {
    const std::string word(from, to);
    const std::size_t at = place(from);
    if (function_of(word)) return fail(from, word + " is a function: expected ( behind it");
    trees_.push_back(word == "pi" ? pi(at) : name(word, at));
    return true;
  }

  bool begin_call(Iterator from, Iterator to) {
    const std::string word(from, to);
    const std::optional<Operation> function = function_of(word);
    if (!function) return fail(from, "unknown function " + word + ": expected " + list_of_functions());
    calls_.push_back({*function, place(from), trees_.size()});
    return deepen(from);
  }

  bool end_call(Iterator at) {
    --depth_;
    const Call call = calls_.back();
    calls_.pop_back();
    const std::size_t found = trees_.size() - call.trees, expected = operands_of(call.function);
    if (found != expected)
      return fail(at, std::string(name_of(call.function)) + " takes " + std::to_string(expected) +
                          (expected == 1 ? " value" : " values") + ", found " + std::to_string(found));
    make(call.function, expected, call.at);
    return true;
  }

  bool deepen(Iterator at) {
    if (++depth_ <= deepest_nesting) return true;
    return fail(at, "more than " + std::to_string(deepest_nesting) + " parentheses and powers within each other");
  }
  void rise() { --depth_; }

  void begin_signs() { signs_.push_back({Operation::add, 0, true}); }
  void take_sign(Iterator at) { signs_.push_back({*at == '-' ? Operation::negate : Operation::add, place(at), false}); }
  void end_signs() {
    for (; !signs_.back().begins; signs_.pop_back())
      if (signs_.back().operation == Operation::negate) make(Operation::negate, 1, signs_.back().at);
    signs_.pop_back();
  }

  void take_operator(Iterator at) {
    operators_.push_back({*at == '+'   ? Operation::add
                          : *at == '-' ? Operation::subtract
                          : *at == '*' ? Operation::multiply
                          : *at == '/' ? Operation::divide
                                       : Operation::power,
                          place(at), false});
  }
  bool take_power(Iterator at) {
    take_operator(at);
    return deepen(at);
  }
  void join() {
    const Sign sign = operators_.back();
    operators_.pop_back();
    make(sign.operation, 2, sign.at);
  }

 private:
  struct Call {
    Operation function;
    std::size_t at, trees;
  };

  std::size_t place(Iterator at) const { return static_cast<std::size_t>(at - text_.begin()); }
  bool fail(Iterator at, std::string message) {
    if (!fault_) fault_ = Fault{place(at), std::move(message)};
    return false;
  }
  void make(Operation made, std::size_t count, std::size_t at) {
    std::vector<Tree> operands(trees_.end() - static_cast<std::ptrdiff_t>(count), trees_.end());
    trees_.resize(trees_.size() - count);
    trees_.push_back(operation(made, std::move(operands), at));
  }
  static std::string list_of_functions() {
    std::string list;
    for (const std::string& function : function_names()) list += (list.empty() ? "" : ", ") + function;
    return list;
  }

  const std::string& text_;
  std::vector<Tree> trees_;
  std::vector<Sign> signs_, operators_;
  std::vector<Call> calls_;
  int depth_ = 0;
  std::optional<Fault> fault_;
};

// So much of a wrong word stands in a message.
constexpr std::size_t longest_token = 40;

struct BuilderTag;

template <class Context>
Builder& builder(const Context& context) {
  return x3::get<BuilderTag>(context).get();
}

// Actions: what `raw` found, from its first to behind its last character.
template <class Take>
auto on(Take take) {
  return [take](auto& context) {
    const auto& found = x3::_attr(context);
    if constexpr (std::is_same_v<decltype(take(builder(context), found.begin(), found.end())), bool>)
      x3::_pass(context) = take(builder(context), found.begin(), found.end());
    else
      take(builder(context), found.begin(), found.end());
  };
}

template <class Act>
auto then(Act act) {
  return x3::eps[([act](auto& context) { act(builder(context)); })];
}

const x3::rule<struct SumTag> sum = "a value";
const x3::rule<struct ProductTag> product = "a value";
const x3::rule<struct SignedTag> with_signs = "a value";
const x3::rule<struct PowerTag> with_power = "a value";
const x3::rule<struct AtomTag> atom = "a value";

const auto digits = +x3::digit;
const auto number_text = x3::raw[x3::lexeme[(digits >> -('.' >> *x3::digit) | '.' >> digits) >>
                                            -(x3::char_("eE") >> -x3::char_("+-") >> digits)]];
const auto name_text = x3::raw[x3::lexeme[(x3::alpha | '_') >> *(x3::alnum | '_')]];
const auto sign_text = x3::raw[x3::char_("+-")];
const auto product_sign = x3::raw[x3::char_("*/")];
const auto power_sign = x3::raw[x3::char_('^')];
const auto opening = x3::raw[x3::char_('(')];
const auto closing = x3::raw[x3::char_(')')];

const auto join = then([](Builder& builder) { builder.join(); });
const auto take_operator = on([](Builder& builder, Iterator from, Iterator) { builder.take_operator(from); });

const auto sum_def = product >> *(sign_text[take_operator] > product > join);
const auto product_def = with_signs >> *(product_sign[take_operator] > with_signs > join);
const auto with_signs_def =
    then([](Builder& builder) { builder.begin_signs(); }) >>
    *sign_text[on([](Builder& builder, Iterator from, Iterator) { builder.take_sign(from); })] >> with_power >>
    then([](Builder& builder) { builder.end_signs(); });
const auto with_power_def =
    atom >> -(power_sign[on([](Builder& builder, Iterator from, Iterator) { return builder.take_power(from); })] >
              with_signs > then([](Builder& builder) {
                builder.join();
                builder.rise();
              }));
const auto number_atom =
    number_text[on([](Builder& builder, Iterator from, Iterator to) { return builder.take_number(from, to); })];
const auto call =
    (name_text >>
     &x3::lit('('))[on([](Builder& builder, Iterator from, Iterator to) { return builder.begin_call(from, to); })] >>
    '(' > sum >
    *(',' > sum) > closing[on([](Builder& builder, Iterator from, Iterator) { return builder.end_call(from); })];
const auto name_atom =
    name_text[on([](Builder& builder, Iterator from, Iterator to) { return builder.take_name(from, to); })];
const auto group = opening[on([](Builder& builder, Iterator from, Iterator) { return builder.deepen(from); })] > sum >
                   closing[on([](Builder& builder, Iterator, Iterator) { builder.rise(); })];
const auto atom_def = number_atom | call | name_atom | group;

BOOST_SPIRIT_DEFINE(sum, product, with_signs, with_power, atom)

// What stands at `at`, for a message: a name or number as a whole, else one character.
std::string token_at(const std::string& text, std::size_t at) {
  if (at >= text.size()) return "the end";
  const auto is_word = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' ||
           (static_cast<unsigned char>(c) & 0x80) != 0;
  };
  std::size_t end = at + 1;
  if (is_word(text[at]))
    while (end < text.size() && end - at < longest_token && is_word(text[end])) ++end;
  return text.substr(at, end - at);
}

// What should stand in place of it.
std::string hint_for(const std::string& text, std::size_t at) {
  if (at > 0 && at < text.size() && text[at] == '*' && text[at - 1] == '*') return "; a power is written ^";
  return "";
}

Fault not_expected(const std::string& text, std::size_t at, const std::string& expected) {
  return {at, "expected " + expected + ", found " + token_at(text, at) + hint_for(text, at)};
}

}  // namespace

std::variant<Tree, Fault> parse(const std::string& text) {
  if (text.size() > longest_text)
    return Fault{0, "a formula of " + std::to_string(text.size()) + " bytes; at most " + std::to_string(longest_text) +
                        " are read: name parts of it in [parameters]"};
  const auto strange =
      std::find_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0x80) != 0; });
  if (strange != text.end())
    return not_expected(text, static_cast<std::size_t>(strange - text.begin()), "letters of a to z, digits and signs");
  Builder builder(text);
  Iterator at = text.begin();
  const auto skip = [&](Iterator from) {
    while (from != text.end() && (*from == ' ' || *from == '\t' || *from == '\n' || *from == '\r')) ++from;
    return from;
  };
  try {
    const bool begins =
        x3::phrase_parse(at, text.end(), x3::with<BuilderTag>(std::ref(builder))[sum], x3::ascii::space);
    if (builder.fault()) return *builder.fault();
    const std::size_t end = static_cast<std::size_t>(skip(at) - text.begin());
    if (!begins) return not_expected(text, end, "a number, a name or (");
    if (end != text.size()) return not_expected(text, end, "an operator or the end");
    return builder.result();
  } catch (const x3::expectation_failure<Iterator>& failure) {
    if (builder.fault()) return *builder.fault();
    const bool is_closing = failure.which() != "a value";
    return not_expected(text, static_cast<std::size_t>(skip(failure.where()) - text.begin()),
                        is_closing ? "an operator or )" : "a number, a name or (");
  }
}

}  // namespace lqg::expression
