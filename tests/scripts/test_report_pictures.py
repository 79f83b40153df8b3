"""report.py: the pictures in the page, their differences, and the budget they are kept in."""

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy")
pytest.importorskip("PIL", reason="needs python3-pil")

import fake_run  # noqa: E402
from report import encoding, pictures  # noqa: E402
from report_page import decode  # noqa: E402
from result_folder import find_worst_region, read_run  # noqa: E402

FRAMES = (3, 10, 20)
LARGE = 10**9


@pytest.fixture
def fake(tmp_path):
    return fake_run.make_run(tmp_path, image_frames=FRAMES, size=(160, 120),
                             overlays=("bias", "level"))


def embed(folder, budget=LARGE):
    run = read_run(folder)
    (embedded,), level = pictures.embed_all([run], budget)
    return run, embedded, level


def entry_of(embedded, frame):
    return next(e for e in embedded.data["frames"] if e["frame"] == frame)


def test_every_picture_is_there_and_close(fake):
    _, embedded, _ = embed(fake.folder)
    assert [e["frame"] for e in embedded.data["frames"]] == list(FRAMES)
    for (strategy, frame), picture in fake.pictures.items():
        shown = decode(embedded.uris[entry_of(embedded, frame)["shown"][strategy]])
        assert np.abs(shown.astype(int) - picture).mean() < 2


def test_difference_is_that_of_the_exact_files(fake):
    _, embedded, _ = embed(fake.folder)
    for frame in FRAMES:
        exact = np.abs(fake.pictures["coh-b", frame].astype(int) - fake.pictures["bool", frame])
        against = entry_of(embedded, frame)["against"]["bool"]
        compared = against["coh-b"]
        left, top, width, height = compared["region"]
        # The crops are kept without loss: of the reference, the strategy, the difference.
        window = (slice(top, top + height), slice(left, left + width))
        for place, whole in zip(compared["crops"], (
                fake.pictures["bool", frame], fake.pictures["coh-b", frame],
                np.minimum(exact * encoding.AMPLIFY, 255))):
            np.testing.assert_array_equal(decode(embedded.uris[place]), whole[window])
        assert (left, top, pytest.approx(compared["error"], abs=0.006)) == find_worst_region(
            fake.pictures["coh-b", frame], fake.pictures["bool", frame], *pictures.REGION)
        assert against["sw-b"] is None, "SW(B) shows what Bool shows"
        assert "bool" not in against and "full" not in against


def test_difference_does_not_wrap_around():
    dark = np.zeros((2, 2, 3), dtype=np.uint8)
    bright = np.full((2, 2, 3), 255, dtype=np.uint8)
    assert (encoding.compute_difference(dark, bright, 8) == 255).all()
    assert (encoding.compute_difference(dark, dark + np.uint8(3), 8) == 24).all()
    assert (encoding.compute_difference(dark + np.uint8(3), dark, 8) == 24).all()


def test_equal_pictures_are_stored_once(fake):
    _, embedded, _ = embed(fake.folder)
    shown = entry_of(embedded, 3)["shown"]
    assert shown["bool"] == shown["sw-b"] == shown["full"] != shown["coh-b"]
    assert len(embedded.uris) == len(set(embedded.uris))
    assert embedded.size == sum(map(len, embedded.uris))


def test_overlays_are_there_and_close(fake):
    run, embedded, _ = embed(fake.folder)
    for frame in FRAMES:
        place = entry_of(embedded, frame)["overlays"]["coh-b"]["bias"]
        shown = decode(embedded.uris[place]).astype(int)
        assert np.abs(shown - run.image("coh-b", frame, "bias")).mean() < 3


def test_budget_is_kept_and_what_it_cost_is_said(fake):
    _, whole, first = embed(fake.folder)
    assert first == encoding.LEVELS[0]
    assert len(pictures.describe_level(first, [read_run(fake.folder)])) == 1
    sizes = []
    for share in (0.7, 0.5, 0.3):
        run, embedded, level = embed(fake.folder, share * whole.size)
        assert embedded.size <= share * whole.size
        sizes.append(embedded.size)
    assert sizes == sorted(sizes, reverse=True)
    assert level.overlays == 0 and level.stride > 1
    assert not any(e["overlays"].get("coh-b") for e in embedded.data["frames"])
    lines = " ".join(pictures.describe_level(level, [run]))
    assert "overlay pictures bias, level were left out" in lines and "Only every" in lines


def test_overlays_go_before_frames():
    worse = encoding.LEVELS
    for before, after in zip(worse, worse[1:]):
        assert after.overlays <= before.overlays
        assert after.stride >= before.stride
        assert after.stride == 1 or after.overlays == 0


def test_first_overlay_stays_longest(fake):
    run = read_run(fake.folder)
    level = encoding.Level(80, overlays=1)
    embedded = pictures.embed(run, level, FRAMES)
    assert embedded.data["overlays"] == ["bias"]
    assert list(entry_of(embedded, 3)["overlays"]["coh-b"]) == ["bias"]
    assert "overlay pictures level were" in pictures.describe_level(level, [run])[1]


def test_pictures_that_the_page_cannot_show_are_named(fake):
    fake.images["format"] = "exr"
    fake_run.write_json(fake.folder / "images" / "images.json", fake.images)
    run, embedded, _ = embed(fake.folder)
    assert embedded.data == {} and len(run.problems) == 1 and "found exr" in run.problems[0]


def test_without_bool_the_full_model_is_the_reference(tmp_path):
    fake_run.make_run(tmp_path, strategies=("coh-b", "sw-b"), image_frames=FRAMES, size=(160, 120))
    _, embedded, _ = embed(tmp_path)
    assert embedded.data["reference"] is None
    assert set(entry_of(embedded, 3)["against"]) == {"full"}
