#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "hlod/view/camera.h"
#include "latency.h"
#include "replay.h"
#include "traversals/options.h"

namespace hlodbench {

// What the first line of a trace says of the run.
struct TraceHeader {
  std::string strategy;
  TraversalOptions options;
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
  ~TraceFile();
  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;

  void writeFrame(const TracedFrame& frame);
  // Throws InputError when the disk did not take everything.
  void finish();

 private:
  void write(const std::string& text);
  std::filesystem::path path_, temporary_;
  std::FILE* file_;
};

}  // namespace hlodbench
