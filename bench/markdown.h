#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hlodbench {

// Escapes only what would end a cell or a line early, or start a list: in a terminal, text stays as
// it is.
std::string escapeMarkdown(std::string text);

// A table whose columns line up in a terminal. `alignment` has an "l" or "r" for each column; every
// row has as many cells as the header.
std::string formatMarkdownTable(const std::vector<std::string>& header,
                                const std::vector<std::vector<std::string>>& rows,
                                std::string_view alignment);

std::string replaceAll(std::string text, std::string_view from, std::string_view to);

}  // namespace hlodbench
