"""The templates that start nights name only what there is."""

import pathlib
import re
import shutil
import subprocess

import pytest
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
TEMPLATES = sorted((ROOT / "scripts" / "nightly_templates").iterdir())
UNIT_ENDINGS = (".service", ".timer")


@pytest.fixture(scope="module")
def usage():
    return subprocess.run([ROOT / "scripts" / "nightly.sh", "--help"], check=True, text=True,
                          capture_output=True).stdout


def commands(text):
    """What follows nightly.sh, up to the end of the command, comments left out."""
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    return re.findall(r"scripts/nightly\.sh([^;\n]*)", "\n".join(lines))


def test_there_is_one_for_each_way_to_start_nights():
    assert {path.name for path in TEMPLATES} == {
        "crontab", "github-actions.yml", "hlodbench-nightly.service", "hlodbench-nightly.timer"}


@pytest.mark.parametrize("path", [p for p in TEMPLATES if p.suffix != ".timer"],
                         ids=lambda path: path.name)
def test_options_are_those_of_the_script(path, usage):
    found = commands(path.read_text(encoding="utf-8"))
    assert len(found) == 1
    options = re.findall(r"--[a-z-]+", found[0])
    assert options
    for option in options:
        assert re.search(rf"^#? *{option} ", usage, re.MULTILINE), option


def test_the_workflow_has_steps_that_github_knows():
    text = (ROOT / "scripts/nightly_templates/github-actions.yml").read_text(encoding="utf-8")
    workflow = yaml.safe_load(text)
    # YAML 1.1 reads the key `on` as true
    assert workflow[True]["schedule"] == [{"cron": "0 3 * * *"}]
    (job,) = workflow["jobs"].values()
    assert job["timeout-minutes"] > 0
    for step in job["steps"]:
        assert ("run" in step) != ("uses" in step)
        if "run" in step:  # as GitHub's shell would parse it
            subprocess.run(["bash", "-n"], input=step["run"], text=True, check=True)


def test_systemd_takes_the_units(tmp_path):
    analyze = shutil.which("systemd-analyze")
    if analyze is None:
        pytest.skip("systemd-analyze is not installed")
    for path in TEMPLATES:
        if path.suffix not in UNIT_ENDINGS:
            continue
        # programs must be there, users too
        text = re.sub(r"^(ExecStart(?:Pre)?=)\S+", r"\1/bin/true", path.read_text(encoding="utf-8"),
                      flags=re.MULTILINE)
        text = re.sub(r"^User=.*\n", "", text, flags=re.MULTILINE)
        (tmp_path / path.name).write_text(text, encoding="utf-8")
    units = [tmp_path / p.name for p in TEMPLATES if p.suffix in UNIT_ENDINGS]
    result = subprocess.run([analyze, "verify", "--man=no", *units], text=True,
                            capture_output=True)
    ours = [line for line in result.stderr.splitlines() if "hlodbench-nightly" in line]
    assert ours == []
