"""What the figures draw is what the folder holds: lines, windows, captions."""

import fake_bias
import fake_run
import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("matplotlib")
from figure_bias import draw_bias, parse_bias  # noqa: E402
from figure_pictures import caption, draw_pictures  # noqa: E402
from figure_session import draw_session  # noqa: E402
from frame_rate import running_median  # noqa: E402
from result_folder import read_run  # noqa: E402
from strategy_style import style_of  # noqa: E402
from worst_detail import find_detail  # noqa: E402

FRAMES = (3, 10, 20)


def line_by_gid(figure, gid):
    found = [line for axes in figure.axes for line in axes.get_lines() if line.get_gid() == gid]
    assert len(found) == 1, gid
    return found[0]


def image_by_gid(figure, gid):
    found = [image for axes in figure.axes for image in axes.images if image.get_gid() == gid]
    assert len(found) == 1, gid
    return np.asarray(found[0].get_array())


@pytest.mark.parametrize("repetitions", (1, 3))
def test_session_lines_are_the_frame_logs(tmp_path, repetitions):
    fake = fake_run.make_run(tmp_path, repetitions=repetitions)
    figure = draw_session(read_run(tmp_path))
    for strategy in fake_run.STRATEGIES:
        logs = [fake.frames[strategy, r] for r in range(repetitions)]
        nodes = line_by_gid(figure, f"dn.{strategy}")
        np.testing.assert_array_equal(nodes.get_xdata(), np.arange(40))
        np.testing.assert_allclose(nodes.get_ydata(), np.mean([log["dn"] for log in logs], axis=0))
        rates = 1000 / np.median([log["frame_ms"] for log in logs], axis=0)
        each = line_by_gid(figure, f"fps-each.{strategy}").get_ydata()
        np.testing.assert_allclose(each, rates, rtol=1e-6)
        smooth = line_by_gid(figure, f"fps.{strategy}").get_ydata()
        assert np.isnan(smooth[:5]).all(), "warm-up"
        for i in range(5, 40):
            window = rates[max(i - 4, 5) : i + 5]
            assert smooth[i] == pytest.approx(np.median(window), rel=1e-6)


def test_session_lines_look_as_their_strategy(tmp_path):
    fake_run.make_run(tmp_path)
    figure = draw_session(read_run(tmp_path))
    for strategy, label in fake_run.LABELS.items():
        for gid in (f"dn.{strategy}", f"fps.{strategy}"):
            assert line_by_gid(figure, gid).get_color() == style_of(strategy).color
            assert line_by_gid(figure, gid).get_marker() == style_of(strategy).marker
        assert line_by_gid(figure, f"dn.{strategy}").get_label() == label
    shown = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert shown == list(fake_run.LABELS.values())


def test_every_measured_value_is_inside_the_axes(tmp_path):
    fake = fake_run.make_run(tmp_path, frames=60)
    # A first frame like no other does not squeeze the rest.
    path = tmp_path / "bool.0.csv"
    rows = path.read_text(encoding="utf-8").splitlines()
    fields = rows[1].split(",")
    fields[2] = "100000"
    rows[1] = ",".join(fields)
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    figure = draw_session(read_run(tmp_path))
    highest = max(log["dn"][5:].max() for log in fake.frames.values())
    assert highest <= figure.axes[0].get_ylim()[1] <= 1.2 * highest
    assert figure.axes[0].get_ylim()[0] == 0 == figure.axes[1].get_ylim()[0]
    for line in figure.axes[1].get_lines():
        assert np.nanmax(line.get_ydata()[5:]) <= figure.axes[1].get_ylim()[1]


@pytest.mark.parametrize("warm_up", (0, 7))
def test_warm_up_is_marked(tmp_path, warm_up):
    fake_run.make_run(tmp_path, warm_up=warm_up)
    figure = draw_session(read_run(tmp_path))
    for axes in figure.axes:
        marks = [patch for patch in axes.patches if patch.get_gid() == "warm-up"]
        assert len(marks) == (warm_up > 0)
        if marks:
            assert marks[0].get_xy()[:, 0].max() == pytest.approx(warm_up - 0.5)


def test_missing_strategy_has_no_line_and_a_short_log_ends_early(tmp_path):
    fake_run.make_run(tmp_path, repetitions=1, failed=[("sw-b", 0)])
    path = tmp_path / "coh-b.0.csv"
    rows = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(rows[:21]) + "\n", encoding="utf-8")
    figure = draw_session(read_run(tmp_path))
    assert not [x for a in figure.axes for x in a.get_lines() if x.get_gid() == "dn.sw-b"]
    assert len(line_by_gid(figure, "dn.coh-b").get_ydata()) == 20


def test_running_median_takes_out_single_spikes_and_keeps_steps():
    values = np.r_[np.full(20, 30.0), np.full(20, 60.0)]
    spiky = values.copy()
    spiky[[5, 30]] = 500
    np.testing.assert_array_equal(running_median(spiky), values)
    values[7] = np.nan
    medians = running_median(values)
    assert np.isnan(medians[7]) and not np.isnan(np.delete(medians, 7)).any()


def test_bias_lines_are_the_program_s(capsys):
    fake_bias.main(["bias", "--s", "0,0.5,1", "--t", "0.1,0.25,0.5", "--samples", "201"])
    curves = parse_bias(capsys.readouterr().out, "test")
    assert len(curves) == 9
    figure = draw_bias(curves)
    for s in (0.5, 1):
        for t in (0.1, 0.25, 0.5):
            line = line_by_gid(figure, f"bias.s{s:g}.t{t:g}")
            np.testing.assert_allclose(line.get_xdata(), np.linspace(0, 1, 201), atol=1e-8)
            expected = [fake_bias.compute_bias(s, t, mu) for mu in line.get_xdata()]
            np.testing.assert_allclose(line.get_ydata(), expected, atol=1e-8)
    identity = line_by_gid(figure, "identity")
    np.testing.assert_array_equal(identity.get_xdata(), identity.get_ydata())


def test_bias_lines_differ_without_colour(capsys):
    fake_bias.main(["bias", "--s", "0.5,1", "--t", "0.1,0.25,0.5", "--samples", "11"])
    figure = draw_bias(parse_bias(capsys.readouterr().out, "test"))
    lines = figure.axes[0].get_lines()
    markers = [line.get_marker() for line in lines if line.get_marker() != "None"]
    assert len(set(markers)) == len(markers) >= 3


def plant(strategy, frame, left, top, amount):
    """An edit of a fake run: one window of an eighth of the picture, each way, is off."""
    def edit(pictures):
        picture = pictures[strategy, frame]
        height, width = picture.shape[0] // 8, picture.shape[1] // 8
        window = picture[top : top + height, left : left + width]
        picture[top : top + height, left : left + width] = np.where(window > 127, window - amount,
                                                                    window + amount)
    return edit


@pytest.mark.parametrize("strategy, frame, left, top",
                         (("simp-b", 10, 0, 0), ("coh-b", 3, 100, 41), ("coh-b", 20, 140, 105)))
def test_detail_is_where_the_error_was_planted(tmp_path, strategy, frame, left, top):
    fake = fake_run.make_run(tmp_path, image_frames=FRAMES, size=(160, 120),
                             edit=plant(strategy, frame, left, top, 60))
    detail = find_detail(read_run(tmp_path))
    assert (detail.strategy, detail.frame, detail.left, detail.top) == (strategy, frame, left, top)
    assert (detail.width, detail.height, detail.searched) == (20, 15, 6)
    difference = (detail.crop(fake.pictures[strategy, frame]).astype(float)
                  - detail.crop(fake.pictures["bool", frame])) @ (0.299, 0.587, 0.114)
    assert detail.error == pytest.approx((difference**2).mean())


def test_detail_is_the_worst_of_several_errors_and_ignores_other_strategies(tmp_path):
    # What Coh(B) shares with Bool is no error, however far it is from the full model.
    edits = (plant("sw-b", 3, 5, 5, 110), plant("bool", 10, 90, 90, 110),
             plant("coh-b", 10, 90, 90, 110), plant("simp-b", 10, 90, 90, 110),
             plant("simp-b", 3, 30, 30, 40), plant("coh-b", 20, 60, 20, 45))
    fake_run.make_run(tmp_path, image_frames=FRAMES, size=(160, 120),
                      edit=lambda pictures: [edit(pictures) for edit in edits])
    detail = find_detail(read_run(tmp_path))
    assert (detail.strategy, detail.frame, detail.left, detail.top) == ("coh-b", 20, 60, 20)


def test_detail_by_rarn_is_in_the_frame_with_most(tmp_path):
    fake = fake_run.make_run(tmp_path, image_frames=FRAMES, size=(160, 120),
                             edit=plant("coh-b", 20, 60, 20, 45))
    for strategy in fake.images["strategies"]:
        for entry in strategy["frames"]:
            most = (strategy["strategy"], entry["frame"]) == ("simp-b", 3)
            entry["rarn_nodes"] = 9 if most else 1
    fake_run.write_json(tmp_path / "images" / "images.json", fake.images)
    run = read_run(tmp_path)
    detail = find_detail(run, "rarn")
    assert (detail.strategy, detail.frame, detail.rarn) == ("simp-b", 3, 9)
    assert find_detail(run).frame == 20
    title = draw_pictures(run, "rarn")._suptitle.get_text()
    assert "frame 3." in title and "Simp*(B) has the most RARN" in title


def test_pictures_shown_are_those_of_the_folder(tmp_path):
    fake = fake_run.make_run(tmp_path, image_frames=FRAMES, size=(160, 120),
                             edit=plant("coh-b", 20, 60, 20, 45))
    run = read_run(tmp_path)
    figure = draw_pictures(run)
    for strategy in ("bool", "simp-b", "coh-b"):
        picture = fake.pictures[strategy, 20]
        np.testing.assert_array_equal(image_by_gid(figure, f"frame.{strategy}"), picture)
        magnified = image_by_gid(figure, f"detail.{strategy}")
        assert magnified.shape == (480, 640, 3)
        np.testing.assert_array_equal(magnified[::32, ::32], picture[20:35, 60:80])
        np.testing.assert_array_equal(magnified[31::32, 31::32], picture[20:35, 60:80])
    for strategy in ("simp-b", "coh-b"):
        overlay = image_by_gid(figure, f"overlay.{strategy}")
        np.testing.assert_array_equal(overlay, run.image(strategy, 20, "bias"))


def test_title_and_captions_say_what_is_shown(tmp_path):
    fake = fake_run.make_run(tmp_path, image_frames=FRAMES, size=(160, 120),
                             edit=plant("coh-b", 20, 60, 20, 45))
    run = read_run(tmp_path)
    figure = draw_pictures(run)
    title = figure._suptitle.get_text()
    for part in ("frame 20.", "20 × 15 pixels at (60, 20)", "search of 6 pictures",
                 "Coh(B) differs most from Bool here"):
        assert part in title
    entry = next(s for s in fake.images["strategies"] if s["strategy"] == "coh-b")["frames"][2]
    expected = f"Coh(B): PSNR Y {entry['vs_reference']['y']:.1f} dB, {entry['rarn_nodes']} RARN"
    assert caption(run, "coh-b", 20) == expected
    assert expected in [axes.get_title() for axes in figure.axes]


def test_equal_pictures_are_said_to_be_equal(tmp_path):
    def equal(pictures):
        for strategy, frame in pictures:
            pictures[strategy, frame] = pictures["full", frame]
    fake_run.make_run(tmp_path, image_frames=FRAMES, edit=equal)
    run = read_run(tmp_path)
    title = draw_pictures(run)._suptitle.get_text()
    assert "6 pictures:\nnone of them differs from Bool in luminance" in title
    assert caption(run, "coh-b", 10) == "Coh(B): identical in Y, 1 RARN"


@pytest.mark.parametrize("path", (
    ("warm_up_frames",), ("repetitions",), ("complete",), ("scene", "triangles"),
    ("session", "name"), ("context", "gl"), ("context", "gl", "renderer")))
@pytest.mark.parametrize("value", (None, "text", -1, [], ...))
def test_record_that_says_less_is_drawn_all_the_same(tmp_path, path, value):
    fake = fake_run.make_run(tmp_path)
    parent = fake.data
    for key in path[:-1]:
        parent = parent[key]
    parent[path[-1]] = value
    if value is ...:
        del parent[path[-1]]
    fake_run.write_json(tmp_path / "run.json", fake.data)
    figure = draw_session(read_run(tmp_path))
    assert figure._suptitle.get_text().startswith("fake: ")
    assert not np.isnan(line_by_gid(figure, "fps.coh-b").get_ydata()[5:]).any()


@pytest.mark.parametrize("quality, expected", (
    (None, "PSNR unknown"), ("text", "PSNR unknown"), ({"y": "text"}, "PSNR unknown"),
    ({}, "PSNR unknown"), ({"y": None}, "identical in Y"), ({"y": 40.04}, "PSNR Y 40.0 dB")))
@pytest.mark.parametrize("rarn", (None, "text", 7))
def test_caption_says_what_is_known(tmp_path, quality, expected, rarn):
    fake = fake_run.make_run(tmp_path, image_frames=(3,))
    for strategy in fake.images["strategies"]:
        strategy["frames"][0].update(vs_reference=quality, rarn_nodes=rarn)
    fake_run.write_json(tmp_path / "images" / "images.json", fake.images)
    run = read_run(tmp_path)
    assert caption(run, "coh-b", 3) == f"Coh(B): {expected}" + (", 7 RARN" if rarn == 7 else "")
    assert find_detail(run, "rarn").rarn == (7 if rarn == 7 else 0)


def test_without_overlay_there_is_no_row_for_it(tmp_path):
    fake_run.make_run(tmp_path, image_frames=FRAMES, overlays=())
    figure = draw_pictures(read_run(tmp_path))
    assert len(figure.axes) == 6
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert "detail" in labels and "modulation" not in labels


def test_one_strategy_is_enough(tmp_path):
    fake_run.make_run(tmp_path, strategies=("bool", "coh-b"), image_frames=FRAMES)
    figure = draw_pictures(read_run(tmp_path))
    assert any("Coh(B)" in axes.get_title() for axes in figure.axes)
