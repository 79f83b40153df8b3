#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "front.h"
#include "hlod/render/renderer.h"
#include "metrics/image_result.h"
#include "session.h"

namespace hlodbench {

// Names the pictures of the full-resolution model; no strategy of that name has pictures.
inline constexpr const char* kFullModel = "full";

// What one strategy drew in the frames that are kept, from one replay.
struct StrategyFronts {
  std::string strategy, label;
  std::vector<Front> fronts;
};

struct PictureOptions {
  std::string format = "png";         // png, or exr for half floats
  std::vector<std::string> overlays;  // names, see listOverlays()
};

// Draws recorded fronts again, outside of anything timed, with the full-resolution model beside
// them; writes the pictures into `folder`, which must exist, and compares them. `result` says which
// frames, and what is done is added to it frame by frame: after an interruption it holds what is
// there, with complete = false. Throws InputError when a file cannot be written.
void drawPictures(const Hierarchy& hierarchy, Renderer& renderer, const Session& session,
                  const std::vector<StrategyFronts>& strategies, const PictureOptions& options,
                  const std::filesystem::path& folder, const std::function<bool()>& isInterrupted,
                  ImageResult& result);

}  // namespace hlodbench
