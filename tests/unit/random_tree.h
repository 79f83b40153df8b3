#pragma once

#include <algorithm>
#include <random>

#include "tiny_tree.h"

namespace hlodbench {

inline TinyTree makeRandomTree(std::mt19937& random) {
  TinyTree tree;
  for (NodeId id = 0; id < tree.hierarchy.nodes.size() && tree.hierarchy.nodes.size() < 200; ++id)
    if (id == 0 || random() % 3 != 0) tree.addChildren(id, 2 + random() % 4);
  // errors that shrink from the root down, and 0 in the leaves
  for (NodeId id = 0; id < tree.hierarchy.nodes.size(); ++id) {
    const Node& node = tree.hierarchy.nodes[id];
    tree.setSse(id, node.isLeaf() ? 0.0 : 16.0 / (1 << std::min(node.level, 8u)));
  }
  return tree;
}

// Gives some of the nodes another visibility.
inline void shakeVisibility(TinyTree& tree, std::mt19937& random) {
  for (NodeId id = 0; id < tree.hierarchy.nodes.size(); ++id)
    if (random() % 8 == 0) tree.setMu(id, random() % 4 == 0 ? 0.0 : (random() % 1000) / 999.0);
}

// Turned to the side by this angle, radians: a part of the tree is outside.
inline Camera makeTurnedCamera(double angle) {
  Pose pose;
  pose.orientation = glm::angleAxis(angle, glm::dvec3(0.0, 1.0, 0.0));
  return makeCamera(makeTestLens(), pose);
}

}  // namespace hlodbench
