#include "view/session_player.h"

#include <gtest/gtest.h>

#include <random>

namespace hlodbench {
namespace {

Session makeSession(int frames, double timeStep) {
  Session session;
  session.timeStep = timeStep;
  session.poses.resize(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) session.poses[static_cast<std::size_t>(i)].position.x = i;
  return session;
}

}  // namespace

TEST(SessionPlayer, ShowsEveryFrameOnceHoweverLongTheyTake) {
  SessionPlayer player;
  player.load(makeSession(20, 0.1));
  EXPECT_EQ(player.frame(), 0u);
  player.play(true);
  for (std::size_t i = 1; i < 20; ++i) {
    EXPECT_TRUE(player.isPlaying());
    player.advance(i % 2 == 0 ? 0.001 : 3.0);
    EXPECT_EQ(player.frame(), i);
    EXPECT_EQ(player.pose().position.x, static_cast<double>(i));
  }
  EXPECT_FALSE(player.isPlaying());
  player.advance(1.0);
  EXPECT_EQ(player.frame(), 19u);
  player.play(true);  // from the end: again
  EXPECT_EQ(player.frame(), 0u);
}

TEST(SessionPlayer, KeepsTheSessionsTimeWhereFramesMayBeLeftOut) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> seconds(0.0, 0.4);
  SessionPlayer player;
  player.everyFrame = false;
  player.load(makeSession(1000, 0.125));
  player.play(true);
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double step = seconds(random);
    sum += step;
    player.advance(step);
    EXPECT_NEAR(static_cast<double>(player.frame()), sum / 0.125, 1.0 + 1e-9);
  }
}

TEST(SessionPlayer, StepsWithinTheSessionAndStops) {
  SessionPlayer player;
  player.load(makeSession(5, 0.0));
  player.play(true);
  player.step(-1);
  EXPECT_EQ(player.frame(), 0u);
  EXPECT_FALSE(player.isPlaying());
  player.step(3);
  EXPECT_EQ(player.frame(), 3u);
  player.step(7);
  EXPECT_EQ(player.frame(), 4u);
  player.seek(99);
  EXPECT_EQ(player.frame(), 4u);
  player.clear();
  EXPECT_TRUE(player.empty());
}

}  // namespace hlodbench
