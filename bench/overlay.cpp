#include "overlay.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_set>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

constexpr glm::vec3 kGrey(0.45f);

// An even colour wheel, bright and not saturated; turn: 0 to 1, repeats.
glm::vec3 computeHue(double turn) {
  const auto channel = [&](double shift) {
    return 0.5 + 0.42 * std::cos(2.0 * 3.14159265358979 * (turn + shift));
  };
  return glm::vec3(glm::dvec3(channel(0.0), channel(-1.0 / 3.0), channel(1.0 / 3.0)));
}

// Weak modulation blue, moderate magenta, strong red (paper, Fig. 5).
std::vector<glm::vec3> tintByBias(const Hierarchy&, const Front& front) {
  const glm::vec3 blue(0.05f, 0.12f, 0.95f), magenta(0.85f, 0.05f, 0.75f), red(0.95f, 0.05f, 0.04f);
  std::vector<glm::vec3> tints;
  for (const DrawnNode& drawn : front.nodes) {
    const float modulation = 1.0f - drawn.bias;
    tints.push_back(modulation < 0.5f ? glm::mix(blue, magenta, 2.0f * modulation)
                                      : glm::mix(magenta, red, 2.0f * modulation - 1.0f));
  }
  return tints;
}

std::vector<glm::vec3> tintByLevel(const Hierarchy& hierarchy, const Front& front) {
  std::vector<glm::vec3> tints;
  for (const DrawnNode& drawn : front.nodes)
    tints.push_back(computeHue(hierarchy.node(drawn.node).level / 7.0));
  return tints;
}

std::vector<glm::vec3> tintByNode(const Hierarchy&, const Front& front) {
  constexpr double kGoldenRatio = 0.618033988749895;  // neighbours in number get far hues
  std::vector<glm::vec3> tints;
  for (const DrawnNode& drawn : front.nodes)
    tints.push_back(computeHue(std::fmod(kGoldenRatio * drawn.node, 1.0)));
  return tints;
}

// Drawn too early: red; drawn over it in the same frame, from below it in the tree: orange.
std::vector<glm::vec3> tintByRarn(const Hierarchy& hierarchy, const Front& front) {
  std::unordered_set<NodeId> refined;
  for (const DrawnNode& drawn : front.nodes)
    if (drawn.refined) refined.insert(drawn.node);
  const auto isBelowRefined = [&](NodeId node) {
    while ((node = hierarchy.node(node).parent) != kNoNode)
      if (refined.count(node) > 0) return true;
    return false;
  };
  std::vector<glm::vec3> tints;
  for (const DrawnNode& drawn : front.nodes)
    tints.push_back(drawn.refined                ? glm::vec3(0.9f, 0.03f, 0.03f)
                    : isBelowRefined(drawn.node) ? glm::vec3(0.95f, 0.5f, 0.02f)
                                                 : kGrey);
  return tints;
}

}  // namespace

const std::vector<OverlayInfo>& listOverlays() {
  static const std::vector<OverlayInfo> overlays{
      {"bias", "modulation of the refinement: weak blue, moderate magenta, strong red", tintByBias},
      {"level", "level of the node drawn, a colour each", tintByLevel},
      {"node", "the node drawn, a colour each", tintByNode},
      {"rarn", "nodes rendered and then refined red, what was drawn over them orange", tintByRarn}};
  return overlays;
}

const OverlayInfo& findOverlay(const std::string& name) {
  std::string known;
  for (const OverlayInfo& overlay : listOverlays()) {
    if (overlay.name == name) return overlay;
    known += (known.empty() ? "" : ", ") + std::string(overlay.name);
  }
  throw InputError(fmt::format("--overlay: expected one of {}, found '{}'", known, name));
}

}  // namespace hlodbench
