"""The shell scripts: what holds for all of them, install_dependencies.sh, test.sh and .ci/run."""

import os
import pathlib
import re
import shutil

import pytest
from stand_ins import CMAKE, add_stand_in, calls, run

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ["install_dependencies.sh", "reproduce.sh", "test.sh", "fetch_dragon.sh",
           "gpu_comparison.sh", "nightly.sh"]


# Every script


@pytest.mark.parametrize("script", SCRIPTS)
def test_help_says_how_to_use_it_and_how_it_ends(script):
    result = run(ROOT / "scripts" / script, "--help")
    assert result.returncode == 0
    assert result.stderr == ""
    assert result.stdout.startswith(f"Usage: scripts/{script}")
    assert "Exit codes:" in result.stdout
    assert "set -euo" not in result.stdout


@pytest.mark.parametrize("script", SCRIPTS)
def test_every_option_stands_in_the_help(script):
    text = (ROOT / "scripts" / script).read_text()
    help_text = run(ROOT / "scripts" / script, "--help").stdout
    cases = re.findall(r"^    (-[-a-z| ]*)\)", text, re.MULTILINE)
    options = [word for case in cases for word in case.replace("|", " ").split()]
    assert "--help" in options
    assert [o for o in options if o != "-h" and o not in help_text] == []


@pytest.mark.parametrize("script", SCRIPTS)
@pytest.mark.parametrize("argument", ["--no-such-option", "stray", ""])
def test_unknown_argument_is_refused(script, argument):
    result = run(ROOT / "scripts" / script, argument)
    assert result.returncode == 2
    assert result.stdout == ""
    assert f"'{argument}'" in result.stderr
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize("script", [f"scripts/{s}" for s in SCRIPTS] + [".ci/run"])
def test_script_is_executable_and_parses(script):
    assert os.access(ROOT / script, os.X_OK)
    assert run("bash", "-n", ROOT / script).returncode == 0


def test_shellcheck_finds_nothing():
    if not shutil.which("shellcheck"):
        pytest.skip("shellcheck is not installed")
    files = [*sorted((ROOT / "scripts").glob("*.sh")), ROOT / ".ci/run"]
    result = run("shellcheck", "-x", *files, cwd=ROOT)
    assert result.stdout == ""
    assert result.returncode == 0


# install_dependencies.sh


def test_packages_are_printed_one_a_line():
    script = ROOT / "scripts/install_dependencies.sh"
    plain = run(script, "--print").stdout.split("\n")[:-1]
    tests = run(script, "--print", "--tests").stdout.split("\n")[:-1]
    assert set(plain) < set(tests)
    assert len(set(tests)) == len(tests)
    assert all(" " not in name for name in tests)
    building = (ROOT / "docs/building.md").read_text()
    assert [name for name in tests if f"`{name}`" not in building] == []


def log_calls_of(environment, *names):
    for name in names:
        add_stand_in(environment, name, f'#!/bin/bash\necho "{name} $*" >>"$LOG"\n')


def test_missing_package_is_named_and_nothing_installed(environment, tmp_path):
    log_calls_of(environment, "apt-get", "sudo")
    environment["MISSING"] = "libopenmesh-dev libgtest-dev"
    result = run(ROOT / "scripts/install_dependencies.sh", "--no-install", env=environment)
    assert result.returncode == 2
    assert result.stderr.strip().endswith("missing packages: libopenmesh-dev")
    assert not (tmp_path / "log").exists()


@pytest.mark.parametrize("candidate", ["22.3.6", "(none)"])
def test_missing_packages_alone_are_installed_by_sudo(environment, candidate):
    log_calls_of(environment, "apt-get")
    add_stand_in(environment, "apt-cache", f'#!/bin/bash\necho "  Candidate: {candidate}"\n')
    add_stand_in(environment, "id", "#!/bin/bash\necho 1000\n")
    add_stand_in(environment, "sudo", '#!/bin/bash\necho sudo >>"$LOG"\nexec "$@"\n')
    environment["MISSING"] = "zlib1g-dev zstd libosmesa6-dev"
    result = run(ROOT / "scripts/install_dependencies.sh", "--tests", env=environment)
    assert result.returncode == 0, result.stderr
    assert result.stdout == ""
    optional = "" if candidate == "(none)" else " libosmesa6-dev"
    made = calls(environment)
    assert [call for call in made if call == "sudo"] == ["sudo", "sudo"]
    assert made[1].endswith(" update")
    assert made[3].endswith(f" install --yes --no-install-recommends zlib1g-dev zstd{optional}")


def test_failed_installation_names_the_packages(environment):
    add_stand_in(environment, "apt-get", "#!/bin/bash\nexit 100\n")
    add_stand_in(environment, "sudo", '#!/bin/bash\nexec "$@"\n')
    environment["MISSING"] = "zlib1g-dev"
    result = run(ROOT / "scripts/install_dependencies.sh", env=environment)
    assert result.returncode == 2
    assert result.stderr.strip().endswith("apt-get could not install: zlib1g-dev")


def test_nothing_missing_calls_no_package_manager(environment, tmp_path):
    log_calls_of(environment, "apt-get", "sudo")
    result = run(ROOT / "scripts/install_dependencies.sh", "--tests", env=environment)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    assert not (tmp_path / "log").exists()


# test.sh and .ci/run

CTEST = r"""#!/bin/bash
echo "ctest HLODBENCH_MODELS=${HLODBENCH_MODELS-none} $*" >>"$LOG"
case $2 in *asan-ubsan) code=${UNIT_CODE-0} ;; *) code=${ALL_CODE-0} ;; esac
echo "1/1 Test #1: one"
echo "100% tests passed, $code tests failed out of 1"
exit "$code"
"""


@pytest.fixture
def test_environment(environment):
    add_stand_in(environment, "ctest", CTEST)
    # As cmake makes the build folder when it configures.
    add_stand_in(environment, "cmake", CMAKE + '[ "$1" != --preset ] || mkdir -p "build/$2"\n')
    environment.pop("CI", None)
    return environment


@pytest.mark.parametrize("all_code", [0, 8])
@pytest.mark.parametrize("unit_code", [0, 8])
def test_test_sh_fails_when_either_run_fails(copy, test_environment, all_code, unit_code):
    test_environment.update(ALL_CODE=str(all_code), UNIT_CODE=str(unit_code))
    result = run(copy / "scripts/test.sh", env=test_environment)
    assert result.returncode == (1 if all_code or unit_code else 0), result.stderr
    assert result.stdout.endswith(
        "== dev\n"
        f"100% tests passed, {all_code} tests failed out of 1\n"
        "== asan-ubsan\n"
        f"100% tests passed, {unit_code} tests failed out of 1\n"
    )


def test_test_sh_fast_leaves_the_sanitizers_out(copy, test_environment):
    result = run(copy / "scripts/test.sh", "--fast", env=test_environment)
    assert result.returncode == 0, result.stderr
    assert not any("asan" in call for call in calls(test_environment))


@pytest.mark.parametrize("models", [False, True])
def test_ci_run_treats_warnings_as_errors_and_finds_models(
    copy, test_environment, tmp_path, models
):
    shutil.copytree(ROOT / ".ci", copy / ".ci")
    if models:
        (tmp_path / "shared/models").mkdir(parents=True)
    test_environment["UNIT_CODE"] = "8"
    result = run(copy / ".ci/run", cwd="/", env=test_environment)
    assert result.returncode == 1
    made = calls(test_environment)
    assert any(call.startswith("cmake --preset ci") for call in made)
    expected = tmp_path / "shared/models" if models else "none"
    assert sum(f"HLODBENCH_MODELS={expected} " in call for call in made) == 2
