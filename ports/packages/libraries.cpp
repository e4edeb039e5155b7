// SPDX-License-Identifier: MIT
// Prints what lqgen has inside: one library a line, its name in the SBOM and its version. MPFR and GMP say it
// themselves; a library without versions has the hash of its header; this and the version of Chart.js CMake tells.
#include <gmp.h>
#include <mbedtls/version.h>
#include <mpfr.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

int main() {
  std::cout << "boost " << BOOST_VERSION / 100000 << '.' << BOOST_VERSION / 100 % 1000 << '.' << BOOST_VERSION % 100
            << '\n'
            << "chart-js " << LQG_CHART_JS_VERSION << '\n'
            << "cli11 " << CLI11_VERSION << '\n'
            << "eigen " << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.' << EIGEN_MINOR_VERSION << '\n'
            << "fast-cpp-csv-parser " << LQG_CSV_VERSION << '\n'
            << "gmp " << gmp_version << '\n'
            << "mbedtls " << MBEDTLS_VERSION_STRING << '\n'
            << "mpfr " << mpfr_get_version() << '\n'
            << "nlohmann-json " << NLOHMANN_JSON_VERSION_MAJOR << '.' << NLOHMANN_JSON_VERSION_MINOR << '.'
            << NLOHMANN_JSON_VERSION_PATCH << '\n'
            << "tomlplusplus " << TOML_LIB_MAJOR << '.' << TOML_LIB_MINOR << '.' << TOML_LIB_PATCH << '\n';
}
