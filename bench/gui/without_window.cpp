// Stands in for the window where GLFW or Dear ImGui was not there when the program was built.
#include "gui/view.h"
#include "hlod/core/error.h"

namespace hlodbench {

bool view(const ViewOptions& /*options*/) {
  throw GlUnavailable(
      "view: this program was built without a window: install GLFW and Dear ImGui (Debian: "
      "libglfw3-dev, libimgui-dev), then configure and build it again");
}

}  // namespace hlodbench
