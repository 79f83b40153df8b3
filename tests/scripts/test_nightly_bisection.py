"""The order of things in scripts/nightly.sh --bisect, with scripted measurements of commits "0" (good)
to "4" (bad)."""

import json
import types

import pytest

pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

from made_up_nights import CELL  # noqa: E402
from made_up_nights import make_verdict as verdict  # noqa: E402
from tracking import bisection  # noqa: E402
from tracking.bisect_report import as_data, make_summary  # noqa: E402
from tracking.commit_line import Commit  # noqa: E402
from tracking.core import ANY  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402
from tracking.timing import SAME, SLOW, UNCLEAR, Rule, Verdict  # noqa: E402
from tracking.timing_tier import CellResult  # noqa: E402

OTHER = "courtyard/bool"
SLOWER, UNCHANGED = verdict(SLOW, 0.09, 0.11), verdict(SAME, -0.01, 0.01)
DOUBTFUL = verdict(UNCLEAR, 0.0, 0.1)
CHANGED_AT_3 = {"1": UNCHANGED, "2": UNCHANGED, "3": SLOWER, "4": SLOWER, ("3", "2"): SLOWER}


class ScriptedPrograms:
    """strategies: {commit: ids}. fails: commits that do not build."""

    def __init__(self, fails=(), strategies=None):
        self.fails, self.strategies = fails, strategies or {}
        self.there, self.built = set(), []

    def get(self, commit):
        if commit in self.fails:
            raise TrackingError(f"{commit}:\nno such thing")
        if commit not in self.there:
            self.there.add(commit)
            self.built.append(commit)
        return fake_program(commit, self.strategies.get(commit, ["coh-b", "bool"]))

    def remove_others(self, kept):
        self.there &= set(kept)


def fake_program(commit, strategies):
    return type("P", (), {"name": commit, "takes_turns": commit != "1",
                          "list_strategies": lambda self: strategies})()


@pytest.fixture
def bisect(monkeypatch, tmp_path):
    """bisect(script, cells, **) gives a Bisection, its programs and what was measured: (new, base,
    cells, seed). script: {commit or (commit, base): Verdict, Verdicts of attempts, or {cell: one}}.
    """

    def run(script, cells=(CELL,), ratios=(), **programs):
        measured, programs = [], ScriptedPrograms(**programs)

        class Tier:
            def __init__(self, options, new, base, *_):
                self.what = new.name, base.name
                self.seed = options.seed
                assert {new.name, base.name} <= programs.there

            def run(self, able, say):
                say("progress")
                measured.append((*self.what, able, self.seed))
                said = script[self.what if self.what in script else self.what[0]]
                if isinstance(said, list):
                    said = said.pop(0)
                of_cell = said if isinstance(said, dict) else dict.fromkeys(able, said)
                samples = {"ratios": {"frame": list(ratios)}}
                return {cell: CellResult(of_cell[cell], samples, {"frame": of_cell[cell]})
                        for cell in able}

        monkeypatch.setattr(bisection, "TimingTier", Tier)
        line = [Commit(str(n), f"subject {n}", str(n - 1) if n else None) for n in range(5)]
        made = bisection.Bisection(line, Rule(), 9, 7)
        options = types.SimpleNamespace(out=tmp_path, core=ANY)
        bisection.Run(made, programs, options).find(cells)
        json.dumps(as_data(made))
        return made, programs, measured

    return run


def found(made, cell=CELL):
    return [commit.hash for commit in made.culprits[cell].candidates]


def test_each_measurement_has_a_seed_and_only_what_is_needed_stays(bisect):
    made, programs, measured = bisect(CHANGED_AT_3)
    assert found(made) == ["3"] and "confirmed |" in make_summary(made)
    assert [m[:2] for m in measured] == [("4", "0"), ("2", "0"), ("3", "0"), ("3", "2")]
    assert measured[0][3] == 7 and measured[-1][3] not in (7, 8)
    assert programs.there == {"0", "2", "3", "4"}
    assert sorted(programs.built) == ["0", "2", "3", "4"]  # once, for the confirmation too
    made, programs, _ = bisect({"1": SLOWER, "2": SLOWER, "4": SLOWER})
    assert found(made) == ["1"] and programs.there == {"0", "1", "4"}


def test_programs_that_cannot_take_turns_are_named(bisect, capsys):
    bisect({"1": SLOWER, "2": SLOWER, "4": SLOWER})
    said = [line for line in capsys.readouterr().err.splitlines() if "--turns" in line]
    assert [line.split(":")[1] for line in said] == [" 1", " 1-parent"]


def test_what_cannot_be_told_is_measured_again_and_then_decided(bisect):
    made, _, measured = bisect({**CHANGED_AT_3, "2": [DOUBTFUL, UNCHANGED]})
    assert found(made) == ["3"]
    again = [m for m in measured if m[:2] == ("2", "0")]
    assert len(again) == 2 and abs(again[0][3] - again[1][3]) > 1  # a tier uses two seeds


def test_the_pairs_of_both_attempts_are_taken_together(bisect):
    """Five pairs cannot have a p below 0.05; ten can."""
    script = {**CHANGED_AT_3, "2": [DOUBTFUL, DOUBTFUL]}
    assert found(bisect(script)[0]) == ["2", "3"]
    script["2"] = [DOUBTFUL, DOUBTFUL]
    assert found(bisect(script, ratios=[0.98, 0.99, 1.0, 1.01, 1.02])[0]) == ["3"]


def test_what_cannot_be_told_twice_is_skipped_with_the_reason(bisect):
    doubtful = Verdict(UNCLEAR, "the reason", 0.05, 0.0, 0.1)
    made, _, measured = bisect({**CHANGED_AT_3, "2": [doubtful, doubtful]})
    assert found(made) == ["2", "3"] and made.culprits[CELL].own is None
    assert len([m for m in measured if m[0] == "2"]) == 2
    assert f"- `2` subject 2: {CELL}: the reason" in make_summary(made)


def test_what_does_not_run_or_lacks_the_strategy_is_skipped(bisect):
    made, _, measured = bisect(CHANGED_AT_3, fails=("2",))
    assert found(made) == ["2", "3"]
    assert "- `2` subject 2: 2: no such thing" in make_summary(made)
    made, _, measured = bisect(CHANGED_AT_3, strategies={"2": ["bool"]})
    assert found(made) == ["2", "3"] and "2" not in [m[0] for m in measured]
    assert "no such strategy" in make_summary(made)


def test_a_strategy_that_the_good_commit_lacks_cannot_be_told(bisect):
    made, _, measured = bisect(CHANGED_AT_3, [CELL, OTHER], strategies={"0": ["coh-b"]})
    assert found(made) == ["3"] and OTHER not in made.culprits
    assert all(m[2] == [CELL] for m in measured)


def test_only_changed_cells_are_measured_and_each_has_its_commit(bisect):
    third = "courtyard/sw-b"
    programs = {str(n): ["coh-b", "bool", "sw-b"] for n in range(5)}
    both, one = {CELL: SLOWER, OTHER: SLOWER}, {CELL: UNCHANGED, OTHER: SLOWER}
    script = {"4": {**both, third: UNCHANGED}, "1": one, "2": one, "3": both,
              ("3", "2"): SLOWER, ("1", "0"): [one, SLOWER]}
    made, _, measured = bisect(script, [CELL, OTHER, third], strategies=programs)
    assert found(made) == ["3"] and found(made, OTHER) == ["1"]
    assert all(third not in m[2] for m in measured[1:])
    assert [m[2] for m in measured if m[0] == "2"] == [[CELL, OTHER]]


@pytest.mark.parametrize("own, said", [
    (verdict(SLOW, 0.02, 0.04), "less than half of the change: bisect from 3 for the rest"),
    (UNCHANGED, "not confirmed: against its parent SAME")])
def test_a_commit_that_is_not_all_of_it_is_said(bisect, own, said):
    made, _, _ = bisect({**CHANGED_AT_3, ("3", "2"): own})
    assert found(made) == ["3"] and said in make_summary(made) and made.is_slower


def test_a_full_disk_ends_it_and_is_no_reason_to_skip(bisect, monkeypatch):
    monkeypatch.setattr(bisection, "check_space", raise_no_space)
    with pytest.raises(TrackingError, match="no space"):
        bisect(CHANGED_AT_3)


def raise_no_space(_):
    raise TrackingError("no space")
