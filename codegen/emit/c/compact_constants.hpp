// SPDX-License-Identifier: MIT
// What the library's loops find in flash.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

// The constants of a filter or a regulator, array after array.
class Tables {
 public:
  Tables(const Controller& controller, const char* owner);

  // Defines NAME_<owner>_<suffix>[] and returns its name; "NULL" and no definition when there is nothing in it. Stages
  // share what is the same.
  std::string add(const std::string& suffix, const design::RealMatrix& matrix);
  std::string add(const std::string& suffix, const std::vector<std::string>& values);
  std::string add_unless_zero(const std::string& suffix, const design::RealMatrix& matrix);

  // The same of lines of values.
  std::string define(const std::string& suffix, const std::string& values, Eigen::Index size,
                     const std::string& type = "lqg_real");

  std::string text;

 private:
  const Controller& controller_;
  std::string name_;
  std::map<std::string, std::map<std::string, std::string>> defined_;  // by suffix, then by values: the names
};

std::string kalman_constants(const Controller& controller);
std::string lqr_constants(const Controller& controller);
std::string servo_constants(const Controller& controller);

}  // namespace lqg::emit
