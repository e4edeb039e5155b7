// SPDX-License-Identifier: MIT
// Straight-line code with a constant gain whose products with dense matrices are loops over tables.
#include <algorithm>
#include <set>

#include "emit/c/function_bodies.hpp"
#include "emit/c/operating_point.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/c/templates.hpp"
#include "emit/recorded/steady_products.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

constexpr const char* in_words[] = {"no row",    "one row",   "two rows", "three rows",
                                    "four rows", "five rows", "six rows"};

std::vector<const Product*> in_loops(const SteadyProducts& products) {
  std::vector<const Product*> loops;
  for (const Product* product : {&products.C, &products.L, &products.K, &products.A, &products.B})
    if (is_in_loop(*product)) loops.push_back(product);
  return loops;
}

// "/* −C, four rows at a time, column after column */ static const float {NAME}_MINUS_C[12] = {…};"
std::string product_table(const Controller& controller, const Product& product) {
  const std::vector<int> heights = heights_of_blocks(product);
  const std::string last = heights.back() < heights.front() ? std::string(", at last ") + in_words[heights.back()] : "";
  return std::string("/* ") + product.meaning + ", " + in_words[heights.front()] + " at a time" + last +
         ", each time column after column */\n" +
         fill(std::string("static const {real} {NAME}_") + product.name + "[" + std::to_string(product.matrix.size()) +
                  "] = {\n",
              common_words(controller)) +
         array_values(in_blocks(product), controller.target.is_double) + "};\n";
}

// The loop over so many rows. Loads come first, and sums last, so that none waits for the one before it.
std::string add_rows(const Controller& controller, int height) {
  std::string loads, entries, products, sums, stores;
  for (int i = 0; i < height; ++i) {
    const std::string k = std::to_string(i), sum = "sum_" + k, entry = "entry_" + k, product = "product_" + k;
    loads += "    {real} " + sum + " = sums[" + k + "];\n";
    entries += "        const {real} " + entry + " = rows[" + k + "];\n";
    if (!controller.target.is_fused) products += "        const {real} " + product + " = " + entry + " * factor;\n";
    sums += "        " + sum + " = " +
            (!controller.target.is_fused
                 ? sum + " + " + product
                 : std::string(controller.target.is_double ? "fma(" : "fmaf(") + entry + ", factor, " + sum + ")") +
            ";\n";
    stores += "    sums[" + k + "] = " + sum + ";\n";
  }
  const Words words = common_words(controller);
  return write_function(templates::products_add_rows, controller,
                        {{"height", std::to_string(height)},
                         {"height_in_words", in_words[height]},
                         {"loads", fill(loads, words)},
                         {"products", fill(entries + products, words) + sums},
                         {"stores", stores}});
}

// "    for (…) {NAME}_add_rows_4(…)": sums += matrix vector; nothing where it is not in a loop.
std::string add_product(const Controller& controller, const Product& product, const std::string& vector,
                        const std::string& sums) {
  if (!is_in_loop(product)) return "";
  const std::vector<int> heights = heights_of_blocks(product);
  const int height = heights.front(), columns = static_cast<int>(product.matrix.cols()),
            whole = static_cast<int>(std::count(heights.begin(), heights.end(), height)), end = whole * height;
  const auto call = [&](int rows, const std::string& first, const std::string& entry) {
    return "{name}_add_rows_" + std::to_string(rows) + "(&{NAME}_" + product.name + "[" + entry + "], " + vector +
           ", " + std::to_string(columns) + ", &" + sums + "[" + first + "]);\n";
  };
  std::string out = "    " + call(height, "0", "0");
  if (whole > 1)
    out = "    for (int i = 0; i < " + std::to_string(end) + "; i += " + std::to_string(height) + ") {\n        " +
          call(height, "i", "i * " + std::to_string(columns)) + "    }\n";
  if (heights.back() < height) out += "    " + call(heights.back(), std::to_string(end), std::to_string(end * columns));
  return fill(out, common_words(controller));
}

// A body that begins with sums, each from what `begin` says, to which products are added.
std::string begun_with_sums(const Controller& controller, const std::string& size, const std::string& begin,
                            const std::string& added, std::string text) {
  const std::string strict = "    LQG_STRICT_BODY\n";
  const std::string sums = "    {real} sums[" + size + "];\n\n    for (int i = 0; i < " + size +
                           "; i++) {\n        sums[i] = " + begin + ";\n    }\n";
  return text.replace(0, strict.size(), strict + fill(sums, common_words(controller)) + added);
}

std::string law_body(const Controller& controller, const SteadyProducts& products) {
  const TracedFunction traced = trace_law(controller, products);
  if (!is_in_loop(products.K)) return body(controller, traced, {"self"});
  const std::string text = body(controller, traced, {});  // the loops read self
  return begun_with_sums(controller, "{NAME}_NU", controller.has.input_change ? "self->u_applied[i]" : "{zero}",
                         add_product(controller, products.K, "self->x", "sums"), text);
}

std::string prediction_body(const Controller& controller, const SteadyProducts& products) {
  const std::string advance = advance_counters(controller);
  const TracedFunction traced = trace_steady_predict(controller, products);
  const std::string added =
      (is_in_loop(products.B) && controller.point.u.size() ? declare_deviations(controller, 'u') + "\n" : "") +
      add_product(controller, products.A, "self->x", "sums") +
      add_product(controller, products.B, deviations(controller, 'u'), "sums");
  // What only the loops read is used, too.
  const std::string text = controller.size.nu && !is_in_loop(products.B)
                               ? body(controller, traced, {"self", "u"}, advance)
                               : body(controller, traced, {"self"}, advance);
  return added.empty() ? text : begun_with_sums(controller, "{NAME}_NX", "{zero}", added, text);
}

std::string steady_update_body(const Controller& controller, const SteadyProducts& products) {
  return write_body(templates::products_update, controller,
                    {{"declare_deviations", declare_deviations(controller, 'y')},
                     {"given", deviations(controller, 'y')},
                     {"add_C", add_product(controller, products.C, "self->x", "innovation")},
                     {"add_L", add_product(controller, products.L, "innovation", "self->x")},
                     {"end", end_of_body(controller, trace_end_of_steady_update(controller, products))}},
                    {{"adds_C", is_in_loop(products.C)},
                     {"tells_deviations", is_in_loop(products.C) && controller.point.y.size() > 0}});
}

std::string products_helpers(const Controller& controller, const SteadyProducts& products) {
  std::set<int> heights;
  for (const Product* product : in_loops(products))
    for (const int height : heights_of_blocks(*product)) heights.insert(height);
  std::string out;
  for (const int height : heights) out += add_rows(controller, height);
  return out +
         write_function(templates::products_innovate, controller,
                        {{"body", body(controller, trace_innovate(controller, products), {"self", "y", "innovation"})}},
                        {{"adds_C", is_in_loop(products.C)}});
}

}  // namespace

FunctionBodies products_bodies(const Controller& controller) {
  const SteadyProducts products = steady_products(controller);
  FunctionBodies bodies = straight_line_bodies(controller);
  for (const Product* product : in_loops(products)) bodies.constants += product_table(controller, *product);
  bodies.resets = true;
  if (controller.has.gate) bodies.weigh = weigh_body(controller);
  bodies.helpers = products_helpers(controller, products);
  bodies.update = steady_update_body(controller, products);
  bodies.predict = prediction_body(controller, products);
  if (controller.has.regulator) bodies.control = law_body(controller, products);
  for (const TracedFunction& alone : trace_updates_alone(controller))
    bodies.updates_alone.push_back(body(controller, alone, {"self"}));
  if (controller.size.ny == 1) bodies.updates_alone = {only_update_body(controller)};
  return bodies;
}

}  // namespace lqg::emit
