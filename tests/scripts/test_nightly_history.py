"""The history of scripts/nightly.sh: what is written, what is read of it, and what is damaged."""

import json
import os
import pathlib
import random
import time

import pytest

np = pytest.importorskip("numpy", reason="needs python3-numpy")
jsonschema = pytest.importorskip("jsonschema", reason="needs python3-jsonschema")

from made_up_nights import (CELL, CONTEXT, KEY, SLOWER, add_night, make_acceptance,  # noqa: E402
                            make_night, make_times)
from tracking import migrate  # noqa: E402
from tracking.accept import accept  # noqa: E402
from tracking.errors import TrackingError  # noqa: E402
from tracking.exact import find_differences, find_reference, judge_exact  # noqa: E402
from tracking.history import append, list_machines, read_history  # noqa: E402
from tracking.machine import describe_machine  # noqa: E402
from tracking.night import list_samples  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "results/night.schema.json").read_text(encoding="utf-8"))
CHECK = jsonschema.Draft7Validator(SCHEMA)


def write(folder, name, text):
    (folder / KEY).mkdir(parents=True, exist_ok=True)
    (folder / KEY / name).write_text(text, encoding="utf-8")


# What is written


def test_schema_is_a_schema():
    jsonschema.Draft7Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("timing", [None, "baseline", "history"])
def test_files_are_what_the_schema_says(tmp_path, timing):
    night = make_night(1, exact="DIFFERENT", dn=101.0, timing=SLOWER)
    if timing:
        night["timing"] = make_times(timing)
    files = [append(tmp_path, KEY, night, "0123456789ab"),
             append(tmp_path, KEY, make_acceptance(2, "a"), "accept")]
    for path in files:
        data = json.loads(path.read_text(encoding="utf-8"))
        CHECK.validate(data)
        assert not CHECK.is_valid({**data, "unknown": 1})
        for key in data:
            assert not CHECK.is_valid({k: v for k, v in data.items() if k != key}), key
    assert len(read_history(tmp_path, KEY).nights) == 1


def test_names_tell_time_and_revision_and_are_never_used_twice(tmp_path):
    names = {append(tmp_path, KEY, make_night(1), "0123456789ab-dirty").name for _ in range(50)}
    assert len(names) == 50
    assert all(name.startswith("20260102T030405Z-0123456789abdirt") for name in names)
    assert list_machines(tmp_path) == [KEY]


def test_a_killed_writer_leaves_nothing_that_is_read(tmp_path):
    add_night(tmp_path, 1)
    write(tmp_path, ".abc.tmp", '{"schema": 1, "ki')
    assert read_history(tmp_path, KEY).problems == []
    assert len(read_history(tmp_path, KEY).nights) == 1
    add_night(tmp_path, 2)
    assert (tmp_path / KEY / ".abc.tmp").exists()  # it may be at it still
    old = time.time() - 7200
    os.utime(tmp_path / KEY / ".abc.tmp", (old, old))
    add_night(tmp_path, 3)
    assert not (tmp_path / KEY / ".abc.tmp").exists()


# Order


def test_order_is_that_of_writing_whatever_the_clock_says_and_names(tmp_path):
    times = ["2026-01-05T00:00:00Z", "2026-01-06T00:00:00Z", "2025-12-31T00:00:00Z",
             "2026-01-07T00:00:00Z"]
    ids = [add_night(tmp_path, i + 1, time) for i, time in enumerate(times)]
    history = read_history(tmp_path, KEY)
    assert [night.id for night in history.nights] == ids
    assert history.next_sequence == 5
    (problem,) = history.problems
    assert ids[2] in problem and "clock went back" in problem


def test_folders_brought_together_are_ordered_alike_whoever_reads_them(tmp_path):
    nights = [(s, f"2026-01-{d:02}T00:00:00Z") for s in (1, 2, 3) for d in (4, 5)]
    random.Random(1).shuffle(nights)
    for sequence, when in nights:
        add_night(tmp_path, sequence, when)
    found = [(n.data["sequence"], n.data["time_utc"]) for n in read_history(tmp_path, KEY).nights]
    assert found == sorted(nights)


# Damage


DAMAGE = {
    "empty": "", "half": '{"schema": 1, "kind": "night", "seq', "list": "[]", "number": "3",
    "not text": "\udcff", "deep": "[" * 100000, "newer": '{"schema": 2, "kind": "night"}',
    "no schema": '{"kind": "night"}', "other kind": '{"schema": 1, "kind": "day"}',
    "no members": '{"schema": 1, "kind": "night"}', "v0": '{"schema": 0}',
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_a_damaged_file_is_named_and_costs_one_night(tmp_path, kind):
    ids = [add_night(tmp_path, s) for s in (1, 3)]
    path = tmp_path / KEY / "20260102T030405Z-0-damaged.json"
    path.write_bytes(DAMAGE[kind].encode("utf-8", "surrogateescape"))
    history = read_history(tmp_path, KEY)
    assert [night.id for night in history.nights] == ids
    (problem,) = history.problems
    assert problem.startswith(f"{path}: ") and "\n" not in problem


@pytest.mark.parametrize("wrong", [[], {"frame": []}, {"frame": [0.0]}, {"draw": ["1"]}, "x"])
def test_damaged_ratios_are_named(tmp_path, wrong):
    times = make_times()
    times["cells"][CELL]["ratios"] = wrong
    write(tmp_path, "b.json", json.dumps({"schema": 1, **make_night(1), "timing": times}))
    history = read_history(tmp_path, KEY)
    assert history.nights == [] and "ratios: expected" in history.problems[0]


def test_no_damage_of_a_member_stops_the_reader(tmp_path):
    night = {"schema": 1, **make_night(1, timing=SLOWER), "timing": make_times()}
    add_night(tmp_path, 1)

    def places(value, path=()):
        yield path
        items = value.items() if isinstance(value, dict) else ()
        for key, child in items:
            yield from places(child, path + (key,))

    for path in list(places(night))[1:]:
        for wrong in (None, [], {}, "x", -1, True, [None], {"a": None}, float("nan")):
            changed = json.loads(json.dumps(night))
            place = changed
            for step in path[:-1]:
                place = place[step]
            place[path[-1]] = wrong
            write(tmp_path, "b.json", json.dumps(changed))
            history = read_history(tmp_path, KEY)
            assert len(history.nights) + len(history.acceptances) in (1, 2), (path, wrong)
            judge_exact(history, CELL, {"dn": 1.0})
            for entry in history.nights:
                assert entry.order


def test_a_night_of_another_machine_is_no_night_of_this_one(tmp_path):
    write(tmp_path, "a.json", json.dumps({"schema": 1, **make_night(1), "machine": {
        "key": "other", "gl_class": "gpu"}}))
    history = read_history(tmp_path, KEY)
    assert history.nights == [] and "other" in history.problems[0]


# Versions and names


def test_a_whole_file_of_a_newer_version_is_not_guessed_at(tmp_path):
    write(tmp_path, "a.json", json.dumps({"schema": migrate.VERSION + 1, **make_night(1)}))
    history = read_history(tmp_path, KEY)
    assert history.nights == [] and "a newer nightly.sh wrote it" in history.problems[0]


def test_a_night_of_version_0_is_read_and_said(tmp_path):
    write(tmp_path, "20250101T000000Z-a-1.json", json.dumps({
        "schema": 0, "time": "2025-01-01T00:00:00Z", "revision": "abc", "scene": "courtyard",
        "counters": {"coh-b": {"dn": 99.0}}, "machine": {"cpu_model": "x"}}))
    add_night(tmp_path, 1)
    history = read_history(tmp_path, KEY)
    assert history.nights[0].data["exact"] == {CELL: {"dn": 99.0}}
    assert "version 0" in history.problems[0]
    assert find_reference(history, CELL)[1]["dn"] == 99.0


def test_a_renamed_counter_is_compared_under_its_new_name(tmp_path, monkeypatch):
    add_night(tmp_path, 1)
    new = {"drawn": 100.0, "drawn.frames": "100.0", "scene": "00"}
    verdict = judge_exact(read_history(tmp_path, KEY), CELL, new)
    assert [d["key"] for d in verdict["differences"]] == ["dn", "dn.frames"]
    monkeypatch.setitem(migrate.RENAMED, "dn", "drawn")
    history = read_history(tmp_path, KEY)
    assert judge_exact(history, CELL, new)["verdict"] == "SAME"
    assert "counter dn is now called drawn" in history.problems[0]


def test_a_new_counter_is_no_difference_and_a_lost_one_is():
    old = {"dn": 1.0, "d": 2}
    assert find_differences(old, {**old, "new": 3}) == []
    assert find_differences(old, {"dn": 1.0}) == [{"key": "d", "old": 2, "new": None}]
    assert [d["key"] for d in find_differences(old, {"dn": 1.0 + 2**-50, "d": 2})] == ["dn"]


def test_a_new_counter_is_compared_from_the_night_on_that_first_had_it(tmp_path):
    first = add_night(tmp_path, 1)
    night = make_night(2, reference=first)
    night["exact"][CELL]["later"] = 7
    append(tmp_path, KEY, night, "a")
    identity, values = find_reference(read_history(tmp_path, KEY), CELL)
    assert identity == first and values == night["exact"][CELL]


# The accepted night


def test_a_change_is_one_until_it_is_accepted(tmp_path):
    first = add_night(tmp_path, 1)
    second = add_night(tmp_path, 2, dn=101.0, exact="DIFFERENT", reference=first)
    changed = {"dn": 101.0}
    assert find_reference(read_history(tmp_path, KEY), CELL)[0] == first
    path, cells, _ = accept(tmp_path, None, [], "A. Nother", "a better front")
    assert cells == [CELL]
    CHECK.validate(json.loads(path.read_text(encoding="utf-8")))
    history = read_history(tmp_path, KEY)
    assert history.acceptances[0].data["who"] == "A. Nother"
    assert history.acceptances[0].data["sequence"] == 3
    assert find_reference(history, CELL)[0] == second
    assert judge_exact(history, CELL, changed | {"dn.frames": "101.0", "scene": "00"})[
        "verdict"] == "SAME"
    assert judge_exact(history, CELL, changed)["verdict"] == "DIFFERENT"


def test_losing_the_first_night_does_not_accept_the_second(tmp_path):
    first = add_night(tmp_path, 1)
    add_night(tmp_path, 2, dn=101.0, exact="DIFFERENT", reference=first)
    third = add_night(tmp_path, 3, reference=first)
    write(tmp_path, f"{first}.json", "")
    assert find_reference(read_history(tmp_path, KEY), CELL)[0] == third


def test_a_night_that_was_the_same_stands_in_for_a_lost_accepted_one(tmp_path):
    add_night(tmp_path, 1)
    second = add_night(tmp_path, 2, dn=101.0, exact="DIFFERENT")
    accept(tmp_path, None, [], "A", "b")
    third = add_night(tmp_path, 4, dn=101.0, reference=second)
    write(tmp_path, f"{second}.json", "")
    assert find_reference(read_history(tmp_path, KEY), CELL)[0] == third


@pytest.mark.parametrize("cells, why, expected", [
    ([], " ", "--why"), (["courtyard/none"], "b", CELL), ([], "b", "nothing to accept")])
def test_what_cannot_be_accepted_is_refused(tmp_path, cells, why, expected):
    add_night(tmp_path, 1)
    with pytest.raises(TrackingError, match=expected):
        accept(tmp_path, None, cells, "A", why)


def test_of_several_machines_one_is_to_be_named(tmp_path):
    add_night(tmp_path, 1, dn=101.0, exact="DIFFERENT")
    (tmp_path / "another-machine").mkdir()
    with pytest.raises(TrackingError, match="another-machine"):
        accept(tmp_path, None, [], "A", "b")
    accept(tmp_path, KEY[:9], [], "A", "b")


# Times of earlier nights


def test_nights_that_were_slow_are_no_norm_until_they_are_accepted(tmp_path):
    def add(sequence, verdict, change=lambda night: None):
        night = make_night(sequence, timing={**SLOWER, "verdict": verdict})
        night["timing"] = make_times("history", new=[float(sequence)])
        night["exact"][CELL]["session"] = "00"
        change(night)
        return night, append(tmp_path, KEY, night, "a")

    tonight, _ = add(1, "SAME")
    add(2, "SLOW")
    add(3, "FAST")
    add(4, "SAME", lambda night: night["exact"][CELL].update(scene="another"))
    add(5, "SAME", lambda night: night["timing"]["calibration"].update(workload="another"))
    add(6, "SAME", lambda night: night["timing"]["cells"][CELL].update(calibration=2.0))
    add(7, "SAME", lambda night: night.update(timing=None))

    def found(workload):
        return list_samples(CELL, tonight, read_history(tmp_path, KEY), workload)

    assert found("numpy-1") == [[1.0], [3.0], [3.0]]
    assert found(None) == [[1.0], [3.0], [5.0], [3.0]]
    _, slow = add(8, "SLOW")
    append(tmp_path, KEY, make_acceptance(9, slow.stem), "accept")
    add(10, "SLOW")
    add(11, "SAME")
    assert found("numpy-1") == [[8.0], [11.0]]


# Machines


def test_whatever_may_change_times_changes_the_key():
    keys = {describe_machine(CONTEXT)["key"], describe_machine(CONTEXT, "lab-1")["key"]}
    for change in ({"cpu_model": "B"}, {"cpu_cores": 4}, {"compiler": "GCC 13"},
                   {"build_type": "Debug"}, {"gl": {**CONTEXT["gl"], "renderer": "NVIDIA H100"}},
                   {"gl": {**CONTEXT["gl"], "version": "4.5 Mesa 23"}}):
        keys.add(describe_machine({**CONTEXT, **change})["key"])
        keys.add(describe_machine({**CONTEXT, **change}, "lab-1")["key"])
    assert len(keys) == 14
    assert describe_machine({**CONTEXT, "load_average": [9, 9, 9]})["key"] == KEY
    assert KEY.startswith("a-processor-2c-software-llvmpipe-")
    assert all(is_folder_name(key) for key in keys)


def is_folder_name(key):
    return key == key.lower() and "/" not in key and " " not in key


@pytest.mark.parametrize("renderer, kind", [
    ("llvmpipe (LLVM 15.0.6, 256 bits)", "software"), ("softpipe", "software"),
    ("ANGLE (Google, Vulkan 1.3 (SwiftShader Device))", "software"),
    ("NVIDIA H100 80GB HBM3/PCIe/SSE2", "gpu"), ("AMD Radeon RX 7900 (radeonsi)", "gpu"),
    ("Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "gpu")])
def test_software_rasterisers_are_told_from_gpus(renderer, kind):
    made = describe_machine({**CONTEXT, "gl": {"renderer": renderer}})
    assert made["gl_class"] == kind and f"-{kind}-" in made["key"]
