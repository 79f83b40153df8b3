#include "hlod/scene/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <vector>

#include "hlod/core/error.h"

namespace hlodbench {

using nlohmann::json;

json readJsonFile(const std::filesystem::path& path) {
  const std::string file = path.string();
  if (!std::filesystem::exists(path)) throw InputError(fmt::format("{}: no such file", file));
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(fmt::format("{}: cannot be opened for reading", file));
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto findDuplicates = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key &&
        !keys.back().insert(parsed.get_ref<const std::string&>()).second)
      throw InputError(
          fmt::format("{}: the key {} stands twice in one object", file, parsed.dump()));
    return true;
  };
  try {
    return json::parse(in, findDuplicates);
  } catch (const json::exception& error) {
    std::string what = error.what();
    what.erase(0,
               what.find(' ') == std::string::npos ? 0 : what.find(' ') + 1);  // the library's id
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw InputError(fmt::format("{}: expected JSON: {}", file, what));
  }
}

void JsonNode::failWith(std::string_view message) const {
  throw InputError(
      fmt::format("{}: {}: {}", file_, pointer_.empty() ? "/" : pointer_.c_str(), message));
}

void JsonNode::fail(std::string_view expected) const {
  constexpr std::size_t kShown = 60;
  std::string found = value_->dump(-1, ' ', false, json::error_handler_t::replace);
  if (found.size() > kShown) found = found.substr(0, kShown) + "...";
  failWith(fmt::format("expected {}, found {}", expected, found));
}

void JsonNode::expectObject(std::initializer_list<std::string_view> keys) const {
  if (!value_->is_object()) fail("an object");
  for (const auto& [key, child] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    at(key).failWith(fmt::format("unknown key; known are {}", fmt::join(keys, ", ")));
  }
}

JsonNode JsonNode::at(const std::string& key) const {
  if (!value_->is_object()) fail("an object");
  const auto it = value_->find(key);
  if (it == value_->end()) failWith(fmt::format("the key \"{}\" is missing", key));
  std::string escaped;
  for (const char c : key) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  return {*it, file_, fmt::format("{}/{}", pointer_, escaped)};
}

JsonNode JsonNode::at(std::size_t index) const {
  return {value_->at(index), file_, fmt::format("{}/{}", pointer_, index)};
}

std::size_t JsonNode::arraySize(std::size_t least, std::size_t most) const {
  const bool fits = value_->is_array() && value_->size() >= least && value_->size() <= most;
  if (fits) return value_->size();
  if (least == most) fail(fmt::format("an array of {} entries", least));
  fail(least == 0 ? "an array" : fmt::format("an array of {} or more entries", least));
}

double JsonNode::number() const {
  if (!value_->is_number()) fail("a number");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) fail("a finite number");
  return number;
}

double JsonNode::numberAbove0() const {
  if (!value_->is_number() || !(number() > 0.0)) fail("a number above 0");
  return number();
}

std::uint64_t JsonNode::integer(std::uint64_t least, std::uint64_t most) const {
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() >= least &&
      value_->get<std::uint64_t>() <= most)
    return value_->get<std::uint64_t>();
  fail(least == most ? fmt::format("{}", least)
                     : fmt::format("a whole number from {} to {}", least, most));
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

std::string JsonNode::text() const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().empty())
    fail("a text that is not empty");
  return value_->get<std::string>();
}

glm::dvec3 JsonNode::vector3() const {
  if (!value_->is_array() || value_->size() != 3) fail("an array of 3 numbers");
  return {at(0).number(), at(1).number(), at(2).number()};
}

}  // namespace hlodbench
