"""scripts/fetch_dragon.sh: its sources, the checksum, and what it leaves behind."""

import gzip

import pytest
from stand_ins import add_stand_in, everything_under, run

DRAGON_SHA256 = "fea87ff48f2aba22fb53e7b67c3ff3f7b8c2a3b3a0653af62c48bba67c6d5744"


def fetch(copy, environment, **variables):
    return run(copy / "scripts/fetch_dragon.sh", env={**environment, **variables})


@pytest.mark.parametrize("compress", [False, True])
def test_wrong_local_dragon_is_refused_and_nothing_left(copy, environment, tmp_path, compress):
    wrong = tmp_path / "not a dragon.ply"
    data = b"ply\nformat ascii 1.0\nend_header\n"
    wrong.write_bytes(gzip.compress(data) if compress else data)
    result = fetch(copy, environment, HLODBENCH_DRAGON=str(wrong))
    assert result.returncode == 2
    assert str(wrong) in result.stderr and DRAGON_SHA256 in result.stderr
    assert everything_under(copy / ".cache") == []


def test_missing_local_dragon_is_named(copy, environment):
    result = fetch(copy, environment, HLODBENCH_DRAGON="/nowhere/d.ply.gz")
    assert result.returncode == 2
    assert "/nowhere/d.ply.gz" in result.stderr
    assert everything_under(copy / ".cache") == []


def accept(environment, text):
    """Makes the content TEXT pass for the dragon's."""
    add_stand_in(
        environment, "sha256sum",
        f'#!/bin/bash\n[ "$(cat)" = "{text}" ] && echo "{DRAGON_SHA256}  -" || echo "0  -"\n',
    )  # fmt: skip


def test_right_local_dragon_is_kept_compressed(copy, environment, tmp_path):
    accept(environment, "dragon")
    (tmp_path / "d.ply").write_text("dragon")
    result = fetch(copy, environment, HLODBENCH_DRAGON=str(tmp_path / "d.ply"))
    assert result.returncode == 0, result.stderr
    assert everything_under(copy / ".cache") == ["dragon_vrip.ply.gz"]
    assert gzip.decompress((copy / ".cache/dragon_vrip.ply.gz").read_bytes()) == b"dragon"
    again = fetch(copy, environment, HLODBENCH_DRAGON="/nowhere")
    assert again.returncode == 0 and "Already there" in again.stderr


# Writes the archive that curl was asked for; its last two arguments are the file and the address.
CURL = r"""#!/bin/bash
file=${*: -2:1}
mkdir "$file.d" "$file.d/dragon_recon" && printf dragon >"$file.d/dragon_recon/dragon_vrip.ply"
tar -czf "$file" -C "$file.d" dragon_recon
"""


def test_second_source_is_asked_when_the_first_fails(copy, environment):
    accept(environment, "dragon")
    add_stand_in(environment, "npm", "#!/bin/bash\necho 'no network' >&2\nexit 1\n")
    add_stand_in(environment, "curl", CURL)
    result = fetch(copy, environment)
    assert result.returncode == 0, result.stderr
    assert "no network" in result.stderr
    assert "Stanford Computer Graphics Laboratory" in result.stderr
    assert everything_under(copy / ".cache") == ["dragon_vrip.ply.gz"]


def test_wrong_download_is_thrown_away(copy, environment):
    accept(environment, "another")
    add_stand_in(environment, "npm", "#!/bin/bash\nexit 1\n")
    add_stand_in(environment, "curl", CURL)
    result = fetch(copy, environment)
    assert result.returncode == 2
    assert "wrong checksum" in result.stderr
    assert everything_under(copy / ".cache") == []


def test_no_source_says_what_to_do(copy, environment):
    for name in ("npm", "curl"):
        add_stand_in(environment, name, "#!/bin/bash\nexit 6\n")
    result = fetch(copy, environment)
    assert result.returncode == 2
    assert "install npm" in result.stderr
    assert everything_under(copy / ".cache") == []
