// SPDX-License-Identifier: MIT
#include "emit/unit_test/linear_unit_test.hpp"

namespace lqg::emit {

std::string linear_sample(const Controller& controller, const std::string& look) {
  const bool predicts = controller.is_predictor;
  return std::string("        TEST_ASSERT_EQUAL_HEX(LQG_OK, {name}_control(&self, ") +
         (predicts ? "u));\n" : "y_in[k], u));\n") + look +
         "        TEST_ASSERT_EQUAL_HEX(LQG_OK, {name}_advance(&self" + (predicts ? ", y_in[k]));\n" : "));\n");
}

std::string linear_estimate_check() {
  return "        {real} x[{NAME}_NX];\n\n"
         "        {name}_estimate(&self, x);\n"
         "        assert_near(x_tolerance, x_out[k], x, {NAME}_NX);\n";
}

std::string linear_hostile_sample(const Controller& controller) {
  const bool predicts = controller.is_predictor;
  return std::string("                status = {name}_control(&self, ") + (predicts ? "u);\n" : "y, u);\n") +
         R"(                for (int i = 0; i < {NAME}_NU; i++)
                    TEST_ASSERT_TRUE(u[i] - u[i] == {zero});
                status |= {name}_advance(&self)" +
         (predicts ? ", y);\n" : ");\n") +
         R"(                if (k % 3 == 1 && what < 3)
                    TEST_ASSERT_TRUE(status & LQG_OUTPUT_REJECTED);
                if (what < 3)
                    TEST_ASSERT_FALSE(status & LQG_STATE_RESET);
                for (int i = 0; i < {NAME}_NZ; i++)
                    TEST_ASSERT_TRUE(self.z[i] - self.z[i] == {zero});
)";
}

}  // namespace lqg::emit
