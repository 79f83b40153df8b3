#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace hlodbench {

// Reads a JSON file. Throws InputError with the file, line and column of what is no JSON; a key
// that stands twice in one object is an error too.
nlohmann::json readJsonFile(const std::filesystem::path& path);

// A place in a JSON file that is read with every expectation spelled out: whatever does not meet
// one throws InputError "FILE: /json/pointer: expected ..., found ...".
// The file's JSON value must outlive the node.
class JsonNode {
 public:
  JsonNode(const nlohmann::json& value, std::string file, std::string pointer = {})
      : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  // Throws InputError "FILE: POINTER: expected EXPECTED, found ...".
  [[noreturn]] void fail(std::string_view expected) const;
  // Throws InputError "FILE: POINTER: MESSAGE".
  [[noreturn]] void failWith(std::string_view message) const;

  [[nodiscard]] const nlohmann::json& value() const { return *value_; }
  [[nodiscard]] const std::string& file() const { return file_; }

  // An object with no keys but these; the first unknown one is the error's place.
  void expectObject(std::initializer_list<std::string_view> keys) const;
  [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
  // A key that must be there.
  [[nodiscard]] JsonNode at(const std::string& key) const;

  // What follows throws for any other kind of value, and so may be called for its check alone.

  // An array of so many entries.
  std::size_t arraySize(std::size_t least = 0,
                        std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  [[nodiscard]] JsonNode at(std::size_t index) const;

  double number() const;  // finite
  double numberAbove0() const;
  std::uint64_t integer(std::uint64_t least, std::uint64_t most) const;
  bool boolean() const;
  std::string text() const;    // not empty
  glm::dvec3 vector3() const;  // an array of 3 numbers

 private:
  const nlohmann::json* value_;
  std::string file_;
  std::string pointer_;
};

}  // namespace hlodbench
