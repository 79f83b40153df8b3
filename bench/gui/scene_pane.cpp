#include "gui/scene_pane.h"

#include <fmt/format.h>

#include "hlod/core/error.h"

namespace hlodbench {

ScenePane::ScenePane(const Hierarchy& hierarchy, Renderer& renderer,
                     std::span<const StrategyInfo> strategies, PaneSettings settings)
    : hierarchy_(hierarchy), renderer_(renderer), strategies_(strategies) {
  configure(std::move(settings));
}

void ScenePane::configure(PaneSettings settings) {
  const StrategyInfo& info = findStrategy(settings.strategy, strategies_);
  if (info.needsRecording)
    throw InputError(
        fmt::format("{}: only works from a recording of a whole session: see it by `hlodbench run`",
                    info.name));
  if (&info != info_) own_.emplace(info.options);
  info_ = &info;
  settings_ = std::move(settings);
  restart();
}

void ScenePane::setOption(std::string_view name, std::string_view text) {
  own_->set(info_->name, name, text);
  restart();
}

void ScenePane::restart() {
  error_.clear();
  const std::size_t nodes = hierarchy_.nodes.size();
  glQueries_ = std::make_unique<GlQuerySource>(renderer_, nodes);
  queries_ = wrapQuerySource(*glQueries_, settings_.latency, nodes);
  try {
    strategy_ = info_->make({hierarchy_, settings_.traversal, nullptr, own_->values()});
  } catch (const std::exception& error) {  // of a plug-in
    strategy_.reset();
    error_ = fmt::format("{}: {}", info_->name, error.what());
  }
}

void ScenePane::render(const Camera& camera) {
  record_ = FrameRecord();
  trace_.clear();
  queries_->beginFrame();
  renderer_.beginFrame(camera);
  if (!strategy_) return;
  GlFrameServices services(renderer_, *queries_);
  const auto start = std::chrono::steady_clock::now();
  try {
    strategy_->renderFrame(camera, services, record_, &trace_);
  } catch (const InputError&) {
    throw;  // a damaged file of geometry
  } catch (const std::exception& error) {
    strategy_.reset();
    error_ =
        fmt::format("{} failed: {}; choose it again to start it anew", info_->name, error.what());
  }
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  storeServiceTimes(services.takeTimes(), time.count(), record_);
}

}  // namespace hlodbench
