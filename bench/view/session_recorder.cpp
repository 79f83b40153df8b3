#include "view/session_recorder.h"

#include <fmt/format.h>

#include "hlod/core/error.h"
#include "session_writer.h"

namespace hlodbench {
namespace {
constexpr double kJournalSeconds = 0.5;

// What cannot be looked at, as in a folder whose name is too long, cannot be written either, and
// that says why.
bool isThere(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}
}  // namespace

SessionRecorder::SessionRecorder(Session header, std::filesystem::path file)
    : header_(std::move(header)),
      file_(std::move(file)),
      recording_(header_.timeStep),
      sampler_(header_.timeStep) {}

void SessionRecorder::setFile(std::filesystem::path file) {
  if (file == file_) return;
  file_ = std::move(file);
  ownsFile_ = false;
}

void SessionRecorder::start(const Lens& lens) {
  if (recording_.empty()) header_.lens = lens;
  if (!journal_) {
    journal_.emplace(nameJournal(file_), makeSession());
    journal_->update(recording_.poses());
  }
  recording_.beginStretch();
  if (recording_.empty())
    sampler_.restart();
  else
    sampler_.restartAfter(recording_.poses().back());
  state_ = State::kRecording;
}

void SessionRecorder::pause() {
  if (state_ != State::kRecording) return;
  state_ = State::kPaused;
  updateJournal();
}

void SessionRecorder::add(double time, const Pose& pose) {
  if (state_ != State::kRecording) return;
  const std::vector<Pose> poses = sampler_.add(time, pose);
  recording_.append(poses);
  saved_ = saved_ && poses.empty();
  if (time - journalTime_ < kJournalSeconds && time >= journalTime_) return;
  journalTime_ = time;
  updateJournal();
}

void SessionRecorder::cutAfter(std::size_t frame) {
  pause();
  recording_.cutAfter(frame);
  saved_ = false;
  updateJournal();
}

void SessionRecorder::undo() {
  pause();
  if (!recording_.canUndo()) return;
  recording_.undo();
  saved_ = recording_.empty();
  updateJournal();
}

void SessionRecorder::updateJournal() {
  if (!journal_) return;
  try {
    journal_->update(recording_.poses());
  } catch (...) {
    if (state_ == State::kRecording) state_ = State::kPaused;
    throw;
  }
}

Session SessionRecorder::makeSession() const {
  Session session = header_;
  session.name = file_.stem().stem().string();  // walk, of walk.session.json
  session.poses = recording_.poses();
  return session;
}

void SessionRecorder::save() {
  pause();
  if (recording_.empty()) return;
  if (!ownsFile_ && isThere(file_))
    throw InputError(
        fmt::format("{}: expected a new file for the session, found one", file_.string()));
  writeSession(file_, makeSession());
  saved_ = ownsFile_ = true;
  if (journal_) journal_->remove();
  journal_.reset();
}

void SessionRecorder::discard() {
  if (journal_) journal_->remove();
  journal_.reset();
  ownsFile_ = false;
  recording_ = Recording(header_.timeStep);
  state_ = State::kIdle;
  saved_ = true;
}

std::filesystem::path nameJournal(const std::filesystem::path& file) {
  return file.string() + kJournalEnding;
}

std::filesystem::path nameNewSession(const std::filesystem::path& folder, const std::string& name) {
  for (int number = 1;; ++number) {
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    const std::filesystem::path file = folder / fmt::format("{}{}.session.json", name, suffix);
    if (!isThere(file) && !isThere(nameJournal(file))) return file;
  }
}

}  // namespace hlodbench
