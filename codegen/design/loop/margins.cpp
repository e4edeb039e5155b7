// SPDX-License-Identifier: MIT
#include "design/loop/margins.hpp"

#include "design/loop/channel_margins.hpp"
#include "design/loop/disk_margin.hpp"
#include "design/loop/six_digits.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// A response as it is to be evaluated.
struct Way {
  const Response& response;
  bool is_rough;

  Evaluate all() const {
    return [way = *this](const Real& angle) {
      if (way.is_rough) return way.response.roughly_at(angle);
      const ComplexMatrix T = way.response.at(angle);
      Eigen::MatrixXcd result(T.re.rows(), T.re.cols());
      result.real() = to_doubles(T.re);
      result.imag() = to_doubles(T.im);
      return result;
    };
  }
  Channels channels() const {
    return [way = *this](Index channel) -> Channel {
      return [is_rough = way.is_rough, response = way.response.channel(channel)](const Real& angle) {
        if (is_rough) {
          const std::complex<double> t = response.roughly_at(angle)(0, 0);
          return ComplexReal{Real(t.real()), Real(t.imag())};
        }
        const ComplexMatrix T = response.at(angle);
        return ComplexReal{T.re(0, 0), T.im(0, 0)};
      };
    };
  }
};

std::optional<double> rounded(const std::optional<Real>& value) {
  return value ? std::optional(to_double(*value)) : std::nullopt;
}

// The margins, and whether the search saw all that the refined places show.
std::pair<Margins, bool> least_margins(const Search& search, const Way& searched, const Way& refined,
                                       const Fineness& fineness) {
  const ChannelMargins of_one = channel_margins(search, searched.channels(), refined.channels(), fineness);
  const DiskMargin disk = disk_margin(search, refined.channels(), refined.all(), fineness);
  Margins result;
  result.gain_dB = rounded(of_one.gain_dB);
  result.gain_up_dB = rounded(of_one.gain_up_dB);
  result.gain_down_dB = rounded(of_one.gain_down_dB);
  result.phase_deg = rounded(of_one.phase_deg);
  result.delay_samples = rounded(of_one.delay_samples);
  result.crossover = rounded(of_one.crossover);
  result.disk = to_double(disk.least);
  return {result, of_one.as_expected && disk.as_expected};
}

Response closed_response(const OpenLoop& loop) { return Response(loop.A - multiply(loop.B, loop.C), loop.B, loop.C); }

// The grid. The refined disk of one channel wants cells with a minimum in each.
std::vector<Real> angles_of(const OpenLoop& loop, const std::vector<ComplexReal>& poles) {
  const std::vector<Real> angles = search_angles(poles);
  return loop.B.cols() == 1 ? without_near_ones(angles) : angles;
}

void keep_six_digits(std::optional<double>& value) {
  if (value) value = six_digits(*value);
}

}  // namespace

Margins margins(const OpenLoop& loop, const std::vector<ComplexReal>& closed_loop_poles) {
  const Response response = closed_response(loop);
  const Digits enough(37);  // two limbs of 64 bits, less a bit: those have a short way through MPFR
  const Response in_few_digits = response.in_present_digits();
  const std::vector<Real> angles = angles_of(loop, closed_loop_poles);
  const Way roughly = {response, true}, exactly = {in_few_digits, false};
  auto [result, is_certain] = least_margins(search_with(roughly.all(), angles), roughly, exactly, exact);
  if (!is_certain) result = least_margins(search_with(exactly.all(), angles), exactly, exactly, exact).first;
  if (loop.B.cols() > 1) keep_six_digits(result.disk);  // of a search in double
  return result;
}

Margins rough_margins(const OpenLoop& loop, const std::vector<ComplexReal>& closed_loop_poles) {
  const Digits enough(37);
  const Response response = closed_response(loop);
  const Way roughly = {response, true};
  const Search search = search_with(roughly.all(), angles_of(loop, closed_loop_poles));
  Margins result = least_margins(search, roughly, roughly, as_far_as_double_goes).first;
  for (std::optional<double>* value : {&result.gain_dB, &result.gain_up_dB, &result.gain_down_dB, &result.phase_deg,
                                       &result.delay_samples, &result.crossover, &result.disk})
    keep_six_digits(*value);
  return result;
}

}  // namespace lqg::design
