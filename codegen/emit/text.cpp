#include "emit/text.hpp"

#include <algorithm>
#include <charconv>

#include "emit/rounding.hpp"

namespace lqg::emit {

std::string fill(const std::string& text, const Words& words) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text[at] == '{' ? text.find('}', at) : std::string::npos;
    const auto word = end == std::string::npos ? words.end() : words.find(text.substr(at + 1, end - at - 1));
    if (word == words.end()) {
      out += text[at++];
    } else {
      out += word->second;
      at = end + 1;
    }
  }
  return out;
}

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::vector<design::Signal> state_signals(const Controller& controller) {
  std::vector<design::Signal> signals = controller.problem.plant.states;
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(signals.begin(), signals.end(), [&](const design::Signal& signal) { return signal.name == name; });
  };
  for (int left = controller.delayed(), nu = controller.nu(); left > 0; --left) {
    const design::Signal& input = controller.problem.plant.inputs[static_cast<std::size_t>((controller.delayed() - left) % nu)];
    std::string name = input.name + "_delayed_" + std::to_string((left + nu - 1) / nu);
    while (is_taken(name)) name += "_samples";
    signals.push_back({name, input.unit});
  }
  return signals;
}

std::vector<design::Signal> reference_signals(const Controller& controller) {
  std::vector<design::Signal> signals;
  for (const int output : controller.references())
    signals.push_back(controller.problem.plant.outputs[static_cast<std::size_t>(output)]);
  return signals;
}

std::string name_with_unit(const design::Signal& signal) {
  return signal.unit.empty() ? signal.name : signal.name + " [" + signal.unit + "]";
}

std::string equation_of_law(const Controller& controller) {
  const std::string x = controller.has_filter() ? "x̂" : "x", xi = controller.nxi() ? "; ξ" : "";
  const std::string last = controller.gives_change() ? "; u[k−1]" : "";
  return (controller.gives_change() ? "u[k−1] − K " : "−K ") + (xi + last == "" ? x : "[" + x + xi + last + "]") +
         (controller.laws.front()[1].size() ? " + Nbar r" : "");
}

std::string filter_name(step::Filter filter) {
  switch (filter) {
    case step::Filter::steady: return "steady";
    case step::Filter::plain: return "plain";
    case step::Filter::ud: return "ud";
    default: return "";
  }
}

Words common_words(const Controller& controller) {
  const std::string& name = controller.problem.name;
  return {{"name", name},
          {"NAME", upper(name)},
          {"real", controller.is_double() ? "double" : "float"},
          {"zero", controller.is_double() ? "0.0" : "0.0f"},
          {"nx", std::to_string(controller.nx())},
          {"nu", std::to_string(controller.nu())},
          {"ny", std::to_string(controller.ny())},
          {"nr", std::to_string(controller.nr())},
          {"nz", std::to_string(controller.nz())},
          {"file", controller.source.file},
          {"filter", filter_name(controller.filter())}};
}

std::string number(const design::Real& value, bool is_double) {
  std::string text = trace::literal(rounded_to_target(value, is_double), is_double);
  if (!is_double) text.pop_back();
  return text;
}

std::string matrix_comment(const std::string& name, const design::RealMatrix& matrix, bool is_double) {
  std::vector<std::size_t> width(static_cast<std::size_t>(matrix.cols()), 0);
  for (int j = 0; j < matrix.cols(); ++j)
    for (int i = 0; i < matrix.rows(); ++i)
      width[static_cast<std::size_t>(j)] =
          std::max(width[static_cast<std::size_t>(j)], number(matrix(i, j), is_double).size());
  std::string out;
  for (int i = 0; i < matrix.rows(); ++i) {
    const std::string head = i == 0 ? name + " = " : std::string(name.size() + 3, ' ');
    out += " *   " + head + "[";
    for (int j = 0; j < matrix.cols(); ++j) {
      const std::string text = number(matrix(i, j), is_double);
      out += std::string(width[static_cast<std::size_t>(j)] - text.size() + (j ? 2 : 1), ' ') + text;
    }
    out += " ]\n";
  }
  return out;
}

std::string array_values(const design::RealMatrix& matrix, bool is_double) {
  std::string out;
  for (int i = 0; i < matrix.rows(); ++i) {
    std::string row = "   ";
    for (int j = 0; j < matrix.cols(); ++j)
      row += " " + trace::literal(rounded_to_target(matrix(i, j), is_double), is_double) + ",";
    if (i + 1 == matrix.rows()) row.pop_back();
    out += trace::wrap(row, 4) + "\n";
  }
  return out;
}

std::string rounded(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
  return std::string(text, end.ptr);
}

}  // namespace lqg::emit
