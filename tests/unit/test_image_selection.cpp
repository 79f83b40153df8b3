#include "image_selection.h"

#include <gmock/gmock.h>

#include <set>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

using testing::ElementsAre;

std::vector<int> select(const std::string& text, int frames = 100, int warmUp = 5,
                        std::uint64_t seed = 1) {
  return selectFrames(parseImageSelection(text), frames, warmUp, seed);
}

TEST(ImageSelection, TakesAllNoneAndLists) {
  EXPECT_THAT(select("none"), ElementsAre());
  EXPECT_THAT(select("0"), ElementsAre());
  EXPECT_THAT(select("all", 4), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(select("30,0,30"), ElementsAre(0, 30));
  EXPECT_THAT(select("7,"), ElementsAre(7));
}

TEST(ImageSelection, TakesMeasuredFramesAtRandom) {
  std::set<int> seen;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<int> frames = select("20", 45, 5, seed);
    ASSERT_EQ(frames.size(), 20u);
    for (std::size_t i = 1; i < frames.size(); ++i) ASSERT_LT(frames[i - 1], frames[i]);
    seen.insert(frames.begin(), frames.end());
  }
  EXPECT_EQ(*seen.begin(), 5);
  EXPECT_EQ(*seen.rbegin(), 44);
  EXPECT_EQ(seen.size(), 40u) << "some measured frame is never taken";
}

TEST(ImageSelection, DependsOnTheSeedAlone) {
  EXPECT_EQ(select("20", 601), select("20", 601));
  EXPECT_NE(select("20", 601, 5, 1), select("20", 601, 5, 2));
  // the same everywhere: results name the seed
  EXPECT_THAT(select("3", 1000, 5, 1), ElementsAre(176, 303, 805));
}

TEST(ImageSelection, TakesNoMoreThanThereAre) {
  EXPECT_THAT(select("20", 8, 5), ElementsAre(5, 6, 7));
}

TEST(ImageSelection, RefusesWhatItCannotRead) {
  for (const char* text : {"some", "-1", "1.5", "1,,2", ",", "1,x", "", "0,120 "})
    EXPECT_THROW(parseImageSelection(text), InputError) << text;
  EXPECT_THROW(select("3,100"), InputError);
}

}  // namespace
}  // namespace hlodbench
