"""figures.py: lines and pictures are those of the folder, and what is missing is said."""

import os
import pathlib
import stat
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import fake_bias
import fake_run
import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("matplotlib")
Image = pytest.importorskip("PIL.Image")

FRAMES = (3, 10, 20)


def add_program(path, text):
    path.write_text(text, encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


@pytest.fixture
def program(tmp_path):
    """A stand-in for hlodbench that knows `bias`."""
    folder = str(pathlib.Path(fake_bias.__file__).parent)
    text = fake_bias.PROGRAM.format(python=sys.executable, folder=folder)
    return add_program(tmp_path / "a program", text)


@pytest.fixture
def figures(run_script, program, tmp_path):
    """Runs figures.py: figures(DIR, ..., program=...) gives a CompletedProcess and the folder."""

    def run(*arguments, program=program, out="made"):
        done = run_script("figures.py", *arguments, "--out", tmp_path / out, "--dpi", 60,
                          "--hlodbench", program)
        return done, tmp_path / out
    return run


def names(folder):
    return sorted(os.listdir(folder)) if folder.exists() else []


def lines(done):
    """What stderr says, each line from this script."""
    said = done.stderr.splitlines()
    assert all(line.startswith("figures.py: ") for line in said), done.stderr
    return said


def test_whole_folder_gives_every_figure_in_every_format(figures, tmp_path):
    fake_run.make_run(tmp_path / "run", scene="one", image_frames=FRAMES)
    done, made = figures(tmp_path / "run")
    assert (done.returncode, done.stderr) == (0, "")
    assert names(made) == ["fig1a.png", "fig1a.svg", "fig4_one.png", "fig4_one.svg",
                           "fig5_one.png", "fig5_one.svg"]
    assert sorted(done.stdout.splitlines()) == [str(made / name) for name in names(made)]


def test_figures_have_the_width_of_print(figures, tmp_path):
    fake_run.make_run(tmp_path / "run", image_frames=FRAMES)
    _, made = figures(tmp_path / "run")
    for name, width_mm in (("fig1a", 85), ("fig4_fake", 175), ("fig5_fake", 175)):
        root = ElementTree.parse(made / f"{name}.svg").getroot()
        assert float(root.get("width").removesuffix("pt")) == pytest.approx(width_mm / 25.4 * 72)
        with Image.open(made / f"{name}.png") as picture:
            assert picture.width == pytest.approx(width_mm / 25.4 * 60, abs=1)


def test_svg_names_strategies_in_text_of_8_points_or_more(figures, tmp_path):
    fake_run.make_run(tmp_path / "run", strategies=("bool", "simp-b", "coh-b", "mine"),
                      image_frames=FRAMES)
    _, made = figures(tmp_path / "run")
    for name, labels in (("fig4_fake", ("Bool", "Simp*(B)", "Coh(B)", "Mine")),
                         ("fig5_fake", ("Bool", "Simp*(B)", "Coh(B)")), ("fig1a", ("s = 1",))):
        root = ElementTree.parse(made / f"{name}.svg").getroot()
        texts = [e for e in root.iter() if e.tag.endswith("}text")]
        shown = " ".join("".join(e.itertext()) for e in texts)
        assert all(label in shown for label in labels)
        sizes = [float(e.get("style").split("px")[0].split()[-1]) for e in texts]
        assert min(sizes) >= 8


def test_same_input_gives_same_bytes(figures, tmp_path):
    fake_run.make_run(tmp_path / "run", image_frames=FRAMES)
    _, first = figures(tmp_path / "run", out="first")
    _, second = figures(tmp_path / "run", out="second")
    assert names(first) == names(second) != []
    for name in names(first):
        assert (first / name).read_bytes() == (second / name).read_bytes(), name


def test_other_input_gives_other_bytes(figures, tmp_path):
    for seed in (1, 2):
        fake_run.make_run(tmp_path / f"run {seed}", seed=seed, image_frames=FRAMES)
    _, first = figures(tmp_path / "run 1", out="first")
    _, second = figures(tmp_path / "run 2", out="second")
    for name in ("fig4_fake.svg", "fig4_fake.png", "fig5_fake.svg"):
        assert (first / name).read_bytes() != (second / name).read_bytes(), name


def test_only_what_was_asked_for(figures, tmp_path):
    fake_run.make_run(tmp_path / "run")
    done, made = figures(tmp_path / "run", "--figures", "4", "--formats", "svg",
                         program=tmp_path / "none")
    assert (done.returncode, done.stderr, names(made)) == (0, "", ["fig4_fake.svg"])


def test_scenes_of_one_name_and_of_odd_names_do_not_collide(figures, tmp_path):
    for i, scene in enumerate(("a", "a", "../b c", "a")):
        fake_run.make_run(tmp_path / f"run{i}", scene=scene)
    folders = [tmp_path / f"run{i}" for i in range(4)]
    done, made = figures(*folders, "--figures", "4", "--formats", "svg")
    assert done.returncode == 0
    assert names(made) == ["fig4_.._b_c.svg", "fig4_a-2.svg", "fig4_a-3.svg", "fig4_a.svg"]


def test_without_pictures_the_others_are_made(figures, tmp_path):
    fake_run.make_run(tmp_path / "run")
    done, made = figures(tmp_path / "run", "--formats", "svg")
    assert done.returncode == 1
    assert names(made) == ["fig1a.svg", "fig4_fake.svg"]
    assert len(lines(done)) == 1
    assert "fig5_fake: not made: " in done.stderr and "--images none" in done.stderr


PROGRAMS = {
    "no program": (None, "expected the program hlodbench: No such file"),
    "a failing one": ("#!/bin/sh\necho a >&2; echo the last line >&2; exit 2\n",
                      "exit code 2: the last line"),
    "no table": ("#!/bin/sh\n", "expected the columns s,t,mu,bias, found ''"),
    "another table": ("#!/bin/sh\necho mu,bias\n", "found 'mu,bias'"),
    "no samples": ("#!/bin/sh\necho s,t,mu,bias\n", "expected samples, found none"),
    "no number": ("#!/bin/sh\necho s,t,mu,bias; echo 0,1,x,1\n", ":2: expected s, t, mu, bias"),
    "not a number": ("#!/bin/sh\necho s,t,mu,bias; echo 0,1,1,nan\n",
                     ":2: expected s, t, mu, bias"),
    "too few": ("#!/bin/sh\necho s,t,mu,bias; echo 0,1,1\n", ":2: expected s, t, mu, bias"),
}


@pytest.mark.parametrize("case", PROGRAMS)
def test_without_the_program_s_table_the_others_are_made(figures, tmp_path, case):
    text, said = PROGRAMS[case]
    fake_run.make_run(tmp_path / "run", image_frames=FRAMES)
    bad = tmp_path / "bad program"
    if text:
        add_program(bad, text)
    done, made = figures(tmp_path / "run", "--formats", "svg", program=bad)
    assert done.returncode == 1
    assert names(made) == ["fig4_fake.svg", "fig5_fake.svg"]
    assert len(lines(done)) == 1 and "fig1a: not made: " in done.stderr and said in done.stderr


def test_failed_and_interrupted_cases_are_said_and_the_rest_is_drawn(figures, tmp_path):
    fake_run.make_run(tmp_path / "run", failed=[("sw-b", 0), ("sw-b", 1)], missing=[("bool", 1)],
                      image_frames=FRAMES)
    done, made = figures(tmp_path / "run", "--formats", "svg")
    assert done.returncode == 0 and len(names(made)) == 3
    assert len(lines(done)) == 3 and "sw-b, repetition 1, failed" in done.stderr
    text = (made / "fig4_fake.svg").read_text(encoding="utf-8")
    assert "INTERRUPTED" in text and "Coh(B)" in text and "SW(B)" not in text


def test_run_without_any_frames_has_no_fig4(figures, tmp_path):
    fake_run.make_run(tmp_path / "run", strategies=("bool",), repetitions=1,
                      failed=[("bool", 0)])
    done, made = figures(tmp_path / "run")
    assert done.returncode == 1 and names(made) == ["fig1a.png", "fig1a.svg"]
    assert "fig4_fake: not made: " in done.stderr and "expected measured frames" in done.stderr


@pytest.mark.parametrize("strategies", (("coh-b", "simp-b"), ("bool", "sw-b")))
def test_pictures_without_anything_to_compare(figures, tmp_path, strategies):
    fake_run.make_run(tmp_path / "run", strategies=strategies, image_frames=FRAMES)
    done, made = figures(tmp_path / "run", "--figures", "5")
    assert (done.returncode, names(made)) == (1, [])
    assert len(lines(done)) == 1 and "expected pictures of bool and of simp-b" in done.stderr


def test_pictures_of_another_format_are_refused(figures, tmp_path):
    fake = fake_run.make_run(tmp_path / "run", image_frames=FRAMES)
    fake.images["format"] = "exr"
    fake_run.write_json(fake.folder / "images" / "images.json", fake.images)
    done, _ = figures(tmp_path / "run", "--figures", "5")
    assert done.returncode == 1 and "format: expected png, found exr" in done.stderr


def test_damaged_picture_is_said_and_another_frame_shown(figures, tmp_path):
    fake = fake_run.make_run(tmp_path / "run", image_frames=FRAMES)
    path = fake.folder / "images" / "bool.00010.png"
    path.write_bytes(path.read_bytes()[:40])
    done, made = figures(tmp_path / "run", "--figures", "5", "--formats", "svg")
    assert done.returncode == 0 and names(made) == ["fig5_fake.svg"]
    assert len(lines(done)) == 1 and "bool.00010.png: expected a picture" in done.stderr


def test_no_picture_can_be_read(figures, tmp_path):
    fake = fake_run.make_run(tmp_path / "run", image_frames=FRAMES)
    for frame in FRAMES:
        (fake.folder / "images" / f"bool.{frame:05}.png").unlink()
    done, made = figures(tmp_path / "run", "--figures", "5")
    assert (done.returncode, names(made)) == (1, [])
    assert len(lines(done)) == 4 and "that can be read, found none" in done.stderr


BAD_USAGE = {
    "no folder": ([], "DIR"),
    "an unknown figure": (["run", "--figures", "1a,6"], "found '6'"),
    "an unknown format": (["run", "--formats", "pdf"], "expected some of svg,png, found 'pdf'"),
    "no format": (["run", "--formats", ""], "found ''"),
    "too few dots": (["run", "--dpi", "0"], "expected 50 to 1200 dots per inch, found '0'"),
    "dots of text": (["run", "--dpi", "many"], "found 'many'"),
    "no such folder": (["run", "nowhere"], "nowhere/run.json: expected the result"),
    "a file as output": (["run", "--out", "run/run.json"], "run.json: "),
}


@pytest.mark.parametrize("case", BAD_USAGE)
def test_bad_usage_is_one_line_and_makes_nothing(run_script, tmp_path, case):
    fake_run.make_run(tmp_path / "run")
    arguments, said = BAD_USAGE[case]
    done = run_script("figures.py", "--out", "made", *arguments)
    assert done.returncode == 2
    message = done.stderr.splitlines()[-1]
    assert message.startswith("figures.py: ") and said in message
    assert "Traceback" not in done.stderr
    assert names(tmp_path / "made") == []


def test_help_documents_the_exit_codes(run_script):
    done = run_script("figures.py", "--help")
    assert done.returncode == 0 and "Exit codes: 0" in done.stdout


def test_without_matplotlib_it_says_what_to_install(root, tmp_path):
    # A module of that name which cannot be imported stands in for the package's absence.
    (tmp_path / "matplotlib.py").write_text("raise ModuleNotFoundError('no', name='matplotlib')")
    done = subprocess.run([sys.executable, root / "scripts" / "figures.py", "a", "--out", "b"],
                          env={**os.environ, "PYTHONPATH": str(tmp_path)}, capture_output=True,
                          text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1 and "python3-matplotlib" in done.stderr


def test_curves_of_the_program_are_those_of_the_stand_in():
    """So the tests of the figure hold for the program, too."""
    from figure_bias import read_bias
    if "HLODBENCH_EXE" not in os.environ:
        pytest.skip("HLODBENCH_EXE does not name the program; run the tests by ctest")
    curves = read_bias(os.environ["HLODBENCH_EXE"])
    assert len(curves) == 9
    for (s, t), (mu, bias) in curves.items():
        expected = [fake_bias.compute_bias(s, t, m) for m in mu]
        np.testing.assert_allclose(bias, expected, atol=1e-6)
