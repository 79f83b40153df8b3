#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gui/controls.h"
#include "gui/frame_comparison.h"
#include "gui/gui.h"
#include "gui/messages.h"
#include "gui/stage.h"
#include "gui/view_options.h"
#include "gui/window.h"
#include "hierarchy_store.h"
#include "session.h"
#include "view/camera_control.h"
#include "view/counter_history.h"
#include "view/session_player.h"
#include "view/session_recorder.h"

namespace hlodbench {

// The window of `hlodbench view`: what it shows, and what can be done with it. Panels and keys call
// the same functions; none of these throws InputError: they tell the user instead.
class Viewer {
 public:
  // Throws InputError for bad options or a scene that cannot be shown, GlUnavailable without a
  // window. Where the user closes the window before the scene is there, run() returns at once.
  explicit Viewer(const ViewOptions& options);
  ~Viewer();
  // Until the window is closed. Returns whether everything is saved that was recorded, and the
  // picture that was to be kept at the end.
  bool run();

  // Strategies
  void configurePanes(const PaneSettings& settings);  // all but the strategy's name
  void chooseStrategy(std::size_t pane, const std::string& name);
  void setStrategyOption(std::size_t pane, const std::string& name, const std::string& value);
  void toggleSplit();
  void toggleFreeze();
  // The camera
  void setFov(double radians);
  // Recording
  void toggleRecording();
  void saveRecording();
  void discardRecording();
  void cutRecording();  // after the frame that is shown
  void undoRecording();
  void recoverRecording(const std::filesystem::path& journal, bool keep);
  // The question that is asked, if one is. yes: by its first button, else: leaves all as it is.
  // Returns whether one was.
  bool answerQuestion(bool yes);
  // Replaying
  void openSession(const std::filesystem::path& file);
  void showSession(Session session);  // whatever scene it is of
  void reviewRecording();             // what was recorded so far
  void closeSession();
  void exportSession();  // that is shown: smoothed and at another rate, as a new file
  // What is written
  void keepPicture(bool withPanels);
  void compareFrame();

  ViewOptions options;
  Window window;
  Gui gui;
  Messages messages;
  std::vector<StrategyInfo> strategies;
  StoredHierarchy stored;
  std::unique_ptr<Stage> stage;
  std::unique_ptr<CameraControl> camera;
  std::unique_ptr<SessionRecorder> recorder;
  SessionPlayer player;
  bool isReviewing = false;                     // the player shows the recording
  std::optional<Session> otherScenes;           // asked about: it was recorded in another scene
  std::vector<std::filesystem::path> journals;  // of recordings that were interrupted
  std::optional<FrameComparison> comparison;
  CounterHistory history;
  Lens lens;                   // of the free camera
  std::size_t activePane = 0;  // that Tab gives another strategy
  Counter plottedCounter = Counter::kDn;
  bool showsPanel = true, showsHelp = false;
  double exportRate = 60.0, exportSigma = 0.0;  // poses a second; seconds
  std::string sessionPath, recordPath;          // as they stand in the panel

 private:
  void load();
  void takeClosingKeys(bool alsoEscape);  // while there is no scene
  void showProgress(const std::string& text, double share);
  void makeSceneParts();
  void showFrame();
  void obey(Command command);
  void moveCamera(double seconds);
  void record();
  void noteShown(const Camera& shown, double seconds);
  void pollComparison();
  void finish();
  void chooseNextStrategy();
  void chooseNextOverlay();
  [[nodiscard]] Area stageArea() const;
  [[nodiscard]] Camera currentCamera();
  [[nodiscard]] float panelWidth() const;
  // Calls what may throw InputError or fail in the file system, and tells the user.
  bool attempt(const std::function<void()>& action);

  Controls controls_;
  std::deque<Pose> shownPoses_;  // the last ones, with the lens of shownLens_
  Lens shownLens_;
  double lastTime_ = 0.0;  // seconds
  int frames_ = 0;
  bool wantsWindowPicture_ = false, isPictureMissing_ = false;
  std::filesystem::path pictureFile_;
  Pose poseBeforeFreeze_;
  bool isOpen_ = false;  // the scene is there
};

}  // namespace hlodbench
