#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "front.h"
#include "gl_frame_services.h"
#include "hlod/render/gl_query_source.h"
#include "hlod/render/renderer.h"
#include "latency.h"
#include "traversals/option_set.h"
#include "traversals/registry.h"

namespace hlodbench {

// What a pane renders with.
struct PaneSettings {
  std::string strategy = "coh-b";
  TraversalOptions traversal;
  Latency latency;
};

// One strategy at work on a renderer, which several panes may share in turn.
class ScenePane {
 public:
  // All must outlive the pane. Throws InputError for a strategy that is not among them, or that
  // only works from a recording.
  ScenePane(const Hierarchy& hierarchy, Renderer& renderer,
            std::span<const StrategyInfo> strategies, PaneSettings settings);

  [[nodiscard]] const PaneSettings& settings() const { return settings_; }
  [[nodiscard]] const StrategyInfo& info() const { return *info_; }
  // The strategy starts cold. Throws as the constructor; nothing has changed then.
  void configure(PaneSettings settings);
  // Sets one of the strategy's own options, as --set does; it starts cold.
  void setOption(std::string_view name, std::string_view text);
  [[nodiscard]] const OptionSet& ownOptions() const { return *own_; }

  // Renders a frame into the renderer's framebuffer and keeps what happened in it. A strategy that
  // fails is told about by takeError(), once, and not asked again until it is configured anew.
  void render(const Camera& camera);
  std::string takeError() { return std::exchange(error_, {}); }

  // Of the last frame.
  [[nodiscard]] const FrameRecord& record() const { return record_; }
  [[nodiscard]] const Trace& trace() const { return trace_; }
  [[nodiscard]] Front front() const { return computeFront(0, trace_); }

 private:
  void restart();

  const Hierarchy& hierarchy_;
  Renderer& renderer_;
  std::span<const StrategyInfo> strategies_;
  PaneSettings settings_;
  const StrategyInfo* info_ = nullptr;
  std::optional<OptionSet> own_;
  std::unique_ptr<GlQuerySource> glQueries_;
  std::unique_ptr<QuerySource> queries_;
  std::unique_ptr<Strategy> strategy_;
  FrameRecord record_;
  Trace trace_;
  std::string error_;
};

}  // namespace hlodbench
