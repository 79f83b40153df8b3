#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace hlodbench {

// SimplifierInput::origins of triangles that simplification made.
inline constexpr std::uint8_t kNotOriginal = 0xff;

// What a simplifier works on: the mesh of one node.
struct SimplifierInput {
  std::span<const glm::vec3> positions;   // in the node's frame: every coordinate within -1 .. 1
  std::span<const glm::uvec3> triangles;  // indices into positions; may be non-manifold
  std::span<const std::uint8_t> locked;   // one a vertex: 1 = must stay, where it is
  // One a triangle, or empty when all are original: which leaf it is an original triangle of, or
  // kNotOriginal when it is of a LOD.
  std::span<const std::uint8_t> origins;
  std::size_t targetTriangles = 0;  // wanted; more may be left where nothing can go
};

// What had to be done to meshes that are not manifold; added up, not reset.
struct SimplifierStats {
  std::uint64_t splitVertices = 0;        // copies of free vertices where surfaces meet
  std::uint64_t flippedFaces = 0;         // turned to fit their neighbours, and turned back
  std::uint64_t degenerateTriangles = 0;  // left out: two equal corners
  std::uint64_t duplicateTriangles = 0;   // left out: the same three corners as another
  std::uint64_t foldedFaces = 0;          // turned over by collapses, where nothing else could go
  std::uint64_t fallbacks = 0;            // nodes handed to the default simplifier

  void add(const SimplifierStats& other);
};

// Reduces the triangles of a mesh. Implementations keep no state: simplify() may be called by
// several threads at once, and equal input gives equal output.
class Simplifier {
 public:
  virtual ~Simplifier() = default;

  // Triangles over the same vertices (the result's vertices are a subset of the input's). Locked
  // vertices do not move, and the borders between them are unchanged; only an open flap that hangs
  // on locked vertices may be folded away whole.
  [[nodiscard]] virtual std::vector<glm::uvec3> simplify(const SimplifierInput& input,
                                                         SimplifierStats& stats) const = 0;
};

inline constexpr std::string_view kDefaultSimplifier = "openmesh";

// The names createSimplifier() knows in this build.
std::vector<std::string> simplifierNames();

// Throws InputError for an unknown name; the message lists the known ones.
std::unique_ptr<Simplifier> createSimplifier(std::string_view name);

// The input's triangles without those of two equal corners and without repetitions of the same
// three corners (in any order), in the same order; what is left out is counted. A face repeated
// the other way round by simplification, where two LODs meet, is a closed pocket without volume
// and goes with its twin; an original face of two sides keeps one.
std::vector<glm::uvec3> removeUselessTriangles(const SimplifierInput& input,
                                               SimplifierStats& stats);

}  // namespace hlodbench
