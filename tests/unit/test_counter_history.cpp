#include "view/counter_history.h"

#include <gmock/gmock.h>

#include <cmath>

namespace hlodbench {
namespace {

using ::testing::ElementsAre;

FrameRecord makeRecord(double dn) {
  FrameRecord record;
  record.set(Counter::kDn, dn);
  return record;
}

}  // namespace

TEST(CounterHistory, KeepsTheLastFramesOfEachPane) {
  CounterHistory history;
  const int frames = static_cast<int>(CounterHistory::kFrames) + 30;
  for (int i = 0; i < frames; ++i) history.add(0.02, {makeRecord(i), makeRecord(2 * i)});
  ASSERT_EQ(history.paneCount(), 2u);
  const std::vector<float> values = history.values(1, Counter::kDn);
  ASSERT_EQ(values.size(), CounterHistory::kFrames);
  EXPECT_EQ(values.front(), 2.0f * 30);
  EXPECT_EQ(values.back(), 2.0f * static_cast<float>(frames - 1));
  EXPECT_DOUBLE_EQ(history.mean(0, Counter::kDn), 0.5 * (30 + frames - 1));
}

TEST(CounterHistory, CountsFramesOfTheLastSecond) {
  CounterHistory history;
  EXPECT_EQ(history.framesPerSecond(), 0.0);
  for (int i = 0; i < 5; ++i) history.add(1.0, {makeRecord(1)});
  EXPECT_NEAR(history.framesPerSecond(), 1.0, 1e-9);
  for (int i = 0; i < 100; ++i) history.add(0.04, {makeRecord(1)});
  EXPECT_NEAR(history.framesPerSecond(), 25.0, 0.5);
}

TEST(CounterHistory, LeavesOutWhatIsAbsent) {
  CounterHistory history;
  history.add(0.1, {makeRecord(1)});
  history.add(0.1, {FrameRecord()});
  history.add(0.1, {makeRecord(3)});
  EXPECT_THAT(history.values(0, Counter::kDn), ElementsAre(1.0f, 3.0f));
  EXPECT_DOUBLE_EQ(history.mean(0, Counter::kDn), 2.0);
  EXPECT_TRUE(std::isnan(history.mean(0, Counter::kRarn)));
  // as many panes as there are now
  history.add(0.1, {makeRecord(1), makeRecord(2)});
  EXPECT_THAT(history.values(1, Counter::kDn), ElementsAre(2.0f));
}

}  // namespace hlodbench
