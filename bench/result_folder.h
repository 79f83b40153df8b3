#pragma once

#include <filesystem>

namespace hlodbench {

// Makes the folder that a run writes into. It may exist if it is empty; anything else there is the
// user's and an InputError. Returns whether the folder is new.
bool makeResultFolder(const std::filesystem::path& folder);

}  // namespace hlodbench
