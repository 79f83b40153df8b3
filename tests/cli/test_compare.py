"""`hlodbench compare`: real small runs, and result folders with made-up times."""

import csv
import io
import json
import shutil
import statistics

import pytest
from made_up_times import copy_with_times, edit_json, read_log, write_log
from small_scene import past_the_walls, write_session, write_walls

EXACT = ("dn", "rarn", "d", "delays", "queries", "triangles", "nodes_visited")
TIMES = ("fps", "frame_ms", "cpu_ms", "wait_ms", "draw_ms", "query_ms", "traversal_ms")
FRAMES, WARM_UP = 16, 4
QUIET = [10.0, 10.001, 10.002, 10.003, 10.004, 10.005]


class World:
    """A hierarchy and runs through it, made when first asked for."""

    def __init__(self, hlodbench, folder):
        self.hlodbench, self.folder = hlodbench, folder
        self.hlod = self.build("walls", 3)
        self.session = write_session(folder / "path.json", past_the_walls(FRAMES))

    def build(self, name, walls):
        place = self.folder / f"scene {name}"
        place.mkdir()
        scene = write_walls(place, walls)
        result = self.hlodbench("build", scene, "-o", place / "a.hlod", "--max-triangles", "200")
        assert result.returncode == 0, result.stderr
        return place / "a.hlod"

    def run(self, name, *options, scene=None, session=None, latency="draws:5", images="0,9",
            warm_up=WARM_UP, strategies="bool,coh-b"):
        """The folder of a run with these options."""
        out = self.folder / name
        if not out.exists():
            fixed = ["--scene", scene or self.hlod, "--session", session or self.session]
            fixed += ["--warm-up", warm_up, "--latency", latency, "--images", images]
            fixed += ["--strategy", strategies, "--out", out]
            result = self.hlodbench("run", *fixed, *options)
            assert result.returncode == 0, result.stderr
        return out

    def base(self):
        """Six repetitions with a fixed latency."""
        return self.run("base", "--repetitions", "6")

    def compare(self, a, b, *options):
        """The comparison as JSON; its exit code is checked against what it says."""
        result = self.hlodbench("compare", a, b, "--format", "json", *options)
        assert result.returncode in (0, 1), result.stderr
        comparison = json.loads(result.stdout)
        verdicts = [r["verdict"] for p in comparison["pairs"] for r in p["rows"]]
        assert result.returncode == (1 if "WORSE" in verdicts else 0)
        for verdict in ("SAME", "BETTER", "WORSE", "UNCLEAR"):
            assert comparison["verdicts"][verdict] == verdicts.count(verdict)
        return comparison

    def rows(self, a, b, *options, pair=0):
        return {r["key"]: r for r in self.compare(a, b, *options)["pairs"][pair]["rows"]}

    def refuse(self, a, b, *options):
        """The lines of a refusal."""
        result = self.hlodbench("compare", a, b, *options)
        assert result.returncode == 2 and result.stdout == "", result.stdout
        lines = result.stderr.splitlines()
        assert lines and all(line.startswith("hlodbench: ") for line in lines)
        return [line.removeprefix("hlodbench: ") for line in lines]


@pytest.fixture(scope="module")
def world(hlodbench, tmp_path_factory):
    return World(hlodbench, tmp_path_factory.mktemp("a world"))


def verdicts(rows, keys):
    return {rows[key]["verdict"] for key in keys}


def counts(folder, strategy, key, repetition=0):
    """Of the measured frames."""
    rows = read_log(folder / f"{strategy}.{repetition}.csv")
    return [float(row[key]) for row in rows if row["warm_up"] == "0"]


# Counts


def test_two_runs_of_the_same_count_the_same(world):
    comparison = world.compare(world.base(), world.run("twin", "--seed", "5"))
    assert [p["strategy_a"] for p in comparison["pairs"]] in (["bool", "coh-b"], ["coh-b", "bool"])
    for pair in comparison["pairs"]:
        assert pair["strategy_a"] == pair["strategy_b"]
        rows = {r["key"]: r for r in pair["rows"]}
        for key in EXACT:
            assert rows[key]["verdict"] == "SAME"
            assert rows[key]["reason"] == f"equal in all {FRAMES - WARM_UP} frames"
            assert rows[key]["a"] == rows[key]["b"] and rows[key]["difference"]["value"] == 0
        pictures = [r for r in pair["rows"] if r["group"] == "pictures"]
        assert {r["verdict"] for r in pictures} == {"SAME"}
        assert {r["key"] for r in pictures} >= {"vs_full.y", "wrong_pixels", "crack_pixels"}
    assert "two runs: " in " ".join(comparison["notes"])


def test_other_counts_differ_by_what_the_logs_say(world):
    a, b = world.base(), world.run("smooth", "--s", "0")
    comparison = world.compare(a, b)
    assert "option s: A 1.0, B 0.0" in comparison["notes"]
    pairs = {p["strategy_a"]: {r["key"]: r for r in p["rows"]} for p in comparison["pairs"]}
    assert verdicts(pairs["bool"], EXACT) == {"SAME"}, "Bool has no bias"
    row = pairs["coh-b"]["dn"]
    ours, others = counts(a, "coh-b", "dn"), counts(b, "coh-b", "dn")
    different = [i for i, (x, y) in enumerate(zip(ours, others)) if x != y]
    assert different
    assert row["reason"] == (
        f"differs in {len(different)} of {len(ours)} frames, first in frame "
        f"{WARM_UP + different[0]}"
    )
    assert row["different_frames"] == len(different)
    change = statistics.fmean(others) - statistics.fmean(ours)
    assert row["difference"]["value"] == pytest.approx(change)
    assert row["relative"]["value"] == pytest.approx(change / statistics.fmean(ours))
    assert row["difference"]["low"] <= change <= row["difference"]["high"]
    assert row["verdict"] == ("WORSE" if change > 0 else "BETTER")
    back = {p["strategy_a"]: p for p in world.compare(b, a)["pairs"]}["coh-b"]
    opposite = {r["key"]: r for r in back["rows"]}["dn"]
    assert {row["verdict"], opposite["verdict"]} == {"WORSE", "BETTER"}


def test_one_count_in_one_frame_is_a_difference(world, tmp_path):
    folder = tmp_path / "edited"
    shutil.copytree(world.run("twin", "--seed", "5"), folder)
    rows = read_log(folder / "coh-b.0.csv")
    rows[11]["dn"] = str(int(rows[11]["dn"]) - 1)
    write_log(folder / "coh-b.0.csv", rows)
    found = world.rows(f"{world.base()}:coh-b", folder)
    assert found["dn"]["verdict"] == "BETTER"
    assert found["dn"]["reason"] == "differs in 1 of 12 frames, first in frame 11"
    assert verdicts(found, EXACT[1:]) == {"SAME"}


def test_frames_that_one_of_them_warmed_up_in_take_no_part(world, tmp_path):
    late = world.run("late", warm_up=9)
    rows = world.rows(f"{world.base()}:bool", late)
    assert rows["dn"]["reason"] == f"equal in all {FRAMES - 9} frames"
    assert "warm-up frames: A 4, B 9" in world.compare(world.base(), late)["notes"]


def test_repetitions_that_count_differently_are_no_exact_ones(world, tmp_path):
    folder = tmp_path / "edited"
    shutil.copytree(world.base(), folder)
    rows = read_log(folder / "coh-b.3.csv")
    rows[11]["dn"] = str(int(rows[11]["dn"]) - 1)
    write_log(folder / "coh-b.3.csv", rows)
    pair = world.compare(f"{world.base()}:coh-b", folder)["pairs"][0]
    row = {r["key"]: r for r in pair["rows"]}["dn"]
    assert row["of"] == "6 and 6 repetitions" and row["verdict"] == "SAME"
    assert any(n.startswith("dn: the repetitions of B count differently") for n in pair["notes"])


def test_counts_with_the_drivers_latency_are_compared_over_repetitions(world):
    driver = world.run("driver", "--repetitions", "2", latency="gl")
    comparison = world.compare(f"{driver}:bool", f"{driver}:coh-b")
    assert any(n.startswith("counts are not exact with latency gl") for n in comparison["notes"])
    rows = {r["key"]: r for r in comparison["pairs"][0]["rows"]}
    for key in EXACT:
        assert rows[key]["of"] == "2 pairs" and rows[key]["verdict"] == "UNCLEAR"
        assert rows[key]["reason"].startswith("too few repetitions: 2 against 2 give p = 0.33")


def test_two_strategies_of_one_run(world):
    base = world.base()
    comparison = world.compare(f"{base}:bool", f"{base}:coh-b")
    (pair,) = comparison["pairs"]
    assert (pair["label_a"], pair["label_b"]) == ("Bool", "Coh(B)")
    rows = {r["key"]: r for r in pair["rows"]}
    change = statistics.fmean(counts(base, "coh-b", "dn")) - statistics.fmean(
        counts(base, "bool", "dn")
    )
    assert rows["dn"]["difference"]["value"] == pytest.approx(change)
    assert rows["fps"]["of"] == "6 pairs"
    assert "vs_reference.y" not in rows, "Bool is the reference itself"
    assert set(rows) >= {*EXACT, *TIMES, "vs_full.y"}


# Times


def made_up(world, folder, **times):
    return copy_with_times(world.base(), folder, {k.replace("_", "-"): v for k, v in times.items()})


@pytest.mark.parametrize("factor, verdict", [(1.05, "WORSE"), (0.95, "BETTER"), (1.0005, "SAME")])
def test_a_change_of_times_is_found(world, tmp_path, factor, verdict):
    a = made_up(world, tmp_path / "a", coh_b=QUIET)
    b = made_up(world, tmp_path / "b", coh_b=[t * factor for t in QUIET])
    rows = world.rows(a, b)
    assert verdicts(rows, TIMES) == {verdict}
    assert rows["frame_ms"]["relative"]["value"] == pytest.approx(factor - 1, abs=2e-4)
    assert rows["fps"]["a"] == pytest.approx(1000 / statistics.median(QUIET), rel=1e-3)
    assert rows["fps"]["a12"] == pytest.approx(1 - rows["frame_ms"]["a12"])
    result = world.hlodbench("compare", a, b)
    assert result.returncode == (1 if verdict == "WORSE" else 0)


def test_noise_is_unclear(world, tmp_path):
    noisy = [10.0, 13.0, 9.0, 14.0, 8.0, 12.0]
    a = made_up(world, tmp_path / "a", coh_b=noisy)
    b = made_up(world, tmp_path / "b", coh_b=[t + 0.5 for t in noisy])
    rows = world.rows(a, b)
    assert verdicts(rows, TIMES) == {"UNCLEAR"}
    assert "the interval reaches beyond +-1 %" in rows["fps"]["reason"]


def test_three_repetitions_are_too_few_and_it_says_how_many_are_not(world, tmp_path):
    a = made_up(world, tmp_path / "a", coh_b=QUIET[:3])
    b = made_up(world, tmp_path / "b", coh_b=[20, 20, 20])
    row = world.rows(a, b)["fps"]
    assert row["verdict"] == "UNCLEAR" and row["p"] == pytest.approx(0.1)
    assert row["reason"] == (
        "too few repetitions: 3 against 3 give p = 0.1 at least; 4 each are needed for p < 0.05"
    )
    assert world.rows(a, b, "--alpha", "0.2")["fps"]["verdict"] == "WORSE"


def test_thresholds_are_the_users(world, tmp_path):
    a = made_up(world, tmp_path / "a", coh_b=QUIET)
    b = made_up(world, tmp_path / "b", coh_b=[t * 1.02 for t in QUIET])
    assert world.rows(a, b)["fps"]["verdict"] == "WORSE"
    assert world.rows(a, b, "--min-change", "5")["fps"]["verdict"] == "SAME"
    assert world.rows(a, b, "--alpha", "0.001")["fps"]["verdict"] == "UNCLEAR"
    mixed = made_up(world, tmp_path / "c", coh_b=[9.9, 9.95, *[t * 1.05 for t in QUIET[:4]]])
    row = world.rows(a, mixed, "--alpha", "0.5")["frame_ms"]
    assert row["a12"] == pytest.approx(4 / 6) and row["verdict"] == "UNCLEAR"
    row = world.rows(a, mixed, "--alpha", "0.5", "--effect", "0.6")["frame_ms"]
    assert row["verdict"] == "WORSE"


def test_strategies_of_one_run_are_paired_by_repetition(world, tmp_path):
    drift = [10.0, 10.4, 10.8, 11.2, 11.6, 12.0]
    folder = made_up(world, tmp_path / "a", bool=drift, coh_b=[1.03 * t for t in drift])
    row = world.rows(f"{folder}:bool", f"{folder}:coh-b")["frame_ms"]
    for bound in ("value", "low", "high"):
        assert row["relative"][bound] == pytest.approx(0.03)
    # as two runs, the drift is all there is
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    unpaired = world.rows(f"{folder}:bool", f"{copy}:coh-b")["frame_ms"]
    assert unpaired["relative"]["high"] - unpaired["relative"]["low"] > 0.05


def test_p_is_that_of_scipy(world, tmp_path):
    reason = "python3-scipy is not installed: p is not compared with scipy's"
    scipy_stats = pytest.importorskip("scipy.stats", reason=reason)
    times = [[10, 11, 12, 13, 14, 15.5], [10.5, 12.5, 14.5, 15, 16, 17], [9, 9.5, 14.2, 18, 19]]
    folders = [
        made_up(world, tmp_path / str(i), coh_b=values) for i, values in enumerate(times)
    ]
    for i, j in ((0, 1), (1, 0), (0, 2), (2, 1)):
        row = world.rows(folders[i], folders[j])["frame_ms"]
        test = scipy_stats.mannwhitneyu(times[j], times[i], method="exact")
        assert row["p"] == pytest.approx(test.pvalue)
        assert row["a12"] == pytest.approx(test.statistic / len(times[i]) / len(times[j]))


@pytest.mark.parametrize("member", ["cpu_model", "build_type", "renderer"])
def test_times_of_another_machine_are_not_compared_unless_told(world, tmp_path, member):
    a = made_up(world, tmp_path / "a", coh_b=QUIET)
    b = made_up(world, tmp_path / "b", coh_b=[2 * t for t in QUIET])

    def edit(run):
        place = run["context"]["gl"] if member == "renderer" else run["context"]
        place[member] = "another"

    edit_json(b / "run.json", edit)
    comparison = world.compare(a, b)
    rows = {r["key"]: r for r in comparison["pairs"][0]["rows"]}
    assert not set(rows) & set(TIMES) and verdicts(rows, EXACT) == {"SAME"}
    assert any(n.startswith("times are not compared: another") for n in comparison["notes"])
    assert verdicts(world.rows(a, b, "--allow", "machine"), TIMES) == {"WORSE"}


# What is not comparable


@pytest.fixture(scope="module")
def others(world):
    """Runs that differ from the base in one thing each."""
    session = write_session(world.folder / "other.json", past_the_walls(FRAMES + 1)[1:])
    return {
        "size": world.run("size", "--size", "80x60"),
        "tau": world.run("tau", "--tau", "3"),
        "session": world.run("session", session=session),
        "scene": world.run("scene", scene=world.build("more walls", 2)),
        "all": world.run("all", "--size", "80x60", "--tau", "3", session=session,
                         scene=world.build("few walls", 1)),
    }


@pytest.mark.parametrize("what", ["size", "tau", "session", "scene"])
def test_what_is_not_comparable_is_refused_unless_allowed(world, others, what):
    (line,) = world.refuse(world.base(), others[what])
    assert f"--allow {what} " in line and "differs: A " in line
    comparison = world.compare(world.base(), others[what], "--allow", what)
    assert any(n.endswith("(allowed)") for n in comparison["notes"])
    rows = {r["key"]: r for r in comparison["pairs"][0]["rows"]}
    assert set(rows) >= set(EXACT)
    assert ("vs_full.y" in rows) == (what in ("tau", "scene"))
    others_allowed = [w for w in ("size", "tau", "session", "scene") if w != what]
    assert len(world.refuse(world.base(), others[what], "--allow", ",".join(others_allowed))) == 1


def test_every_difference_has_a_line(world, others):
    lines = world.refuse(world.base(), others["all"])
    assert [line.split(" differs")[0] for line in lines] == [
        "scene", "session", "viewport size", "tau",
    ]  # fmt: skip
    assert len(world.refuse(world.base(), others["all"], "--allow", "scene,tau")) == 2
    world.compare(world.base(), others["all"], "--allow", "scene,session,size,tau")


def test_other_sessions_have_no_frames_to_pair(world, others):
    row = world.rows(f"{world.base()}:coh-b", others["session"], "--allow", "session")["dn"]
    assert row["difference"]["low"] is None and "other frames" in row["reason"]
    ours = counts(world.base(), "coh-b", "dn")
    assert row["a"] == pytest.approx(statistics.fmean(ours))


# Damage


def remove_log(folder):
    (folder / "coh-b.2.csv").unlink()


def cut_log(folder):
    path = folder / "coh-b.2.csv"
    path.write_text("\n".join(path.read_text().splitlines()[:-3]) + "\n")


def swap_frames(folder):
    rows = read_log(folder / "coh-b.2.csv")
    write_log(folder / "coh-b.2.csv", [rows[1], rows[0], *rows[2:]])


def spoil_log(folder):
    path = folder / "coh-b.2.csv"
    path.write_text(path.read_text().replace("\n5,", "\nfive,"))


def cut_run(folder):
    path = folder / "run.json"
    path.write_text(path.read_text()[:2000])


def cut_images(folder):
    path = folder / "images" / "images.json"
    path.write_text(path.read_text()[:500])


def spoil_images(folder):
    edit_json(folder / "images" / "images.json", lambda j: j["strategies"][0].pop("frames"))


DAMAGE = {
    remove_log: "coh-b.2.csv",
    cut_log: "expected the session's 16 frames, found 13",
    swap_frames: "coh-b.2.csv:2: expected frame 0, found 1",
    spoil_log: "five",
    cut_run: "run.json: expected JSON",
    cut_images: "images.json: expected JSON",
    spoil_images: "/strategies/0: expected a member \"frames\"",
    shutil.rmtree: "expected a result folder with a run.json in it",
}


@pytest.mark.parametrize("damage", DAMAGE, ids=lambda d: d.__name__)
def test_a_damaged_folder_is_named(world, tmp_path, damage):
    folder = tmp_path / "damaged"
    shutil.copytree(world.base(), folder)
    damage(folder)
    for sides in ((world.base(), folder), (folder, world.base())):
        (line,) = world.refuse(*sides)
        assert str(folder) in line and DAMAGE[damage] in line


def test_a_log_of_a_strategy_not_asked_for_is_not_read(world, tmp_path):
    folder = tmp_path / "damaged"
    shutil.copytree(world.base(), folder)
    cut_log(folder)
    world.compare(f"{folder}:bool", world.base())


def test_failed_and_missing_replays_are_named_and_the_rest_compared(world, tmp_path):
    folder = tmp_path / "part"
    shutil.copytree(world.base(), folder)

    def edit(run):
        cases = run["cases"]
        failed = next(c for c in cases if (c["strategy"], c["repetition"]) == ("coh-b", 1))
        failed.update(error="context lost", csv=None, summary=None)
        lost = next(c for c in cases if (c["strategy"], c["repetition"]) == ("coh-b", 5))
        cases.remove(lost)
        run.update(complete=False, missing=[{"strategy": "coh-b", "repetition": 5}])

    edit_json(folder / "run.json", edit)
    comparison = world.compare(f"{world.base()}:coh-b", folder)
    notes = comparison["notes"]
    assert "B: Coh(B) repetition 1 failed: context lost" in notes
    assert "B: incomplete run, missing: Coh(B) repetition 5" in notes
    rows = {r["key"]: r for r in comparison["pairs"][0]["rows"]}
    assert rows["fps"]["of"] == "6 and 4 repetitions" and rows["dn"]["verdict"] == "SAME"
    inside = world.rows(f"{folder}:bool", f"{folder}:coh-b")
    assert inside["fps"]["of"] == "4 pairs"


def test_a_strategy_of_one_side_is_named(world, tmp_path):
    single = world.run("single", strategies="coh-b")
    assert "bool: only A has it" in world.compare(world.base(), single)["notes"]
    (line,) = world.refuse(f"{world.base()}:bool", single)
    assert "expected a strategy that ran in both" in line
    (line,) = world.refuse(world.base(), f"{single}:sw-b")
    assert "expected a strategy of the run (coh-b), found 'sw-b'" in line
    assert "after the colon" in world.refuse(world.base(), f"{single}:")[0]


@pytest.mark.parametrize(
    "options",
    [("--allow", "everything"), ("--alpha", "0"), ("--alpha", "nan"), ("--effect", "0.4"),
     ("--min-change", "-1"), ("--format", "xml")],
)  # fmt: skip
def test_wrong_options_are_refused(world, options):
    assert len(world.refuse(world.base(), world.base(), *options)) == 1


# Pictures


def test_pictures_are_compared_frame_by_frame(world, tmp_path):
    folder = tmp_path / "other pictures"
    shutil.copytree(world.base(), folder)

    def edit(images):
        first, second = next(s for s in images["strategies"] if s["strategy"] == "coh-b")["frames"]
        first["vs_full"]["y"] -= 2
        second["vs_full"]["y"] += 1
        second["vs_full"]["cb"] = None  # identical
        first["wrong_pixels"] += 3

    edit_json(folder / "images" / "images.json", edit)
    rows = world.rows(f"{world.base()}:coh-b", folder)
    assert rows["vs_full.y"]["difference"]["value"] == pytest.approx(-0.5)
    assert rows["vs_full.y"]["verdict"] == "WORSE" and rows["vs_full.y"]["relative"] is None
    assert rows["vs_full.cb"]["verdict"] == "BETTER"
    assert "0 of both, 0 of A alone, 1 of B alone" in rows["vs_full.cb"]["reason"]
    assert rows["vs_full.cr"]["verdict"] == "SAME"
    assert rows["wrong_pixels"]["difference"]["value"] == pytest.approx(1.5)
    assert rows["wrong_pixels"]["verdict"] == "WORSE"


def test_pictures_of_other_frames_and_none_are_said(world):
    part = world.run("part of the pictures", images="9,12")
    comparison = world.compare(f"{world.base()}:coh-b", part)
    notes = comparison["pairs"][0]["notes"]
    assert "pictures: A has 2 frames, B 2; compared are the 1 of both" in notes
    none = world.run("no pictures", images="none")
    notes = world.compare(world.base(), none)["notes"]
    assert "pictures are not compared: B has no pictures" in notes


# Output


def test_formats_say_the_same(world, tmp_path):
    a = made_up(world, tmp_path / "a", coh_b=QUIET, bool=QUIET)
    b = made_up(world, tmp_path / "b | c", coh_b=[t * 1.05 for t in QUIET], bool=QUIET)
    comparison = world.compare(a, b)
    table = world.hlodbench("compare", a, b, "--format", "csv")
    rows = list(csv.DictReader(io.StringIO(table.stdout)))
    flat = [(p, r) for p in comparison["pairs"] for r in p["rows"]]
    assert len(rows) == len(flat)
    for row, (pair, value) in zip(rows, flat):
        assert (row["strategy_b"], row["key"]) == (pair["strategy_b"], value["key"])
        assert (row["verdict"], row["reason"]) == (value["verdict"], value["reason"])
        assert row["folder_b"] == str(b)
        count = row["different_frames"]
        assert (int(count) if count else None) == value["different_frames"]
        for name in ("a", "b", "p"):
            found = float(row[name]) if row[name] else None
            assert found == value[name]
    assert all(f"note: {note}" in table.stderr for note in comparison["notes"])
    text = world.hlodbench("compare", a, b).stdout
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert len(lines) == len(flat) + 2 * len(comparison["pairs"])
    assert len({line.replace("\\|", "").count("|") for line in lines}) == 1
    v = comparison["verdicts"]
    assert text.startswith(
        f"### B against A: {v['BETTER']} BETTER, {v['WORSE']} WORSE, {v['SAME']} SAME, "
        f"{v['UNCLEAR']} UNCLEAR\n"
    )
    assert all(note.replace("|", "\\|") in text for note in comparison["notes"])


def test_the_same_folders_give_the_same_output(world):
    first, second = (world.hlodbench("compare", world.base(), world.base()) for _ in range(2))
    assert first.returncode == 0 and first.stdout == second.stdout
    assert "0 WORSE" in first.stdout and "0 UNCLEAR" in first.stdout
