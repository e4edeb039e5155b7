// SPDX-License-Identifier: MIT
#include "design/thread.hpp"

#include <mpfr.h>

namespace lqg::design {

ThreadCaches::~ThreadCaches() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }

}  // namespace lqg::design
