#include "hlod/build/border_locks.h"

namespace hlodbench {

BorderLocks::BorderLocks(const WeldedMesh& mesh)
    : mesh_(mesh), first_(mesh.positionCount(), 0xffffffffu), last_(mesh.positionCount(), 0) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t id = mesh.positionIds[mesh.triangles[t][corner]];
      if (first_[id] == 0xffffffffu) first_[id] = t;
      last_[id] = t;
    }
  }
}

}  // namespace hlodbench
