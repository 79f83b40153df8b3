#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "number_range.h"
#include "traversals/bias.h"

namespace hlodbench {
namespace {

struct BiasCommand {
  std::vector<double> s{0.0, 0.5, 1.0};
  std::vector<double> t{0.1, 0.25, 0.5};
  double exponent = BiasOptions{}.exponent;
  int samples = 101;
};

void printBias(const BiasCommand& command) {
  fmt::print("s,t,exponent,mu,bias\n");
  for (const double s : command.s)
    for (const double t : command.t)
      for (int i = 0; i < command.samples; ++i) {
        const double mu = i / static_cast<double>(command.samples - 1);
        fmt::print("{},{},{},{:.9g},{:.9g}\n", s, t, command.exponent, mu,
                   computeBias(mu, {s, t, command.exponent}));
      }
}

}  // namespace

void addBiasCommand(CLI::App& app) {
  auto command = std::make_shared<BiasCommand>();
  CLI::App* sub = app.add_subcommand(
      "bias", "Print the bias B over the relative visibility mu as CSV (paper, Fig. 1a)");
  sub->add_option("--s", command->s, "smoothness, 0 to 1; several, comma-separated")
      ->delimiter(',')
      ->capture_default_str()
      ->check(makeNumberRange(0.0, 1.0));
  sub->add_option("--t", command->t, "turn-over point, 0 to 1; several, comma-separated")
      ->delimiter(',')
      ->capture_default_str()
      ->check(makeNumberRange(0.0, 1.0));
  sub->add_option("--exponent", command->exponent, "steepness (reconstruction), 1 to 100")
      ->capture_default_str()
      ->check(makeNumberRange(1.0, 100.0));
  sub->add_option("--samples", command->samples, "values of mu from 0 to 1, for each s and t")
      ->capture_default_str()
      ->check(CLI::Range(2, 100'000));
  sub->callback([command] { printBias(*command); });
}

}  // namespace hlodbench
