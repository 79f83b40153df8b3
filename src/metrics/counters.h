#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

namespace hlodbench {

// What is logged for every frame. To add a counter, add a line here and the same line to
// kCounterTable: CSV headers, JSON, printed tables, `hlodbench list` and comparisons follow.
enum class Counter : std::size_t {
  kDn,
  kRarn,
  kD,
  kDelays,
  kQueries,
  kTriangles,
  kNodesVisited,
  kQueriesWasted,
  kRepeatedDelays,
  kFrontChange,
  kFrameMs,
  kCpuMs,
  kWaitMs,
  kDrawMs,
  kQueryMs,
  kTraversalMs,
  kGpuMs,
  kMissingNodes,
  kLoads,
  kEvictions,
  kResidentMib,
  kPredictedRight,
  kTooConservative,
  kTooAggressive,
  kNeedlessDelays,
  kInvisibleNodes,
  kVisibleTriangles,
  kInvisibleTriangles,
  kCount
};

enum class Better { kLower, kHigher, kNeither };
enum class Exactness {
  kExact,  // the same in every run with a fixed latency, on one driver
  kNoisy   // a timing, or what depends on one
};

struct CounterInfo {
  Counter counter;
  std::string_view key;    // in CSV and JSON
  std::string_view label;  // in printed tables
  std::string_view unit;   // "" for plain counts
  Better better;
  Exactness exactness;
  std::string_view description;  // one line
  bool isOptional = false;       // no column in the frame log of a replay that has it in no frame
};

inline constexpr std::size_t kCounterCount = static_cast<std::size_t>(Counter::kCount);

inline constexpr std::array<CounterInfo, kCounterCount> kCounterTable{{
    {Counter::kDn, "dn", "DN", "", Better::kLower, Exactness::kExact,
     "drawn nodes: draw calls for node geometry, parents of RARN included (paper, Table 1)"},
    {Counter::kRarn, "rarn", "RARN", "", Better::kLower, Exactness::kExact,
     "nodes rendered and then refined in the same frame (paper, Table 1)"},
    {Counter::kD, "d", "D", "", Better::kLower, Exactness::kExact,
     "nodes delayed and then drawn at that node (paper, Table 1)"},
    {Counter::kDelays, "delays", "delays", "", Better::kLower, Exactness::kExact,
     "all nodes delayed, drawn or not"},
    {Counter::kQueries, "queries", "queries", "", Better::kLower, Exactness::kExact,
     "occlusion queries issued"},
    {Counter::kTriangles, "triangles", "triangles", "", Better::kLower, Exactness::kExact,
     "triangles drawn"},
    {Counter::kNodesVisited, "nodes_visited", "visited", "", Better::kLower, Exactness::kExact,
     "nodes taken from the priority queue"},
    {Counter::kQueriesWasted, "queries_wasted", "wasted", "", Better::kLower, Exactness::kExact,
     "queries whose result changed nothing: the node was drawn already, and was to be drawn"},
    {Counter::kRepeatedDelays, "repeated_delays", "repeated", "", Better::kLower, Exactness::kExact,
     "nodes delayed that were visible in the last frame and are drawn or refined as then"},
    {Counter::kFrontChange, "front_change", "change", "", Better::kNeither, Exactness::kExact,
     "nodes drawn in this frame and not in the last, and the reverse"},
    {Counter::kFrameMs, "frame_ms", "frame", "ms", Better::kLower, Exactness::kNoisy,
     "time from this frame's start to the next one's"},
    {Counter::kCpuMs, "cpu_ms", "CPU", "ms", Better::kLower, Exactness::kNoisy,
     "processor time of the traversing thread"},
    {Counter::kWaitMs, "wait_ms", "wait", "ms", Better::kLower, Exactness::kNoisy,
     "time blocked on query results"},
    {Counter::kDrawMs, "draw_ms", "draw", "ms", Better::kLower, Exactness::kNoisy,
     "time in draw calls for nodes; a software rasteriser transforms and sets up triangles in "
     "them"},
    {Counter::kQueryMs, "query_ms", "query", "ms", Better::kLower, Exactness::kNoisy,
     "time in issuing queries and asking whether they are done, boxes included, waiting not"},
    {Counter::kTraversalMs, "traversal_ms", "traversal", "ms", Better::kLower, Exactness::kNoisy,
     "time of the strategy itself: of its frame less drawing, querying and waiting"},
    {Counter::kGpuMs, "gpu_ms", "GPU", "ms", Better::kLower, Exactness::kNoisy,
     "time between the frame's first and last GPU timestamp, where timer queries exist"},
    {Counter::kMissingNodes, "missing_nodes", "missing", "", Better::kLower, Exactness::kNoisy,
     "nodes drawn as an ancestor, because they were not there yet (--gpu-memory)", true},
    {Counter::kLoads, "loads", "loads", "", Better::kLower, Exactness::kNoisy,
     "nodes whose geometry came to the GPU (--gpu-memory)", true},
    {Counter::kEvictions, "evictions", "evictions", "", Better::kLower, Exactness::kNoisy,
     "nodes whose geometry went to make room (--gpu-memory)", true},
    {Counter::kResidentMib, "resident_mib", "resident", "MiB", Better::kLower, Exactness::kNoisy,
     "geometry of nodes on the GPU (--gpu-memory)", true},
    {Counter::kPredictedRight, "predicted_right", "right", "", Better::kHigher, Exactness::kExact,
     "predictions that say what SW(B) did in this frame (--explain)", true},
    {Counter::kTooConservative, "too_conservative", "too conservative", "", Better::kLower,
     Exactness::kExact, "predictions to go on, or to draw, where SW(B) had ended (--explain)",
     true},
    {Counter::kTooAggressive, "too_aggressive", "too aggressive", "", Better::kLower,
     Exactness::kExact, "predictions to stop where SW(B) refined (--explain)", true},
    {Counter::kNeedlessDelays, "needless_delays", "needless delay", "", Better::kLower,
     Exactness::kExact, "predictions to wait where SW(B) drew or refined (--explain)", true},
    {Counter::kInvisibleNodes, "invisible_nodes", "invisible nodes", "", Better::kLower,
     Exactness::kExact, "drawn nodes to which no pixel of the picture belongs (--explain)", true},
    {Counter::kVisibleTriangles, "visible_triangles", "visible triangles", "", Better::kNeither,
     Exactness::kExact, "triangles to which a pixel of the picture belongs (--explain)", true},
    {Counter::kInvisibleTriangles, "invisible_triangles", "invisible triangles", "", Better::kLower,
     Exactness::kExact, "drawn triangles to which no pixel of the picture belongs (--explain)",
     true},
}};

// One frame's values. A counter that a strategy or a driver does not have is absent (NaN), not 0.
class FrameRecord {
 public:
  FrameRecord() { values_.fill(std::numeric_limits<double>::quiet_NaN()); }
  [[nodiscard]] double get(Counter c) const { return values_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] bool has(Counter c) const { return !std::isnan(get(c)); }
  void set(Counter c, double value) { values_[static_cast<std::size_t>(c)] = value; }

  int frame = 0;        // index into the session
  bool warmUp = false;  // excluded from every average

 private:
  std::array<double, kCounterCount> values_;
};

}  // namespace hlodbench
