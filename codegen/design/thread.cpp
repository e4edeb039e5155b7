// SPDX-License-Identifier: MIT
#include "design/thread.hpp"

#include <mpfr.h>

#include "design/number_memory.hpp"

namespace lqg::design {

ThreadCaches::~ThreadCaches() {
  mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE);
  empty_number_store();
}

}  // namespace lqg::design
