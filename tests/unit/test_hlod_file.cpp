#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/core/error.h"
#include "hlod/tree/hlod_file.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;

class HlodFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("hlod_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    TriangleMesh mesh = testing::bumpySphere(40);
    testing::addBumpySphere(mesh, 20, glm::vec3(6.0f, 0.0f, 0.0f), 1.0f, 1);
    mesh.objectTable[1] = {"a name of its own", {0.1f, 0.2f, 0.3f}};
    BuildOptions options;
    options.maxTriangles = 100;
    BuildReport report;
    tree_ = buildHierarchy(mesh, options, report);
    info_.sceneHash = 0x0123456789abcdefull;
    info_.options = canonicalOptions(options);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path path() const { return folder_ / "tree.hlod"; }

  [[nodiscard]] std::string bytes() const {
    std::ifstream in(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void setBytes(const std::string& content) const {
    std::ofstream(path(), std::ios::binary).write(content.data(), std::ssize(content));
  }
  [[nodiscard]] std::size_t filesInFolder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
  Hierarchy tree_;
  HlodFileInfo info_;
};

// The message of the InputError that fn throws; it must name the file and be one line.
template <typename Fn>
std::string messageOf(const fs::path& path, Fn&& fn) {
  try {
    fn();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(path.string()), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }
  return "no error";
}

#define EXPECT_REASON(fn, reason)                                           \
  EXPECT_NE(messageOf(path(), [&] { fn; }).find(reason), std::string::npos) \
      << messageOf(path(), [&] { fn; })

TEST_F(HlodFile, GivesBackWhatWasWritten) {
  writeHlodFile(path(), tree_, info_);
  EXPECT_EQ(filesInFolder(), 1u);
  HlodFileInfo info;
  const Hierarchy back = readHlodFile(path(), &info);
  EXPECT_EQ(validate(back), "");
  EXPECT_EQ(back.inputTriangles, tree_.inputTriangles);
  EXPECT_EQ(back.indices, tree_.indices);
  ASSERT_EQ(back.vertices.size(), tree_.vertices.size());
  EXPECT_EQ(std::memcmp(back.vertices.data(), tree_.vertices.data(),
                        back.vertices.size() * sizeof(Vertex)),
            0);
  ASSERT_EQ(back.nodes.size(), tree_.nodes.size());
  for (std::size_t i = 0; i < back.nodes.size(); ++i) {
    const Node& a = back.nodes[i];
    const Node& b = tree_.nodes[i];
    EXPECT_EQ(a.box.min, b.box.min);
    EXPECT_EQ(a.box.max, b.box.max);
    EXPECT_EQ(a.error, b.error);
    EXPECT_EQ(a.parent, b.parent);
    EXPECT_EQ(a.firstChild, b.firstChild);
    EXPECT_EQ(a.childCount, b.childCount);
    EXPECT_EQ(a.level, b.level);
    EXPECT_EQ(a.firstVertex, b.firstVertex);
    EXPECT_EQ(a.vertexCount, b.vertexCount);
    EXPECT_EQ(a.firstIndex, b.firstIndex);
    EXPECT_EQ(a.indexCount, b.indexCount);
  }
  ASSERT_EQ(back.objects.size(), 2u);
  EXPECT_EQ(back.objects[1].name, "a name of its own");
  EXPECT_EQ(back.objects[1].color, tree_.objects[1].color);
  for (const HlodFileInfo& read : {info, readHlodFileInfo(path())}) {
    EXPECT_EQ(read.sceneHash, info_.sceneHash);
    EXPECT_EQ(read.options, info_.options);
    EXPECT_EQ(read.version, kHlodFileVersion);
    EXPECT_EQ(read.contentHash, info_.contentHash);
    EXPECT_NE(read.contentHash, 0u);
  }
}

TEST_F(HlodFile, EqualHierarchiesMakeEqualBytesAndOthersAnotherHash) {
  writeHlodFile(path(), tree_, info_);
  const std::string first = bytes();
  const std::uint64_t hash = info_.contentHash;
  writeHlodFile(path(), tree_, info_);
  EXPECT_EQ(bytes(), first);
  tree_.nodes[0].error *= 2.0f;
  writeHlodFile(path(), tree_, info_);
  EXPECT_NE(info_.contentHash, hash);
}

TEST_F(HlodFile, EveryFlippedByteIsFound) {
  writeHlodFile(path(), tree_, info_);
  const std::string good = bytes();
  const std::size_t header = 88 + info_.options.size();
  for (std::size_t at = 0; at < good.size(); at += at < header + 200 ? 1 : 1009) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    setBytes(bad);
    EXPECT_NE(messageOf(path(), [&] { readHlodFile(path()); }), "no error") << "byte " << at;
    if (at < header) {
      EXPECT_NE(messageOf(path(), [&] { readHlodFileInfo(path()); }), "no error") << "byte " << at;
    }
  }
}

TEST_F(HlodFile, SaysWhatIsWrong) {
  EXPECT_REASON(readHlodFile(path()), "No such file");
  EXPECT_REASON(readHlodFileInfo(path()), "No such file");
  writeHlodFile(path(), tree_, info_);
  const std::string good = bytes();
  setBytes("");
  EXPECT_REASON(readHlodFile(path()), "not a hierarchy file");
  setBytes("ply\n" + good);
  EXPECT_REASON(readHlodFile(path()), "not a hierarchy file");
  std::string other = good;
  other[8] = 77;
  setBytes(other);
  EXPECT_REASON(readHlodFile(path()), "expected format version 1, found 77");
  setBytes(good + "x");
  EXPECT_REASON(readHlodFileInfo(path()), "bytes, found");
  for (const std::size_t size : {1ul, 87ul, 88ul, 120ul, good.size() / 2, good.size() - 1}) {
    setBytes(good.substr(0, size));
    EXPECT_NE(messageOf(path(), [&] { readHlodFile(path()); }), "no error") << size;
    EXPECT_NE(messageOf(path(), [&] { readHlodFileInfo(path()); }), "no error") << size;
  }
  // Counts that would overflow, or ask for more memory than there is.
  for (const std::size_t field : {48u, 56u, 64u, 72u, 80u}) {
    std::string huge = good;
    huge.replace(field, 8, 8, '\xff');
    setBytes(huge);
    EXPECT_NE(messageOf(path(), [&] { readHlodFile(path()); }), "no error") << field;
  }
  fs::remove(path());
  fs::create_directory(path());
  EXPECT_REASON(readHlodFile(path()), "not a file");
}

TEST_F(HlodFile, AFailedWriteLeavesTheOldFileAndNothingElse) {
  writeHlodFile(path(), tree_, info_);
  const std::string good = bytes();
  // A limit on file sizes fails a write in its middle, as a full disk does.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{good.size() / 2, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  tree_.nodes[0].error *= 2.0f;
  const std::string message = messageOf(path(), [&] { writeHlodFile(path(), tree_, info_); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, oldHandler);
  EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
  EXPECT_EQ(filesInFolder(), 1u);
  EXPECT_EQ(bytes(), good);
}

TEST_F(HlodFile, AMissingFolderOrAFolderInTheWayIsReported) {
  const fs::path missing = folder_ / "none" / "tree.hlod";
  EXPECT_NE(messageOf(missing, [&] { writeHlodFile(missing, tree_, info_); }).find("No such file"),
            std::string::npos);
  fs::create_directories(path() / "full");
  EXPECT_REASON(writeHlodFile(path(), tree_, info_), "cannot be written");
  EXPECT_EQ(filesInFolder(), 1u);
}

}  // namespace
}  // namespace hlodbench
