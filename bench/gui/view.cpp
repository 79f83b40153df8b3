#include "gui/view.h"

#include "gui/viewer.h"

namespace hlodbench {

bool view(const ViewOptions& options) {
  return Viewer(options).run();
}

}  // namespace hlodbench
