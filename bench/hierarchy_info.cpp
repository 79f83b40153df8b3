#include "hierarchy_info.h"

#include <fmt/format.h>

#include <algorithm>

namespace hlodbench {
namespace {

struct Range {
  double min = 1e300, max = 0.0, sum = 0.0;
  std::size_t count = 0;
  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
    sum += value;
    ++count;
  }
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

std::string format(const glm::vec3& v) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

}  // namespace

std::string formatSummary(const Hierarchy& hierarchy, const HlodFileInfo& info) {
  struct Level {
    Range triangles, error;
    std::size_t leaves = 0;
  };
  std::vector<Level> levels;
  Range leafTriangles, innerTriangles;
  std::size_t consistent = 0;
  for (const Node& node : hierarchy.nodes) {
    levels.resize(std::max<std::size_t>(levels.size(), node.level + 1));
    Level& level = levels[node.level];
    level.triangles.add(node.triangleCount());
    level.error.add(node.error);
    consistent += (node.flags & kConsistentWinding) != 0 ? 1 : 0;
    level.leaves += node.isLeaf() ? 1 : 0;
    (node.isLeaf() ? leafTriangles : innerTriangles).add(node.triangleCount());
  }
  const Aabb& box = hierarchy.nodes[kRoot].box;
  std::string text = fmt::format(
      "hierarchy   {:016x}, made with {}\n"
      "scene       {} triangles in {} objects, box {} to {} (world units)\n"
      "nodes       {}: {} leaves, {} inner nodes, {} levels\n"
      "geometry    {:.1f} MiB; {} of the nodes are wound consistently\n"
      "triangles   leaf min {:.0f}, mean {:.1f}, max {:.0f}",
      info.contentHash, info.options, hierarchy.inputTriangles, hierarchy.objects.size(),
      format(box.min), format(box.max), hierarchy.nodes.size(), leafTriangles.count,
      innerTriangles.count, levels.size(),
      static_cast<double>(hierarchy.geometry.bytes().size()) / (1 << 20), consistent,
      leafTriangles.min, leafTriangles.mean(), leafTriangles.max);
  if (innerTriangles.count > 0)
    text += fmt::format("; inner node min {:.0f}, mean {:.1f}, max {:.0f}", innerTriangles.min,
                        innerTriangles.mean(), innerTriangles.max);
  text += "\n\nlevel   nodes  leaves  triangles a node (min mean max)   error (min mean max)\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
    text += fmt::format("{:5}{:8}{:8}{:9.0f}{:9.1f}{:9.0f}{:16.4g}{:11.4g}{:11.4g}\n", i,
                        levels[i].triangles.count, levels[i].leaves, levels[i].triangles.min,
                        levels[i].triangles.mean(), levels[i].triangles.max, levels[i].error.min,
                        levels[i].error.mean(), levels[i].error.max);
  return text;
}

std::string formatNodesJson(const Hierarchy& hierarchy) {
  std::string text = "{\"nodes\":[";
  for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) {
    const Node& n = hierarchy.nodes[id];
    std::string children;
    for (NodeId c = n.firstChild; c < n.firstChild + n.childCount; ++c)
      children += fmt::format("{}{}", children.empty() ? "" : ",", c);
    text += fmt::format(R"({}{{"id":{},"parent":{},"children":[{}],"min":[{:.9g},{:.9g},{:.9g}],)"
                        R"("max":[{:.9g},{:.9g},{:.9g}],"error":{:.9g},"triangles":{}}})",
                        id == 0 ? "\n" : ",\n", id,
                        n.parent == kNoNode ? "null" : std::to_string(n.parent), children,
                        n.box.min.x, n.box.min.y, n.box.min.z, n.box.max.x, n.box.max.y,
                        n.box.max.z, n.error, n.triangleCount());
  }
  return text + "\n]}\n";
}

}  // namespace hlodbench
