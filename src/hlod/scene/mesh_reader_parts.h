#pragma once

// What the readers of mesh files share; nobody else includes this.

#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hlod/scene/mesh_reader.h"

namespace hlodbench::mesh_reader {

// The bytes of a file, unpacked where it was gzipped, and what errors call it.
struct FileText {
  std::string name;
  std::string bytes;
};

// Each takes one format's bytes and throws InputError; readMeshFile() checks afterwards that
// vertices are finite and that there is some area.
MeshFile readPly(FileText file);
MeshFile readObj(const FileText& file);
MeshFile readOff(const FileText& file);
MeshFile readStl(const FileText& file);

// Throws InputError "NAME: WHAT".
[[noreturn]] void fail(const FileText& file, const std::string& what);
// Throws InputError "NAME: line LINE: WHAT"; LINE counts from 1.
[[noreturn]] void failAtLine(const FileText& file, std::uint64_t line, const std::string& what);

// A name's ending in small letters.
std::string lowerCase(std::string text);

// Adds a polygon as a fan around its first corner; there must be 3 corners or more.
void addPolygon(std::span<const std::uint32_t> corners, MeshFile& mesh);

// Hands out a text line by line, without line ends, and says where it is.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  // False at the end of the text.
  bool next(std::string_view& line);
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::uint64_t number_ = 0;
};

// Takes the next word off the front of a line; empty when there is none.
std::string_view takeWord(std::string_view& line);

// The number that the whole word is, or nothing. Does not depend on the locale.
template <typename T>
std::optional<T> parseNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// Takes three numbers off a line of vertex data: a point.
glm::vec3 takePoint(const FileText& file, const Lines& lines, std::string_view& line);

}  // namespace hlodbench::mesh_reader
