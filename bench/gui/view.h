#pragma once

#include "gui/view_options.h"

namespace hlodbench {

// Shows the scene in a window until the user closes it. Returns whether everything that was
// recorded is saved. Throws InputError for bad options or a scene that cannot be shown, and
// GlUnavailable without a window, or where the program was built without GLFW and Dear ImGui.
bool view(const ViewOptions& options);

}  // namespace hlodbench
