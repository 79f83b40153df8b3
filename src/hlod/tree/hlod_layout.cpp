#include "hlod/tree/hlod_layout.h"

#include "hlod/tree/hasher.h"

namespace hlodbench {

std::uint64_t computeHeaderHash(HlodHeader header, const std::string& options) {
  header.headerHash = 0;
  Hasher hasher;
  hasher.add(&header, sizeof(header));
  hasher.add(options.data(), options.size());
  return hasher.digest();
}

std::uint64_t computeContentHash(HlodHeader header, const HlodTables& tables) {
  header.headerHash = 0;
  header.contentHash = 0;
  Hasher hasher;
  hasher.add(&header, sizeof(header));
  hasher.add(tables.options.data(), tables.options.size());
  hasher.add(tables.objects.data(), tables.objects.size());
  hasher.add(tables.nodes.data(), tables.nodes.size() * sizeof(StoredNode));
  return hasher.digest();
}

}  // namespace hlodbench
