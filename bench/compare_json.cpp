#include <nlohmann/json.hpp>

#include "compare_text.h"
#include "metrics/json_or_null.h"

namespace hlodbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchemaVersion = "1.0.0";

Json toJson(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return {
      {"value", interval->value}, {"low", orNull(interval->low)}, {"high", orNull(interval->high)}};
}

Json toJson(const CompareRow& row) {
  return {{"group", row.group},
          {"key", row.key},
          {"label", row.label},
          {"unit", row.unit},
          {"a", orNull(row.a)},
          {"b", orNull(row.b)},
          {"of", row.basis},
          {"different_frames", orNull(row.different)},
          {"difference", toJson(row.difference)},
          {"relative", toJson(row.relative)},
          {"p", orNull(row.p)},
          {"a12", orNull(row.a12)},
          {"verdict", toString(row.judgement.verdict)},
          {"reason", row.judgement.reason}};
}

Json toJson(const ComparePair& pair) {
  Json rows = Json::array();
  for (const CompareRow& row : pair.rows) rows.push_back(toJson(row));
  return {{"strategy_a", pair.strategyA}, {"strategy_b", pair.strategyB},
          {"label_a", pair.labelA},       {"label_b", pair.labelB},
          {"notes", pair.notes},          {"rows", std::move(rows)}};
}

Json toJson(const CompareSide& side) {
  return {{"folder", side.folder.string()},
          {"scene", side.run.scene.name},
          {"session", side.run.session.name},
          {"git_revision", orNull(side.run.environment.gitRevision)},
          {"time_utc", side.run.environment.timeUtc}};
}

}  // namespace

std::string renderCompareJson(const Comparison& comparison, const CompareSide& a,
                              const CompareSide& b, const CompareOptions& options) {
  Json counts = Json::object();
  for (const Verdict verdict :
       {Verdict::kBetter, Verdict::kWorse, Verdict::kSame, Verdict::kUnclear})
    counts[toString(verdict)] = comparison.count(verdict);
  Json pairs = Json::array();
  for (const ComparePair& pair : comparison.pairs) pairs.push_back(toJson(pair));
  const Json json{{"schema_version", kSchemaVersion},
                  {"a", toJson(a)},
                  {"b", toJson(b)},
                  {"options",
                   {{"alpha", options.verdict.alpha},
                    {"effect", options.verdict.effect},
                    {"min_change", options.verdict.minChange},
                    {"allow", options.allowed}}},
                  {"verdicts", std::move(counts)},
                  {"notes", comparison.notes},
                  {"pairs", std::move(pairs)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hlodbench
