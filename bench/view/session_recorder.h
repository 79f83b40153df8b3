#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "session.h"
#include "view/pose_sampler.h"
#include "view/recording.h"
#include "view/recording_journal.h"

namespace hlodbench {

// Records a session from the poses that are shown: at a fixed time step, however fast the frames
// are. What is recorded is in a journal within half a second, and in the session file when saved.
class SessionRecorder {
 public:
  enum class State { kIdle, kRecording, kPaused };

  // header: everything of the session but its poses, lens and name; its timeStep is the step,
  // seconds. file: where it is saved; the session is called as it is.
  SessionRecorder(Session header, std::filesystem::path file);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  // The journal of what is recorded already stays where it is until the session is saved.
  void setFile(std::filesystem::path file);
  [[nodiscard]] bool isSaved() const { return saved_; }
  // The lens with which it was begun; while there is a recording, it must not change.
  [[nodiscard]] const Lens& lens() const { return header_.lens; }

  // Begins, or goes on. Throws InputError where the journal cannot be written: nothing is recorded
  // then.
  void start(const Lens& lens);
  void pause();
  // One shown frame; time: seconds. Throws InputError when the disk is full: the recording pauses.
  void add(double time, const Pose& pose);
  // These pause.
  void cutAfter(std::size_t frame);
  void undo();
  // Writes the session; a file that is there is replaced only if this wrote it. Throws InputError;
  // the recording and its journal then stay.
  void save();
  // The session as it would be saved.
  [[nodiscard]] Session makeSession() const;
  // Forgets the recording: its journal goes, a file that was saved stays.
  void discard();

 private:
  void updateJournal();

  Session header_;
  std::filesystem::path file_;
  State state_ = State::kIdle;
  Recording recording_;
  PoseSampler sampler_;
  std::optional<RecordingJournal> journal_;
  double journalTime_ = 0.0;
  bool saved_ = true;
  bool ownsFile_ = false;  // what is there under this name was written by this
};

// FOLDER/NAME.session.json, or with -2, -3, ... after NAME the first that is not there, nor its
// journal.
std::filesystem::path nameNewSession(const std::filesystem::path& folder, const std::string& name);

// Where the journal of a session file is.
std::filesystem::path nameJournal(const std::filesystem::path& file);

}  // namespace hlodbench
