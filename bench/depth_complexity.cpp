#include "depth_complexity.h"

#include <glad/gl.h>

#include <algorithm>

#include "front.h"
#include "hlod/core/error.h"
#include "hlod/render/gl_context.h"
#include "hlod/render/renderer.h"
#include "progress_line.h"

namespace hlodbench {
namespace {

struct Layers {
  double drawn = 0.0;
  double covered = 0.0;
};

Layers countLayers(const Hierarchy& hierarchy, Renderer& renderer, const Camera& camera) {
  const std::vector<NodeId> leaves = listLeavesInside(hierarchy, Frustum(camera));
  const GlQuery query;
  renderer.beginFrame(camera);
  glDepthFunc(GL_ALWAYS);
  glBeginQuery(GL_SAMPLES_PASSED, query);
  renderer.drawNodes(leaves);
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint drawn = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &drawn);
  const Image image = renderer.readColor();
  double covered = 0.0;
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) covered += image.pixels[i] != 0 ? 1 : 0;
  return {static_cast<double>(drawn), covered};
}

}  // namespace

DepthComplexity measureDepthComplexity(const Hierarchy& hierarchy, const Session& session,
                                       int every, const std::string& contextName) {
  const auto context = createContext(contextName, {});
  Renderer renderer(hierarchy, session.lens.width, session.lens.height);
  ProgressLine line("depth complexity");
  DepthComplexity result;
  result.min = 1e300;
  int taken = 0;
  for (std::size_t i = 0; i < session.poses.size(); i += static_cast<std::size_t>(every)) {
    const Layers layers =
        countLayers(hierarchy, renderer, makeCamera(session.lens, session.poses[i]));
    line.update("", static_cast<double>(i) / session.poses.size());
    ++taken;
    result.coverage += layers.covered / (session.lens.width * session.lens.height);
    if (layers.covered == 0.0) continue;
    const double depth = layers.drawn / layers.covered;
    result.mean += depth;
    result.min = std::min(result.min, depth);
    result.max = std::max(result.max, depth);
    ++result.frames;
  }
  if (result.frames == 0) throw InputError(session.name + ": no frame shows anything of the scene");
  result.mean /= result.frames;
  result.coverage /= taken;
  return result;
}

}  // namespace hlodbench
