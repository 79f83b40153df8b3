#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "metrics/result.h"

namespace hlodbench {

// run.json, described by results/result.schema.json. What is absent is null or left out.
nlohmann::ordered_json toJson(const RunResult& run);

// The inverse: runResultFromJson(toJson(run)) equals run. Members it does not know are ignored
// (a later minor version). `name` stands for the file in messages. Throws InputError with name and
// JSON pointer for another major version, a missing member, a wrong type or range, a case that is
// there twice or has neither a summary nor an error, or a CSV name that leaves the folder.
RunResult runResultFromJson(const nlohmann::json& json, const std::string& name);

// `folder`/run.json; writing goes through a temporary name. Throw InputError naming the file.
void writeRunResult(const std::filesystem::path& folder, const RunResult& run);
RunResult readRunResult(const std::filesystem::path& folder);

}  // namespace hlodbench
