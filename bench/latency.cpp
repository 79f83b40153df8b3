#include "latency.h"

#include <charconv>

#include "hlod/core/error.h"
#include "hlod/query/fixed_latency_query_source.h"

namespace hlodbench {
namespace {

constexpr std::uint32_t kMaxLatency = 1'000'000;

// The driver's own latency: passes everything on.
class ForwardingQuerySource final : public QuerySource {
 public:
  explicit ForwardingQuerySource(QuerySource& target) : target_(target) {}
  void beginFrame() override { target_.beginFrame(); }
  void issue(NodeId node) override { target_.issue(node); }
  bool isAvailable(NodeId node) override { return target_.isAvailable(node); }
  std::uint32_t getResult(NodeId node) override { return target_.getResult(node); }
  void noteDraw() override { target_.noteDraw(); }

 private:
  QuerySource& target_;
};

}  // namespace

std::string Latency::toString() const {
  if (kind == Kind::kGl) return "gl";
  return (kind == Kind::kFrames ? "frames:" : "draws:") + std::to_string(count);
}

Latency parseLatency(std::string_view text) {
  if (text == "gl") return {};
  Latency latency;
  const std::size_t colon = text.find(':');
  const std::string_view unit = text.substr(0, colon);
  const std::string_view number =
      colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  latency.kind = unit == "frames" ? Latency::Kind::kFrames : Latency::Kind::kDraws;
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), latency.count);
  if ((unit != "frames" && unit != "draws") || number.empty() || error != std::errc() ||
      end != number.data() + number.size() || latency.count > kMaxLatency)
    throw InputError(
        "--latency: expected gl, frames:N or draws:N with N from 0 to 1000000, found '" +
        std::string(text) + "'");
  return latency;
}

std::unique_ptr<QuerySource> wrapQuerySource(QuerySource& gl, const Latency& latency,
                                             std::size_t nodeCount) {
  if (latency.kind == Latency::Kind::kGl) return std::make_unique<ForwardingQuerySource>(gl);
  const auto unit = latency.kind == Latency::Kind::kFrames ? FixedLatencyQuerySource::Unit::kFrames
                                                           : FixedLatencyQuerySource::Unit::kDraws;
  return std::make_unique<FixedLatencyQuerySource>(gl, unit, latency.count, nodeCount);
}

}  // namespace hlodbench
