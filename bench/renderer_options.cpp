#include "renderer_options.h"

#include <fmt/format.h>

#include "byte_size.h"
#include "choice.h"
#include "hlod/core/error.h"

namespace hlodbench {

void addMemoryOption(CLI::App& command, std::uint64_t& bytes) {
  command
      .add_option_function<std::string>(
          "--gpu-memory",
          [&bytes](const std::string& text) {
            const auto size = parseByteSize(text);
            if (!size && text != "unlimited")
              throw InputError(fmt::format(
                  "--gpu-memory: expected a number of bytes like 256M, or unlimited, found '{}'",
                  text));
            bytes = size.value_or(kUnlimitedMemory);
          },
          "for the geometry of nodes, bytes, with K, M or G: nodes come from the file when they "
          "are "
          "wanted, and those not drawn for the longest time go; until they are there, an ancestor "
          "is drawn. Where it is too small for all nodes, more than 1G is taken as 1G")
      ->default_str("unlimited");
}

void addFacesOption(CLI::App& command, FaceCulling& faces) {
  addChoice<FaceCulling>(
      command, "--faces", faces,
      {{"both", FaceCulling::kNone}, {"front", FaceCulling::kBackWhereConsistent}},
      "faces drawn; front: back faces are left out where the input is consistently wound (the "
      "full-resolution pictures always have both)");
}

}  // namespace hlodbench
