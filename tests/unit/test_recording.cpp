#include "view/recording.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace hlodbench {
namespace {

// Told apart by a number.
std::vector<Pose> makePoses(int first, int count) {
  std::vector<Pose> poses(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) poses[static_cast<std::size_t>(i)].position.x = first + i;
  return poses;
}

std::vector<int> number(const std::vector<Pose>& poses) {
  std::vector<int> numbers;
  for (const Pose& pose : poses) numbers.push_back(static_cast<int>(pose.position.x));
  return numbers;
}

// Keeps a copy of everything before each step of undo.
struct Model {
  std::vector<int> now;
  std::vector<std::vector<int>> before;
  bool isInStretch = false;

  void append(int first, int count) {
    if (count == 0) return;
    if (!isInStretch) before.push_back(now);
    isInStretch = true;
    for (int i = 0; i < count; ++i) now.push_back(first + i);
  }
  void cutAfter(std::size_t frame) {
    if (frame + 1 >= now.size()) return;
    before.push_back(now);
    now.resize(frame + 1);
    isInStretch = false;
  }
  void undo() {
    if (!before.empty()) {
      now = before.back();
      before.pop_back();
    }
    isInStretch = false;
  }
};

}  // namespace

TEST(Recording, UndoRestoresWhatWasThere) {
  std::mt19937 random(3);
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (int round = 0; round < 300; ++round) {
    Recording recording(0.02);
    Model model;
    int next = 0;
    for (int i = 0; i < 60; ++i) {
      switch (below(6)) {
        case 0:
          recording.beginStretch();
          model.isInStretch = false;
          break;
        case 1:
        case 2:
        case 3: {
          const int count = static_cast<int>(below(5));
          recording.append(makePoses(next, count));
          model.append(next, count);
          next += count;
          break;
        }
        case 4: {
          const std::size_t frame = below(model.now.size() + 2);
          recording.cutAfter(frame);
          model.cutAfter(frame);
          break;
        }
        default:
          recording.undo();
          model.undo();
      }
      ASSERT_EQ(number(recording.poses()), model.now);
      ASSERT_EQ(recording.canUndo(), !model.before.empty());
      ASSERT_EQ(recording.empty(), model.now.empty());
    }
    while (recording.canUndo()) {
      recording.undo();
      model.undo();
      ASSERT_EQ(number(recording.poses()), model.now);
    }
    EXPECT_TRUE(recording.empty()) << "without any step nothing is recorded";
  }
}

TEST(Recording, AStretchIsOneStepHoweverItCame) {
  Recording recording(0.02);
  EXPECT_EQ(recording.step(), 0.02);
  EXPECT_FALSE(recording.canUndo());
  recording.beginStretch();
  EXPECT_FALSE(recording.canUndo()) << "there is nothing in it";
  for (int i = 0; i < 10; ++i) recording.append(makePoses(i, 1));
  recording.beginStretch();
  for (int i = 10; i < 20; ++i) recording.append(makePoses(i, 1));
  recording.undo();
  EXPECT_EQ(recording.poses().size(), 10u);
  recording.undo();
  EXPECT_TRUE(recording.empty());
  recording.undo();
  EXPECT_TRUE(recording.empty());
}

TEST(Recording, ACutAtTheEndIsNoStep) {
  Recording recording(0.02);
  recording.cutAfter(0);
  recording.append(makePoses(0, 5));
  for (const std::size_t frame : {std::size_t{4}, std::size_t{5}, ~std::size_t{0}})
    recording.cutAfter(frame);
  recording.undo();
  EXPECT_TRUE(recording.empty());
}

}  // namespace hlodbench
