#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace hlodbench {

// A value as JSON, null where it is absent.
template <typename T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace hlodbench
