#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "hlod/core/error.h"
#include "metrics/text_file.h"
#include "session.h"
#include "session_writer.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class SessionFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::path(::testing::TempDir()) / (std::string("hlodbench_") + info->name() + ".json");
  }
  void TearDown() override { fs::remove(path_); }

  [[nodiscard]] Session read(const std::string& text) const {
    std::ofstream(path_) << text;
    return readSession(path_);
  }
  [[nodiscard]] std::string readError(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_EQ(what.rfind(path_.string() + ": ", 0), 0u) << what;
      return what;
    }
    ADD_FAILURE() << "was read: " << text;
    return "";
  }

  fs::path path_;
};

const json kGood = {
    {"version", 1},           {"name", "walk"},
    {"viewport", {640, 480}}, {"fovy_rad", 0.87},
    {"near", 0.02},           {"far", 100},
    {"up", {0, 1, 0}},        {"time_step_s", 0.0333},
    {"made", "by hand"},      {"frames", {{1, 2, 3, 0, 0, 0, 1}, {4, 5, 6, 0, 0.6, 0, 0.8}}}};

}  // namespace

TEST_F(SessionFile, ReadsLensAndPoses) {
  const Session session = read(kGood.dump());
  EXPECT_EQ(session.name, "walk");
  EXPECT_EQ(session.lens.width, 640);
  EXPECT_EQ(session.lens.height, 480);
  EXPECT_EQ(session.lens.fovyRad, 0.87);
  EXPECT_EQ(session.lens.nearPlane, 0.02);
  EXPECT_EQ(session.lens.farPlane, 100.0);
  ASSERT_EQ(session.poses.size(), 2u);
  EXPECT_EQ(session.poses[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(session.poses[1].orientation.y, 0.6);
  EXPECT_EQ(session.poses[1].orientation.w, 0.8);
}

TEST_F(SessionFile, TheCameraLooksAlongMinusZ) {
  json session = kGood;
  const double half = std::sqrt(0.5);
  session["frames"] = {{0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, half, 0, half}};
  const Session read_ = read(session.dump());
  const glm::dvec3 ahead = makeCamera(read_.lens, read_.poses[0]).forward();
  EXPECT_NEAR(glm::distance(ahead, glm::dvec3(0, 0, -1)), 0.0, 1e-12);
  // A quarter turn about y, counter-clockwise seen from above: to the left.
  const glm::dvec3 left = makeCamera(read_.lens, read_.poses[1]).forward();
  EXPECT_NEAR(glm::distance(left, glm::dvec3(-1, 0, 0)), 0.0, 1e-12);
}

TEST_F(SessionFile, NormalisesQuaternionsThatAreNearlyUnit) {
  for (const double length : {0.9991, 1.0, 1.0009}) {
    json session = kGood;
    session["frames"][0] = {1, 2, 3, 0.6 * length, 0, 0, -0.8 * length};
    EXPECT_NEAR(glm::length(read(session.dump()).poses[0].orientation), 1.0, 1e-15);
  }
}

TEST_F(SessionFile, TakesRemarksAsOptional) {
  json session = kGood;
  for (const char* key : {"up", "time_step_s", "made"}) session.erase(key);
  const Session without = read(session.dump());
  EXPECT_EQ(without.poses.size(), 2u);
  EXPECT_FALSE(without.up);
  EXPECT_FALSE(without.scene);
  EXPECT_EQ(without.timeStep, 0.0);
  EXPECT_EQ(without.made, "");
}

TEST_F(SessionFile, KeepsRemarks) {
  json session = kGood;
  session["up"] = {0, 0, 2};
  session["scene"] = {{"name", "bunny"}, {"hash", "0123456789abcdef"}};
  const Session with = read(session.dump());
  EXPECT_EQ(with.up, glm::dvec3(0, 0, 2));
  EXPECT_EQ(with.timeStep, 0.0333);
  EXPECT_EQ(with.made, "by hand");
  ASSERT_TRUE(with.scene);
  EXPECT_EQ(with.scene->name, "bunny");
  EXPECT_EQ(with.scene->hash, "0123456789abcdef");
}

TEST_F(SessionFile, NamesThePlaceOfEachFault) {
  const std::string unit = "/frames/1: expected a quaternion (the last 4 numbers) of length 1";
  const std::vector<std::tuple<std::string, json, std::string>> cases{
      {"/version", 3, "/version: expected 1, found 3"},
      {"/version", "1", "/version: expected 1, found \"1\""},
      {"/name", 5, "/name: expected a text that is not empty, found 5"},
      {"/viewport", {640}, "/viewport: expected an array of 2 entries"},
      {"/viewport/0", 0, "/viewport/0: expected a whole number from 1 to 16384, found 0"},
      {"/viewport/1", 16385, "/viewport/1: expected a whole number from 1 to 16384, found 16385"},
      {"/viewport/1", 480.5, "/viewport/1: expected a whole number"},
      {"/fovy_rad", 0, "/fovy_rad: expected a number of radians above 0 and below pi, found 0"},
      {"/fovy_rad", 50, "/fovy_rad: expected a number of radians above 0 and below pi, found 50"},
      {"/near", 0, "/near: expected a number above 0, found 0"},
      {"/far", 0.02, "/far: expected a number above /near, which is 0.02, found 0.02"},
      {"/up", {0, 0, 0}, "/up: expected a direction that is not 0 0 0"},
      {"/time_step_s", -1, "/time_step_s: expected a number above 0, found -1"},
      {"/scene", "bunny", "/scene: expected an object, found \"bunny\""},
      {"/scene", {{"name", "a"}}, "/scene: the key \"hash\" is missing"},
      {"/scene",
       {{"name", "a"}, {"hash", "0123456789ABCDEF"}},
       "/scene/hash: expected 16 hex digits in lower case, found \"0123456789ABCDEF\""},
      {"/scene", {{"name", "a"}, {"hash", "0123"}}, "/scene/hash: expected 16 hex digits"},
      {"/made", "", "/made: expected a text that is not empty"},
      {"/fps", 30, "/fps: unknown key; known are version, name"},
      {"/frames", json::array(), "/frames: expected an array of 1 or more entries, found []"},
      {"/frames/1", {1, 2, 3}, "/frames/1: expected an array of 7 entries, found [1,2,3]"},
      {"/frames/1/2", nullptr, "/frames/1/2: expected a number, found null"},
      {"/frames/1", {1, 2, 3, 0, 0, 0, 0}, unit + ", found 0"},
      {"/frames/1", {1, 2, 3, 0, 0, 0, 1.0011}, unit + ", found 1.0011"},
      {"/frames/1", {1, 2, 3, 0, 0, 0, 0.9989}, unit + ", found 0.9989"},
      {"/frames/1", {1, 2, 3, 1e200, 0, 0, 1e200}, unit + ", found inf"}};
  for (const auto& [pointer, value, message] : cases) {
    json session = kGood;
    session[json::json_pointer(pointer)] = value;
    EXPECT_THAT(readError(session.dump()), HasSubstr(message)) << pointer;
  }
  for (const char* key : {"version", "name", "viewport", "fovy_rad", "near", "far", "frames"}) {
    json session = kGood;
    session.erase(key);
    EXPECT_THAT(readError(session.dump()),
                HasSubstr(std::string("/: the key \"") + key + "\" is missing"));
  }
}

TEST_F(SessionFile, RefusesWhatIsNoJson) {
  EXPECT_THAT(readError("{"), HasSubstr("expected JSON: parse error at line 1"));
  std::string infinite = kGood.dump();
  infinite.replace(infinite.find("0.87"), 4, "1e999");
  EXPECT_THAT(readError(infinite), HasSubstr("expected JSON: number overflow"));
  EXPECT_THROW(readSession(path_ / "none"), InputError);
  EXPECT_THROW(readSession(fs::temp_directory_path()), InputError);
}

TEST_F(SessionFile, ReadsTenThousandFrames) {
  json session = kGood;
  session["frames"] = std::vector<json>(10'000, {0.123456789, 1.6, -3.25, 0, 0.6, 0, 0.8});
  EXPECT_EQ(read(session.dump()).poses.size(), 10'000u);
}

// Writing

TEST_F(SessionFile, IsLaidOutAsTheShippedOnes) {
  Session session;
  session.name = "walk \"1\"";
  session.scene = {"bunny", "0123456789abcdef"};
  session.lens = {640, 480, 0.87, 0.02, 100.0};
  session.up = {0.0, 1.0, 0.0};
  session.timeStep = 1.0 / 30.0;
  session.made = "by hand";
  session.poses = {{{0.1, -2.5, 3.0}, {0.8, 0.0, 0.6, 0.0}},
                   {{1e-9, 1e9, 0.0}, {1.0, 0.0, 0.0, -0.0}}};
  writeSession(path_, session);
  EXPECT_EQ(readTextFile(path_), R"({
  "version": 1,
  "name": "walk \"1\"",
  "scene": {"name": "bunny", "hash": "0123456789abcdef"},
  "viewport": [640, 480],
  "fovy_rad": 0.87,
  "near": 0.02,
  "far": 100.0,
  "up": [0.0, 1.0, 0.0],
  "time_step_s": 0.03333333333333333,
  "made": "by hand",
  "frames": [
    [0.1, -2.5, 3.0, 0.0, 0.6, 0.0, 0.8],
    [1e-09, 1000000000.0, 0.0, 0.0, 0.0, -0.0, 1.0]
  ]
}
)");
}

TEST_F(SessionFile, ComesBackAsItWasWritten) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round) {
    Session session;
    session.name = "round " + std::to_string(round) + " \xc3\xa4\n\"";
    session.lens = {1 + round, 16384 - round, 0.1 + 0.1 * round, std::exp(normal(random)), 1e5};
    if (round % 2 == 1) session.scene = {session.name, "00000000000000ff"};
    if (round % 3 == 1) session.up = {normal(random), normal(random), normal(random)};
    if (round % 4 == 1) session.timeStep = std::exp(normal(random));
    if (round % 5 == 1) session.made = "somehow";
    for (int i = 0; i <= 10 * round; ++i)
      session.poses.push_back(
          {{std::exp(9 * normal(random)), normal(random), -std::exp(-9 * normal(random))},
           glm::normalize(
               glm::dquat(normal(random), normal(random), normal(random), normal(random)))});
    writeSession(path_, session);
    const Session back = readSession(path_);
    EXPECT_EQ(back.name, session.name);
    EXPECT_EQ(back.lens.width, session.lens.width);
    EXPECT_EQ(back.lens.height, session.lens.height);
    EXPECT_EQ(back.lens.fovyRad, session.lens.fovyRad);
    EXPECT_EQ(back.lens.nearPlane, session.lens.nearPlane);
    EXPECT_EQ(back.lens.farPlane, session.lens.farPlane);
    EXPECT_EQ(back.up, session.up);
    EXPECT_EQ(back.timeStep, session.timeStep);
    EXPECT_EQ(back.made, session.made);
    ASSERT_EQ(back.scene.has_value(), session.scene.has_value());
    if (back.scene) {
      EXPECT_EQ(back.scene->name, session.scene->name);
      EXPECT_EQ(back.scene->hash, session.scene->hash);
    }
    ASSERT_EQ(back.poses.size(), session.poses.size());
    for (std::size_t i = 0; i < back.poses.size(); ++i) {
      EXPECT_EQ(back.poses[i].position, session.poses[i].position);
      EXPECT_EQ(back.poses[i].orientation, session.poses[i].orientation);
    }
  }
}

TEST_F(SessionFile, IsThereWholeOrNotAtAll) {
  Session session;
  session.name = "walk";
  session.poses.resize(3);
  EXPECT_THROW(writeSession(path_ / "no" / "folder.json", session), InputError);
  EXPECT_FALSE(fs::exists(path_));
}

TEST(OtherScene, IsNamedWithBothHashes) {
  Session session;
  session.name = "walk";
  EXPECT_EQ(describeOtherScene(session, "courtyard", 1), "");
  session.scene = {"courtyard", "00000000000000ab"};
  EXPECT_EQ(describeOtherScene(session, "whatever its name", 0xab), "");
  EXPECT_EQ(describeOtherScene(session, "bunny", 0xabcdef0123456789),
            "the session 'walk' was recorded in scene 'courtyard' (00000000000000ab), "
            "this is 'bunny' (abcdef0123456789)");
}

}  // namespace hlodbench
