#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "front.h"

namespace hlodbench {

// A picture in which the colour of each node of a front tells something about it.
struct OverlayInfo {
  std::string_view name;
  std::string_view description;  // one line
  // One colour a node of the front, linear RGB, 0 to 1.
  std::function<std::vector<glm::vec3>(const Hierarchy&, const Front&)> computeTints;
};

const std::vector<OverlayInfo>& listOverlays();

// Throws InputError listing the known names.
const OverlayInfo& findOverlay(const std::string& name);

}  // namespace hlodbench
