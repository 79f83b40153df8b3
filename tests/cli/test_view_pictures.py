"""`hlodbench view`: the pictures that it keeps, and that they show what was asked for."""

import numpy as np
from small_scene import look, write_session
from view_window import (  # noqa: F401 (fixtures)
    MIDDLE,
    PANEL,
    SIZE,
    count_differing,
    read_picture,
    relief,
    screen,
    start,
)

PANE = SIZE[0] // 2 - 1  # pixels: the width of one of two, with a gap of two between them
YELLOW = (255, 210, 40)  # of the frozen camera's frustum
GREEN, RED = (60, 220, 90), (235, 60, 50)  # of boxes that were queried
WHITE, BLUE = (255, 255, 255), (90, 120, 255)  # of boxes drawn and culled


def count_color(picture, color):
    return int((np.abs(picture - np.array(color)).max(axis=2) < 12).sum())


def test_a_picture_is_that_of_a_run(hlodbench, start, relief, tmp_path):
    pose = look((0.6, 0.4, 2.5), (0, 0, 0))
    session = write_session(tmp_path / "pose.json", [pose] * 8, size=(200, 120))
    view = start(relief, "--session", session, "--strategy", "bool").open()
    kept = view.keep_picture()
    assert kept == str(tmp_path / "relief-1.png")
    shown = read_picture(kept)
    assert shown.shape == (120, 200, 3), "the session's size, not the window's"
    whole = view.keep_picture("shift+p")
    assert whole == str(tmp_path / "relief-2.png")
    assert read_picture(whole).shape == (SIZE[1], PANEL + SIZE[0], 3)
    assert view.quit() == 0

    out = tmp_path / "run"
    fixed = ["--strategy", "bool", "--warm-up", "0", "--repetitions", "1", "--images", "7,"]
    run = hlodbench("run", "--scene", relief, "--session", session, "--out", out, *fixed)
    assert run.returncode == 0, run.stderr
    (picture,) = (out / "images").glob("*bool*.png")
    difference = np.abs(shown - read_picture(picture)).mean()
    print(f"mean absolute difference {difference} of 255")
    assert difference < 1
    assert count_differing(shown, shown[:1, :1] + 0 * shown) > 5000


def test_a_picture_of_the_window_needs_no_input(start, relief, tmp_path):
    file = tmp_path / "window.png"
    view = start(relief, "--frames", "4", "--picture", file, "--strategy", "coh-b,bool")
    assert view.wait_for_end() == 0, view.errors()
    shown = read_picture(file)
    assert shown.shape == (SIZE[1], PANEL + SIZE[0], 3)
    scene = shown[:, PANEL:]
    left, right = scene[:, :PANE], scene[:, -PANE:]
    # two strategies, one camera: the same scene twice
    assert count_differing(left, right) < 0.05 * left[..., 0].size
    assert count_differing(left, left[:1, :1] + 0 * left) > 2000


def test_what_is_switched_on_is_seen_and_gone_when_off(start, relief):
    view = start(relief).open()
    plain = view.look()
    assert plain.shape == (SIZE[1], SIZE[0], 3)
    assert count_differing(plain, view.look()) < 50, "nothing moved"

    view.press("v")
    split = view.look()
    assert split.shape == (SIZE[1], 2 * PANE, 3), "the gap between them is no part of it"
    left, right = np.split(split, 2, axis=1)
    assert count_differing(left, right) < 0.05 * left[..., 0].size
    view.press("v")

    seen = [plain]
    for _ in range(4):  # overlays
        view.press("o")
        seen.append(view.look())
        assert all(count_differing(seen[-1], other) > 500 for other in seen[:-1])
    view.press("o")
    assert count_differing(plain, view.look()) < 50, "after the last overlay there is none"

    colors = []
    for _ in range(4):  # boxes: drawn, queried, culled, all
        view.press("b")
        boxes = view.look()
        colors.append([count_color(boxes, color) for color in (WHITE, GREEN, BLUE)])
    drawn, queried, culled, both = colors
    assert drawn[0] > 300 and drawn[1] == 0
    assert queried[1] > 300 and queried[0] == 0
    assert culled[0] == culled[1] == 0
    assert both[1] > 300
    view.press("b")
    assert count_differing(plain, view.look()) < 50
    assert view.quit() == 0, view.errors()


def test_a_frozen_view_is_seen_from_outside(start, relief):
    view = start(relief).open()
    before = view.look()
    assert count_color(before, YELLOW) == 0
    view.press("f")
    view.drag(*[(20, 4)] * 5)
    view.xdotool(*["click", 5] * 6)  # the wheel: farther
    outside = view.look()
    assert count_color(outside, YELLOW) > 100, "the frozen camera's frustum"
    assert count_color(outside, GREEN) + count_color(outside, RED) > 300, "what was queried"
    assert count_differing(before, outside) > 5000
    view.press("f")
    assert count_differing(before, view.look()) < 50, "back to where it was frozen"
    assert view.quit() == 0, view.errors()


def test_the_view_follows_the_windows_size_and_vsync_changes_nothing(start, relief):
    view = start(relief).open()
    before = view.look()
    view.xdotool("windowsize", view.window, PANEL + 400, 300)
    view.wait(lambda: view.look().shape == (300, 400, 3), "a picture of the new size")
    whole = read_picture(view.keep_picture("shift+p"))
    assert whole.shape == (300, PANEL + 400, 3)
    view.press("h")
    view.wait(lambda: view.look().shape == (300, PANEL + 400, 3), "a picture without the panel")
    view.press("h")
    view.xdotool("windowsize", view.window, PANEL + SIZE[0], SIZE[1])
    view.wait(lambda: view.look().shape == before.shape, "a picture of the first size")
    assert count_differing(before, view.look()) < 50
    for _ in range(2):
        view.press("y")
        assert count_differing(before, view.look()) < 50
    assert view.quit() == 0, view.errors()


def test_a_very_small_window_goes_on(start, relief):
    view = start(relief).open()
    for size in ((PANEL - 50, 30), (1, 1), (PANEL + SIZE[0], SIZE[1])):
        view.xdotool("windowsize", view.window, *size)
        shape = (size[1], max(1, size[0] - PANEL), 3)
        view.wait(lambda shape=shape: view.look().shape == shape, f"a picture of {shape}")
    assert view.quit() == 0, view.errors()


def test_a_key_held_while_the_window_loses_the_focus_moves_nothing(start, relief):
    view = start(relief).open()
    view.press("2")  # fly
    before = view.look()
    view.xdotool("keydown", "s")
    view.wait(lambda: count_differing(before, view.look()) > 500, "a movement")
    # no window has the keys: none is told that this one is let go
    view.focus_nothing()
    view.xdotool("keyup", "s")
    view.focus()
    still = view.look()
    for _ in range(5):
        assert count_differing(still, view.look()) == 0
    assert view.quit() == 0, view.errors()


def test_double_click_goes_to_a_point_and_home_back(start, relief):
    view = start(relief).open()
    before = view.look()
    view.point(*MIDDLE)

    def has_gone():  # where frames are very long, two clicks are no double click
        view.xdotool("click", 1, "click", 1)
        return count_differing(before, view.look()) > 3000

    view.wait(has_gone, "to be somewhere else")
    view.press("Home")
    view.wait(lambda: count_differing(before, view.look()) < 50, "to be back")
    assert view.quit() == 0, view.errors()
