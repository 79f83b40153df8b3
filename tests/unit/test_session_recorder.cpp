#include "view/session_recorder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;

class SessionRecorderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "hlodbench-recorder-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    file_ = folder_ / "walk.session.json";
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Session makeHeader() {
    Session header;
    header.timeStep = 0.1;
    header.made = "by a test";
    return header;
  }
  // Shows frames for `seconds` at a speed of 1 along x, at times that fit no step.
  void record(SessionRecorder& recorder, double seconds) {
    constexpr double kFrame = 0.0371;
    recorder.start(Lens{});
    const double end = time_ + seconds;
    for (; time_ < end; time_ += kFrame) {
      Pose pose;
      pose.position.x = time_;
      recorder.add(time_, pose);
    }
  }

  fs::path folder_, file_;
  double time_ = 2.0;
};

}  // namespace

TEST_F(SessionRecorderTest, SavesWhatWasShownAtTheStep) {
  SessionRecorder recorder(makeHeader(), file_);
  EXPECT_TRUE(recorder.isSaved());
  record(recorder, 3.0);
  EXPECT_FALSE(recorder.isSaved());
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_TRUE(fs::exists(nameJournal(file_)));
  recorder.save();
  EXPECT_TRUE(recorder.isSaved());
  EXPECT_FALSE(fs::exists(nameJournal(file_)));
  const Session session = readSession(file_);
  EXPECT_EQ(session.timeStep, 0.1);
  EXPECT_EQ(session.made, "by a test");
  EXPECT_EQ(session.name, "walk");
  ASSERT_GE(session.poses.size(), 29u);
  for (std::size_t i = 0; i < session.poses.size(); ++i)
    EXPECT_NEAR(session.poses[i].position.x, 2.0 + 0.1 * static_cast<double>(i), 1e-9);
}

TEST_F(SessionRecorderTest, TheJournalHoldsWhatWasRecordedHalfASecondAgo) {
  SessionRecorder recorder(makeHeader(), file_);
  record(recorder, 5.0);
  const std::size_t recorded = recorder.recording().poses().size();
  const Session found = recoverJournal(nameJournal(file_));
  EXPECT_LE(found.poses.size(), recorded);
  EXPECT_GE(found.poses.size() + 6, recorded);
  recorder.pause();
  EXPECT_EQ(recoverJournal(nameJournal(file_)).poses.size(), recorded);
}

TEST_F(SessionRecorderTest, GoesOnAfterCutsUndoAndSaving) {
  SessionRecorder recorder(makeHeader(), file_);
  record(recorder, 2.0);
  recorder.cutAfter(9);
  EXPECT_EQ(recorder.recording().poses().size(), 10u);
  EXPECT_EQ(recoverJournal(nameJournal(file_)).poses.size(), 10u);
  recorder.undo();
  const std::size_t before = recorder.recording().poses().size();
  EXPECT_GE(before, 19u);
  recorder.save();
  record(recorder, 1.0);  // after it was saved: into a new journal, whole
  EXPECT_FALSE(recorder.isSaved());
  recorder.pause();
  EXPECT_EQ(recoverJournal(nameJournal(file_)).poses.size(), recorder.recording().poses().size());
  EXPECT_GT(recorder.recording().poses().size(), before);
  recorder.save();
  EXPECT_EQ(readSession(file_).poses.size(), recorder.recording().poses().size());
}

TEST_F(SessionRecorderTest, ReplacesNoFileOfSomebodyElse) {
  std::ofstream(file_) << "mine";
  SessionRecorder recorder(makeHeader(), file_);
  record(recorder, 1.0);
  EXPECT_THROW(recorder.save(), InputError);
  EXPECT_FALSE(recorder.isSaved());
  EXPECT_TRUE(fs::exists(nameJournal(file_)));
  std::ifstream kept(file_);
  std::string text;
  kept >> text;
  EXPECT_EQ(text, "mine");
  recorder.setFile(folder_ / "other.session.json");
  recorder.save();
  EXPECT_TRUE(fs::exists(folder_ / "other.session.json"));
  EXPECT_FALSE(fs::exists(nameJournal(file_)));
}

TEST_F(SessionRecorderTest, RecordsNothingWhereItCannotKeepAJournal) {
  std::ofstream(folder_ / "file") << "x";
  SessionRecorder recorder(makeHeader(), folder_ / "file" / "walk.session.json");
  EXPECT_THROW(recorder.start(Lens{}), InputError);
  EXPECT_EQ(recorder.state(), SessionRecorder::State::kIdle);
  EXPECT_TRUE(recorder.isSaved());
}

TEST_F(SessionRecorderTest, NewNamesAreFree) {
  EXPECT_EQ(nameNewSession(folder_, "walk"), file_);
  std::ofstream(nameJournal(file_)) << "x";
  EXPECT_EQ(nameNewSession(folder_, "walk"), folder_ / "walk-2.session.json");
  std::ofstream(folder_ / "walk-2.session.json") << "x";
  EXPECT_EQ(nameNewSession(folder_, "walk"), folder_ / "walk-3.session.json");
}

}  // namespace hlodbench
