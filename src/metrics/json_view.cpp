#include "metrics/json_view.h"

#include <fmt/format.h>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// A key as a JSON pointer's token (RFC 6901).
std::string escapeToken(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += c;
  }
  return token;
}

}  // namespace

nlohmann::json parseJson(std::string_view text, const std::string& name) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    std::string what = error.what();
    if (const std::size_t at = what.find("] "); at != what.npos) what = what.substr(at + 2);
    for (char& c : what)
      if (c == '\n' || c == '\r') c = ' ';
    throw InputError(fmt::format("{}: expected JSON: {}", name, what));
  }
}

JsonView::JsonView(const nlohmann::json& value, std::string name, std::string pointer)
    : value_(&value), name_(std::move(name)), pointer_(std::move(pointer)) {}

void JsonView::fail(const std::string& expected, const std::string& found) const {
  throw InputError(fmt::format("{}: {}: expected {}, found {}", name_,
                               pointer_.empty() ? "/" : pointer_, expected, found));
}

void JsonView::failType(const std::string& expected) const {
  std::string found = value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (found.size() > kLongest) found = fmt::format("a long {}", value_->type_name());
  fail(expected, found);
}

std::optional<JsonView> JsonView::find(std::string_view key) const {
  const auto found = object().find(key);
  if (found == value_->end() || found->is_null()) return std::nullopt;
  return JsonView(*found, name_, pointer_ + "/" + escapeToken(key));
}

JsonView JsonView::at(std::string_view key) const {
  const auto found = object().find(key);
  if (found == value_->end()) fail(fmt::format("a member \"{}\"", key), "none");
  return JsonView(*found, name_, pointer_ + "/" + escapeToken(key));
}

std::size_t JsonView::size() const {
  if (!value_->is_array()) failType("an array");
  return value_->size();
}

JsonView JsonView::item(std::size_t index) const {
  if (index >= size()) fail(fmt::format("{} items or more", index + 1), fmt::format("{}", size()));
  return JsonView((*value_)[index], name_, fmt::format("{}/{}", pointer_, index));
}

std::string JsonView::text() const {
  if (!value_->is_string()) failType("a string");
  return value_->get<std::string>();
}

double JsonView::number() const {
  if (!value_->is_number()) failType("a number");
  return value_->get<double>();
}

bool JsonView::boolean() const {
  if (!value_->is_boolean()) failType("true or false");
  return value_->get<bool>();
}

const nlohmann::json& JsonView::object() const {
  if (!value_->is_object()) failType("an object");
  return *value_;
}

std::int64_t JsonView::integer(std::int64_t min, std::int64_t max) const {
  const bool tooLarge = value_->is_number_unsigned() &&
                        value_->get<std::uint64_t>() >
                            static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (!value_->is_number_integer() || tooLarge || value_->get<std::int64_t>() < min ||
      value_->get<std::int64_t>() > max)
    failType(max == std::numeric_limits<std::int64_t>::max()
                 ? fmt::format("a whole number from {}", min)
                 : fmt::format("a whole number from {} to {}", min, max));
  return value_->get<std::int64_t>();
}

}  // namespace hlodbench
