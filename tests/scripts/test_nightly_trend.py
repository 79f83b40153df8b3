"""scripts/nightly.sh trend: what the page of the history says, and what it makes of damage."""

import json
import pathlib
import re
import resource
import subprocess
import sys

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("jinja2", reason="needs python3-jinja2")
pytest.importorskip("PIL", reason="needs python3-pil")

import made_up_trend  # noqa: E402
import report_page  # noqa: E402
from made_up_nights import (CELL, KEY, add_night, make_acceptance, make_night,  # noqa: E402
                            make_times)
from made_up_trend import DN_FROM, KEYS, SLOWER_FROM, UNTIMED  # noqa: E402
from tracking.commits import find_subjects  # noqa: E402
from tracking.history import append  # noqa: E402
from tracking.trend_nights import describe_cell, find_links  # noqa: E402
from tracking.trend_series import find_runs, list_counters, make_series  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
EVIL = "</script><img src=x onerror=alert(1)> & \"'<!--"


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    return report_page.add_library(tmp_path_factory.mktemp("library"))


@pytest.fixture
def trend(tmp_path, library):
    """Runs it on tmp_path/history."""

    def run(*arguments, **options):
        return subprocess.run(
            [sys.executable, ROOT / "scripts/nightly.py", "trend", "--history",
             tmp_path / "history", "--out", tmp_path / "out/trend.html", "--plot-library", library,
             *map(str, arguments)],
            cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120, **options)
    return run


def page_of(tmp_path):
    return report_page.Page(tmp_path / "out/trend.html")


def data_of(page, machine=0):
    return page.json[f"machine-{machine}-data"]


def unfold(runs):
    return [value for value, count in runs for _ in range(count)]


# The numbers


def test_every_number_of_the_history_is_on_the_page(tmp_path, trend):
    ids = made_up_trend.write_history(tmp_path / "history")
    done = trend()
    assert done.returncode == 0 and done.stdout == "", done.stderr
    assert "100 nights of 2 machines" in done.stderr
    data = data_of(page_of(tmp_path))
    assert data["key"] == KEYS[0] and [night["id"] for night in data["nights"]] == ids
    files = [json.loads((tmp_path / "history" / KEYS[0] / f"{name}.json").read_text())
             for name in ids]
    for cell, values in files[0]["exact"].items():
        scene, strategy = cell.split("/")
        for key in (k for k, v in values.items() if not isinstance(v, str)):
            line = data["series"][scene][key][strategy]
            assert unfold(line["runs"]) == [file["exact"][cell][key] for file in files]
    for strategy in made_up_trend.STRATEGIES:
        for key in ("time.ms", "time.ratio", "time.normalised"):
            line = data["series"]["courtyard"][key][strategy]
            for i, file in enumerate(files):
                row = [line[name][i] for name in ("low", "values", "high")]
                if i in UNTIMED:
                    assert row == [None] * 3
                    continue
                sample = file["timing"]["cells"][f"courtyard/{strategy}"]
                new = np.array(sample["new"])
                expected = {"time.ms": np.median(new),
                            "time.ratio": np.median(new / sample["base"]),
                            "time.normalised": np.median(new) / sample["calibration"]}[key]
                assert row[1] == pytest.approx(expected, rel=1e-5)
                assert row[0] <= row[1] <= row[2] and row[0] < row[2]


def test_stages_beside_the_baseline_have_lines_from_when_they_were_measured(tmp_path, trend):
    made_up_trend.write_history(tmp_path / "history")
    trend()
    series = data_of(page_of(tmp_path))["series"]["courtyard"]
    frames, draws = (series[key]["coh-b"]["values"] for key in ("time.ratio", "time.ratio.draw"))
    for i, (frame, draw) in enumerate(zip(frames, draws)):
        if i in UNTIMED or i < made_up_trend.STAGES_FROM:
            assert draw is None
        else:
            assert draw == pytest.approx(frame ** 2, rel=1e-4)
    assert "time.ratio.query" not in series


def test_change_points_are_where_the_history_changes(tmp_path, trend):
    made_up_trend.write_history(tmp_path / "history")
    trend()
    page = page_of(tmp_path)
    series = data_of(page)["series"]["courtyard"]
    assert [c[0] for c in series["dn"]["coh-b"]["changes"]] == [DN_FROM]
    assert series["dn"]["coh-b"]["changes"][0][1:] == [125.5, 123.25]
    assert [c[0] for c in series["time.ratio"]["coh-b"]["changes"]] == [SLOWER_FROM]
    assert series["dn"]["bool"]["changes"] == series["time.ratio"]["bool"]["changes"] == []
    assert data_of(page, 1)["series"]["courtyard"]["time.ratio"]["coh-b"]["changes"] == []


def test_a_night_says_what_it_was_and_who_accepted_it(tmp_path, trend):
    made_up_trend.write_history(tmp_path / "history")
    (tmp_path / "nightly/3").mkdir(parents=True)
    (tmp_path / "nightly/3/summary.md").write_text("x", encoding="utf-8")
    trend()
    page = page_of(tmp_path)
    nights = data_of(page)["nights"]
    night = nights[DN_FROM]
    assert night["regression"] and "1 DIFFERENT" in night["verdict"]
    assert night["accepted"] == [{"time_utc": "2026-06-01T04:00:00Z", "who": "A. Nother",
                                  "why": made_up_trend.WHY, "cells": ["courtyard/coh-b"]}]
    exact, timing, why = night["cells"]["courtyard/coh-b"]
    assert (exact, timing) == ("DIFFERENT", "SAME")
    assert why.startswith("dn 125.5 -> 123.25") and "and 3 more" in why
    assert nights[3]["links"] == [["summary", "./../nightly/3/summary.md"]]
    assert (tmp_path / "out" / nights[3]["links"][0][1]).is_file()
    assert nights[4]["links"] == []
    rows = page.rows("verdicts")
    assert rows["courtyard/coh-b"] == ["SAME", "SAME", "+0.1 % [-1.0, +1.0]",
                                       "interval within +-3 %"]
    assert len(page.rows("nights")) == 61


def test_machines_can_be_chosen(tmp_path, trend):
    made_up_trend.write_history(tmp_path / "history", 3)
    assert trend("--machine", "lab").returncode == 0
    page = page_of(tmp_path)
    assert data_of(page)["key"] == KEYS[1] and "machine-1-data" not in page.json
    assert trend("--machine", "lab", "--machine", "a-").returncode == 0
    assert data_of(page_of(tmp_path), 1)["key"] == KEYS[1]
    done = trend("--machine", "lab", "--machine", "nobody")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1 and "nobody" in done.stderr


@pytest.mark.parametrize("nights", [1, 2, 400])
def test_few_and_many_nights_make_a_page_of_moderate_size(tmp_path, trend, nights):
    made_up_trend.write_history(tmp_path / "history", nights)
    assert trend().returncode == 0
    assert len(data_of(page_of(tmp_path))["nights"]) == nights
    assert (tmp_path / "out/trend.html").stat().st_size < 50_000 + 2000 * nights


def test_nights_without_a_counter_or_cell_have_none():
    nights = [make_night(1), make_night(2), make_night(3)]
    nights[1]["exact"] = {}
    nights[2]["exact"][CELL]["queries"] = 7
    series = make_series(nights)["courtyard"]
    assert unfold(series["dn"]["coh-b"]["runs"]) == [100.0, None, 100.0]
    assert unfold(series["queries"]["coh-b"]["runs"]) == [None, None, 7]
    assert series["dn"]["coh-b"]["changes"] == [] and "dn.frames" not in series
    assert [c["key"] for c in list_counters([{"s": {"dn": {}, "time.ms": {}}}])] == ["time.ms", "dn"]
    assert find_runs([1, 1, None, None, 1]) == [[1, 2], [None, 2], [1, 1]]


@pytest.mark.parametrize("new, base", [(1e308, 1e-308), (1e-308, 1e308), (5e-324, 1.0)])
def test_absurd_times_are_no_end_of_the_page(tmp_path, trend, new, base):
    night = make_night(1)
    night["timing"] = make_times(new=[new] * 3, base=[base] * 3)
    append(tmp_path / "history", KEY, night, "a")
    assert trend().returncode == 0
    assert data_of(page_of(tmp_path))["nights"]


def test_a_number_that_is_too_large_is_damage(tmp_path, trend):
    add_night(tmp_path / "history", 1)
    add_night(tmp_path / "history", 2, dn=10**400)
    done = trend()
    assert done.returncode == 0 and "expected a number" in done.stderr
    assert len(data_of(page_of(tmp_path))["nights"]) == 1


# Text of files


def test_text_of_files_never_becomes_markup(tmp_path, trend):
    night = make_night(1)
    night["revision"] = night["time_utc"] = EVIL
    cell = f"{EVIL}/{EVIL}"
    night["exact"] = {cell: {EVIL: 1.5}}
    night["verdicts"] = {cell: {"exact": {"verdict": EVIL}, "timing": {"verdict": EVIL,
                                                                       "reason": EVIL}}}
    night["context"] = {"results": "../" + EVIL}
    night["machine"] = {**night["machine"], "cpu_model": EVIL}
    (path := tmp_path / "history" / KEY).mkdir(parents=True)
    (path / "a.json").write_text(json.dumps({"schema": 1, **night}), encoding="utf-8")
    for entry in (make_acceptance(2, "a"), make_acceptance(3, EVIL)):
        append(tmp_path / "history", KEY, {**entry, "who": EVIL, "why": EVIL}, "accept")
    assert trend().returncode == 0
    page = page_of(tmp_path)
    assert not [a for tag, a in page.elements if tag == "img" or "onerror" in a]
    assert EVIL not in page.source and page.text.count(EVIL) >= 8
    assert data_of(page)["nights"][0]["accepted"][0]["why"] == EVIL
    # The page's own scripts are all there is, and their hashes are those allowed.
    policy = next(a["content"] for _, a in page.elements if "http-equiv" in a)
    scripts = [a for tag, a in page.elements if tag == "script"]
    assert len([a for a in scripts if a.get("type") != "application/json"]) == 2
    assert policy.count("'sha256-") == 2 and "default-src 'none'" in policy
    assert not re.search(r'(?:src|href)="(?!#)', page.source.split("<script")[0])


def test_links_lead_to_files_that_are_there_and_nowhere_else(tmp_path):
    history, page = tmp_path / "history", tmp_path / "a b" / "trend.html"
    for place in ("javascript:alert(1)", "x y", "#?"):
        (history / place).mkdir(parents=True)
        (history / place / "summary.md").write_text("", encoding="utf-8")
    for place, expected in (("javascript:alert(1)", "./../history/javascript%3Aalert%281%29"),
                            ("x y", "./../history/x%20y"), ("#?", "./../history/%23%3F")):
        links = find_links({"context": {"results": place}}, history, page)
        assert links == [["summary", f"{expected}/summary.md"]]
    for context in (None, 3, {}, {"results": 3}, {"results": ""}, {"results": "no"},
                    {"results": "a\0b"}, {"results": "x" * 5000}, {"results": "https://a.b"}):
        assert find_links({"context": context}, history, page) == []


def test_verdicts_of_others_are_read_as_far_as_they_go():
    assert describe_cell({}) == describe_cell({"exact": None, "timing": None}) == ["", "", ""]
    for differences in (None, 3, [], [3], [{}], [{"key": 1, "old": [], "new": {}}]):
        cell = describe_cell({"exact": {"verdict": "DIFFERENT", "differences": differences}})
        assert cell[0] == "DIFFERENT" and isinstance(cell[2], str)


def test_subjects_are_those_of_git():
    def git(*arguments):
        return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True,
                              check=False).stdout.strip()
    head = git("rev-parse", "HEAD")
    if not head:
        pytest.skip("no git repository")
    subject, tree = git("log", "-1", "--format=%s"), git("rev-parse", "HEAD^{tree}")
    asked = ["0" * 40, head[:12], "unknown", head, f"{head[:12]}-dirty", tree, "-h", EVIL, "\n"]
    assert find_subjects(ROOT, asked) == {head[:12]: subject, head: subject,
                                          f"{head[:12]}-dirty": subject}
    assert find_subjects(ROOT / "none", asked) == {}


# Damage


def test_damage_is_named_on_the_page_and_on_stderr(tmp_path, trend):
    history = tmp_path / "history"
    made_up_trend.write_history(history, 3)
    other = (history / KEYS[1]).glob("*.json")
    (history / KEYS[0] / "foreign.json").write_bytes(next(other).read_bytes())
    (history / KEYS[0] / "broken.json").write_text("{", encoding="utf-8")
    (history / "Not A Machine").mkdir()
    (history / "stray.json").write_text("{}", encoding="utf-8")
    (history / ".gitignore").write_text("", encoding="utf-8")
    (history / "empty").mkdir()
    append(history, KEYS[0], {**make_acceptance(9, "lost"), "machine_key": KEYS[0]}, "accept")
    done = trend()
    assert done.returncode == 0
    problems = " ".join(page_of(tmp_path).problems())
    for name in ("foreign.json", "broken.json", "Not A Machine", "stray.json", "night lost"):
        assert name in problems and name in done.stderr, name
    assert ".gitignore" not in problems
    assert len(page_of(tmp_path).problems()) == 5 == len(done.stderr.splitlines()) - 1


@pytest.mark.parametrize("kind", ["absent", "empty", "machine without nights", "only damage"])
def test_a_history_without_nights_is_refused(tmp_path, trend, kind):
    folder = tmp_path / "history"
    if kind != "absent":
        folder.mkdir()
    if kind in ("machine without nights", "only damage"):
        (folder / KEY).mkdir()
    if kind == "only damage":
        (folder / KEY / "a.json").write_text("{", encoding="utf-8")
    done = trend()
    assert done.returncode == 2 and done.stdout == ""
    (line,) = done.stderr.splitlines()
    assert "expected nights, found none" in line
    assert ("a.json" in line) == (kind == "only damage")
    assert not (tmp_path / "out").exists()


def test_a_page_that_cannot_be_written_leaves_the_old_one(tmp_path, trend):
    add_night(tmp_path / "history", 1)
    assert trend().returncode == 0
    before = (tmp_path / "out/trend.html").read_bytes()
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["trend.html"]
    done = trend("--out", tmp_path / "out")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    done = trend("--plot-library", tmp_path)
    assert done.returncode == 2 and "dygraphs" in done.stderr
    done = trend(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000)))
    assert done.returncode == 2 and "too large" in done.stderr  # as on a disk that is full
    assert (tmp_path / "out/trend.html").read_bytes() == before
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["trend.html"]


@pytest.mark.parametrize("arguments", [("--no-such-option",), ("stray",), ("--out", ""),
                                       ("--machine",), ("--repetitions", "9")])
def test_wrong_usage_is_one_line(tmp_path, trend, arguments):
    add_night(tmp_path / "history", 1)
    done = trend(*arguments)
    assert done.returncode == 2 and done.stdout == "" and len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_every_option_stands_in_the_help():
    from tracking.cli import make_trend_parser
    done = subprocess.run([ROOT / "scripts/nightly.sh", "--help"], capture_output=True, text=True,
                          check=True)
    for action in make_trend_parser()._actions:  # pylint: disable=protected-access
        assert f"{action.option_strings[0]} " in done.stdout
