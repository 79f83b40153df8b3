// Hierarchies that are built in memory.

#include "hlod/build/hierarchy_builder.h"
#include "hlod/tree/memory_sink.h"

namespace hlodbench {

Hierarchy buildHierarchy(const TriangleSource& source, const BuildOptions& options,
                         BuildReport& report, const Progress& progress) {
  MemorySink sink;
  const BuiltTree tree = buildTree(source, options, sink, report, progress);
  Hierarchy hierarchy = makeHierarchy(tree);
  sink.finish(hierarchy, sinkIds(tree));
  return hierarchy;
}

Hierarchy buildHierarchy(const TriangleMesh& mesh, const BuildOptions& options, BuildReport& report,
                         const Progress& progress) {
  return buildHierarchy(MeshTriangles(mesh), options, report, progress);
}

}  // namespace hlodbench
