"""report.py on sweeps: which numbers the page has for its heat-maps."""

import csv

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
pytest.importorskip("PIL", reason="needs python3-pil")
pytest.importorskip("yaml", reason="needs python3-yaml")

import fake_run  # noqa: E402
import report_page  # noqa: E402
from report.sweeps import order_values  # noqa: E402
from sweep_table import write_sweep  # noqa: E402


@pytest.fixture
def make_report(tmp_path, run_script):
    def make(*folders, code=0):
        done = run_script("report.py", *folders, "--out", tmp_path / "out.html", "--hlodbench",
                          tmp_path / "none", "--plot-library",
                          report_page.add_library(tmp_path / "library"))
        assert done.returncode == code, done.stderr
        return report_page.Page(tmp_path / "out.html") if code == 0 else done.stderr
    return make


def test_page_has_every_number_of_the_table(tmp_path, make_report):
    write_sweep(tmp_path / "mine")
    data = make_report(tmp_path / "mine").json["sweep-0-data"]
    keys = [p["key"] for p in data["parameters"]]
    assert keys == ["s", "latency", "option.simp"]
    assert data["parameters"][1]["values"] == ["draws:5", "draws:20", "gl"]
    counters = [c["key"] for c in data["counters"]]
    assert counters == ["dn", "frame_ms", "fps"]  # not the columns of facts, nor empty ones
    with open(tmp_path / "mine" / "sweep.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(data["rows"])
    for row, shown in zip(rows, data["rows"]):
        assert shown["strategy"] == row["strategy"]
        values = [p["values"][i] for p, i in zip(data["parameters"], shown["places"])]
        assert values == [row[key] for key in keys]
        assert shown["values"] == [float(row[c]) if row[c] else None for c in counters]


def test_runs_and_sweeps_share_a_page(tmp_path, make_report):
    write_sweep(tmp_path / "mine")
    fake_run.make_run(tmp_path / "run", scene="one")
    page = make_report(tmp_path / "mine", tmp_path / "run")
    assert {"scene-0-data", "sweep-0-data"} <= page.json.keys()
    assert "hlodbench: one, mine" in page.text and "all with scene walls, session path" in page.text
    alone = make_report(tmp_path / "mine")
    assert "scene-0-data" not in alone.json and "Table 1 is left out" not in alone.text


def test_table_that_cannot_be_read_is_a_problem(tmp_path, make_report):
    for name in ("mine", "empty", "torn"):
        write_sweep(tmp_path / name)
    (tmp_path / "empty" / "sweep.csv").write_text(
        (tmp_path / "mine" / "sweep.csv").read_text().splitlines()[0] + "\n")
    text = (tmp_path / "torn" / "sweep.csv").read_text()
    (tmp_path / "torn" / "sweep.csv").write_text(text[: len(text) // 2].rstrip("\n")[:-8])
    problems = make_report(*(tmp_path / name for name in ("mine", "empty", "torn"))).problems()
    assert len(problems) == 2
    assert "expected finished cells, found none" in problems[0]
    assert "fields, found fewer" in problems[1]
    said = make_report(tmp_path / "empty", code=2)
    assert said.count("\n") == 1 and "expected finished cells" in said


def test_values_are_in_the_order_of_their_numbers():
    for ordered in (["draws:0", "draws:5", "draws:20", "frames:1", "gl"],
                    ["64x48", "160x120", "1000x5"], ["0", "0.5", "1", "1e3"], ["last", "mean"]):
        assert order_values(reversed(ordered)) == ordered
