// SPDX-License-Identifier: MIT
// The controller's step, recorded: the very templates that are the host reference, run over symbols.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emit/controller.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

// A test in the middle of a function: where the state is not sound a recovery comes, and the rest goes on with what
// that has written.
struct TracedRecovery {
  std::vector<trace::Store> stores;    // of what comes before it
  std::vector<trace::Store> recovers;  // what the recovery reads besides
  std::vector<int> statuses;
  int finite = -1;
  std::string faults;  // as those of a TracedFunction
};

struct TracedFunction {
  std::shared_ptr<trace::Graph> graph;
  std::vector<trace::Store> stores;
  std::vector<trace::Store> stores_if_sound;  // which wait for the test that all is finite
  std::vector<int> statuses;                  // joined by |
  int finite = -1;                            // condition; −1: cannot become infinite
  std::string recovery;            // the call that answers where it is not finite; empty: NAME_reset or NAME_recover
  std::string faults;              // a bit of the status with which it is not finite either
  bool checks_covariance = false;  // P may be at fault, not x̂: NAME_recover
  bool is_void = false;
  // The questions to NAME_weigh, which add to the status and count even where nothing else needs their answers.
  std::vector<int> asked;
  std::vector<int> gates;  // the conditions that the gate left the output out
  std::vector<int> lost;   // output by output, the condition that a partial update leaves it out

  std::optional<TracedRecovery> before;  // what the function did before its rest, which all other members are of

  std::vector<int> results() const;
  std::vector<int> results_before() const;
};

trace::Printer printer_of(const TracedFunction& function);

struct TracedController {
  TracedFunction update, control, predict, step;
  std::vector<TracedFunction> updates_alone;
};

TracedController trace_controller(const Controller& controller);

// Parts of it.
TracedFunction trace_regulator(const Controller& controller);
TracedFunction trace_prediction(const Controller& controller);
std::vector<TracedFunction> trace_updates_alone(const Controller& controller);  // empty where there is one output only

// The calls of a sample as one function, which finds the bits and the status that they find. `pattern` is that of the
// covariance.
TracedFunction trace_sample(const Controller& controller, const std::vector<bool>& pattern);

// Why output i is not used, of its innovation and S: it is where the status is LQG_OK. What is not the same for all
// outputs is limits[i], widen[i] or narrow[i].
TracedFunction trace_weigh(const Controller& controller);
bool is_same_for_all(const Eigen::VectorXd& values);

// What both styles have as straight-line code: who does not call it does not pay for it.

// innovation[] and S[] of y[].
TracedFunction trace_innovation(const Controller& controller);

// x̂ of x[], and the input of u[].
TracedFunction trace_set_state(const Controller& controller);
TracedFunction trace_set_input(const Controller& controller);

// x[] of self->z, or of self->x about the operating point.
TracedFunction trace_estimate_in_own_units(const Controller& controller);

// P[] of x̂: of U and d, or of what the filter keeps of z.
TracedFunction trace_covariance(const Controller& controller);

// P as at the start; not finite where x̂ has to begin anew, too.
TracedFunction trace_begin_covariance(const Controller& controller);

// r − y of the integrals of an output, of which y was `heard`; no stores where it has none.
TracedFunction trace_observation(const Controller& controller, int output);

// Those that an update leaves out, of the innovation[] of the outputs as they are, infinite where one is not there.
TracedFunction trace_lost_outputs(const Controller& controller);

// Which entries of P (or of U, then D) are ever different from 0: those of P0, and those that a step makes so.
std::vector<bool> covariance_pattern(const Controller& controller);

}  // namespace lqg::emit
