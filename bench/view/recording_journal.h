#pragma once

#include <filesystem>
#include <vector>

#include "session.h"

namespace hlodbench {

// What a journal's name ends with: walk.session.json.recording.
inline constexpr const char* kJournalEnding = ".recording";

// The poses of a recording in a file beside the session to be, so that a crash loses at most what
// came after the last update().
//
// The file is JSON, a value a line: a session without frames, then an array a pose as in a session,
// and an object {"frames": N} where the recording was shortened to its first N poses. Every number
// has the digits to come back bit by bit.
class RecordingJournal {
 public:
  // Creates the file, with what the header says but its poses. Throws InputError if that fails
  // (names the folder and the reason), or if the file is there already: it may hold a recording
  // that was never saved.
  RecordingJournal(std::filesystem::path path, const Session& header);
  ~RecordingJournal();  // the file stays unless removed
  RecordingJournal(const RecordingJournal&) = delete;
  RecordingJournal& operator=(const RecordingJournal&) = delete;

  // Brings the file up to date with these poses: writes what is new or was cut, straight to the
  // file system. Throws InputError if that fails, as on a full disk; the file is then as it was,
  // and the next call tries again.
  void update(const std::vector<Pose>& poses);

  // When the session is saved. After it update() does nothing: a recording that goes on needs a new
  // journal.
  void remove();

 private:
  void write(const std::string& text);
  void close();

  std::filesystem::path path_;
  int file_;
  std::size_t size_ = 0;  // bytes of whole lines
  std::vector<Pose> written_;
};

// The session of a journal as of its last whole line; it may have no pose. What comes after a line
// that is torn or damaged is dropped. Throws InputError if the first line is no header.
Session recoverJournal(const std::filesystem::path& path);

// The journals in a folder, by name; none if it cannot be read.
std::vector<std::filesystem::path> listJournals(const std::filesystem::path& folder);

}  // namespace hlodbench
