"""A stand-in for the program: prints the table of `hlodbench bias`, after src/traversals/bias.h."""

import argparse

PROGRAM = """#!{python}
import sys
sys.path.insert(0, {folder!r})
import fake_bias
sys.exit(fake_bias.main(sys.argv[1:]))
"""


def compute_bias(s, t, mu, exponent=2.0):
    """B_{s,t}(mu): between mu and a sigmoid that crosses it at t."""
    if mu <= t:
        sigmoid = t * (mu / t) ** exponent
    else:
        sigmoid = 1 - (1 - t) * ((1 - mu) / (1 - t)) ** exponent
    return (1 - s) * mu + s * sigmoid


def numbers(text):
    return [float(v) for v in text.split(",")]


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("command", choices=("bias",))
    parser.add_argument("--s", type=numbers, required=True)
    parser.add_argument("--t", type=numbers, required=True)
    parser.add_argument("--samples", type=int, required=True)
    options = parser.parse_args(arguments)
    print("s,t,exponent,mu,bias")
    for s in options.s:
        for t in options.t:
            for i in range(options.samples):
                mu = i / (options.samples - 1)
                print(f"{s:g},{t:g},2,{mu:.9g},{compute_bias(s, t, mu):.9g}")
    return 0
