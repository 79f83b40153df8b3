#include "metrics/mann_whitney.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace hlodbench {
namespace {

// The values of both samples, ranked together.
struct Ranking {
  std::vector<std::size_t> doubled;  // twice the rank, from 2; ties share their middle rank
  double tieTerm = 0.0;              // sum of t^3 - t over groups of t equal values
  std::size_t sumOfB = 0;            // of the doubled ranks of b
};

Ranking rank(std::span<const double> a, std::span<const double> b) {
  std::vector<std::pair<double, bool>> values;
  for (const double value : a) values.emplace_back(value, false);
  for (const double value : b) values.emplace_back(value, true);
  std::sort(values.begin(), values.end());
  Ranking ranking;
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin;
    while (end < values.size() && values[end].first == values[begin].first) ++end;
    const std::size_t doubled = begin + 1 + end;  // the mean of begin + 1 to end, twice
    for (std::size_t i = begin; i < end; ++i) {
      ranking.doubled.push_back(doubled);
      if (values[i].second) ranking.sumOfB += doubled;
    }
    const double ties = static_cast<double>(end - begin);
    ranking.tieTerm += ties * ties * ties - ties;
    begin = end;
  }
  return ranking;
}

// In how many ways `chosen` of the ranks have each sum.
std::vector<double> countSums(const std::vector<std::size_t>& ranks, std::size_t chosen) {
  const std::size_t total = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(total + 1, 0.0));
  ways[0][0] = 1.0;
  for (const std::size_t r : ranks)
    for (std::size_t k = chosen; k >= 1; --k)
      for (std::size_t sum = total; sum >= r; --sum) ways[k][sum] += ways[k - 1][sum - r];
  return ways[chosen];
}

double computeExactP(const Ranking& ranking, std::size_t chosen) {
  const std::vector<double> ways = countSums(ranking.doubled, chosen);
  double below = 0.0;  // as small as ours, or smaller
  double above = 0.0;
  double all = 0.0;
  for (std::size_t sum = 0; sum < ways.size(); ++sum) {
    all += ways[sum];
    if (sum <= ranking.sumOfB) below += ways[sum];
    if (sum >= ranking.sumOfB) above += ways[sum];
  }
  return std::min(1.0, 2.0 * std::min(below, above) / all);
}

double computeNormalP(double u, double n, double m, double tieTerm) {
  const double count = n + m;
  const double variance = n * m / 12.0 * (count + 1.0 - tieTerm / (count * (count - 1.0)));
  if (!(variance > 0.0)) return 1.0;  // all values are equal
  const double distance = std::max(0.0, std::abs(u - 0.5 * n * m) - 0.5);
  return std::erfc(distance / std::sqrt(2.0 * variance));
}

void checkSample(std::span<const double> sample) {
  if (sample.empty()) throw std::invalid_argument("computeMannWhitney: a sample is empty");
  for (const double value : sample)
    if (!std::isfinite(value))
      throw std::invalid_argument("computeMannWhitney: a value is not finite");
}

}  // namespace

MannWhitney computeMannWhitney(std::span<const double> a, std::span<const double> b) {
  checkSample(a);
  checkSample(b);
  const double n = static_cast<double>(a.size());
  const double m = static_cast<double>(b.size());
  const Ranking ranking = rank(a, b);
  MannWhitney result;
  result.u = 0.5 * static_cast<double>(ranking.sumOfB) - 0.5 * m * (m + 1.0);
  result.a12 = result.u / (n * m);
  result.isExact = a.size() + b.size() <= kMostExact;
  result.p = result.isExact ? computeExactP(ranking, b.size())
                            : computeNormalP(result.u, n, m, ranking.tieTerm);
  return result;
}

double computeSmallestP(std::size_t n, std::size_t m) {
  double ways = 1.0;
  for (std::size_t i = 1; i <= m; ++i) ways *= static_cast<double>(n + i) / static_cast<double>(i);
  return std::min(1.0, 2.0 / ways);
}

std::size_t computeNeededRepetitions(double alpha) {
  std::size_t count = 1;
  while (!(computeSmallestP(count, count) < alpha)) ++count;
  return count;
}

}  // namespace hlodbench
