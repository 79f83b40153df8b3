#include "trace_file.h"

#include <fmt/format.h>

#include "readings.h"

namespace hlodbench {
namespace {

const char* toString(Prediction prediction) {
  switch (prediction) {
    case Prediction::kRefine:
      return "refine";
    case Prediction::kStop:
      return "stop";
    case Prediction::kDelay:
      return "delay";
  }
  return "";
}

std::string formatEvent(const TraceEvent& e) {
  switch (e.type) {
    case TraceEvent::Type::kVisit:
      if (!e.inFrustum)
        return fmt::format(R"({{"type":"visit","node":{},"in_frustum":false}})", e.node);
      return fmt::format(
          R"({{"type":"visit","node":{},"in_frustum":true,"sse_px":{:.9g},"prediction":"{}"}})",
          e.node, e.sse, toString(e.prediction));
    case TraceEvent::Type::kNear:
      return fmt::format(R"({{"type":"near","node":{}}})", e.node);
    case TraceEvent::Type::kQuery:
      return fmt::format(R"({{"type":"query","node":{}}})", e.node);
    case TraceEvent::Type::kResult:
      return fmt::format(
          R"({{"type":"result","node":{},"pixels":{},"box_px":{:.9g},"mu":{:.9g},"bias":{:.9g},"stop":{}}})",
          e.node, e.pixels, e.boxPixels, e.mu, e.bias, e.stop);
    case TraceEvent::Type::kDraw:
      return fmt::format(R"({{"type":"draw","node":{}}})", e.node);
    case TraceEvent::Type::kRarn:
      return fmt::format(R"({{"type":"rarn","node":{}}})", e.node);
  }
  return "";
}

std::string formatHeader(const TraceHeader& h) {
  const TraversalOptions& o = h.options;
  std::string readings;
  for (const auto& [key, value] : listReadings(o, h.queryFaces))
    readings += fmt::format(R"(,"{}":"{}")", key, value);
  return fmt::format(
      R"({{"type":"run","version":1,"strategy":"{}","tau":{:.9g},"s":{:.9g},"t":{:.9g},)"
      R"("exponent":{:.9g},"viewport":[{},{}],"fovy_rad":{:.9g},"near":{:.9g},"far":{:.9g},)"
      R"("hierarchy":"{:016x}","latency":"{}","stale_children":"{}","zero_pixels":"{}",)"
      R"("simp_estimate":"{}"{}}})",
      h.strategy, o.tau, o.bias.s, o.bias.t, o.bias.exponent, h.lens.width, h.lens.height,
      h.lens.fovyRad, h.lens.nearPlane, h.lens.farPlane, h.hierarchyHash, h.latency.toString(),
      o.staleChildren == StaleChildren::kSkip ? "skip" : "literal",
      o.zeroPixels == ZeroPixels::kZeroBias ? "zero" : "literal",
      o.simpEstimate == SimpEstimate::kLastProcessed ? "last" : "mean", readings);
}

}  // namespace

TraceFile::TraceFile(std::filesystem::path path, const TraceHeader& header)
    : file_(std::move(path)) {
  write(formatHeader(header));
}

void TraceFile::write(const std::string& text) {
  file_.write(text);
  file_.write("\n");
}

void TraceFile::writeFrame(const TracedFrame& frame) {
  const glm::dvec3& p = frame.pose.position;
  const glm::dquat& q = frame.pose.orientation;
  write(fmt::format(
      R"({{"type":"frame","frame":{},"position":[{:.9g},{:.9g},{:.9g}],"orientation":[{:.9g},{:.9g},{:.9g},{:.9g}]}})",
      frame.record.frame, p.x, p.y, p.z, q.x, q.y, q.z, q.w));
  for (const TraceEvent& event : frame.events) write(formatEvent(event));
  const auto count = [&](Counter c) { return frame.record.has(c) ? frame.record.get(c) : 0.0; };
  write(fmt::format(
      R"({{"type":"end","frame":{},"dn":{},"rarn":{},"d":{},"delays":{},"queries":{},"triangles":{:.0f}}})",
      frame.record.frame, count(Counter::kDn), count(Counter::kRarn), count(Counter::kD),
      count(Counter::kDelays), count(Counter::kQueries), count(Counter::kTriangles)));
}

void TraceFile::finish() {
  file_.commit();
}

}  // namespace hlodbench
