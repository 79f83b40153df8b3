"""`hlodbench view`: what was recorded is saved, cut and undone, and a crash loses little of it."""

import json
import signal

import pytest
from small_scene import look, write_json, write_session
from view_window import (  # noqa: F401 (fixtures)
    PANEL,
    SIZE,
    count_journal_poses,
    read_picture,
    read_session,
    record,
    relief,
    screen,
    start,
)


@pytest.fixture
def file(tmp_path):
    return tmp_path / "relief.session.json"


@pytest.fixture
def journal(tmp_path):
    return tmp_path / "relief.session.json.recording"


def read_journal(path):
    """The poses of its whole lines."""
    poses = []
    for line in path.read_text(encoding="utf-8").split("\n")[1:-1]:
        value = json.loads(line)
        if isinstance(value, dict):
            assert value["frames"] < len(poses)
            del poses[value["frames"] :]
        else:
            poses.append(value)
    return poses


def begin_to_record(view, journal, frames):
    view.press("r")
    view.wait(lambda: count_journal_poses(journal) >= frames, f"{frames} poses")


def saved_frames(view, file, count=1):
    return int(view.wait_for_line(rf"wrote {file}: (\d+) frames", count).group(1))


@pytest.mark.parametrize("how", ["the key", "the window's button", "a signal"])
def test_closing_the_window_saves_the_recording(start, relief, file, journal, how):
    view = start(relief).open()
    begin_to_record(view, journal, 20)
    if how == "the key":
        view.press("ctrl+q")
    elif how == "a signal":
        view.process.send_signal(signal.SIGINT)
    else:
        view.ask_to_close()
    assert view.wait_for_end() == 0, view.errors()
    assert not journal.exists()
    assert len(read_session(file)["frames"]) == saved_frames(view, file) >= 20


def test_a_recording_that_was_killed_is_offered_at_the_next_start(start, relief, file, journal):
    view = start(relief).open()
    begin_to_record(view, journal, 40)
    view.kill()
    left = read_journal(journal)
    assert len(left) >= 40 and not file.exists()

    # Esc: not now
    view = start(relief).open()
    view.press("Escape")
    view.look()
    view.press("Return")
    assert view.quit() == 0, view.errors()
    assert journal.exists() and not file.exists()

    # a recording of this start has another name
    view = start(relief).open()
    other = file.with_name("relief-2.session.json")
    begin_to_record(view, other.with_name(other.name + ".recording"), 1)
    view.press("r", "Return")
    assert saved_frames(view, file) == len(left)
    assert read_session(file)["frames"] == left
    assert not journal.exists()
    assert view.quit() == 0, view.errors()
    assert read_session(other)["frames"]


def test_a_damaged_journal_is_told_of_and_stays(start, relief, file, journal):
    journal.write_text('{"version": 1, "na', encoding="utf-8")
    view = start(relief).open()
    view.press("Return")
    view.wait_for_line(f"hlodbench: {journal}: line 1: expected the header of a recording.*")
    view.look()
    assert journal.exists() and not file.exists()
    assert view.quit() == 0, view.errors()


def test_review_cut_undo_and_save(start, relief, file, journal):
    view = start(relief).open()
    record(view, journal, 30)
    view.look()  # what was pressed before has been done
    poses = read_journal(journal)
    count = len(poses)
    assert count >= 30

    to_the_end = ["period"] * (count + 5)
    view.press("space", "space", *to_the_end)  # replays it, stops
    view.press(*["comma"] * 5, "x")  # five frames back
    view.look()
    assert read_journal(journal) == poses[: count - 5]
    view.press("ctrl+z")
    view.look()
    assert read_journal(journal) == poses
    view.press(*["comma"] * 3, "x", "ctrl+s")
    assert saved_frames(view, file) == count - 3
    assert read_session(file)["frames"] == poses[: count - 3]
    assert not journal.exists()

    # it goes on where it was cut, as one more stretch
    view.press("r")
    view.wait(lambda: count_journal_poses(journal) >= count, "more poses")
    view.drag(*[(3, 0)] * 10)
    view.press("r", "ctrl+s")
    more = saved_frames(view, file, 2)
    frames = read_session(file)["frames"]
    assert len(frames) == more > count - 3
    assert frames[: count - 3] == poses[: count - 3]
    view.press("ctrl+z")
    assert view.quit() == 0, view.errors()
    assert saved_frames(view, file, 3) == count - 3
    assert read_session(file)["frames"] == poses[: count - 3]


def test_replaying_plays_to_the_end_and_escape_leaves(start, relief, tmp_path):
    poses = [look((0.05 * i - 1, 0.2, 2.5), (0, 0, 0)) for i in range(40)]
    session = write_session(tmp_path / "path.json", poses, size=(200, 120))
    view = start(relief, "--session", session).open()
    first = view.look()
    assert first.shape == (120, 200, 3)
    view.press("period")
    second = view.look()
    assert (first != second).any()
    view.press("comma")
    assert (first == view.look()).all()
    view.press(*["period"] * 45)
    last = view.look()
    view.press("space", "space")  # it begins again, and stops soon
    assert (last != view.look()).any()
    view.press(*["period"] * 45)
    assert (last == view.look()).all()
    view.press("comma", "space")  # on to the end, where it stops
    view.wait(lambda: (last == view.look()).all(), "the last frame")
    assert (last == view.look()).all()
    view.press("Escape")
    assert view.look().shape == (SIZE[1], SIZE[0], 3)
    view.press("x")  # there is nothing to cut
    view.wait_for_line("review the recording first.*")
    assert view.quit() == 0, view.errors()


def test_a_session_of_another_scene_is_asked_about(start, relief, tmp_path):
    session = write_session(
        tmp_path / "path.json",
        [look((0.5, 0.2, 2.5), (0, 0, 0))] * 3,
        size=(200, 120),
        scene={"name": "other", "hash": "0123456789abcdef"},
    )
    own = (SIZE[1], SIZE[0], 3)
    view = start(relief, "--session", session).open()
    assert view.look().shape == own
    view.press("Escape")
    view.press("Return")
    assert view.look().shape == own
    assert view.quit() == 0, view.errors()

    view = start(relief, "--session", session).open()
    assert view.look().shape == own
    view.press("Return")
    assert view.look().shape == (120, 200, 3)
    assert view.quit() == 0, view.errors()

    # a session of this scene is not
    view = start(relief).open()
    record(view, tmp_path / "relief.session.json.recording", 2)
    assert view.quit() == 0, view.errors()
    content = read_session(tmp_path / "relief.session.json")
    same = write_json(tmp_path / "same.json", {**content, "viewport": [200, 120]})
    view = start(relief, "--session", same).open()
    assert view.look().shape == (120, 200, 3)
    assert view.quit() == 0, view.errors()


def test_a_comparison_of_the_frame_ends_with_a_report(start, relief, tmp_path):
    view = start(relief, "--strategy", "coh-b,bool").open()
    view.drag(*[(4, 1)] * 5)
    view.press("c")
    folder = tmp_path / "relief-frame-1"
    view.wait_for_line(f"open {folder / 'report.html'} in a browser")
    run = read_session(folder / "run" / "run.json")
    assert run["complete"] is True
    assert {case["strategy"] for case in run["cases"]} == {"bool", "sw-b", "coh-b"}
    assert "<html" in (folder / "report.html").read_text(encoding="utf-8")
    assert list((folder / "run" / "images").glob("*.png"))
    assert view.quit() == 0, view.errors()


def test_a_drag_that_begins_on_the_panel_turns_nothing(start, relief):
    view = start(relief).open()
    before = view.look()
    view.drag(*[(20, 5)] * 10, start=(5, 5))
    assert (before == view.look()).all()
    view.drag(*[(20, 5)] * 3)
    assert (before != view.look()).any()
    assert view.quit() == 0, view.errors()


def test_the_lens_stays_while_there_is_a_recording(start, relief, file, journal):
    view = start(relief).open()
    record(view, journal, 5)
    view.xdotool("windowsize", view.window, PANEL + 400, 300)

    def is_resized():
        return read_picture(view.keep_picture("shift+p")).shape == (300, PANEL + 400, 3)

    view.wait(is_resized, "the window's new size")
    before = view.look()
    assert before.shape == (SIZE[1], SIZE[0], 3)
    view.press("bracketright")
    view.wait_for_line("the field of view stays as it is in a recording.*")
    assert (before == view.look()).all()
    assert view.quit() == 0, view.errors()
    assert read_session(file)["viewport"] == list(SIZE)


def test_freezing_pauses_and_recording_goes_on_without_a_jump(start, relief, file, journal):
    view = start(relief).open()
    begin_to_record(view, journal, 5)
    view.drag(*[(3, 1)] * 10)
    view.press("f")
    view.look()
    before = read_journal(journal)
    view.drag(*[(20, 1)] * 10)  # from outside
    view.look()
    assert read_journal(journal) == before
    view.press("r")
    view.wait(lambda: count_journal_poses(journal) >= len(before) + 5, "5 more poses")
    assert view.quit() == 0, view.errors()
    frames = read_session(file)["frames"]
    assert len(frames) >= len(before) + 5
    assert frames[: len(before)] == before
    assert all(frame == before[-1] for frame in frames[len(before) :])
