#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/counters.h"

namespace hlodbench {

// The per-frame log of one (strategy, repetition): a header line "frame,warm_up," and the keys of
// kCounterTable, then a line a frame. warm_up is 0 or 1; an absent counter is an empty field;
// numbers are the shortest text that reads back to the same double, with a point in every locale.

// The file's text. Throws std::invalid_argument for an infinite value, which no reader takes.
std::string formatFrameCsv(const std::vector<FrameRecord>& records);

// `name` stands for the file in error messages. Columns may come in any order and a counter's
// column may be missing (then it is absent in every frame). Throws InputError with name and line
// for an unknown or repeated column, a wrong number of fields, or a field that is no finite number.
std::vector<FrameRecord> parseFrameCsv(std::string_view text, const std::string& name);

// The same on files; writing goes through a temporary name. Throw InputError naming the file.
void writeFrameCsv(const std::filesystem::path& path, const std::vector<FrameRecord>& records);
std::vector<FrameRecord> readFrameCsv(const std::filesystem::path& path);

}  // namespace hlodbench
