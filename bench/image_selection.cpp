#include "image_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <random>
#include <utility>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& option) {
  throw InputError(fmt::format(
      "{}: expected all, none, a number of frames or a list like 0,120, found '{}'", option, text));
}

int parseFrame(const std::string& part, const std::string& text, const std::string& option) {
  int frame = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), frame);
  if (error != std::errc() || end != part.data() + part.size() || frame < 0) refuse(text, option);
  return frame;
}

}  // namespace

std::string ImageSelection::name() const {
  switch (kind) {
    case Kind::kNone:
      return "none";
    case Kind::kAll:
      return "all";
    case Kind::kRandom:
      return "random";
    case Kind::kList:
      return "list";
  }
  return "";
}

ImageSelection parseImageSelection(const std::string& text, const std::string& option) {
  using Kind = ImageSelection::Kind;
  if (text == "all") return {Kind::kAll, 0, {}};
  if (text == "none") return {Kind::kNone, 0, {}};
  if (text.find(',') == std::string::npos) {
    const int count = parseFrame(text, text, option);
    return {count > 0 ? Kind::kRandom : Kind::kNone, count, {}};
  }
  ImageSelection selection{Kind::kList, 0, {}};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    selection.frames.push_back(parseFrame(text.substr(begin, end - begin), text, option));
    begin = end + 1;
  }
  if (selection.frames.empty()) refuse(text, option);
  return selection;
}

std::vector<int> selectFrames(const ImageSelection& selection, int sessionFrames, int warmUpFrames,
                              std::uint64_t seed, const std::string& option) {
  using Kind = ImageSelection::Kind;
  std::vector<int> frames;
  if (selection.kind == Kind::kAll) {
    frames.resize(static_cast<std::size_t>(sessionFrames));
    std::iota(frames.begin(), frames.end(), 0);
  } else if (selection.kind == Kind::kRandom) {
    frames.resize(static_cast<std::size_t>(std::max(0, sessionFrames - warmUpFrames)));
    std::iota(frames.begin(), frames.end(), warmUpFrames);
    std::mt19937_64 random(seed);
    // Fisher-Yates by hand: std::sample differs between standard libraries
    const auto count = std::min(frames.size(), static_cast<std::size_t>(selection.count));
    for (std::size_t i = 0; i < count; ++i)
      std::swap(frames[i], frames[i + random() % (frames.size() - i)]);
    frames.resize(count);
  } else {
    frames = selection.frames;
  }
  for (const int frame : frames)
    if (frame >= sessionFrames)
      throw InputError(
          fmt::format("{}: expected frames 0 to {}, found {}", option, sessionFrames - 1, frame));
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace hlodbench
