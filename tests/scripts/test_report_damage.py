"""report.py: damaged folders. The page names what is wrong and shows the rest; nothing crashes."""

import json
import shutil

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

import fake_run  # noqa: E402
import report_page  # noqa: E402
from fake_pictures import save  # noqa: E402
from report.cli import main  # noqa: E402
from result_folder import ResultError, read_run  # noqa: E402

FRAMES = (3, 10, 20)


@pytest.fixture
def report(tmp_path, run_script):
    """report(DIR...): the finished process and the path that the page would have."""
    library = report_page.add_library(tmp_path / "library")

    def make(*arguments):
        out = tmp_path / "out.html"
        done = run_script("report.py", "--hlodbench", "none", "--plot-library", library,
                          "--out", out, *arguments)
        assert "Traceback" not in done.stderr
        return done, out

    return make


@pytest.fixture
def fake(tmp_path):
    return fake_run.make_run(tmp_path / "a", image_frames=FRAMES, size=(100, 80))


def shown_frames(page):
    return page.json["scene-0-data"]["pictures"]["frames"]


@pytest.mark.parametrize("damage", ["gone", "text", "cut", "size", "empty"])
def test_wrong_picture(fake, report, damage):
    path = fake.folder / "images" / "coh-b.00010.png"
    if damage == "gone":
        path.unlink()
    elif damage == "size":
        save(path, np.zeros((8, 8, 3)))
    else:
        content = {"text": b"no picture", "cut": path.read_bytes()[:-100], "empty": b""}[damage]
        path.write_bytes(content)
    done, out = report(fake.folder)
    assert done.returncode == 0
    page = report_page.Page(out)
    assert len(page.problems()) == 1 and "coh-b.00010.png: expected" in page.problems()[0]
    entry = shown_frames(page)[1]
    assert "coh-b" not in entry["shown"] and "simp-b" in entry["shown"]
    assert "coh-b" in shown_frames(page)[0]["shown"]


def test_wrong_reference_picture(fake, report):
    (fake.folder / "images" / "bool.00010.png").write_bytes(b"")
    done, out = report(fake.folder)
    page = report_page.Page(out)
    assert done.returncode == 0 and len(page.problems()) == 1
    assert set(shown_frames(page)[1]["against"]) == {"full"}
    assert set(shown_frames(page)[0]["against"]) == {"full", "bool"}


def test_frame_without_entry(fake, report):
    fake.images["strategies"][3]["frames"].pop(1)
    fake.images["frames"].append(35)
    fake_run.write_json(fake.folder / "images" / "images.json", fake.images)
    done, out = report(fake.folder)
    page = report_page.Page(out)
    assert done.returncode == 0
    assert any("frame 10: expected a picture of coh-b" in p for p in page.problems())
    assert any("frame 35: expected a picture of bool" in p for p in page.problems())
    assert [e["frame"] for e in shown_frames(page)] == [3, 10, 20, 35]


@pytest.mark.parametrize("text", ["", "{", "[]", "null", '{"schema_version": "2.0.0"}',
                                  '{"schema_version": "1.0.0", "frames": 7}'])
def test_wrong_list_of_pictures(fake, report, text):
    (fake.folder / "images" / "images.json").write_text(text, encoding="utf-8")
    done, out = report(fake.folder)
    page = report_page.Page(out)
    assert done.returncode == 0 and len(page.problems()) == 1
    assert "images.json" in page.problems()[0]
    assert page.json["scene-0-data"]["pictures"] is None and page.json["scene-0-data"]["series"]


def test_frame_log_cut_short(fake, report):
    for repetition in (0, 1):
        path = fake.folder / f"coh-b.{repetition}.csv"
        path.write_text("\n".join(path.read_text(encoding="utf-8").splitlines()[:11]) + "\n12,0",
                        encoding="utf-8")
    done, out = report(fake.folder)
    page = report_page.Page(out)
    assert done.returncode == 0 and len(page.problems()) == 2
    values = page.json["scene-0-data"]["series"]["dn"]["coh-b"]
    assert len(values) == 40 and None not in values[:10] and set(values[10:]) == {None}


def test_every_frame_log_lost(fake, report):
    for path in fake.folder.glob("*.csv"):
        path.unlink()
    done, out = report(fake.folder)
    page = report_page.Page(out)
    assert done.returncode == 0 and len(page.problems()) == 8
    assert "there is nothing to plot" in page.text and len(shown_frames(page)) == 3


def change(run, *keys, value):
    """Sets a member of run.json, "drop" takes it out; gives the path as the message has it."""
    place = run.data
    for key in keys[:-1]:
        place = place[key]
    if value == "drop":
        del place[keys[-1]]
    else:
        place[keys[-1]] = value
    fake_run.write_json(run.folder / "run.json", run.data)


@pytest.mark.parametrize("keys", [("scene",), ("scene", "name"), ("session",), ("cases",),
                                  ("session", "frames"), ("context",), ("cases", 2, "strategy"),
                                  ("cases", 0, "csv"), ("missing",)])
@pytest.mark.parametrize("value", ["drop", 7.5, [3], True])
def test_wrong_member_is_named(fake, keys, value):
    optional = keys in (("cases", 0, "csv"), ("missing",))
    change(fake, *keys, value=value)
    if optional and value == "drop":
        read_run(fake.folder)
        return
    with pytest.raises(ResultError) as refusal:
        read_run(fake.folder)
    message = str(refusal.value)
    assert message.startswith(f"{fake.folder / 'run.json'}: {keys[0]}") and "\n" not in message
    assert "expected" in message and "found" in message


def test_other_folders_are_shown_when_one_is_unusable(fake, report, tmp_path):
    other = tmp_path / "b"
    shutil.copytree(fake.folder, other)
    change(fake, "schema_version", value="0.9.0")
    done, out = report(fake.folder, other, tmp_path / "nowhere")
    page = report_page.Page(out)
    assert done.returncode == 0
    assert any("schema_version: expected 1.x, found &#39;0.9.0&#39;" in p for p in page.problems())
    assert any("nowhere/run.json" in p for p in page.problems())
    assert "scene-0-data" in page.json and "scene-1-data" not in page.json


def test_nothing_usable_is_refused(report, tmp_path):
    (tmp_path / "out.html").write_text("what was there", encoding="utf-8")
    done, out = report(tmp_path / "nowhere", tmp_path / "neither")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    assert "nowhere/run.json" in done.stderr and "neither/run.json" in done.stderr
    assert out.read_text(encoding="utf-8") == "what was there"


def test_missing_plot_library_is_refused(fake, run_script, tmp_path):
    done = run_script("report.py", fake.folder, "--plot-library", tmp_path)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    assert "dygraph.min.js" in done.stderr and "libjs-dygraphs" in done.stderr


def test_unwritable_output_is_refused_and_leaves_nothing(fake, report, tmp_path):
    done, _ = report(fake.folder, "--out", tmp_path / "no" / "where.html")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    (tmp_path / "folder.html").mkdir()
    done, _ = report(fake.folder, "--out", tmp_path / "folder.html")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    assert not list(tmp_path.glob("*.tmp"))


@pytest.mark.parametrize("options", [["--max-size", "0"], ["--max-size", "nan"], []])
def test_wrong_usage_is_refused(run_script, tmp_path, options):
    assert run_script("report.py", *options, *([tmp_path] if options else [])).returncode == 2


def test_default_places(fake, run_script, tmp_path):
    library = report_page.add_library(tmp_path / "library")
    shutil.copytree(fake.folder, tmp_path / "b")
    fixed = ("--plot-library", library, "--hlodbench", "none")
    assert run_script("report.py", fake.folder, *fixed).returncode == 0
    assert (fake.folder / "report.html").is_file()
    assert run_script("report.py", fake.folder, tmp_path / "b", *fixed).returncode == 0
    assert (tmp_path / "report.html").is_file()


def test_same_folder_twice_is_shown_once(fake, report):
    done, out = report(fake.folder, fake.folder)
    assert done.returncode == 0 and "scene-1-data" not in report_page.Page(out).json


JUNK = (None, True, -1, 0, 2.5, 10**30, "", "a\0b", "../x", [], [None], {}, {"y": "z"})


def list_places(tree, path=()):
    """Paths of keys to everything in a tree of JSON."""
    pairs = tree.items() if isinstance(tree, dict) else enumerate(tree) \
        if isinstance(tree, list) else ()
    for key, value in pairs:
        yield (*path, key)
        yield from list_places(value, (*path, key))


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("name", ["run.json", "images/images.json"])
def test_junk_anywhere_never_crashes(tmp_path, name, seed, capsys):
    made = fake_run.make_run(tmp_path / "a", strategies=("bool", "coh-b"), frames=12,
                             image_frames=(3, 8), size=(24, 18), missing=[("coh-b", 1)])
    library = report_page.add_library(tmp_path / "library")
    rng = np.random.default_rng(seed)
    whole = json.dumps(made.data if name == "run.json" else made.images)
    places = list(list_places(json.loads(whole)))
    for place in rng.choice(len(places), 12, replace=False):
        tree = json.loads(whole)
        inner = tree
        for key in places[place][:-1]:
            inner = inner[key]
        inner[places[place][-1]] = JUNK[rng.integers(len(JUNK))]
        fake_run.write_json(made.folder / name, tree)
        code = main([str(made.folder), "--out", str(tmp_path / "out.html"), "--hlodbench", "none",
                     "--plot-library", str(library)])
        error = capsys.readouterr().err
        assert code in (0, 2) and len(error.splitlines()) == 1, (places[place], error)


def test_numbers_that_json_has_not(fake, report):
    entry = fake.images["strategies"][3]["frames"][0]
    entry["vs_reference"] = {"y": float("nan"), "cb": float("inf"), "cr": 1.0}
    fake_run.write_json(fake.folder / "images" / "images.json", fake.images)
    done, out = report(fake.folder)
    assert done.returncode == 0
    text = next(t for a, t in report_page.Page(out).scripts if a.get("id") == "scene-0-data")
    assert json.loads(text, parse_constant=pytest.fail)
