#pragma once

#include <filesystem>
#include <string>

#include "hlod/core/atomic_file.h"
#include "hlod/view/camera.h"
#include "latency.h"
#include "replay.h"
#include "traversals/options.h"

namespace hlodbench {

// What the first line of a trace says of the run.
struct TraceHeader {
  std::string strategy;
  TraversalOptions options;
  QueryFaces queryFaces = QueryFaces::kFront;
  Lens lens;
  Latency latency;
  std::uint64_t hierarchyHash = 0;
};

// Writes a trace: JSON Lines, one object an event in order of happening, numbers with 9 significant
// digits; docs/trace-format.md describes it. The file appears under its name only when finish()
// is called; otherwise nothing is left.
class TraceFile {
 public:
  // Throws InputError when the file cannot be written.
  TraceFile(std::filesystem::path path, const TraceHeader& header);

  // These throw InputError when the disk does not take everything.
  void writeFrame(const TracedFrame& frame);
  void finish();

 private:
  void write(const std::string& text);
  AtomicFile file_;
};

}  // namespace hlodbench
