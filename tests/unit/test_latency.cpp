#include <gtest/gtest.h>

#include "hlod/core/error.h"
#include "hlod/query/fixed_latency_query_source.h"
#include "hlod/query/scripted_query_source.h"
#include "latency.h"

namespace hlodbench {
namespace {

TEST(FixedLatency, CountsDraws) {
  ScriptedQuerySource results([](NodeId n) { return n * 10; }, 3);
  FixedLatencyQuerySource source(results, FixedLatencyQuerySource::Unit::kDraws, 2, 3);
  source.beginFrame();
  source.issue(1);
  EXPECT_FALSE(source.isAvailable(1));
  source.noteDraw();
  EXPECT_FALSE(source.isAvailable(1));
  source.issue(2);
  source.noteDraw();
  EXPECT_TRUE(source.isAvailable(1));
  EXPECT_FALSE(source.isAvailable(2));
  EXPECT_EQ(source.getResult(2), 20u) << "waiting is allowed";
}

TEST(FixedLatency, CountsFrames) {
  ScriptedQuerySource results([](NodeId) { return 1; }, 1);
  FixedLatencyQuerySource none(results, FixedLatencyQuerySource::Unit::kFrames, 0, 1);
  none.beginFrame();
  none.issue(0);
  EXPECT_TRUE(none.isAvailable(0));
  FixedLatencyQuerySource one(results, FixedLatencyQuerySource::Unit::kFrames, 1, 1);
  one.beginFrame();
  one.issue(0);
  one.noteDraw();
  EXPECT_FALSE(one.isAvailable(0));
  one.beginFrame();
  EXPECT_TRUE(one.isAvailable(0));
}

TEST(Latency, ReadsWhatItPrints) {
  for (const char* text : {"gl", "frames:0", "frames:3", "draws:1000"})
    EXPECT_EQ(parseLatency(text).toString(), text);
}

TEST(Latency, RefusesEverythingElse) {
  for (const char* text : {"", "frames", "frames:", "draws:-1", "draws:1.5", "draws:2x", "ms:3",
                           "draws:99999999999", "gl:1"})
    EXPECT_THROW(parseLatency(text), InputError) << text;
}

}  // namespace
}  // namespace hlodbench
