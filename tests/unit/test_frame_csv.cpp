#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <clocale>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <locale>
#include <random>

#include "hlod/core/error.h"
#include "metrics/frame_csv.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;

std::string makeHeader() {
  std::string header = "frame,warm_up";
  for (const CounterInfo& info : kCounterTable)
    if (!info.isOptional) header += fmt::format(",{}", info.key);
  return header + "\n";
}

// A folder that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    path_ = fs::temp_directory_path() / fmt::format("hlodbench-csv-{}-{}", ::getpid(), ++count);
    fs::create_directories(path_);
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void expectSame(const FrameRecord& a, const FrameRecord& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.warmUp, b.warmUp);
  for (const CounterInfo& info : kCounterTable) {
    ASSERT_EQ(a.has(info.counter), b.has(info.counter)) << info.key;
    if (!a.has(info.counter)) continue;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.get(info.counter)),
              std::bit_cast<std::uint64_t>(b.get(info.counter)))
        << info.key;
  }
}

std::string parseError(const std::string& text) {
  try {
    parseFrameCsv(text, "log.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Decimal comma and dots between thousands, as in half of Europe; needs no installed locale.
struct CommaNumpunct : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// Sets a C locale with a decimal comma: an installed one, or one compiled into `folder`.
bool setCommaLocale(const fs::path& folder) {
  const std::string compile = fmt::format("localedef -i de_DE -f UTF-8 '{}' >/dev/null 2>&1",
                                          (folder / "de_DE.UTF-8").string());
  for (const bool compiled : {false, true}) {
    if (compiled &&
        (std::system(compile.c_str()) != 0 || ::setenv("LOCPATH", folder.c_str(), 1) != 0))
      return false;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"})
      if (std::setlocale(LC_ALL, name) && std::string(std::localeconv()->decimal_point) == ",")
        return true;
  }
  return false;
}

FrameRecord makeAwkwardFrame() {
  FrameRecord record;
  record.frame = 1234567;
  record.set(Counter::kFrameMs, 1234.5678);
  record.set(Counter::kTriangles, 12345678.0);
  return record;
}

}  // namespace

TEST(FrameCsv, WritesTheHeaderAndLeavesAbsentFieldsEmpty) {
  FrameRecord record;
  record.frame = 3;
  record.warmUp = true;
  record.set(Counter::kDn, 183.0);
  record.set(Counter::kFrameMs, 0.1);
  EXPECT_EQ(formatFrameCsv({record}), makeHeader() + "3,1,183,,,,,,,,,,0.1,,,,,,\n");
  EXPECT_EQ(formatFrameCsv({}), makeHeader());
}

TEST(FrameCsv, HasAColumnOfAnOptionalCounterWhereAFrameHasIt) {
  std::vector<FrameRecord> records(2);
  records[1].frame = 1;
  records[1].set(Counter::kLoads, 7.0);
  std::string header = makeHeader();
  header.insert(header.size() - 1, ",loads");
  EXPECT_EQ(formatFrameCsv(records), header + "0,0,,,,,,,,,,,,,,,,,,\n1,0,,,,,,,,,,,,,,,,,,7\n");
}

TEST(FrameCsv, ReadsBackEveryBitOfWhatItWrote) {
  std::mt19937_64 engine(5);
  std::vector<FrameRecord> records(200);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].frame = static_cast<int>(i);
    records[i].warmUp = engine() % 2 == 0;
    for (const CounterInfo& info : kCounterTable) {
      const double value = std::bit_cast<double>(engine());
      if (engine() % 3 != 0 && std::isfinite(value)) records[i].set(info.counter, value);
    }
  }
  records[0].set(Counter::kDn, -0.0);
  records[0].set(Counter::kD, std::numeric_limits<double>::denorm_min());
  const std::vector<FrameRecord> read = parseFrameCsv(formatFrameCsv(records), "log.csv");
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t i = 0; i < read.size(); ++i) expectSame(read[i], records[i]);
}

TEST(FrameCsv, DoesNotChangeWithTheLocale) {
  const std::string expected = makeHeader() + "1234567,0,,,,,,12345678,,,,,1234.5678,,,,,,\n";
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaNumpunct));
  const std::string text = formatFrameCsv({makeAwkwardFrame()});
  const std::vector<FrameRecord> read = parseFrameCsv(expected, "log.csv");
  std::locale::global(before);
  EXPECT_EQ(text, expected);
  expectSame(read.at(0), makeAwkwardFrame());
}

TEST(FrameCsv, DoesNotChangeWithTheCLocale) {
  const TemporaryFolder folder;
  if (!setCommaLocale(folder.path())) {
    std::setlocale(LC_ALL, "C");
    GTEST_SKIP() << "no locale with a decimal comma is installed and localedef made none";
  }
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", 0.5);
  EXPECT_STREQ(text, "0,5");  // or the locale is not in force and this test tests nothing
  const std::string csv = formatFrameCsv({makeAwkwardFrame()});
  const std::vector<FrameRecord> read = parseFrameCsv(csv, "log.csv");
  std::setlocale(LC_ALL, "C");
  EXPECT_THAT(csv, testing::HasSubstr(",1234.5678,"));
  expectSame(read.at(0), makeAwkwardFrame());
}

TEST(FrameCsv, TakesColumnsInAnyOrderLinesFromWindowsAndNoLastNewline) {
  const std::vector<FrameRecord> read =
      parseFrameCsv("d,warm_up,frame\r\n4.5,0,7\r\n,1,8", "log.csv");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].frame, 7);
  EXPECT_DOUBLE_EQ(read[0].get(Counter::kD), 4.5);
  EXPECT_FALSE(read[0].has(Counter::kDn));
  EXPECT_TRUE(read[1].warmUp);
  EXPECT_FALSE(read[1].has(Counter::kD));
}

TEST(FrameCsv, NamesFileAndLineOfWhatIsWrong) {
  using testing::HasSubstr;
  using testing::StartsWith;
  EXPECT_THAT(parseError(""), StartsWith("log.csv:1: expected a header"));
  EXPECT_THAT(parseError("frame,warm_up,fps\n"), StartsWith("log.csv:1: "));
  EXPECT_THAT(parseError("frame,warm_up,fps\n"), HasSubstr("\"fps\""));
  EXPECT_THAT(parseError("frame,dn\n"), HasSubstr("\"warm_up\", found none"));
  EXPECT_THAT(parseError("frame,warm_up,dn,dn\n"), HasSubstr("\"dn\" again"));
  const std::string header = "frame,warm_up,dn\n0,0,1\n";
  EXPECT_THAT(parseError(header + "1,0\n"), StartsWith("log.csv:3: expected 3 fields, found 2"));
  EXPECT_THAT(parseError(header + "\n"), StartsWith("log.csv:3: expected 3 fields, found 1"));
  EXPECT_THAT(parseError(header + "1,yes,2\n"), StartsWith("log.csv:3: warm_up: expected 0 or 1"));
  EXPECT_THAT(parseError(header + "-1,0,2\n"), StartsWith("log.csv:3: frame: "));
  EXPECT_THAT(parseError(header + "1.5,0,2\n"), StartsWith("log.csv:3: frame: "));
  for (const std::string bad : {"1;5", "nan", "inf", "1e999", "0x10", " 1", "1 ", "--1"})
    EXPECT_THAT(parseError(header + "1,0," + bad + "\n"), StartsWith("log.csv:3: dn: ")) << bad;
  for (const std::string& text : {header + "1,0,x\n", std::string("frame,dn\n")})
    EXPECT_EQ(parseError(text).find('\n'), std::string::npos);
}

TEST(FrameCsv, RefusesToWriteAnInfiniteValue) {
  FrameRecord record;
  record.set(Counter::kDn, std::numeric_limits<double>::infinity());
  EXPECT_THROW(formatFrameCsv({record}), std::invalid_argument);
}

TEST(FrameCsv, LeavesOneFileAndReplacesAnOlderOne) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "bool-0.csv";
  std::ofstream(path) << "something old";
  writeFrameCsv(path, {makeAwkwardFrame()});
  expectSame(readFrameCsv(path).at(0), makeAwkwardFrame());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(FrameCsv, SaysWhichFileCannotBeReadOrWritten) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "missing" / "bool-0.csv";
  EXPECT_THROW(readFrameCsv(path), InputError);
  EXPECT_THROW(readFrameCsv(folder.path()), InputError);
  try {
    writeFrameCsv(path, {});
    FAIL() << "wrote into a folder that is not there";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(path.string() + ": cannot be written"));
  }
}

TEST(TextFile, LeavesNoTemporaryFileWhenItCannotTakeTheName) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "target");
  EXPECT_THROW(writeTextFile(folder.path() / "target", "x"), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

}  // namespace hlodbench
