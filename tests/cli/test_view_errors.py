"""`hlodbench view` says what is wrong: on the terminal where there is no window, else in it."""

import pytest
from refusal import BAD_INPUT, NO_GL, complain
from small_scene import look, write_courtyard, write_ply, write_session
from view_window import (  # noqa: F401 (fixtures)
    SIZE,
    count_journal_poses,
    relief,
    screen,
    start,
    wait_until,
)


@pytest.fixture
def view_command(hlodbench, screen):
    """Runs `hlodbench view` to its end, on the virtual screen."""

    def run(*arguments, **environment):
        environment = {"DISPLAY": screen.display, "WAYLAND_DISPLAY": "", **environment}
        return hlodbench("view", *arguments, env=environment, timeout=60)

    return run


def write_damaged(path):
    return write_ply(path, [(0, 0, 0), (1, 0, 0), ("zero", 1, 0)], [(0, 1, 2)])


def test_without_a_display_it_says_what_to_do(view_command, relief):
    for display in ("", ":4711"):
        result = view_command(relief, DISPLAY=display)
        complain(result, NO_GL, "display", "xvfb-run", "`hlodbench run`")


def test_an_old_opengl_is_no_window(view_command, relief):
    result = view_command(relief, "--frames", "1", MESA_GL_VERSION_OVERRIDE="2.1")
    complain(result, NO_GL, "OpenGL 3.3")


def test_a_damaged_mesh_ends_a_script(view_command, tmp_path):
    mesh = write_damaged(tmp_path / "damaged.ply")
    result = view_command(mesh, "--frames", "1", "--cache", tmp_path / "cache")
    complain(result, BAD_INPUT, mesh)
    result = view_command(tmp_path / "none.ply", "--frames", "1", "--cache", tmp_path / "cache")
    complain(result, BAD_INPUT, tmp_path / "none.ply")


@pytest.mark.parametrize("how", ["Escape", "ctrl+q", "the window's button"])
def test_a_damaged_mesh_is_told_of_in_the_window(start, screen, tmp_path, how):
    mesh = write_damaged(tmp_path / "damaged.ply")
    view = start(mesh).find()

    def is_text_shown():  # orange or white letters on the dark window in the middle
        middle = screen.read()[: SIZE[1], : SIZE[0]]
        return (middle.max(axis=2) > 200).sum() > 200

    view.wait(is_text_shown, "the message")
    assert "hlodbench: " not in view.errors(), "it is on the terminal at the end"


    def has_ended():  # keys that come while it still reads are dropped
        if " " not in how:
            view.press(how)
        return view.process.poll() is not None

    if " " in how:
        view.ask_to_close()
    wait_until(has_ended, "the end of the program")
    assert view.process.returncode == BAD_INPUT
    (line,) = [li for li in view.errors().splitlines() if li.startswith("hlodbench: ")]
    assert str(mesh) in line


@pytest.mark.parametrize("how", ["ctrl+q", "the window's button"])
def test_building_can_be_ended(start, tmp_path, how):
    scene = write_courtyard(tmp_path / "yard.scene.json", triangles=1000000)
    view = start(scene, "--threads", "1").find()
    view.wait_for_line("building .*")
    if " " in how:
        view.ask_to_close()
    else:
        view.press(how)
    assert view.wait_for_end() == 0, view.errors()
    assert "showing" not in view.errors() and "hlodbench: " not in view.errors()
    assert not [p for p in tmp_path.rglob("*") if "hlod" in p.name], "nothing half built is left"


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--strategy", "nonsense"], ["nonsense"]),
        (["--strategy", "bool,nonsense"], ["nonsense"]),
        (["--strategy", "bool,bool,bool"], ["--strategy"]),
        (["--size", "0x10"], ["0x10"]),
        (["--size", "wide"], ["wide"]),
        (["--fov", "200"], ["--fov"]),
        (["--rate", "0"], ["--rate"]),
        (["--latency", "soon"], ["soon"]),
        (["--picture", "a.png"], ["--picture", "--frames"]),
        (["--max-triangles", "200"], ["--max-triangles"]),  # of a hierarchy that is built already
    ],
)
def test_bad_options_are_refused(view_command, relief, tmp_path, arguments, words):
    frames = [] if "--picture" in arguments else ["--frames", "1"]
    result = view_command(relief, "--folder", tmp_path, *frames, *arguments)
    complain(result, BAD_INPUT, *words)


def impossible(tmp_path, kind):
    """A folder that cannot be made, even by root."""
    if kind == "too long":
        return tmp_path / ("a" * 300)
    (tmp_path / "file").write_text("", encoding="utf-8")
    return tmp_path / "file" / "folder"


@pytest.mark.parametrize("kind", ["below a file", "too long"])
def test_where_nothing_can_be_written_nothing_is_recorded(start, relief, tmp_path, kind):
    folder = impossible(tmp_path, kind)
    view = start(relief, "--record", folder / "path.session.json").open()
    view.press("r")
    view.wait_for_line(f"hlodbench: {folder}: no recording can be kept in this folder: .*")
    view.look()
    view.press("ctrl+s")
    view.look()
    assert view.quit() == 0, view.errors()
    assert "frames" not in view.errors().split("no recording")[1]
    assert not list(tmp_path.glob("*.session.json*"))


@pytest.mark.parametrize("kind", ["below a file", "too long"])
def test_a_folder_that_cannot_be_written_to_is_told_of(start, relief, tmp_path, kind):
    folder = impossible(tmp_path, kind)
    view = start(relief, folder=folder).open()
    for count, key in enumerate(["p", "shift+p", "c", "r"], 1):
        view.press(key)
        view.wait_for_line(f"hlodbench: .*{folder}.*", count)
    assert view.quit() == 0, view.errors()


def test_a_script_learns_that_its_picture_is_missing(view_command, relief, tmp_path):
    picture = impossible(tmp_path, "below a file") / "picture.png"
    result = view_command(relief, "--frames", "2", "--picture", picture)
    complain(result, BAD_INPUT, picture)


def record_over_another_file(start, relief, folder):
    """A window that is told to close; the file of its recording has become another's."""
    file = folder / "path.session.json"
    view = start(relief, "--record", file).open()
    view.press("r")
    journal = folder / "path.session.json.recording"
    view.wait(lambda: count_journal_poses(journal) >= 5, "5 poses")
    file.write_text("another's", encoding="utf-8")
    view.press("ctrl+q")
    return view, file, journal


def test_a_recording_that_cannot_be_saved_is_kept(start, relief, tmp_path):
    """The file is there already when it is to be written: it may be another's."""
    view, file, journal = record_over_another_file(start, relief, tmp_path)
    view.wait_for_line(f"hlodbench: {file}: expected a new file for the session, found one")
    view.wait_for_line("hlodbench: not saved: .*")
    view.look()  # the window lives on
    assert view.quit() == BAD_INPUT
    assert file.read_text(encoding="utf-8") == "another's"
    assert count_journal_poses(journal) >= 5


def test_what_can_be_saved_at_last_is_saved(start, relief, tmp_path):
    view, file, journal = record_over_another_file(start, relief, tmp_path)
    view.wait_for_line("hlodbench: not saved: .*")
    file.unlink()
    assert view.quit() == 0
    assert view.errors().count(f"\nwrote {file}") == 1
    assert not journal.exists()


@pytest.mark.parametrize("content", [None, "", "{", '{"version": 1, "frames": []}'])
def test_a_damaged_session_is_told_of(start, relief, tmp_path, content):
    session = tmp_path / "damaged.json"
    if content is not None:
        session.write_text(content, encoding="utf-8")
    view = start(relief, "--session", session).open()
    view.wait_for_line(f"hlodbench: .*{session}.*")
    assert view.look().shape == (SIZE[1], SIZE[0], 3)
    assert view.quit() == 0, view.errors()


def test_a_session_that_is_dropped_may_be_damaged_too(start, relief, tmp_path):
    """One bad pose among good ones."""
    pose = look((0, 0, 3), (0, 0, 0))
    session = write_session(tmp_path / "path.json", [pose, pose[:6], pose])
    view = start(relief, "--session", session).open()
    view.wait_for_line(f"hlodbench: {session}: .*frames.*")
    assert view.quit() == 0, view.errors()


def test_help_lists_options_with_defaults_and_units(hlodbench):
    result = hlodbench("view", "--help")
    assert result.returncode == 0
    text = " ".join(result.stdout.split())
    for part in (
        "--session TEXT",
        "--record TEXT",
        "--folder TEXT=.",
        "--rate FLOAT=60 poses recorded a second",
        "--strategy TEXT=[coh-b]",
        "--latency TEXT=gl",
        "--tau FLOAT=1 pixels",
        "--size TEXT=640x480 of the view at the start, WIDTHxHEIGHT, pixels",
        "--fov FLOAT=50 vertical field of view at the start, degrees",
        "--no-vsync",
        "--frames INT",
        "--picture TEXT",
        "--cache TEXT=",
        "--max-triangles UINT",
        "--preset TEXT=paper",
        "The ? key shows the keys",
    ):
        assert part in text, part
