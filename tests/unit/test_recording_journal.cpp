#include "view/recording_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "hlod/core/error.h"
#include "metrics/text_file.h"
#include "pose_checks.h"
#include "session_writer.h"
#include "view/recording.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Journal : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("hlodbench_journal_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    path_ = folder_ / "walk.session.json.recording";
    header_.name = "walk";
    header_.scene = {"bunny", "0123456789abcdef"};
    header_.up = {0.0, 0.6, 0.8};
    header_.timeStep = 1.0 / 60.0;
    header_.made = "by \"hand\"";
  }
  void TearDown() override { fs::remove_all(folder_); }

  Pose makePose() {
    const auto n = [this] { return normal_(random_); };
    return {{n(), -0.0, std::exp(20.0 * n())}, glm::normalize(glm::dquat(n(), n(), n(), n()))};
  }
  std::vector<Pose> makePoses(std::size_t count) {
    std::vector<Pose> poses;
    while (poses.size() < count) poses.push_back(makePose());
    return poses;
  }
  static void expectSame(const std::vector<Pose>& a, const std::vector<Pose>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(isSame(a[i], b[i])) << i;
  }
  template <typename Action>
  static std::string catchError(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }
  // Puts a file in the journal's place and reads it.
  Session recover(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return recoverJournal(path_);
  }

  fs::path folder_, path_;
  Session header_;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

}  // namespace

TEST_F(Journal, GivesBackItsHeaderAndPosesBitByBit) {
  const std::vector<Pose> poses = makePoses(500);
  {
    RecordingJournal journal(path_, header_);
    EXPECT_TRUE(recoverJournal(path_).poses.empty());
    journal.update(poses);
    expectSame(recoverJournal(path_).poses, poses);
  }
  const Session session = recoverJournal(path_);
  expectSame(session.poses, poses);
  // the header: as a session file has it
  header_.poses = poses;
  writeSession(folder_ / "expected", header_);
  writeSession(folder_ / "found", session);
  EXPECT_EQ(readTextFile(folder_ / "found"), readTextFile(folder_ / "expected"));
}

TEST_F(Journal, FollowsCutsAndUndos) {
  for (int round = 0; round < 40; ++round) {
    RecordingJournal journal(path_, header_);
    Recording recording(header_.timeStep);
    for (int i = 0; i < 40; ++i) {
      for (auto changes = random_() % 4; changes > 0; --changes) {
        switch (random_() % 5) {
          case 0:
            recording.cutAfter(random_() % (recording.poses().size() + 1));
            break;
          case 1:
            recording.undo();
            break;
          case 2:
            recording.beginStretch();
            [[fallthrough]];
          default:
            recording.append(makePoses(random_() % 6));
        }
      }
      journal.update(recording.poses());
      expectSame(recoverJournal(path_).poses, recording.poses());
    }
    journal.remove();
  }
}

TEST_F(Journal, WritesOnlyWhatIsNew) {
  RecordingJournal journal(path_, header_);
  std::vector<Pose> poses = makePoses(100);
  journal.update(poses);
  const auto size = fs::file_size(path_);
  journal.update(poses);
  EXPECT_EQ(fs::file_size(path_), size);
  poses.resize(50);
  journal.update(poses);
  EXPECT_EQ(fs::file_size(path_), size + std::string("{\"frames\": 50}\n").size());
}

TEST_F(Journal, LosesOnlyATornLine) {
  const std::vector<Pose> poses = makePoses(6);
  RecordingJournal(path_, header_).update(poses);
  const std::string text = readTextFile(path_);
  const std::size_t headerEnd = text.find('\n') + 1;
  std::size_t whole = 0;
  for (std::size_t end = headerEnd; end <= text.size(); ++end) {
    if (end > headerEnd && text[end - 1] == '\n') ++whole;
    fs::remove(path_);
    expectSame(recover(text.substr(0, end)).poses, {poses.begin(), poses.begin() + whole});
  }
  EXPECT_EQ(whole, poses.size());
  for (std::size_t end = 0; end < headerEnd; ++end)
    EXPECT_THROW(recover(text.substr(0, end)), InputError) << end;
}

TEST_F(Journal, EndsAtADamagedLine) {
  const std::vector<Pose> poses = makePoses(3);
  RecordingJournal(path_, header_).update(poses);
  const std::string text = readTextFile(path_);
  for (const std::string line :
       {"", "[1, 2]", "[0, 0, 0, 0, 0, 0, 5]", "[0, 0, 0, 0, 0, 0, null]", "{\"frames\": 4}",
        "{\"frames\": -1}", "{\"other\": 1}", "7", "{\"frames\""})
    expectSame(recover(text + line + "\n[0, 0, 0, 0, 0, 0, 1]\n").poses, poses);
  expectSame(recover(text + std::string(100, '\0') + "\n").poses, poses);
}

TEST_F(Journal, NamesWhatIsWrongWithAHeader) {
  const std::string start = path_.string() + ": line 1: ";
  const auto error = [this](const std::string& text) {
    return catchError([&] { (void)recover(text); });
  };
  EXPECT_EQ(error(""), start + "expected the header of a recording, found none that is whole");
  EXPECT_EQ(error("\n"), start + "expected the header of a recording, found none that is whole");
  EXPECT_EQ(error("5\n"), start + "/: expected an object, found 5");
  RecordingJournal(folder_ / "other", header_);
  std::string text = readTextFile(folder_ / "other");
  EXPECT_TRUE(recover(text).poses.empty());
  EXPECT_THAT(error(std::string(text).replace(text.find("\"far\""), 5, "\"fog\"")),
              HasSubstr(start + "/fog: unknown key"));
  EXPECT_THAT(error(std::string(text).replace(text.find("[]"), 2, "[1]")),
              HasSubstr(start + "/frames: expected an array of 0 entries"));
  EXPECT_THROW(recoverJournal(folder_ / "none"), InputError);
}

TEST_F(Journal, IsNotOverwritten) {
  const std::vector<Pose> poses = makePoses(5);
  RecordingJournal(path_, header_).update(poses);
  const std::string what = catchError([this] { RecordingJournal(path_, header_); });
  EXPECT_THAT(what, HasSubstr(path_.string() + ": expected a new file, found one"));
  expectSame(recoverJournal(path_).poses, poses);
}

TEST_F(Journal, NamesTheFolderThatCannotBeWrittenTo) {
  const fs::path missing = folder_ / "none";
  EXPECT_EQ(
      catchError([&] { RecordingJournal(missing / "a.recording", header_); }),
      missing.string() + ": no recording can be kept in this folder: No such file or directory");
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to a folder that is read-only";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  const std::string what = catchError([this] { RecordingJournal(path_, header_); });
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_EQ(what,
            folder_.string() + ": no recording can be kept in this folder: Permission denied");
}

// A limit on the size of files stands in for a full disk: part of what is written fits.
TEST_F(Journal, AfterAFullDiskGoesOnWhereItWas) {
  RecordingJournal journal(path_, header_);
  const std::vector<Pose> poses = makePoses(1000);
  const std::vector<Pose> few(poses.begin(), poses.begin() + 3);
  journal.update(few);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  rlimit small = limit;
  small.rlim_cur = fs::file_size(path_) + 5000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string what = catchError([&] { journal.update(poses); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(what, path_.string() + ": cannot be written: File too large");
  expectSame(recoverJournal(path_).poses, few);
  journal.update(poses);
  expectSame(recoverJournal(path_).poses, poses);
}

TEST_F(Journal, IsGoneWhenRemoved) {
  RecordingJournal journal(path_, header_);
  journal.update(makePoses(5));
  journal.remove();
  EXPECT_FALSE(fs::exists(path_));
  journal.update(makePoses(9));
  journal.remove();
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Journal, IsFoundByItsName) {
  EXPECT_TRUE(listJournals(folder_).empty());
  EXPECT_TRUE(listJournals(folder_ / "none").empty());
  const std::vector<fs::path> journals{folder_ / "a.session.json.recording",
                                       folder_ / "b.json.recording", folder_ / "c.recording"};
  for (const std::size_t i : {1u, 2u, 0u}) RecordingJournal(journals[i], header_);
  std::ofstream(folder_ / "a.session.json") << "{}";
  std::ofstream(folder_ / "a.recording.bak") << "{}";
  fs::create_directory(folder_ / "folder.recording");
  EXPECT_EQ(listJournals(folder_), journals);
}

// A process that is killed while it records: what update() took is there.
TEST_F(Journal, SurvivesTheEndOfItsProcess) {
  const std::vector<Pose> poses = makePoses(20'000);
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      RecordingJournal journal(path_, header_);
      for (std::uint32_t count = 1; count <= poses.size(); ++count) {
        journal.update({poses.begin(), poses.begin() + count});
        if (::write(pipe[1], &count, sizeof(count)) != sizeof(count)) break;
      }
      for (;;) ::pause();
    } catch (...) {
    }
    ::_exit(1);
  }
  ::close(pipe[1]);
  std::uint32_t count = 0;
  while (count < 200 && ::read(pipe[0], &count, sizeof(count)) == sizeof(count)) continue;
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  while (::read(pipe[0], &count, sizeof(count)) == sizeof(count)) continue;
  ::close(pipe[0]);
  const std::vector<Pose> found = recoverJournal(path_).poses;
  ASSERT_GE(found.size(), count);
  ASSERT_LE(found.size(), count + 1u) << "one more whose writing was done and not told";
  expectSame(found, {poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(found.size())});
}

}  // namespace hlodbench
