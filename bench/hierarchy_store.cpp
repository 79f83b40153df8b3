#include "hierarchy_store.h"

#include <fmt/format.h>

#include <cstdlib>

#include "hlod/core/error.h"
#include "hlod/scene/scene_file.h"
#include "hlod/scene/scene_source.h"
#include "hlod/tree/hasher.h"
#include "hlod/tree/hlod_writer.h"
#include "interrupt.h"
#include "progress_line.h"

namespace hlodbench {
namespace {

// "scene1" for scene1.scene.json, scene1.hlod, scene1.ply.gz.
std::string nameOf(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  return name.substr(0, name.find('.', 1));
}

// Hierarchies built with other options than the defaults have names of their own, so that going to
// and fro between two sets builds each once.
std::string cacheNameOf(const std::filesystem::path& scene, const BuildOptions& options) {
  const std::string text = canonicalOptions(options);
  if (text == canonicalOptions(BuildOptions())) return nameOf(scene) + ".hlod";
  return fmt::format("{}.{:08x}.hlod", nameOf(scene),
                     computeHash(std::as_bytes(std::span(text))) & 0xffffffffu);
}

bool isUpToDate(const std::filesystem::path& file, std::uint64_t sceneHash,
                const std::string& options) {
  if (!std::filesystem::exists(file) || isOtherHlodVersion(file)) return false;
  const HlodFileInfo info = readHlodFileInfo(file);
  return info.sceneHash == sceneHash && info.options == options;
}

}  // namespace

StoredHierarchy buildOrReuse(const std::filesystem::path& scenePath,
                             const std::filesystem::path& file, const BuildOptions& options,
                             const Progress& onProgress) {
  const std::uint64_t sceneHash = computeSceneHash(scenePath);
  const std::string optionText = canonicalOptions(options);
  StoredHierarchy stored;
  stored.sceneName = nameOf(scenePath);
  stored.file = file;
  if (isUpToDate(file, sceneHash, optionText)) {
    stored.hierarchy = readHlodFile(file, &stored.info);
    return stored;
  }
  if (const std::filesystem::path folder = file.parent_path(); !folder.empty()) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw InputError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  }
  stored.info.sceneHash = sceneHash;
  stored.info.options = optionText;
  ProgressLine line("building " + stored.sceneName);
  // reading takes the small first part of the time
  constexpr double kReading = 0.1;
  const auto report = [&](const std::string& stage, double share) {
    if (isInterrupted()) throw InputError(fmt::format("{}: not built: interrupted", file.string()));
    line.update(stage, share);
    if (onProgress) onProgress(stage, share);
  };
  const std::unique_ptr<TriangleSource> scene =
      openScene(scenePath, options.memory > 0 ? MeshPlace::kFile : MeshPlace::kMemory,
                [&](const std::string& stage, double share) { report(stage, kReading * share); });
  BuildOptions local = options;
  local.temporaryFolder = file.parent_path().empty() ? "." : file.parent_path();
  stored.report.emplace();
  HlodWriter writer(file);
  const BuiltTree tree =
      buildTree(*scene, local, writer, *stored.report, [&](const std::string& stage, double share) {
        report(stage, kReading + (1.0 - kReading) * share);
      });
  Hierarchy hierarchy = makeHierarchy(tree);
  writer.finish(hierarchy, stored.info, sinkIds(tree));
  // from now on the file's geometry serves, and memory is free for other things
  stored.hierarchy = readHlodFile(file, &stored.info);
  return stored;
}

StoredHierarchy openHierarchy(const std::filesystem::path& path,
                              const std::filesystem::path& cacheFolder, const BuildOptions& options,
                              const Progress& onProgress) {
  if (path.extension() != ".hlod")
    return buildOrReuse(path, cacheFolder / cacheNameOf(path, options), options, onProgress);
  StoredHierarchy stored;
  stored.sceneName = nameOf(path);
  stored.file = path;
  stored.hierarchy = readHlodFile(path, &stored.info);
  return stored;
}

std::filesystem::path getDefaultCacheFolder() {
  const char* folder = std::getenv("HLODBENCH_CACHE");
  return folder != nullptr && *folder != '\0' ? folder : ".cache";
}

}  // namespace hlodbench
