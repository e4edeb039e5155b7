// Calls of the library's loops over constant matrices.
#include <cmath>
#include <initializer_list>
#include <limits>

#include "emit/bodies.hpp"
#include "emit/model_of.hpp"
#include "emit/text.hpp"

namespace lqg::emit {

namespace {

using design::Real;
using design::RealMatrix;

// The constants of a filter or a regulator, array after array.
class Tables {
 public:
  Tables(const Controller& controller, const char* owner)
      : controller_(controller), name_(upper(controller.problem.name) + "_" + owner) {}

  // Defines NAME_<owner>_<suffix>[] and returns its name; "NULL" and no definition when there is nothing in it.
  std::string add(const std::string& suffix, const RealMatrix& matrix) {
    if (matrix.size() == 0) return "NULL";
    text += "static const lqg_real " + name_ + "_" + suffix + "[" + std::to_string(matrix.size()) + "] = {\n" +
            array_values(matrix, controller_.is_double()) + "};\n";
    return name_ + "_" + suffix;
  }
  std::string add_unless_zero(const std::string& suffix, const RealMatrix& matrix) {
    return is_zero(matrix) ? "NULL" : add(suffix, matrix);
  }

  std::string text;

 private:
  const Controller& controller_;
  std::string name_;
};

// One row: the lower triangle, row by row.
RealMatrix lower_triangle(const RealMatrix& matrix) {
  const int n = static_cast<int>(matrix.rows());
  RealMatrix row(1, n * (n + 1) / 2);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) row(0, step::triangle(i, j)) = matrix(i, j);
  return row;
}

// One row: the strict upper triangle, column by column.
RealMatrix strict_upper_triangle(const RealMatrix& matrix) {
  const int n = static_cast<int>(matrix.rows());
  RealMatrix row(1, n * (n - 1) / 2);
  for (int j = 1; j < n; ++j)
    for (int k = 0; k < j; ++k) row(0, step::strict_triangle(k, j)) = matrix(k, j);
  return row;
}

RealMatrix as_row(const design::RealVector& vector) { return vector.transpose(); }

// What the library compares u with; nothing finite lies beyond the largest number.
RealMatrix limits_row(const Eigen::VectorXd& limits, int inward, bool is_double) {
  const double largest = is_double ? std::numeric_limits<double>::max() : std::numeric_limits<float>::max();
  RealMatrix row(1, limits.size());
  for (int i = 0; i < limits.size(); ++i)
    row(0, i) = std::isinf(limits(i)) ? std::copysign(largest, limits(i))
                                      : limit_of_target(limits(i), inward, is_double);
  return row;
}

// Fields of an initializer, in the order in which they were defined (a braced list is evaluated from left to right).
std::string fields(std::initializer_list<std::string> values) {
  std::string out;
  for (const std::string& value : values) out += (out.empty() ? "" : ", ") + value;
  return out;
}

std::string plant_fields(const Controller& controller, const RealMatrix& C, const RealMatrix& D, Tables& tables) {
  const std::string NAME = upper(controller.problem.name);
  return "    {" + fields({NAME + "_NX", std::to_string(controller.nu()), NAME + "_NY",
                           tables.add("A", controller.solution.plant.A), tables.add("B", controller.solution.plant.B),
                           tables.add("C", C), tables.add_unless_zero("D", D)}) +
         "},  /* nx, nu, ny, A, B, C, D */\n";
}

std::string initial_state(const Controller& controller, Tables& tables) {
  const Eigen::VectorXd& x0 = controller.problem.estimator->x0;
  RealMatrix row(1, x0.size());
  for (int i = 0; i < x0.size(); ++i) row(0, i) = x0(i);
  return tables.add_unless_zero("X0", row);
}

std::string steady_fields(const Controller& controller, Tables& tables) {
  const design::EstimatorSolution& estimator = *controller.solution.estimator;
  const design::SampledPlant& plant = controller.solution.plant;
  std::string out = plant_fields(controller, plant.C, plant.D, tables);
  return out + "    " + fields({tables.add("L", estimator.L), tables.add_unless_zero("M", estimator.M),
                                initial_state(controller, tables)}) + "  /* L, M, x0 */\n";
}

std::string online_fields(const Controller& controller, Tables& tables) {
  const design::OnlineSolution& online = *controller.solution.online;
  const bool has_M = !is_zero(online.M);
  std::string out = plant_fields(controller, online.C, online.D, tables);
  out += "    " + fields({online.E.isIdentity(0) ? "NULL" : tables.add("E", online.E), tables.add("V", as_row(online.V))}) +
         ",  /* E, V */\n";
  const auto add_rest = [&] {
    out += "    " + fields({has_M ? tables.add("M", online.M) : "NULL", has_M ? tables.add("A_FREE", online.A_free) : "NULL"}) +
           ",  /* M, A_free */\n";
  };
  if (controller.filter() == step::Filter::plain) {
    out += "    " + tables.add("W", lower_triangle(online.W)) + ",  /* W */\n";
    add_rest();
    return out + "    " + fields({initial_state(controller, tables), tables.add("P0", lower_triangle(online.P0))}) +
           "  /* x0, P0 */\n";
  }
  out += "    " + fields({std::to_string(online.G.cols()), tables.add("G", online.G), tables.add("W", as_row(online.w))}) +
         ",  /* nq, G, w */\n";
  add_rest();
  return out + "    " + fields({initial_state(controller, tables), tables.add("U0", strict_upper_triangle(online.U0)),
                                tables.add("D0", as_row(online.D0))}) + "  /* x0, U0, d0 */\n";
}

std::string kalman_constants(const Controller& controller) {
  Tables tables(controller, "KALMAN");
  const std::string values =
      controller.solution.online ? online_fields(controller, tables) : steady_fields(controller, tables);
  return tables.text + fill("static const lqg_kalman_{filter}_t {NAME}_KALMAN = {\n", common_words(controller)) +
         values + "};\n";
}

std::string lqr_constants(const Controller& controller) {
  Tables tables(controller, "LQR");
  const std::string NAME = upper(controller.problem.name), K = tables.add("K", controller.solution.regulator->K);
  std::string u_min = "NULL", u_max = "NULL";
  if (const auto& limits = controller.problem.limits) {
    u_min = tables.add("U_MIN", limits_row(limits->u_min, +1, controller.is_double()));
    u_max = tables.add("U_MAX", limits_row(limits->u_max, -1, controller.is_double()));
  }
  return tables.text + "static const lqg_lqr_t " + NAME + "_LQR = {\n    " +
         fields({NAME + "_NX", NAME + "_NU", K, u_min, u_max}) + "  /* nx, nu, K, u_min, u_max */\n};\n";
}

// The words of a call of the filter: its state, and how long its scratch is.
Words call_words(const Controller& controller) {
  Words words = common_words(controller);
  const std::string u_applied = controller.keeps_input() ? "self->u_applied" : "NULL";
  const std::string innovation = controller.keeps_innovation() ? "self->innovation" : "NULL";
  std::string covariance, nq;
  if (controller.filter() == step::Filter::plain) covariance = "self->P, ";
  if (controller.filter() == step::Filter::ud) {
    covariance = controller.nx() > 1 ? "self->U, self->d, " : "NULL, self->d, ";
    nq = ", " + std::to_string(controller.solution.online->G.cols());
  }
  words["FILTER"] = upper(words["filter"]);
  words["nq"] = nq;
  words["state"] = "self->x, " + covariance + u_applied + ", " + innovation;
  words["u"] = controller.nu() ? "u" : "NULL";
  return words;
}

std::string options_check(const Controller& controller) {
  const auto check = [&](const char* option, bool wanted, const char* what) {
    return std::string(wanted ? "#ifndef " : "#ifdef ") + option + "\n#error \"" + controller.problem.name + ".h " +
           what + ": " + (wanted ? "define " : "do not define ") + option +
           " for the library and for this file, or run lqgen with other options.\"\n#endif\n";
  };
  return check("LQG_REAL_DOUBLE", controller.is_double(), controller.is_double() ? "computes in double" : "computes in float") +
         check("LQG_FUSED", controller.is_fused(),
               controller.is_fused() ? "uses fused multiply-adds" : "uses plain arithmetic");
}

}  // namespace

Bodies compact_bodies(const Controller& controller) {
  Bodies bodies;
  bodies.includes = "#include <stddef.h>\n\n#include \"lqg/lqg.h\"\n\n" + options_check(controller);
  if (controller.has_filter()) {
    bodies.constants = kalman_constants(controller);
    const Words words = call_words(controller);
    bodies.init = fill("    lqg_kalman_{filter}_init(&{NAME}_KALMAN, {state});\n", words);
    bodies.update = fill(R"(    lqg_real work[LQG_KALMAN_{FILTER}_WORK({NAME}_NX, {NAME}_NY{nq})];

    return lqg_kalman_{filter}_update(&{NAME}_KALMAN, {state}, y, work);
)", words);
    bodies.predict = fill(R"(    lqg_real work[LQG_KALMAN_{FILTER}_WORK({NAME}_NX, {NAME}_NY{nq})];

    return lqg_kalman_{filter}_predict(&{NAME}_KALMAN, {state}, {u}, work);
)", words);
  }
  if (controller.has_regulator()) {
    bodies.constants += lqr_constants(controller);
    bodies.control = fill(controller.keeps_input() ? R"(    const lqg_status status = lqg_lqr_control(&{NAME}_LQR, self->x, u);

    for (int i = 0; i < {NAME}_NU; i++)
        self->u_applied[i] = u[i];
    return status;
)"
                                : controller.has_filter() ? "    return lqg_lqr_control(&{NAME}_LQR, self->x, u);\n"
                                                          : "    return lqg_lqr_control(&{NAME}_LQR, x, u);\n",
                          common_words(controller));
  }
  return bodies;
}

}  // namespace lqg::emit
