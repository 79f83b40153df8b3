#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace hlodbench {

// Parses `text`; `name` stands for the file in messages. Throws InputError in one line, with the
// line and column of a syntax error.
nlohmann::json parseJson(std::string_view text, const std::string& name);

// A JSON value that knows its file and its JSON pointer, so that every complaint about it names
// both: "run.json: /cases/3/label: expected a string, found a number". All members throw
// InputError. Refers to the value: it must outlive the view.
class JsonView {
 public:
  JsonView(const nlohmann::json& value, std::string name, std::string pointer = "");

  [[nodiscard]] JsonView at(std::string_view key) const;                   // must be there
  [[nodiscard]] std::optional<JsonView> find(std::string_view key) const;  // absent, null: nothing
  [[nodiscard]] JsonView item(std::size_t index) const;                    // of an array
  [[nodiscard]] std::size_t size() const;                                  // of an array

  [[nodiscard]] std::string text() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] const nlohmann::json& object() const;
  // A whole number from min to max.
  [[nodiscard]] std::int64_t integer(
      std::int64_t min = 0, std::int64_t max = std::numeric_limits<std::int64_t>::max()) const;
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

 private:
  [[noreturn]] void failType(const std::string& expected) const;

  const nlohmann::json* value_;
  std::string name_;
  std::string pointer_;
};

}  // namespace hlodbench
