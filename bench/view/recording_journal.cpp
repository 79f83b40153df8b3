#include "view/recording_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "hlod/core/error.h"
#include "metrics/text_file.h"
#include "session_json.h"

namespace hlodbench {
namespace {

using nlohmann::json;

constexpr mode_t kMode = 0666;  // less what the user's mask takes

static_assert(sizeof(Pose) == 7 * sizeof(double), "poses are compared byte by byte");

// Bit by bit: -0 is not 0 in the file either.
bool isSame(const Pose& a, const Pose& b) {
  return std::memcmp(&a, &b, sizeof(Pose)) == 0;
}

// A line is one value; false, with `poses` as they were, if it is none of a journal's.
bool replayLine(std::string_view line, const std::string& file, std::vector<Pose>& poses) {
  const json value = json::parse(line, nullptr, false);
  if (value.is_discarded()) return false;
  const JsonNode node(value, file);
  try {
    if (value.is_array()) {
      poses.push_back(readPose(node));
    } else {
      node.expectObject({"frames"});
      poses.resize(node.at("frames").integer(0, poses.size()));
    }
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace

RecordingJournal::RecordingJournal(std::filesystem::path path, const Session& header)
    : path_(std::move(path)),
      file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, kMode)) {
  if (file_ < 0 && errno == EEXIST)
    throw InputError(
        fmt::format("{}: expected a new file, found one, maybe of a recording that was not saved",
                    path_.string()));
  if (file_ < 0) {
    const int reason = errno;
    const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    throw InputError(fmt::format("{}: no recording can be kept in this folder: {}", folder.string(),
                                 std::strerror(reason)));
  }
  try {
    write(fmt::format("{{{}, \"frames\": []}}\n", fmt::join(formatSessionHead(header), ", ")));
  } catch (...) {
    remove();
    throw;
  }
}

RecordingJournal::~RecordingJournal() {
  close();
}

void RecordingJournal::update(const std::vector<Pose>& poses) {
  if (file_ < 0) return;
  const auto end =
      std::mismatch(written_.begin(), written_.end(), poses.begin(), poses.end(), isSame);
  std::string text;
  if (end.first != written_.end())
    text = fmt::format("{{\"frames\": {}}}\n", end.first - written_.begin());
  for (auto pose = end.second; pose != poses.end(); ++pose) text += formatPose(*pose) + "\n";
  if (text.empty()) return;
  write(text);
  written_.erase(end.first, written_.end());
  written_.insert(written_.end(), end.second, poses.end());
}

void RecordingJournal::remove() {
  if (file_ < 0) return;
  close();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void RecordingJournal::write(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t bytes = ::write(file_, text.data() + done, text.size() - done);
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) {
      const int reason = errno;
      // A torn line would hide whatever is written after it.
      if (done > 0 && ::ftruncate(file_, static_cast<off_t>(size_)) != 0) close();
      throw InputError(
          fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(reason)));
    }
    done += static_cast<std::size_t>(bytes);
  }
  size_ += text.size();
}

void RecordingJournal::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

Session recoverJournal(const std::filesystem::path& path) {
  const std::string text = readTextFile(path);
  const std::string file = path.string();
  std::string_view rest = text;
  // The next line without its end, or nothing if it has none: then its writing was interrupted.
  const auto takeLine = [&rest] {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end == std::string_view::npos ? 0 : end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return line;
  };
  const json header = json::parse(takeLine(), nullptr, false);
  if (header.is_discarded())
    throw InputError(fmt::format(
        "{}: line 1: expected the header of a recording, found none that is whole", file));
  const JsonNode root(header, file + ": line 1");
  Session session = readSessionHead(root);
  root.at("frames").arraySize(0, 0);
  while (!rest.empty())
    if (!replayLine(takeLine(), file, session.poses)) break;
  return session;
}

std::vector<std::filesystem::path> listJournals(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code ignored;
    if (at->path().extension() == kJournalEnding && at->is_regular_file(ignored))
      found.push_back(at->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace hlodbench
