"""scripts/reproduce.sh: what it prints, its exit codes, and what it leaves behind."""

import os
import pathlib
import signal
import subprocess
import time

import pytest
from stand_ins import DPKG_QUERY, add_program, add_stand_in, calls, everything_under, run


def test_reproduce_prints_the_table_alone(copy, environment, tmp_path):
    link = tmp_path / "link to it"
    link.symlink_to(copy / "scripts/reproduce.sh")
    result = run(link, "--repetitions", "2", cwd="/", env=environment)
    assert result.returncode == 0, result.stderr
    assert result.stdout == "| DN | RARN | D |\n"
    assert "50 % of" in result.stderr
    (results,) = (copy / "results/runs").iterdir()
    assert results.name.startswith("2")
    assert everything_under(results) == [
        "courtyard", "courtyard/run.json", "figures", "report.html",
    ]  # fmt: skip
    made = calls(environment)
    assert any("--strategy bool,sw-b,simp-b,coh-b --repetitions 2" in call for call in made)
    assert made[-1] == f"table {results}/courtyard --format markdown"
    assert result.stderr.endswith(
        f"Open in a browser: {results}/report.html\nFigures: {results}/figures\n"
    )


@pytest.mark.parametrize("script", ["report.py", "figures.py"])
def test_reproduce_keeps_the_rest_without_a_report_or_figures(copy, environment, script):
    environment.update(FAIL_AT=script, FAIL_CODE="1")
    result = run(copy / "scripts/reproduce.sh", env=environment)
    assert result.returncode == 1
    assert "could not be made" in result.stderr
    assert result.stdout == "| DN | RARN | D |\n"
    (results,) = (copy / "results/runs").iterdir()
    left = {"report.py": "figures", "figures.py": "report.html"}[script]
    assert everything_under(results) == sorted(["courtyard", "courtyard/run.json", left])


def test_reproduce_writes_where_it_is_told(copy, environment, tmp_path):
    environment["HLODBENCH_CACHE"] = str(tmp_path / "the cache")
    work = tmp_path / "some where"
    work.mkdir()
    result = run(
        copy / "scripts/reproduce.sh", "--out", "my records", "--context", "osmesa",
        cwd=work, env=environment,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    assert everything_under(work) == [
        "my records", "my records/courtyard", "my records/courtyard/run.json",
        "my records/figures", "my records/report.html",
    ]  # fmt: skip
    assert (tmp_path / "the cache/courtyard.hlod").is_file()
    assert not (copy / ".cache").exists() and not (copy / "results").exists()
    assert any("--context osmesa" in call for call in calls(environment))


@pytest.mark.parametrize("name", ["courtyard", "report.html", "figures"])
def test_reproduce_refuses_what_exists_before_it_works(copy, environment, tmp_path, name):
    (tmp_path / name).mkdir()
    result = run(copy / "scripts/reproduce.sh", "--out", tmp_path, env=environment)
    assert result.returncode == 2
    assert "already exists" in result.stderr
    assert not pathlib.Path(environment["LOG"]).exists()


@pytest.mark.parametrize(
    "arguments",
    [["--repetitions"], ["--repetitions", "0"], ["--repetitions", "x"], ["--context", "x"],
     ["--out", ""]],
)  # fmt: skip
def test_reproduce_refuses_bad_values(copy, environment, arguments):
    result = run(copy / "scripts/reproduce.sh", *arguments, env=environment)
    assert result.returncode == 2
    assert arguments[0] in result.stderr
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize("command", ["build", "run", "table"])
@pytest.mark.parametrize("code", [1, 2, 3])
def test_reproduce_passes_exit_codes_on(copy, environment, command, code):
    environment.update(FAIL_AT=command, FAIL_CODE=str(code))
    result = run(copy / "scripts/reproduce.sh", env=environment)
    assert result.returncode == code
    assert result.stdout == ""
    assert ("No usable OpenGL" in result.stderr) == (code == 3)
    if command == "run":
        assert everything_under(copy / "results/runs") == []


def test_reproduce_names_the_package_that_gl_misses(copy, environment):
    # Gone only once hlodbench runs, so that the check before does not stop the script.
    late = DPKG_QUERY.replace("shift 2", 'shift 2\n[ -e "$LOG" ] || MISSING=')
    add_stand_in(environment, "dpkg-query", late)
    add_stand_in(environment, "apt-get", "#!/bin/bash\n")
    environment.update(FAIL_AT="run", FAIL_CODE="3", MISSING="libegl1")
    result = run(copy / "scripts/reproduce.sh", env=environment)
    assert result.returncode == 3
    assert "missing packages: libegl1 \n" in result.stderr


def test_reproduce_paper_replays_both_scenes_five_times(copy, environment):
    add_program(copy / "scripts", "fetch_dragon.sh", '#!/bin/bash\necho fetch_dragon >>"$LOG"\n')
    result = run(copy / "scripts/reproduce.sh", "--paper", env=environment)
    assert result.returncode == 0, result.stderr
    made = calls(environment)
    assert made.index("fetch_dragon") < min(i for i, c in enumerate(made) if c.startswith("build"))
    assert [c.split("sessions/")[1].split(".")[0] for c in made if c.startswith("run ")] == [
        "scene1", "scene2",
    ]  # fmt: skip
    assert all("--repetitions 5" in c for c in made if c.startswith("run "))
    assert "min left" in result.stderr


@pytest.mark.parametrize("kind", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_reproduce_leaves_no_half_written_records(copy, environment, kind):
    environment["SLOW"] = "yes"
    process = subprocess.Popen(
        [copy / "scripts/reproduce.sh"], env=environment, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    runs = copy / "results/runs"
    deadline = time.monotonic() + 30
    while not list(runs.glob("*/.*/run.json")) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert list(runs.glob("*/.*/run.json"))
    os.killpg(process.pid, kind)  # as a terminal does
    out, _ = process.communicate(timeout=30)
    assert process.returncode == 128 + kind
    assert out == ""
    assert everything_under(runs) == []
    assert (copy / ".cache/courtyard.hlod").is_file()
