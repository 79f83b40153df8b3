#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace hlodbench {

// From now on, a bus error within these bytes, which is what the system answers when a mapped file
// has been cut off, ends the program with the line "hlodbench: PATH: cut off while it was in use"
// and exit code 2. Other bus errors go on as before. Up to 256 mappings at a time are guarded.
void guardMapping(std::span<const std::byte> bytes, const std::string& path);

// To be called before the bytes are unmapped.
void unguardMapping(std::span<const std::byte> bytes);

}  // namespace hlodbench
