"""A bisection, from building to its summary: at which commit did the times of cells change?"""

import pathlib
from dataclasses import dataclass, field

from run_cells import ROOT

from . import timing
from .bisect import ON_BAD, ON_GOOD, Search, choose_quantity, decide, search_all
from .bisect_programs import Programs
from .bisect_report import write_bisection
from .calibration import NONE
from .core import AUTO
from .commit_line import Commit, list_line
from .errors import TrackingError
from .lock import MachineLock
from .matrix import list_cells, list_scenes
from .measure import take_turns
from .night import check_space, fetch_models, make_out, say
from .timing_tier import CellResult, TimingTier

SEEDS = 2  # that a tier uses: its own, and the next one to measure again
ATTEMPTS = 2  # to judge a commit
LACKING = CellResult(timing.Verdict(timing.UNCLEAR, "one of the two has no such strategy"), {})
SIDES = {ON_GOOD: "as the good commit", ON_BAD: "as the bad commit", None: "cannot be told"}


@dataclass
class Probe:
    """A commit that was tried."""

    commit: Commit
    error: str | None = None  # why it could not be
    cells: dict = field(default_factory=dict)  # {cell: [(CellResult, side)]}, an item each attempt

    def side(self, cell):
        """What decide() said last of a cell; None if it could not be measured."""
        return self.cells[cell][-1][1] if cell in self.cells else None


@dataclass
class Culprit:
    """What was found of a cell that changed."""

    candidates: list  # Commits
    own: CellResult | None = None  # of the only candidate against its parent
    error: str | None = None  # why that could not be measured


@dataclass
class Bisection:
    """All that was found."""

    line: list  # Commits, from the good one to the bad one
    rule: timing.Rule
    repetitions: int
    seed: int
    changes: dict = field(default_factory=dict)  # {cell: CellResult} of the bad commit
    quantities: dict = field(default_factory=dict)  # {cell that changed: the one that decided}
    culprits: dict = field(default_factory=dict)  # {cell that changed: Culprit}
    probes: list = field(default_factory=list)

    @property
    def is_slower(self):
        """Whether a cell is."""
        return any(result.verdict.verdict == timing.SLOW for result in self.changes.values())


@dataclass(frozen=True)
class TierOptions:
    """What a TimingTier wants to know."""

    rule: timing.Rule
    repetitions: int
    seed: int
    out: pathlib.Path
    core: int | str  # as the option --core
    calibration: str = NONE  # pairs do without


def run_bisection(options):
    """Everything; the Bisection. Raises TrackingError."""
    cells = list_cells(options.paper, options.cell)
    line = list_line(ROOT, options.bisect)
    make_out(options.out)
    made = Bisection(line, options.rule, options.repetitions, options.seed)
    with MachineLock():
        if options.paper:
            fetch_models(options)
        programs = Programs(options.out, list_scenes(cells), options.context, say,
                            [line[0], line[-1]])
        try:
            Run(made, programs, options).find(cells)
        finally:
            programs.remove_others([line[0].hash])
        write_bisection(options.out, made)
    return made


class Run:
    """The measuring of a Bisection, which it fills in. options: those of nightly.sh."""

    def __init__(self, made, programs, options):
        self._made, self._programs = made, programs
        self._out, self._core = options.out, options.core
        self._is_gpu = None if options.core == AUTO else False  # None: not known yet
        self._good = made.line[0].hash
        self._searches = {}

    def find(self, cells):
        """Finds the commits, and measures each against its parent."""
        made, bad = self._made, self._made.line[-1]
        say(f"{count_of(len(made.line) - 1, 'commit')} from {made.line[0].short} to {bad.short}")
        self._check_space()
        made.changes = self._measure(bad.hash, self._good, cells, bad.short)
        made.quantities = {cell: choose_quantity(result) for cell, result in made.changes.items()
                           if timing.is_change(result.verdict)}
        changed = [f"{cell} {made.changes[cell].verdict.verdict}" for cell in made.quantities]
        say(f"changed: {', '.join(changed) or 'no cell'}")
        self._searches = {cell: Search(len(made.line) - 1) for cell in made.quantities}
        search_all(self._searches, self._try)
        made.culprits = {cell: Culprit([made.line[n] for n in search.list_candidates()])
                         for cell, search in self._searches.items()}
        self._confirm()

    def _try(self, number, cells, steps):
        """{cell: side} of a commit."""
        self._forget()
        self._check_space()
        probe = Probe(self._made.line[number])
        self._made.probes.append(probe)
        name = probe.commit.short
        say(f"about {count_of(steps, 'more build')}; {name} {probe.commit.subject}: "
            f"{', '.join(cells)}")
        try:
            for attempt in range(ATTEMPTS):
                undecided = [cell for cell in cells if probe.side(cell) is None]
                if undecided:
                    self._judge(probe, undecided, attempt)
        except TrackingError as error:
            probe.error = one_line(error)
            say(f"{name} is skipped: {probe.error}")
        sides = {cell: probe.side(cell) for cell in cells}
        if probe.cells:
            say(f"{name}: " + ", ".join(f"{cell} {SIDES[side]}" for cell, side in sides.items()))
        return sides

    def _judge(self, probe, cells, attempt):
        """Measures cells of a probe once."""
        name = f"{probe.commit.short}{'-again' * attempt}"
        results = self._measure(probe.commit.hash, self._good, cells, name, attempt)
        for cell, result in results.items():
            quantity = self._made.quantities[cell]
            attempts = probe.cells.setdefault(cell, [])
            pairs = [ratio for made, _ in [*attempts, (result, None)]
                     for ratio in (made.samples.get("ratios") or {}).get(quantity, [])]
            side = decide(result.quantities.get(quantity),
                          self._made.changes[cell].quantities[quantity], pairs)
            attempts.append((result, side))

    def _confirm(self):
        """Measures each commit that was found against its parent."""
        found = {}
        for cell, culprit in self._made.culprits.items():
            if len(culprit.candidates) == 1:
                found.setdefault(culprit.candidates[0], []).append(cell)
        self._forget()
        for commit, cells in found.items():
            say(f"{commit.short} against its parent: {', '.join(cells)}")
            self._check_space()
            try:
                results = self._measure(commit.hash, commit.parent, cells,
                                        f"{commit.short}-parent", ATTEMPTS)
            except TrackingError as error:
                say(f"{commit.short} is not confirmed: {one_line(error)}")
                for cell in cells:
                    self._made.culprits[cell].error = one_line(error)
                continue
            for cell in cells:
                self._made.culprits[cell].own = results[cell]

    def _measure(self, new, base, cells, name, attempt=0):
        """{cell: CellResult} of a commit against another one, hashes. name: of the folder for
        results. attempt: each has an order of its own."""
        base, new = self._programs.get(base), self._programs.get(new)
        known = set(base.list_strategies()) & set(new.list_strategies())
        able = [cell for cell in cells if cell.split("/")[1] in known]
        options = TierOptions(self._made.rule, self._made.repetitions,
                              self._made.seed + SEEDS * attempt, self._out / name, self._core)
        if not take_turns(new, base):
            say(f"{name}: one of the programs knows no --turns: they run one after the other, "
                "which tells less")
        results = {}
        if able:
            if self._is_gpu is None:
                self._is_gpu = new.draws_on_gpu(able[0].split("/")[0])
            tier = TimingTier(options, new, base, self._is_gpu, None)
            results = tier.run(able, lambda text: say(f"{name}: {text}"))
        return {cell: results.get(cell, LACKING) for cell in cells}

    def _forget(self):
        """Takes away programs that are not needed any more."""
        numbers = {0, len(self._made.line) - 1}
        for search in self._searches.values():
            numbers |= {search.good, search.bad}
        self._programs.remove_others(self._made.line[number].hash for number in numbers)

    def _check_space(self):
        check_space([ROOT, self._out])


def count_of(number, what):
    """As a text."""
    return f"{number} {what}{'s' * (number != 1)}"


def one_line(error):
    """Its message."""
    return " ".join(str(error).split())
