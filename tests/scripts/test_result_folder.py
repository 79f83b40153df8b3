"""result_folder.py reads what is there, and names what is not."""

import json

import fake_run
import jsonschema
import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("PIL")
from fake_pictures import psnr, save  # noqa: E402
from result_folder import ResultError, find_worst_region, read_run  # noqa: E402

FRAMES = (3, 10, 20)


@pytest.fixture
def fake(tmp_path):
    return fake_run.make_run(tmp_path / "a run", image_frames=FRAMES)


def test_fake_run_has_the_format_of_the_program(fake, result_schema):
    jsonschema.Draft7Validator(result_schema).validate(fake.data)


def test_whole_run_has_no_problems(fake):
    run = read_run(fake.folder)
    assert run.problems == []
    assert run.scene == "fake"
    assert run.strategies() == ["bool", "sw-b", "simp-b", "coh-b"]
    assert run.image_strategies() == run.strategies()
    assert run.image_frames() == list(FRAMES)


def test_other_strategies_come_after_the_paper_s(tmp_path):
    strategies = ("mine", "coh-b", "other", "bool")
    fake = fake_run.make_run(tmp_path, strategies=strategies, image_frames=(3,))
    run = read_run(fake.folder)
    assert run.strategies() == ["bool", "coh-b", "mine", "other"]
    assert run.image_strategies() == run.strategies()
    assert [run.label(s) for s in run.strategies()] == ["Bool", "Coh(B)", "Mine", "Other"]


@pytest.mark.parametrize("repetitions", (1, 2, 3))
def test_frames_are_means_and_for_times_medians(tmp_path, repetitions):
    fake = fake_run.make_run(tmp_path, repetitions=repetitions)
    run = read_run(fake.folder)
    for strategy in run.strategies():
        logs = [fake.frames[strategy, r] for r in range(repetitions)]
        for counter in ("dn", "rarn", "queries"):
            expected = np.mean([log[counter] for log in logs], axis=0)
            np.testing.assert_allclose(run.frame_means(strategy, counter), expected)
        times = np.median([log["frame_ms"] for log in logs], axis=0)
        np.testing.assert_allclose(run.frame_means(strategy, "frame_ms"), times, rtol=1e-6)


def test_absent_counter_is_nan_and_never_zero(fake):
    run = read_run(fake.folder)
    assert np.isnan(run.frame_means("bool", "d")).all()
    assert np.isnan(run.frame_means("bool", "no_such_counter")).all()
    assert not np.isnan(run.frame_means("coh-b", "d")).any()


def test_failed_and_missing_cases_are_named_and_the_rest_stays(tmp_path):
    fake_run.make_run(tmp_path, failed=[("sw-b", 0), ("sw-b", 1)], missing=[("coh-b", 1)],
                      image_frames=FRAMES)
    run = read_run(tmp_path)
    assert run.strategies() == ["bool", "simp-b", "coh-b"]
    assert any("sw-b, repetition 0, failed: frame 2" in p for p in run.problems)
    assert any("coh-b, repetition 1, is missing" in p for p in run.problems)
    assert not np.isnan(run.frame_means("coh-b", "dn")).any()


def test_frame_log_cut_short_is_read_as_far_as_it_goes(fake):
    path = fake.folder / "coh-b.0.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([*lines[:11], lines[11][:9]]), encoding="utf-8")
    run = read_run(fake.folder)
    assert len(run.problems) == 1 and "coh-b.0.csv:12" in run.problems[0]
    assert len(next(c for c in run.cases if c.strategy == "coh-b").columns["dn"]) == 10
    assert len(run.frame_means("coh-b", "dn")) == 40, "repetition 1 is whole"


def test_pictures_are_those_written(fake):
    run = read_run(fake.folder)
    for (strategy, frame), picture in fake.pictures.items():
        np.testing.assert_array_equal(run.image(strategy, frame), picture)
    assert run.image("coh-b", 4) is None, "no such frame"
    assert run.image("coh-b", 3, "bias").shape == (48, 64, 3)
    assert run.image("coh-b", 3, "level") is None
    assert run.problems == []


def test_fake_psnr_is_that_of_its_pictures(fake):
    run = read_run(fake.folder)
    for frame in FRAMES:
        expected = psnr(run.image("coh-b", frame), run.image("bool", frame))
        assert run.image_entry("coh-b", frame)["vs_reference"] == pytest.approx(expected)
    assert run.image_entry("sw-b", 3)["vs_reference"] == {"y": None, "cb": None, "cr": None}
    assert run.image_entry("bool", 3)["vs_reference"] is None


@pytest.mark.parametrize("damage", ("gone", "text", "cut", "size"))
def test_damaged_picture_is_named_once(fake, damage):
    path = fake.folder / "images" / "coh-b.00010.png"
    if damage == "gone":
        path.unlink()
    elif damage == "text":
        path.write_text("no picture", encoding="utf-8")
    elif damage == "cut":
        path.write_bytes(path.read_bytes()[:-100])
    else:
        save(path, np.zeros((8, 8, 3)))
    run = read_run(fake.folder)
    assert run.image("coh-b", 10) is None and run.image("coh-b", 10) is None
    assert run.image("coh-b", 20) is not None
    assert len(run.problems) == 1 and "coh-b.00010.png: expected" in run.problems[0]


def test_run_without_pictures_says_so(tmp_path):
    fake_run.make_run(tmp_path)
    run = read_run(tmp_path)
    assert run.images is None and run.image_frames() == [] and run.image("bool", 3) is None
    assert len(run.problems) == 1 and "images.json" in run.problems[0]


def rewrite(folder, **members):
    data = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    data.update(members)
    fake_run.write_json(folder / "run.json", data)


def test_unusable_folder_is_refused_in_one_line(fake, tmp_path):
    with pytest.raises(ResultError, match="run.json: expected the result"):
        read_run(tmp_path / "nowhere")
    rewrite(fake.folder, schema_version="2.0.0")
    with pytest.raises(ResultError, match="schema_version: expected 1.x, found '2.0.0'"):
        read_run(fake.folder)
    for text in ("", "[]", "{", "null", '{"schema_version": 1}'):
        (fake.folder / "run.json").write_text(text, encoding="utf-8")
        with pytest.raises(ResultError) as refusal:
            read_run(fake.folder)
        assert "run.json" in str(refusal.value) and "\n" not in str(refusal.value)


@pytest.mark.parametrize("seed", range(5))
def test_worst_region_is_where_the_error_was_planted(seed):
    rng = np.random.default_rng(seed)
    reference = rng.integers(0, 200, (90, 120, 3)).astype(np.uint8)
    picture = reference + rng.integers(0, 2, reference.shape).astype(np.uint8)
    left, top = int(rng.integers(0, 121 - 20)), int(rng.integers(0, 91 - 10))
    picture[top : top + 10, left : left + 20] = reference[top : top + 10, left : left + 20] + 50
    found = find_worst_region(picture, reference, 20, 10)
    assert found == (left, top, pytest.approx(2500))


def test_worst_region_agrees_with_trying_every_window():
    rng = np.random.default_rng(9)
    a, b = rng.integers(0, 256, (2, 17, 23, 3)).astype(np.uint8)
    squared = ((a.astype(float) - b) @ (0.299, 0.587, 0.114)) ** 2
    errors = {(left, top): squared[top : top + 5, left : left + 7].mean()
              for left in range(23 - 6) for top in range(17 - 4)}
    worst = max(errors, key=errors.get)
    assert find_worst_region(a, b, 7, 5) == (*worst, pytest.approx(errors[worst]))


def test_worst_region_of_equal_or_small_pictures():
    picture = np.full((6, 8, 3), 9, dtype=np.uint8)
    assert find_worst_region(picture, picture, 4, 3)[2] == 0
    assert find_worst_region(picture, picture + np.uint8(2)) == (0, 0, pytest.approx(4))
