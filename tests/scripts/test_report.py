"""report.py: what the page says is what the folders and the program say."""

import base64
import hashlib
import json
import os
import re

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
pytest.importorskip("PIL", reason="needs python3-pil")

import fake_run  # noqa: E402
import report_page  # noqa: E402
from report import page as page_parts  # noqa: E402
from report import program_table, quality, series, styles  # noqa: E402
from result_folder import read_run  # noqa: E402

FRAMES = (3, 10, 20)


@pytest.fixture
def library(tmp_path):
    return report_page.add_library(tmp_path / "library")


@pytest.fixture
def make_report(tmp_path, run_script, library):
    """make_report(DIR..., options...) gives the page; the program is missing unless named."""

    def make(*arguments, out=None):
        out = out or tmp_path / "out.html"
        done = run_script("report.py", "--hlodbench", tmp_path / "none", "--plot-library", library,
                          "--out", out, *arguments)
        assert done.returncode == 0, done.stderr
        assert len(done.stderr.splitlines()) == 1 and str(out) in done.stderr
        return report_page.Page(out)

    return make


def row(folder, strategy, label, *numbers):
    return ",".join([str(folder), "scene1", "scene1", strategy, label, "2", "0", "70", "1",
                     *map(str, numbers)])


@pytest.fixture
def program(tmp_path):
    """A stand-in that knows the folder tmp_path/a."""
    folder = tmp_path / "a"
    return report_page.add_program(tmp_path / "program", [
        row(folder, "bool", "Bool", 135.98713, 0, 1.72, 26.6497, 28.1861, 1.1227, 1.062, 1.1268,
            0.0127, "scene 1", 217, "", "", 169.9, 1.13, ""),
        row(folder, "coh-b", "Coh(B)", 109.619, 0.1057, 1.4334, 29.4162, 30.5566, "", "", "",
            0.013, "scene 1", 183.3, 0.1, 4.7, 191.6, "", 0.0256)])


def test_table_one_is_what_the_program_prints(tmp_path, make_report, program):
    fake_run.make_run(tmp_path / "a", scene="scene1")
    page = make_report(tmp_path / "a", "--hlodbench", program)
    rows = page.rows("table-one")
    dash = ["–"] * 3
    assert rows["Bool"] == ["136.0", "217", "0.63", *dash, *dash, "26.6", "169.9", "0.16",
                            "1.12 [1.06, 1.13]", "1.13", "0.99", "28.2"]
    assert rows["Coh(B)"] == ["109.6", "183.3", "0.60", "0.11", "0.1", "1.06", "1.43", "4.7",
                              "0.30", "29.4", "191.6", "0.15", *dash, "30.6"]
    assert "Simp*/SW 1.196 (1.103)" in page.text
    # What is copied is the program's text to the letter, whatever is in it.
    assert page.json["texts"]["latex"] == report_page.LATEX
    csv = (program.parent / "table.csv").read_text(encoding="utf-8")
    assert page.json["texts"]["csv"] == csv


def test_share_of_the_oracle_has_a_column_where_the_run_has_one(tmp_path, make_report, program):
    fake_run.make_run(tmp_path / "a", scene="scene1")
    page = make_report(tmp_path / "a", "--hlodbench", program)
    assert "of Oracle's FPS" not in page.text
    rows = (program.parent / "table.csv").read_text(encoding="utf-8").splitlines()[1:]
    more = [row(tmp_path / "a", "oracle", "Oracle", 104, "", "", 60, 61, 0.5, "", "", "", "", "",
                "", "", "", "", "")]
    shares = ("0.4444,0.4,0.5", "0.49,,", ",,")
    with_limit = report_page.add_program(
        tmp_path / "other", [f"{r},{s}" for r, s in zip(rows + more, shares)],
        ",ours_limit_share,ours_limit_share_low,ours_limit_share_high")
    page = make_report(tmp_path / "a", "--hlodbench", with_limit)
    assert "of Oracle's FPS" in page.text
    last = {label: cells[-1] for label, cells in page.rows("table-one").items()}
    assert last["Bool"] == "44.4 % [40.0, 50.0]" and last["Coh(B)"] == "49.0 %"
    assert last["Oracle"] == "–"


def test_without_the_program_the_rest_is_there(tmp_path, make_report):
    fake_run.make_run(tmp_path / "a", image_frames=FRAMES)
    page = make_report(tmp_path / "a")
    assert "Table 1 is left out" in page.text and str(tmp_path / "none") in page.text
    assert page.json["texts"] == {}
    assert not any("data-copy" in attributes for _, attributes in page.elements)
    assert page.rows("quality") and page.json["scene-0-data"]["series"]


def test_folder_that_the_program_refuses_takes_no_other_away(tmp_path, make_report, program):
    fake_run.make_run(tmp_path / "a", scene="scene1")
    fake_run.make_run(tmp_path / "refused")
    page = make_report(tmp_path / "a", tmp_path / "refused", "--hlodbench", program)
    assert page.rows("table-one")["Coh(B)"][0] == "109.6"
    assert any("refused/run.json: cases: nonsense" in p for p in page.problems())


def test_real_program_and_report_agree(tmp_path, make_report, root):
    exe = os.environ.get("HLODBENCH_EXE")
    if not exe:
        pytest.skip("HLODBENCH_EXE does not name the program; run the tests by ctest")
    folder = root / "results" / "reference" / "llvmpipe" / "scene1"
    page = make_report(folder, "--hlodbench", exe)
    printed = {}
    for line in page.json["texts"]["markdown"].splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if "this run" in cells:  # the first table is Table 1
            printed.setdefault(cells[1], cells[3:-1])
    assert len(printed) == 4
    for label, cells in page.rows("table-one").items():
        if label.replace("*", "\\*") not in printed and label not in printed:
            continue
        dn, rarn, d, fps, frame_fps, speedup = printed.pop(
            label if label in printed else label.replace("*", "\\*"))
        assert [cells[0], cells[3], cells[6], cells[9], cells[12], cells[15]] == [
            dn, rarn, d, fps, speedup, frame_fps]
    assert not printed


def test_psnr_beside_that_of_the_paper(tmp_path, make_report):
    made = fake_run.make_run(tmp_path / "a", image_frames=FRAMES, scene="scene1")
    rows = make_report(tmp_path / "a").rows("quality")
    summary = made.images["strategies"][3]["summary"]
    y = summary["vs_reference"]["y"]
    assert rows["Coh(B)"][0] == f"{y['mean']:.2f} ± {y['stddev']:.2f}"
    assert rows["Coh(B)"][3] == (f"{summary['vs_full']['y']['mean']:.2f} ± "
                                 f"{summary['vs_full']['y']['stddev']:.2f}")
    assert rows["SW(B)"][:3] == ["3 identical"] * 3
    assert rows["Bool"][:3] == ["reference"] * 3
    assert rows["paper, scene 1"][:3] == ["42.84 ± 3.22", "67.04 ± 3.68", "56.20 ± 3.65"]


@pytest.mark.parametrize("statistic, text", [
    ({"mean": 42.804, "stddev": 3.2, "count": 18, "identical": 2}, "42.80 ± 3.20 (2 identical)"),
    ({"mean": 42.806, "stddev": None, "count": 1, "identical": 0}, "42.81"),
    ({"mean": None, "stddev": None, "count": 0, "identical": 20}, "20 identical"),
    ({"mean": float("nan"), "stddev": None}, "–"),
    ({"mean": "high"}, "–"), (None, "–"), ({}, "–"), ([], "–"),
])
def test_psnr_as_text(statistic, text):
    assert quality.format_psnr(statistic).replace("\N{NO-BREAK SPACE}", " ") == text


def test_series_are_those_of_the_frame_logs(tmp_path, make_report):
    made = fake_run.make_run(tmp_path / "a")
    data = make_report(tmp_path / "a").json["scene-0-data"]
    assert [s["id"] for s in data["strategies"]] == ["bool", "sw-b", "simp-b", "coh-b"]
    assert next(s["label"] for s in data["strategies"] if s["id"] == "simp-b") == "Simp*(B)"
    for counter, digits in (("dn", 2), ("rarn", 2), ("frame_ms", 3)):
        for strategy in fake_run.STRATEGIES:
            logs = [made.frames[strategy, r][counter] for r in (0, 1)]
            expected = (logs[0] + logs[1]) / 2  # of two, mean and median are the same
            assert data["series"][counter][strategy] == pytest.approx(
                list(expected), abs=0.5001 * 10**-digits)
    assert data["series"]["gpu_ms"]["bool"] == [None] * 40
    assert data["series"]["d"]["sw-b"] == [None] * 40


def test_stored_numbers_are_those_shown(tmp_path):
    fake_run.make_run(tmp_path)
    for value in series.make_series(read_run(tmp_path), "coh-b", "frame_ms"):
        assert float(f"{value:.3f}") == value


def test_runs_of_one_scene_can_be_told_apart(tmp_path, make_report):
    for name in ("a", "b", "c"):
        fake_run.make_run(tmp_path / name, scene="other" if name == "c" else "same")
    page = make_report(*(tmp_path / name for name in ("a", "b", "c")))
    assert page.rows("environment")["Scene"] == ["same (a)", "same (b)", "other"]
    for name in ("same (a)", "same (b)", "other"):
        assert f"Frames of {name}" in page.text


def test_environment_and_warnings(tmp_path, make_report):
    fake_run.make_run(tmp_path / "a", missing=[("coh-b", 1)])
    page = make_report(tmp_path / "a")
    rows = page.rows("environment")
    assert rows["OpenGL renderer"] == ["llvmpipe"] and rows["Cores"] == ["2"]
    assert rows["Arguments"] == ["hlodbench run --out fake"] and rows["Build type"] == ["Release"]
    assert "node counts are valid" in page.text and "the run was interrupted" in page.text
    assert any("coh-b, repetition 1, is missing" in p for p in page.problems())


def test_page_needs_nothing_from_anywhere(tmp_path, make_report):
    fake_run.make_run(tmp_path / "a", image_frames=FRAMES)
    page = make_report(tmp_path / "a")
    for tag, attributes in page.elements:
        assert tag not in ("link", "iframe", "object", "base", "form")
        for name in ("src", "srcset", "action", "data", "poster"):
            assert name not in attributes, f"<{tag} {name}>"
        assert attributes.get("href", "#").startswith("#")
        assert not [name for name in attributes if name.startswith("on")]
    assert "sourceMappingURL" not in page.source
    styles_text = "".join(t for a, t in page.scripts if not a)
    assert "url(" not in styles_text and "@import" not in styles_text


def test_only_the_scripts_of_the_page_may_run(tmp_path, make_report):
    fake_run.make_run(tmp_path / "a")
    page = make_report(tmp_path / "a")
    policy = next(a["content"] for t, a in page.elements if t == "meta" and "http-equiv" in a)
    allowed = set(re.findall(r"'(sha256-[^']+)'", policy))
    bodies = re.findall(r"<script>(.*?)</script>", page.source, re.DOTALL)
    found = {"sha256-" + base64.b64encode(hashlib.sha256(b.encode()).digest()).decode()
             for b in bodies}
    assert found == allowed and len(found) == 2
    assert "default-src 'none'" in policy and "'unsafe-inline'" not in policy.split("script-src")[1]


HOSTILE = '</script><img src=x onerror="alert(1)">'


def test_names_from_files_are_escaped(tmp_path, make_report):
    made = fake_run.make_run(tmp_path / "a", scene=HOSTILE, image_frames=FRAMES,
                             strategies=("bool", "coh-b", "x\"><svg onload=alert(1)>"[:9]))
    data = made.data
    data["context"].update(cpu_model=HOSTILE, warnings=[HOSTILE], arguments=[HOSTILE])
    for case in data["cases"]:
        case["label"] = HOSTILE
    fake_run.write_json(tmp_path / "a" / "run.json", data)
    page = make_report(tmp_path / "a")
    assert not any(tag == "img" and "onerror" in a for tag, a in page.elements)
    assert page.rows("environment")["Processor"] == [HOSTILE]
    assert page.json["scene-0-data"]["name"] == HOSTILE
    own = page_parts.PAGE_FOLDER.glob("*.js")
    for path in own:
        code = path.read_text(encoding="utf-8")
        for word in ("innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval("):
            assert word not in code, path.name


def test_json_that_cannot_end_its_element():
    value = {"a": "</script><!--&\u2028", "b": [1.5, None]}
    text = str(page_parts.dump_json(value))
    assert "<" not in text and ">" not in text and json.loads(text) == value
    assert page_parts.clean({"a": [float("nan"), float("inf"), 1.0]}) == {"a": [None, None, 1.0]}


def test_dark_colours_can_be_told_from_the_paper():
    for style in styles.make_styles([*fake_run.STRATEGIES, "mine", "other"]).values():
        color = [int(style["darkColor"][i : i + 2], 16) for i in (1, 3, 5)]
        assert styles.compute_contrast(color, styles.DARK_PAPER) >= styles.CONTRAST
    assert styles.compute_contrast((0, 0, 0), (255, 255, 255)) == pytest.approx(21)
    grey = styles.compute_contrast((119, 119, 119), (255, 255, 255))
    assert grey == pytest.approx(4.48, abs=0.01)


def test_dashes_of_the_paper():
    paper = program_table.read_paper(page_parts.PAGE_FOLDER.parents[2] / "results"
                                     / "paper_table1.json")
    assert program_table.is_dash("sw-b", "d", paper)
    assert program_table.is_dash("coh-b", "speedup", paper)
    assert not program_table.is_dash("coh-b", "d", paper)
    assert not program_table.is_dash("of-mine", "d", paper)
