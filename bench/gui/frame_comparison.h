#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gui/child_process.h"
#include "gui/scene_pane.h"
#include "session.h"

namespace hlodbench {

// What is compared.
struct ComparisonInputs {
  std::filesystem::path hierarchy;    // .hlod
  Session session;                    // the frames that led to the one compared, which is the last
  std::vector<PaneSettings> panes;    // the strategies, besides Bool and SW(B)
  std::vector<std::string> settings;  // of their own options, as for --set
  std::vector<std::filesystem::path> plugins;
};

// Writes one frame's comparison as `hlodbench run` makes it, and the report of it, in programs that
// run beside this one: the strategies are replayed over the frames that led there, so that each
// has the past that it needs.
class FrameComparison {
 public:
  // folder: new; of the result. Throws InputError where it cannot be made.
  FrameComparison(const ComparisonInputs& inputs, std::filesystem::path folder);

  // Goes on with what is to be done; true once, when all is done or has failed.
  bool poll();
  // Where it stands, or what it came to, in one line.
  [[nodiscard]] const std::string& message() const { return message_; }
  [[nodiscard]] bool isEnded() const { return ended_; }
  [[nodiscard]] bool hasFailed() const { return failed_; }

 private:
  bool end(bool failed, std::string message);

  std::filesystem::path folder_, log_;
  std::optional<ChildProcess> run_, report_;
  std::string message_;
  bool failed_ = false, ended_ = false;
};

}  // namespace hlodbench
