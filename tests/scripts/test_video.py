"""make_video.py: the video has every picture in its place, whole, and is never half written."""

import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import time

import fake_run
import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("matplotlib")
pytest.importorskip("PIL")
from fake_pictures import save  # noqa: E402
from frame_rate import smooth_frame_rates  # noqa: E402
from result_folder import read_run  # noqa: E402
from video_frames import FrameComposer  # noqa: E402

needs_ffmpeg = pytest.mark.skipif(
    not (shutil.which("ffmpeg") and shutil.which("ffprobe")),
    reason="NO VIDEO IS TESTED: ffmpeg and ffprobe are not installed (Debian: ffmpeg)")
SIZE = (160, 120)


@pytest.fixture
def fake(tmp_path):
    return fake_run.make_run(tmp_path / "run", image_frames=range(10, 22), size=SIZE)


def probe(path):
    done = subprocess.run(
        ["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
         "stream=width,height,nb_read_frames,r_frame_rate,codec_name,pix_fmt,color_space",
         "-of", "json", path], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)["streams"][0]


def decode(path, size):
    """The frames of a video: (frames, height, width, 3) uint8."""
    done = subprocess.run(["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt",
                           "rgb24", "-"], capture_output=True, check=True)
    return np.frombuffer(done.stdout, dtype=np.uint8).reshape(-1, size[1], size[0], 3)


@needs_ffmpeg
@pytest.mark.parametrize("strategies, columns, rows", (
    (("coh-b",), 1, 1), (("simp-b", "coh-b"), 2, 1), (("bool", "simp-b", "coh-b"), 2, 2),
    (fake_run.STRATEGIES, 2, 2)))
def test_video_has_every_frame_and_the_size_of_the_grid(run_script, fake, tmp_path, strategies,
                                                        columns, rows):
    video = tmp_path / "a video.mp4"
    done = run_script("make_video.py", fake.folder, "--out", video, "--fps", 25, "--strategies",
                      ",".join(strategies))
    assert done.returncode == 0, done.stderr
    composer = FrameComposer(read_run(fake.folder), strategies)
    found = probe(video)
    assert (found["width"], found["height"]) == composer.size
    assert columns * SIZE[0] <= found["width"] <= columns * (SIZE[0] + 6)
    assert rows * SIZE[1] <= found["height"] <= rows * (SIZE[1] + 30)
    assert found["nb_read_frames"] == "12" and found["r_frame_rate"] == "25/1"
    assert (found["codec_name"], found["pix_fmt"]) == ("h264", "yuv420p")
    assert found["color_space"] == "bt709"


@needs_ffmpeg
def test_video_shows_the_pictures_in_place_and_order(run_script, fake, tmp_path):
    video = tmp_path / "video.mp4"
    done = run_script("make_video.py", fake.folder, "--out", video)
    assert done.returncode == 0, done.stderr
    composer = FrameComposer(read_run(fake.folder), list(fake_run.STRATEGIES))
    frames = decode(video, composer.size)
    assert len(frames) == 12
    for shown, frame in zip(frames, range(10, 22)):
        for strategy in fake_run.STRATEGIES:
            left, top, right, bottom = composer.picture_box(strategy)
            error = shown[top:bottom, left:right].astype(float) - fake.pictures[strategy, frame]
            assert np.sqrt((error**2).mean()) < 6, "what remains is compression"
        # A neighbouring frame is further away: the order is right.
        left, top, right, bottom = composer.picture_box("bool")
        distances = {f: np.abs(shown[top:bottom, left:right].astype(float)
                               - fake.pictures["bool", f]).mean() for f in range(10, 22)}
        assert min(distances, key=distances.get) == frame


@needs_ffmpeg
@pytest.mark.parametrize("color", ((220, 20, 20), (20, 200, 20), (20, 20, 220), (128, 128, 128)))
def test_colours_survive(run_script, tmp_path, color):
    def paint(pictures):
        for picture in pictures.values():
            picture[:] = color
    fake = fake_run.make_run(tmp_path / "run", strategies=("bool",), image_frames=(3,), size=SIZE,
                             edit=paint)
    done = run_script("make_video.py", fake.folder, "--out", "v.mp4")
    assert done.returncode == 0
    composer = FrameComposer(read_run(fake.folder), ["bool"])
    left, top, right, bottom = composer.picture_box("bool")
    shown = decode(tmp_path / "v.mp4", composer.size)[0, top + 8 : bottom - 8, left + 8 : right - 8]
    assert np.abs(shown.mean(axis=(0, 1)) - color).max() < 4


@needs_ffmpeg
def test_frames_that_are_not_consecutive_are_said(run_script, tmp_path):
    fake_run.make_run(tmp_path / "run", image_frames=(3, 4, 10, 20))
    done = run_script("make_video.py", tmp_path / "run", "--out", "v.mp4")
    assert done.returncode == 0
    assert "4 frames with pictures, 3 to 20, are not consecutive: the video jumps 2" in done.stderr
    assert probe(tmp_path / "v.mp4")["nb_read_frames"] == "4"


@needs_ffmpeg
def test_missing_picture_leaves_a_gap_and_is_said(run_script, fake, tmp_path):
    (fake.folder / "images" / "coh-b.00015.png").unlink()
    done = run_script("make_video.py", fake.folder, "--out", "v.mp4")
    assert done.returncode == 0
    assert "coh-b.00015.png: expected a picture, found none" in done.stderr
    assert probe(tmp_path / "v.mp4")["nb_read_frames"] == "12"


@needs_ffmpeg
def test_nothing_but_the_video_is_left(run_script, fake, tmp_path):
    folder = tmp_path / "videos"
    folder.mkdir()
    before = sorted(os.listdir(fake.folder / "images"))
    done = run_script("make_video.py", fake.folder, "--out", folder / "v.mp4",
                      env={**os.environ, "TMPDIR": str(folder)})
    assert done.returncode == 0
    assert os.listdir(folder) == ["v.mp4"]
    assert sorted(os.listdir(fake.folder / "images")) == before
    assert stat.S_IMODE((folder / "v.mp4").stat().st_mode) & 0o044 or os.umask(0) & 0o044


def test_composed_frame_has_the_exact_pictures(fake):
    run = read_run(fake.folder)
    composer = FrameComposer(run, list(fake_run.STRATEGIES))
    canvas = np.asarray(composer.compose(12))
    assert canvas.shape == (composer.size[1], composer.size[0], 3)
    for strategy in fake_run.STRATEGIES:
        left, top, right, bottom = composer.picture_box(strategy)
        np.testing.assert_array_equal(canvas[top:bottom, left:right], fake.pictures[strategy, 12])
        assert len(np.unique(canvas[top - 8 : top, left:right])) > 2, "the line above has text"


@pytest.mark.parametrize("size", ((64, 48), (63, 47), (641, 479)))
def test_video_frames_are_even_in_size(tmp_path, size):
    fake = fake_run.make_run(tmp_path, image_frames=(3,), size=size)
    for count in range(1, 5):
        composer = FrameComposer(read_run(fake.folder), list(fake_run.STRATEGIES[:count]))
        assert composer.size[0] % 2 == 0 == composer.size[1] % 2
        assert composer.compose(3).size == composer.size


def test_counters_are_those_of_the_frame_log(fake):
    run = read_run(fake.folder)
    composer = FrameComposer(run, list(fake_run.STRATEGIES))
    for strategy in fake_run.STRATEGIES:
        log = fake.frames[strategy, 0]
        words = composer.caption(strategy, 14).split()
        assert words[:3] == [run.label(strategy), "frame", "14"]
        assert words[words.index("DN") + 1] == f"{log['dn'][14]:.0f}"
        assert words[words.index("RARN") + 1] == f"{log['rarn'][14]:.0f}"
        assert words[words.index("FPS") - 1] == f"{smooth_frame_rates(run, strategy)[14]:.1f}"
    assert composer.caption("bool", 2).split()[-2:] == ["-", "FPS"], "warm-up"
    assert composer.caption("bool", 4000).split()[4] == "-", "after the end of the log"


@pytest.mark.parametrize("strategies", (("simp-b", "coh-b"), ("a-strategy-of-a-long-name", "bool")))
@pytest.mark.parametrize("width", (320, 640, 1280))
def test_caption_is_whole_above_its_picture(tmp_path, strategies, width):
    fake = fake_run.make_run(tmp_path, strategies=strategies, image_frames=(13,), size=(width, 240))
    composer = FrameComposer(read_run(fake.folder), strategies)
    canvas = np.asarray(composer.compose(13)).astype(int)
    for strategy in strategies:
        left, top, right, _ = composer.picture_box(strategy)
        bar = canvas[top - round(composer.font.size) : top, left:right].max(axis=(0, 2))
        after_square = 2 * int(composer.font.size * 0.85)
        written = np.flatnonzero(bar[after_square:] > 200) + after_square
        assert written.max() < width - 2, "the end of the bar is empty"
        expected = composer.font.getlength(composer.caption(strategy, 13))
        assert written.max() - written.min() == pytest.approx(expected, abs=composer.font.size)
        assert expected > 0.8 * width, "as large as fits"


BAD_USAGE = {
    "no such folder": (["nowhere", "--out", "v.mp4"], "nowhere/run.json: expected the result"),
    "another suffix": (["run", "--out", "v.avi"], "expected a name that ends in .mp4"),
    "an unknown strategy": (["run", "--out", "v.mp4", "--strategies", "bool,mine"],
                            "expected some of bool,sw-b,simp-b,coh-b, found 'mine'"),
    "no strategy": (["run", "--out", "v.mp4", "--strategies", ""], "found ''"),
    "no frames a second": (["run", "--out", "v.mp4", "--fps", "0"], "found '0'"),
    "NaN frames a second": (["run", "--out", "v.mp4", "--fps", "nan"], "found 'nan'"),
    "text frames a second": (["run", "--out", "v.mp4", "--fps", "x"], "found 'x'"),
    "no pictures": (["bare", "--out", "v.mp4"], "images.json: none; the run made no pictures"),
    "another format": (["exr", "--out", "v.mp4"], "format: expected png, found exr"),
}


@pytest.mark.parametrize("case", BAD_USAGE)
def test_bad_usage_is_one_line_and_makes_nothing(run_script, fake, tmp_path, case):
    fake_run.make_run(tmp_path / "bare")
    exr = fake_run.make_run(tmp_path / "exr", image_frames=(3,))
    fake_run.write_json(exr.folder / "images" / "images.json", {**exr.images, "format": "exr"})
    arguments, said = BAD_USAGE[case]
    done = run_script("make_video.py", *arguments)
    assert done.returncode == 2
    message = done.stderr.splitlines()[-1]
    assert message.startswith("make_video.py: ") and said in message
    assert "Traceback" not in done.stderr
    assert sorted(os.listdir(tmp_path)) == ["bare", "exr", "run"]


def test_without_ffmpeg_it_says_what_to_install(run_script, fake, tmp_path):
    done = run_script("make_video.py", fake.folder, "--out", "v.mp4",
                      env={**os.environ, "PATH": str(tmp_path)})
    assert done.returncode == 2
    assert done.stderr == "make_video.py: needs the program ffmpeg (Debian: ffmpeg)\n"


def stand_in(tmp_path, text):
    """An environment whose ffmpeg is this shell script."""
    folder = tmp_path / "programs"
    folder.mkdir()
    (folder / "ffmpeg").write_text("#!/bin/sh\n" + text, encoding="utf-8")
    (folder / "ffmpeg").chmod(0o755)
    return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}


@pytest.mark.parametrize("text", ("echo one >&2; echo no space left >&2; exit 1",
                                  "cat >/dev/null; echo no space left >&2; exit 1"))
def test_failing_ffmpeg_is_reported_and_an_old_video_stays(run_script, fake, tmp_path, text):
    (tmp_path / "v.mp4").write_text("old", encoding="utf-8")
    done = run_script("make_video.py", fake.folder, "--out", "v.mp4", env=stand_in(tmp_path, text))
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == "make_video.py: ffmpeg: no space left"
    assert (tmp_path / "v.mp4").read_text(encoding="utf-8") == "old"
    assert sorted(os.listdir(tmp_path)) == ["programs", "run", "v.mp4"]


def test_output_folder_that_does_not_exist(run_script, fake, tmp_path):
    done = run_script("make_video.py", fake.folder, "--out", "no/v.mp4",
                      env=stand_in(tmp_path, "cat >/dev/null"))
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].startswith("make_video.py: no/v.mp4: No such file")


@pytest.mark.parametrize("number, code", ((signal.SIGINT, 130), (signal.SIGTERM, 143)))
def test_interruption_leaves_nothing(root, fake, tmp_path, number, code):
    environment = stand_in(tmp_path, f"echo started >{tmp_path}/log; exec sleep 60")
    process = subprocess.Popen(
        [sys.executable, root / "scripts" / "make_video.py", fake.folder, "--out", "v.mp4"],
        cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True)
    for _ in range(200):
        if (tmp_path / "log").exists():
            break
        time.sleep(0.05)
    process.send_signal(number)
    process.communicate(timeout=30)
    assert process.returncode == code
    assert sorted(os.listdir(tmp_path)) == ["log", "programs", "run"]


def test_damaged_size_is_said(fake):
    save(fake.folder / "images" / "coh-b.00015.png", np.zeros((8, 8, 3)))
    run = read_run(fake.folder)
    FrameComposer(run, ["coh-b"]).compose(15)
    assert any("expected 160x120 pixels, found 8x8" in p for p in run.problems)
