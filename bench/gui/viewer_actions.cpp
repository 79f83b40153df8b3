// What can be done in the window; panels and keys call these.
#include <fmt/format.h>

#include <algorithm>

#include "gui/viewer.h"
#include "hlod/core/error.h"
#include "overlay.h"
#include "session_writer.h"
#include "view/pose_path.h"

namespace hlodbench {
namespace {

constexpr double kLeastFov = 0.1745, kMostFov = 2.0944;  // radians: 10 and 120 degrees

// FOLDER/NAME-1.EXTENSION, or the first number that is free.
std::filesystem::path nameNew(const std::filesystem::path& folder, const std::string& name,
                              const std::string& extension) {
  std::error_code ignored;  // what cannot be looked at cannot be written: that says why
  for (int number = 1;; ++number)
    if (auto path = folder / fmt::format("{}-{}{}", name, number, extension);
        !std::filesystem::exists(path, ignored))
      return path;
}

}  // namespace

bool Viewer::attempt(const std::function<void()>& action) {
  try {
    action();
    return true;
  } catch (const InputError& error) {
    messages.warn(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    messages.warn(error.what());
  }
  return false;
}

void Viewer::configurePanes(const PaneSettings& settings) {
  for (std::size_t i = 0; i < stage->paneCount(); ++i)
    attempt([&] {
      PaneSettings next = settings;
      next.strategy = stage->pane(i).settings().strategy;
      stage->pane(i).configure(next);
    });
}

void Viewer::chooseStrategy(std::size_t pane, const std::string& name) {
  activePane = pane;
  attempt([&] {
    PaneSettings settings = stage->pane(pane).settings();
    settings.strategy = name;
    stage->pane(pane).configure(settings);
    history.clear();
  });
}

void Viewer::chooseNextStrategy() {
  const std::string_view current = stage->pane(activePane).info().name;
  const auto isCurrent = [&](const StrategyInfo& info) { return info.name == current; };
  auto next = std::find_if(strategies.begin(), strategies.end(), isCurrent);
  do {
    if (++next == strategies.end()) next = strategies.begin();
  } while (next->needsRecording);
  chooseStrategy(activePane, std::string(next->name));
}

void Viewer::setStrategyOption(std::size_t pane, const std::string& name,
                               const std::string& value) {
  attempt([&] { stage->pane(pane).setOption(name, value); });
}

void Viewer::toggleSplit() {
  activePane = 0;
  if (stage->paneCount() > 1) {
    stage->join();
  } else {
    PaneSettings second = stage->pane(0).settings();
    second.strategy = second.strategy == "bool" ? "coh-b" : "bool";
    stage->split(second);
    activePane = 1;
  }
  history.clear();
}

void Viewer::chooseNextOverlay() {
  const auto& overlays = listOverlays();
  const auto current = std::find_if(overlays.begin(), overlays.end(), [&](const OverlayInfo& info) {
    return info.name == stage->look.overlay;
  });
  const auto next = current == overlays.end() ? overlays.begin() : current + 1;
  stage->look.overlay = next == overlays.end() ? "" : std::string(next->name);
}

void Viewer::toggleFreeze() {
  if (stage->isFrozen()) {
    stage->letGo();
    camera->setPose(poseBeforeFreeze_);
    return;
  }
  attempt([&] { recorder->pause(); });
  if (!player.empty()) player.play(false);
  poseBeforeFreeze_ = camera->pose();
  stage->freeze();
}

void Viewer::setFov(double radians) {
  if (!recorder->recording().empty()) {
    messages.tell("the field of view stays as it is in a recording: save and discard it first");
    return;
  }
  lens.fovyRad = std::clamp(radians, kLeastFov, kMostFov);
}

void Viewer::toggleRecording() {
  attempt([&] {
    if (recorder->state() == SessionRecorder::State::kRecording) {
      recorder->pause();
      return;
    }
    if (stage->isFrozen()) toggleFreeze();
    closeSession();
    const auto& poses = recorder->recording().poses();
    if (poses.empty()) recorder->setFile(recordPath);
    // goes on where the recording ends, without a jump
    else
      camera->setPose(poses.back());
    recorder->start(currentCamera().lens);
  });
}

void Viewer::saveRecording() {
  attempt([&] {
    recorder->setFile(recordPath);
    const std::size_t frames = recorder->recording().poses().size();
    recorder->save();
    if (frames > 0)
      messages.tell(fmt::format("wrote {}: {} frames", recorder->file().string(), frames));
  });
}

void Viewer::discardRecording() {
  if (isReviewing) closeSession();
  attempt([&] { recorder->discard(); });
  recordPath = nameNewSession(recorder->file().parent_path(), stored.sceneName).string();
}

void Viewer::cutRecording() {
  if (!isReviewing) {
    messages.tell("review the recording first: it is cut after the frame that is shown");
    return;
  }
  const std::size_t frame = player.frame();
  attempt([&] { recorder->cutAfter(frame); });
  reviewRecording();
  player.seek(frame);
}

void Viewer::undoRecording() {
  attempt([&] { recorder->undo(); });
  if (!isReviewing) return;
  if (recorder->recording().empty())
    closeSession();
  else
    reviewRecording();
}

void Viewer::exportSession() {
  attempt([&] {
    if (!(exportRate > 0.0) || !(exportSigma >= 0.0))
      throw InputError(fmt::format(
          "export: expected more than 0 poses a second and 0 or more seconds, found {:g} and {:g}",
          exportRate, exportSigma));
    Session session = player.session();
    session.poses = smoothPoses(session.poses, player.timeStep(), exportSigma);
    session.poses = resamplePoses(session.poses, player.timeStep(), 1.0 / exportRate);
    session.timeStep = 1.0 / exportRate;
    session.made += fmt::format("{}smoothed by {:g} s, resampled to {:g} poses a second",
                                session.made.empty() ? "" : "; ", exportSigma, exportRate);
    const std::filesystem::path file = nameNewSession(options.folder, session.name + "-export");
    session.name = file.stem().stem().string();
    writeSession(file, session);
    messages.tell(fmt::format("wrote {}: {} frames", file.string(), session.poses.size()));
  });
}

void Viewer::recoverRecording(const std::filesystem::path& journal, bool keep) {
  std::erase(journals, journal);
  attempt([&] {
    if (keep) {
      const Session session = recoverJournal(journal);
      if (session.poses.empty())
        throw InputError(fmt::format("{}: expected frames, found none", journal.string()));
      const std::filesystem::path wanted = journal.parent_path() / journal.stem();
      const std::filesystem::path file =
          std::filesystem::exists(wanted)
              ? nameNewSession(journal.parent_path(), session.name + "-recovered")
              : wanted;
      writeSession(file, session);
      messages.tell(fmt::format("wrote {}: {} frames", file.string(), session.poses.size()));
    }
    std::filesystem::remove(journal);
  });
}

bool Viewer::answerQuestion(bool yes) {
  if (otherScenes) {
    Session session = std::move(*otherScenes);
    otherScenes.reset();
    if (yes) showSession(std::move(session));
    return true;
  }
  if (journals.empty()) return false;
  const std::filesystem::path journal = journals.front();
  if (yes)
    recoverRecording(journal, true);
  else
    journals.erase(journals.begin());
  return true;
}

void Viewer::openSession(const std::filesystem::path& file) {
  attempt([&] {
    Session session = readSession(file);
    sessionPath = file.string();
    if (describeOtherScene(session, stored.sceneName, stored.info.sceneHash).empty())
      showSession(std::move(session));
    else
      otherScenes = std::move(session);
  });
}

void Viewer::showSession(Session session) {
  attempt([&] { recorder->pause(); });
  if (stage->isFrozen()) toggleFreeze();
  isReviewing = false;
  player.load(std::move(session));
  history.clear();
}

void Viewer::reviewRecording() {
  if (recorder->recording().empty()) return;
  showSession(recorder->makeSession());
  player.seek(player.session().poses.size() - 1);
  isReviewing = true;
}

void Viewer::closeSession() {
  player.clear();
  isReviewing = false;
}

void Viewer::keepPicture(bool withPanels) {
  pictureFile_ = nameNew(options.folder, stored.sceneName, ".png");
  if (withPanels)
    wantsWindowPicture_ = true;
  else
    stage->requestPicture();
}

void Viewer::compareFrame() {
  if (comparison && !comparison->isEnded()) {
    messages.tell("the last comparison is not ready yet");
    return;
  }
  attempt([&] {
    ComparisonInputs inputs;
    inputs.hierarchy = stored.file;
    inputs.session.name = stored.sceneName + " frame";
    inputs.session.lens = shownLens_;
    inputs.session.made = "hlodbench view, the frames that led to the one compared";
    inputs.session.poses.assign(shownPoses_.begin(), shownPoses_.end());
    inputs.plugins = options.plugins;
    for (std::size_t i = 0; i < stage->paneCount(); ++i) {
      const ScenePane& pane = stage->pane(i);
      inputs.panes.push_back(pane.settings());
      for (const std::string& text : pane.ownOptions().texts())
        inputs.settings.push_back(fmt::format("{}.{}", pane.info().name, text));
    }
    comparison.emplace(inputs, nameNew(options.folder, stored.sceneName + "-frame", ""));
    messages.tell(comparison->message());
  });
}

void Viewer::pollComparison() {
  if (!comparison || !comparison->poll()) return;
  if (comparison->hasFailed())
    messages.warn(comparison->message());
  else
    messages.tell(comparison->message());
}

}  // namespace hlodbench
