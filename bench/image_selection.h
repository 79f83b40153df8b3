#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hlodbench {

// Which frames of a session are kept as pictures, or explained.
struct ImageSelection {
  enum class Kind { kNone, kAll, kRandom, kList };
  Kind kind = Kind::kRandom;
  int count = 20;           // kRandom: as many as the paper compares (section 5.3)
  std::vector<int> frames;  // kList

  // "none", "all", "random" or "list".
  [[nodiscard]] std::string name() const;
};

// "all", "none", a number of frames to choose at random, or a list with a comma in it: "0,120",
// "7,". Throws InputError that names the option.
ImageSelection parseImageSelection(const std::string& text, const std::string& option = "--images");

// The frames, ascending, each once. Random ones are taken from those that are no warm-up; the same
// seed gives the same frames everywhere. Throws InputError for a frame that the session does not
// have.
std::vector<int> selectFrames(const ImageSelection& selection, int sessionFrames, int warmUpFrames,
                              std::uint64_t seed, const std::string& option = "--images");

}  // namespace hlodbench
