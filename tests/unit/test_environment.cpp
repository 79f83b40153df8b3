#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <regex>

#include "metrics/environment.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A made-up system to read, gone with the test.
class FakeSystem {
 public:
  FakeSystem() : root_(fs::temp_directory_path() / fmt::format("hlodbench-env-{}", ::getpid())) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~FakeSystem() { fs::remove_all(root_); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  [[nodiscard]] const fs::path& root() const { return root_; }

 private:
  fs::path root_;
};

// A machine there is nothing to say against.
Environment makeQuiet() {
  Environment environment;
  environment.buildType = "Release";
  environment.cpuCores = 8;
  environment.cpuGovernor = "performance";
  environment.loadAverage = {0.2, 5.0, 9.0};
  environment.gl.renderer = "NVIDIA GeForce RTX 3080/PCIe/SSE2";
  return environment;
}

}  // namespace

TEST(Environment, ReadsWhatTheSystemTells) {
  const FakeSystem system;
  system.write("proc/cpuinfo", "processor\t: 0\nmodel name\t: Fast CPU @ 3.0: GHz\n");
  system.write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "schedutil\n");
  system.write("etc/os-release", "NAME=\"X\"\nPRETTY_NAME=\"Some Linux 12\"\n");
  system.write("proc/loadavg", "0.52 0.58 10.59 1/389 12345\n");
  const Environment environment =
      readEnvironment({"hlodbench", "run"}, {"vendor", "renderer", "4.5"}, system.root());
  EXPECT_EQ(environment.cpuModel, "Fast CPU @ 3.0: GHz");
  EXPECT_EQ(environment.cpuGovernor, "schedutil");
  EXPECT_EQ(environment.distribution, "Some Linux 12");
  ASSERT_TRUE(environment.loadAverage);
  EXPECT_THAT(*environment.loadAverage, ElementsAre(0.52, 0.58, 10.59));
  EXPECT_THAT(environment.arguments, ElementsAre("hlodbench", "run"));
  EXPECT_EQ(environment.gl.renderer, "renderer");
}

TEST(Environment, LeavesAbsentWhatIsNotThereOrEmpty) {
  const FakeSystem system;
  system.write("proc/loadavg", "busy\n");
  system.write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "\n");
  const Environment environment = readEnvironment({}, {}, system.root());
  EXPECT_FALSE(environment.cpuModel);
  EXPECT_FALSE(environment.cpuGovernor);
  EXPECT_FALSE(environment.distribution);
  EXPECT_FALSE(environment.loadAverage);
}

TEST(Environment, KnowsItsBuildAndTheTime) {
  const Environment environment = readEnvironment({}, {});
  EXPECT_TRUE(std::regex_match(environment.program, std::regex("hlodbench \\d+\\.\\d+\\.\\d+")));
  EXPECT_TRUE(std::regex_match(environment.compiler, std::regex("(GCC|Clang) \\d+\\.\\d+\\.\\d+")));
  EXPECT_TRUE(std::regex_match(
      environment.timeUtc, std::regex("20\\d\\d-[01]\\d-[0-3]\\dT[0-2]\\d:[0-5]\\d:[0-5]\\dZ")));
  EXPECT_THAT(environment.buildType, testing::Not(IsEmpty()));
  EXPECT_THAT(environment.kernel, testing::Not(IsEmpty()));
  if (environment.gitRevision) {
    EXPECT_TRUE(std::regex_match(*environment.gitRevision, std::regex("[0-9a-f]{12,40}(-dirty)?")));
  }
}

TEST(SoftwareRenderer, IsToldFromAGpu) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer",
                           "SWR (LLVM 12.0)", "Mesa DRI swrast", "Google SwiftShader"})
    EXPECT_TRUE(isSoftwareRenderer(name)) << name;
  for (const char* name : {"NVIDIA GeForce RTX 3080/PCIe/SSE2", "AMD Radeon RX 6800 (navi21)",
                           "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "zink (ANSWR 1)", ""})
    EXPECT_FALSE(isSoftwareRenderer(name)) << name;
}

TEST(Warnings, AreNoneOnAQuietMachine) {
  EXPECT_THAT(computeWarnings(makeQuiet()), IsEmpty());
  Environment unknown = makeQuiet();
  unknown.cpuGovernor.reset();  // what is not known is not warned of
  unknown.loadAverage.reset();
  unknown.gl = {};
  EXPECT_THAT(computeWarnings(unknown), IsEmpty());
  unknown.buildType = "RelWithDebInfo";
  EXPECT_THAT(computeWarnings(unknown), IsEmpty());
}

TEST(Warnings, NameOneConditionEach) {
  Environment environment = makeQuiet();
  environment.buildType = "Debug";
  EXPECT_THAT(computeWarnings(environment), ElementsAre(HasSubstr("\"Debug\"")));
  environment = makeQuiet();
  environment.buildType = "none";
  EXPECT_THAT(computeWarnings(environment), ElementsAre(HasSubstr("\"none\"")));
  environment = makeQuiet();
  environment.buildType = "Release+sanitizers";
  EXPECT_THAT(computeWarnings(environment), ElementsAre(HasSubstr("sanitizers")));
  environment = makeQuiet();
  environment.gl.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  EXPECT_THAT(computeWarnings(environment), ElementsAre(HasSubstr("software rasteriser")));
  environment = makeQuiet();
  environment.cpuGovernor = "powersave";
  EXPECT_THAT(computeWarnings(environment), ElementsAre(HasSubstr("\"powersave\"")));
  environment = makeQuiet();
  environment.loadAverage = {4.01, 0.0, 0.0};
  EXPECT_THAT(computeWarnings(environment), ElementsAre(HasSubstr("4.01 on 8 cores")));
}

}  // namespace hlodbench
