#include "hlod/render/driver_memory.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace hlodbench {

void keepDriverMemory() {
#ifdef __GLIBC__
  if (std::getenv("MALLOC_TRIM_THRESHOLD_") != nullptr) return;
  constexpr int kMiB = 1 << 20;
  mallopt(M_TRIM_THRESHOLD, 1024 * kMiB);
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);  // the most that is allowed
  mallopt(M_TOP_PAD, 16 * kMiB);
#endif
}

}  // namespace hlodbench
