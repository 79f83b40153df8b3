#include "metrics/frame_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <stdexcept>

#include "hlod/core/error.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

constexpr std::string_view kFrameColumn = "frame";
constexpr std::string_view kWarmUpColumn = "warm_up";

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == text.npos ? text.npos : end - begin));
    if (end == text.npos) return parts;
    begin = end + 1;
  }
}

template <typename Number>
bool parseWhole(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

// Reads lines into records; knows which line it is at for its messages.
class Parser {
 public:
  explicit Parser(const std::string& name) : name_(name) {}

  std::vector<FrameRecord> parse(std::string_view text) {
    if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    if (text.empty()) fail("expected a header line, found an empty file");
    std::vector<FrameRecord> records;
    for (std::string_view line : split(text, '\n')) {
      ++line_;
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      if (line_ == 1)
        readHeader(line);
      else
        records.push_back(readRecord(line));
    }
    return records;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", name_, std::max(line_, std::size_t{1}), what));
  }

  void readHeader(std::string_view line) {
    columns_ = split(line, ',');
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string_view column = columns_[i];
      if (std::count(columns_.begin(), columns_.end(), column) > 1)
        fail(fmt::format("expected each column once, found \"{}\" again", column));
      if (column == kFrameColumn || column == kWarmUpColumn) continue;
      if (findCounter(column) == nullptr)
        fail(fmt::format("expected frame, warm_up and counter keys, found column \"{}\"", column));
    }
    for (const std::string_view needed : {kFrameColumn, kWarmUpColumn})
      if (std::count(columns_.begin(), columns_.end(), needed) == 0)
        fail(fmt::format("expected a column \"{}\", found none", needed));
  }

  static const CounterInfo* findCounter(std::string_view key) {
    const auto found = std::find_if(kCounterTable.begin(), kCounterTable.end(),
                                    [&](const CounterInfo& info) { return info.key == key; });
    return found == kCounterTable.end() ? nullptr : &*found;
  }

  FrameRecord readRecord(std::string_view line) const {
    const std::vector<std::string_view> fields = split(line, ',');
    if (fields.size() != columns_.size())
      fail(fmt::format("expected {} fields, found {}", columns_.size(), fields.size()));
    FrameRecord record;
    for (std::size_t i = 0; i < fields.size(); ++i) readField(columns_[i], fields[i], record);
    return record;
  }

  void readField(std::string_view column, std::string_view field, FrameRecord& record) const {
    if (column == kFrameColumn) {
      if (!parseWhole(field, record.frame) || record.frame < 0)
        fail(fmt::format("{}: expected a frame index from 0, found \"{}\"", column, field));
    } else if (column == kWarmUpColumn) {
      if (field != "0" && field != "1")
        fail(fmt::format("{}: expected 0 or 1, found \"{}\"", column, field));
      record.warmUp = field == "1";
    } else if (!field.empty()) {
      double value = 0.0;
      if (!parseWhole(field, value) || !std::isfinite(value))
        fail(fmt::format("{}: expected a finite number or nothing, found \"{}\"", column, field));
      record.set(findCounter(column)->counter, value);
    }
  }

  std::string name_;
  std::size_t line_ = 0;
  std::vector<std::string_view> columns_;
};

}  // namespace

std::string formatFrameCsv(const std::vector<FrameRecord>& records) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{},{}", kFrameColumn, kWarmUpColumn);
  std::vector<CounterInfo> columns;
  for (const CounterInfo& info : kCounterTable)
    if (!info.isOptional || std::any_of(records.begin(), records.end(), [&](const auto& record) {
          return record.has(info.counter);
        }))
      columns.push_back(info);
  for (const CounterInfo& info : columns) fmt::format_to(to, ",{}", info.key);
  out.push_back('\n');
  for (const FrameRecord& record : records) {
    fmt::format_to(to, "{},{}", record.frame, record.warmUp ? 1 : 0);
    for (const CounterInfo& info : columns) {
      out.push_back(',');
      if (!record.has(info.counter)) continue;
      const double value = record.get(info.counter);
      if (std::isinf(value))
        throw std::invalid_argument(
            fmt::format("formatFrameCsv: frame {}: {} is infinite", record.frame, info.key));
      fmt::format_to(to, "{}", value);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

std::vector<FrameRecord> parseFrameCsv(std::string_view text, const std::string& name) {
  return Parser(name).parse(text);
}

void writeFrameCsv(const std::filesystem::path& path, const std::vector<FrameRecord>& records) {
  writeTextFile(path, formatFrameCsv(records));
}

std::vector<FrameRecord> readFrameCsv(const std::filesystem::path& path) {
  return parseFrameCsv(readTextFile(path), path.string());
}

}  // namespace hlodbench
