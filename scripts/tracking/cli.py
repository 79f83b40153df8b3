"""Options of scripts/nightly.sh, and its exit codes."""

import argparse
import os
import pathlib
import secrets
import signal
import sys
import time

from run_cells import ROOT

from .accept import accept
from .bisection import run_bisection
from .calibration import NONE
from .core import ANY, AUTO, choose_core
from .errors import TrackingError
from .night import run_night, say
from .summary import is_regression
from .timing import Rule

RESULTS = ROOT / "results" / "runs" / "nightly"
SUCCESS, REGRESSION, NOT_RUN = 0, 1, 2
RETRY_S = 5
FEWEST_REPETITIONS = 9  # fewer have too little power: docs/nightly.md


class Parser(argparse.ArgumentParser):
    """Errors are one line, as those of the other scripts. The help text is in nightly.sh."""

    def __init__(self):
        super().__init__(prog="nightly.sh", add_help=False, allow_abbrev=False)

    def error(self, message):
        raise TrackingError(f"{message}; see nightly.sh --help")

    def parse(self, arguments):
        options, rest = self.parse_known_args(arguments)
        if rest:
            raise TrackingError(f"unknown option or argument '{rest[0]}'; see nightly.sh --help")
        return options


def make_history_option(parser):
    default = os.environ.get("HLODBENCH_HISTORY") or ROOT / "results" / "runs" / "history"
    parser.add_argument("--history", type=folder, default=pathlib.Path(default))


def make_run_parser():
    parser = Parser()
    make_history_option(parser)
    parser.add_argument("--paper", action="store_true")
    parser.add_argument("--cell", action="append", default=[])
    parser.add_argument("--out", type=folder)
    parser.add_argument("--baseline")
    parser.add_argument("--bisect")
    parser.add_argument("--repetitions", type=whole(FEWEST_REPETITIONS, 9999),
                        default=FEWEST_REPETITIONS)
    parser.add_argument("--no-times", dest="timing", action="store_false")
    parser.add_argument("--no-report", dest="report", action="store_false")
    for name, default in (("min-change", 1.5), ("max-spread", 15), ("max-others", 25)):
        parser.add_argument(f"--{name}", type=per_cent, default=default / 100)
    parser.add_argument("--min-traversal", type=per_cent)
    parser.add_argument("--calibration", choices=("numpy", NONE), default="numpy")
    parser.add_argument("--core", type=core, default=AUTO)
    parser.add_argument("--machine")
    parser.add_argument("--context", choices=("auto", "egl", "osmesa"), default="auto")
    parser.add_argument("--seed", type=whole(0, 2**53 - 1), default=1)
    parser.add_argument("--program", type=folder)
    parser.add_argument("--baseline-program", type=folder)
    return parser


def make_accept_parser():
    parser = Parser()
    make_history_option(parser)
    parser.add_argument("--why", required=True)
    parser.add_argument("--cell", action="append", default=[])
    parser.add_argument("--who")
    parser.add_argument("--key")
    return parser


def make_trend_parser():
    parser = Parser()
    make_history_option(parser)
    parser.add_argument("--out", type=folder, default=RESULTS / "trend.html")
    parser.add_argument("--machine", action="append", default=[])
    parser.add_argument("--plot-library", type=folder)
    return parser


def folder(text):
    if not text:
        raise argparse.ArgumentTypeError("expected a path, found none")
    return pathlib.Path(text).absolute()


def whole(low, high):
    """The type of an option that is a whole number."""

    def convert(text):
        if not text.isascii() or not text.isdigit() or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"expected a number from {low} to {high}, "
                                             f"not '{text}'")
        return int(text)
    return convert


def core(text):
    """The type of --core."""
    return text if text in (AUTO, ANY) else whole(0, 9999)(text)


def per_cent(text):
    """The type of an option in per cent; a share."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value <= 100:
        raise argparse.ArgumentTypeError(f"expected per cent from 0 to 100, not '{text}'")
    return value / 100


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    end_on_signals()
    try:
        if arguments[:1] == ["accept"]:
            return run_accept(make_accept_parser().parse(arguments[1:]))
        if arguments[:1] == ["trend"]:
            return run_trend(make_trend_parser().parse(arguments[1:]))
        return run(make_run_parser().parse(arguments))
    except TrackingError as error:
        say(" ".join(str(error).split("\n")))
    except OSError as error:
        say(f"{error.filename or 'nightly.sh'}: {error.strerror}")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    return NOT_RUN


def end_on_signals():
    """Makes signals end this process by SystemExit, with the usual codes, so that children end and
    what is unfinished goes. Python drops what a handler raises in the callbacks around a fork: so
    it is raised again after RETRY_S, unless the process has ended."""

    def stop(number, _):
        def again(*_):
            stop(number, None)
        signal.signal(signal.SIGALRM, again)
        signal.setitimer(signal.ITIMER_REAL, RETRY_S)
        sys.exit(128 + number)

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # as nohup has it
            signal.signal(number, stop)


def run(options):
    """A night or a bisection; prints its summary."""
    check(options)
    if options.out is None:
        stamp = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime())
        options.out = RESULTS / f"{stamp}-{secrets.token_hex(3)}"
    options.rule = Rule(min_change=options.min_change, min_traversal=options.min_traversal,
                        most_spread=options.max_spread, most_others=options.max_others)
    if options.bisect is None:
        is_worse = is_regression(run_night(options))
    else:
        is_worse = run_bisection(options).is_slower
    print((options.out / "summary.md").read_text(encoding="utf-8"), end="")
    say(f"results: {options.out}")
    return REGRESSION if is_worse else SUCCESS


def check(options):
    """Refuses options that exclude each other, and a core that there is not."""
    choose_core(options.core, False)
    if options.baseline and options.baseline_program:
        raise TrackingError("--baseline and --baseline-program exclude each other")
    if options.bisect is not None:
        for name, given in (("--baseline", options.baseline),
                            ("--baseline-program", options.baseline_program),
                            ("--program", options.program), ("--no-times", not options.timing)):
            if given:
                raise TrackingError(f"--bisect and {name} exclude each other")


def run_accept(options):
    """Records an acceptance; prints what was accepted."""
    path, cells, problems = accept(options.history, options.key, options.cell, options.who,
                                   options.why)
    for problem in problems:
        say(problem)
    print("\n".join(cells))
    say(f"added to the history: {path}")
    return SUCCESS


def run_trend(options):
    """Writes the page of the history; names on stderr what of it cannot be read."""
    try:
        from .trend import write_trend  # jinja2 is wanted for this alone
    except ImportError as error:
        raise TrackingError(f"trend: needs {error.name} (Debian: python3-{error.name})") from None
    trend = write_trend(options.history, options.machine, options.out, options.plot_library)
    for problem in trend.problems:
        say(problem)
    say(f"{options.out}: {trend.nights} nights of {trend.machines} machines, "
        f"{trend.size / 1e6:.1f} MB")
    return SUCCESS
