#pragma once

#include <algorithm>
#include <cmath>

namespace hlodbench::plugin {

// Parameters of the bias B_{s,t}(mu) (paper, Eq. 1 and Fig. 1a).
struct BiasOptions {
  double s = 1.0;         // smoothness, 0 to 1: 0 gives B = mu, 1 the plain sigmoid
  double t = 0.25;        // turn-over point, 0 to 1: the nearer to 0, the more conservative
  double exponent = 2.0;  // steepness of the sigmoid, >= 1 (reconstruction; 1 gives B = mu)
};

// The sigmoid S_t(mu), 0 to 1, for mu in 0 to 1: t (mu/t)^p up to the turn-over point, then
// 1 - (1-t) ((1-mu)/(1-t))^p. Below t it is at most mu (aggressive), above at least mu.
// reconstruction: the paper describes the curve and gives no formula; see docs/deviations.md.
inline double computeSigmoid(double mu, double t, double exponent) {
  if (mu <= t) return t > 0.0 ? t * std::pow(mu / t, exponent) : 0.0;
  return 1.0 - (1.0 - t) * std::pow((1.0 - mu) / (1.0 - t), exponent);
}

// The bias that turns the screen-space error into the virtual multiresolution one:
// VMSSE = B_{s,t}(mu) * SSE (paper, Eq. 1). s "linearly interpolates between mu and the unsmoothed
// sigmoid" (paper, section 3.2). mu is clamped to 0..1; the result lies in 0..1.
inline double computeBias(double mu, const BiasOptions& options) {
  mu = std::clamp(mu, 0.0, 1.0);
  return (1.0 - options.s) * mu + options.s * computeSigmoid(mu, options.t, options.exponent);
}

}  // namespace hlodbench::plugin
