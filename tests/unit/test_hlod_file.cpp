#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <numeric>
#include <random>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/core/error.h"
#include "hlod/tree/hlod_writer.h"
#include "hlod/tree/memory_sink.h"
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

void checkAll(const Hierarchy& hierarchy) {
  for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) checkGeometryHash(hierarchy, id);
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
  const auto read = back.geometry.bytes();
  const auto written = tree_.geometry.bytes();
  EXPECT_TRUE(std::equal(read.begin(), read.end(), written.begin(), written.end()));
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
    EXPECT_EQ(a.geometryOffset, b.geometryOffset);
    EXPECT_EQ(a.geometryHash, b.geometryHash);
    EXPECT_EQ(a.flags, b.flags);
    EXPECT_EQ(a.vertexCount, b.vertexCount);
    EXPECT_EQ(a.indexCount, b.indexCount);
  }
  ASSERT_EQ(back.objects.size(), 2u);
  EXPECT_EQ(back.objects[1].name, "a name of its own");
  EXPECT_EQ(back.objects[1].color, tree_.objects[1].color);
  for (const HlodFileInfo& found : {info, readHlodFileInfo(path())}) {
    EXPECT_EQ(found.sceneHash, info_.sceneHash);
    EXPECT_EQ(found.options, info_.options);
    EXPECT_EQ(found.version, kHlodFileVersion);
    EXPECT_EQ(found.contentHash, info_.contentHash);
    EXPECT_NE(found.contentHash, 0u);
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
  const std::size_t header = 128;
  const std::size_t tables = header + tree_.geometry.bytes().size();
  for (std::size_t at = 0; at < good.size();
       at += at < header + 32 || at > good.size() - 200 ? 1 : 1009) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    setBytes(bad);
    const std::string opening = messageOf(path(), [&] { readHlodFile(path()); });
    if (at >= header && at < tables) {
      // opening does not look at the geometry
      EXPECT_EQ(opening, "no error") << "byte " << at;
      EXPECT_NE(messageOf(path(), [&] { checkAll(readHlodFile(path())); }).find("node "),
                std::string::npos)
          << "byte " << at;
    } else {
      EXPECT_NE(opening, "no error") << "byte " << at;
    }
    if (at < header || at >= good.size() - info_.options.size()) {
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
  EXPECT_REASON(readHlodFile(path()), "expected format version 2, found 77");
  setBytes(good + "x");
  EXPECT_REASON(readHlodFileInfo(path()), "bytes, found");
  for (const std::size_t size : {1ul, 87ul, 88ul, 127ul, 128ul, good.size() / 2, good.size() - 1}) {
    setBytes(good.substr(0, size));
    EXPECT_NE(messageOf(path(), [&] { readHlodFile(path()); }), "no error") << size;
    EXPECT_NE(messageOf(path(), [&] { readHlodFileInfo(path()); }), "no error") << size;
  }
  // Counts that would overflow, or ask for more memory than there is.
  for (std::size_t field = 32; field < 128; field += 8) {
    std::string huge = good;
    huge.replace(field, 8, 8, '\xff');
    setBytes(huge);
    EXPECT_NE(messageOf(path(), [&] { readHlodFile(path()); }), "no error") << field;
  }
  fs::remove(path());
  fs::create_directory(path());
  EXPECT_REASON(readHlodFile(path()), "not a file");
}

TEST_F(HlodFile, StaysReadableWhenItIsReplaced) {
  writeHlodFile(path(), tree_, info_);
  const Hierarchy old = readHlodFile(path());
  tree_.nodes[0].error *= 2.0f;
  writeHlodFile(path(), tree_, info_);
  EXPECT_EQ(validate(old), "");
  EXPECT_NE(old.nodes[0].error, readHlodFile(path()).nodes[0].error);
}

TEST_F(HlodFile, OtherVersionsAreTold) {
  EXPECT_FALSE(isOtherHlodVersion(path()));
  writeHlodFile(path(), tree_, info_);
  EXPECT_FALSE(isOtherHlodVersion(path()));
  std::string other = bytes();
  other[8] = 1;
  setBytes(other);
  EXPECT_TRUE(isOtherHlodVersion(path()));
  setBytes("some notes of mine, no hierarchy");
  EXPECT_FALSE(isOtherHlodVersion(path()));
}

// What leaves the nodes' geometry through a sink, in some order, under some numbers.
void sendTo(NodeSink& sink, const Hierarchy& from, std::span<const NodeId> ids,
            std::span<const NodeId> order) {
  for (const NodeId id : order) {
    const NodeIndices packed = from.indices(from.node(id));
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < packed.size(); ++i) indices.push_back(packed[i]);
    sink.addGeometry(ids.empty() ? id : ids[id], from.vertices(from.node(id)), indices);
  }
}

TEST_F(HlodFile, IsTheSameWhateverOrderAndNumbersTheGeometryComesIn) {
  const auto count = static_cast<NodeId>(tree_.nodes.size());
  std::vector<NodeId> order(count), ids(count);
  std::iota(order.begin(), order.end(), 0u);
  std::iota(ids.begin(), ids.end(), 0u);
  HlodWriter plain(path());
  sendTo(plain, tree_, {}, order);
  Hierarchy tables = tree_;
  for (Node& node : tables.nodes) node.vertexCount = node.indexCount = 0;  // the writer sets them
  plain.finish(tables, info_);
  EXPECT_EQ(filesInFolder(), 1u);
  const std::string expected = bytes();
  EXPECT_EQ(validate(readHlodFile(path())), "");
  std::mt19937 random(1);
  std::shuffle(order.begin(), order.end(), random);
  std::shuffle(ids.begin(), ids.end(), random);
  fs::remove(path());
  HlodWriter mixed(path());
  sendTo(mixed, tree_, ids, order);
  mixed.finish(tables, info_, ids);
  EXPECT_TRUE(bytes() == expected);
  MemorySink memory;
  sendTo(memory, tree_, ids, order);
  memory.finish(tables, ids);
  writeHlodFile(path(), tables, info_);
  EXPECT_TRUE(bytes() == expected);
  EXPECT_EQ(validate(tables), "");
}

TEST_F(HlodFile, AWriterThatIsNotFinishedLeavesNothing) {
  {
    HlodWriter writer(path());
    sendTo(writer, tree_, {}, std::vector<NodeId>{0, 1, 2});
  }
  EXPECT_EQ(filesInFolder(), 0u);
  const fs::path missing = folder_ / "none" / "tree.hlod";
  EXPECT_THROW(HlodWriter{missing}, InputError);
}

using HlodFileDeathTest = HlodFile;

TEST_F(HlodFileDeathTest, CutOffWhileItIsInUseEndsWithOneLine) {
  writeHlodFile(path(), tree_, info_);
  EXPECT_EXIT(
      {
        const Hierarchy mapped = readHlodFile(path());
        fs::resize_file(path(), 4096);
        checkAll(mapped);
      },
      ::testing::ExitedWithCode(2), "^hlodbench: .*tree.hlod: cut off while it was in use\n$");
}

TEST_F(HlodFileDeathTest, OtherBusErrorsGoOnAsByDefault) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer has a handler of its own";
#endif
  writeHlodFile(path(), tree_, info_);
  const Hierarchy mapped = readHlodFile(path());
  EXPECT_EXIT(std::raise(SIGBUS), ::testing::KilledBySignal(SIGBUS), "^$");
  // a mapping that is none of ours
  const fs::path other = folder_ / "other";
  std::ofstream(other) << std::string(100'000, 'x');
  EXPECT_EXIT(
      {
        const int fd = ::open(other.c_str(), O_RDONLY);
        const char* bytes =
            static_cast<const char*>(::mmap(nullptr, 100'000, PROT_READ, MAP_PRIVATE, fd, 0));
        fs::resize_file(other, 0);
        std::exit(bytes[50'000]);
      },
      ::testing::KilledBySignal(SIGBUS), "^$");
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
