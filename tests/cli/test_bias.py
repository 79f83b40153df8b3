"""`hlodbench bias`: the curves of Fig. 1a."""

import csv
import io


def read(result):
    assert result.returncode == 0, result.stderr
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(result.stdout))]


def test_curves_have_the_stated_properties(hlodbench):
    rows = read(hlodbench("bias", "--s", "0,0.5,1", "--t", "0.1,0.25,0.5", "--samples", "51"))
    assert len(rows) == 3 * 3 * 51
    for row in rows:
        assert 0 <= row["bias"] <= 1
        if row["s"] == 0:
            assert abs(row["bias"] - row["mu"]) < 1e-8  # s = 0: B = mu
        elif 0 < row["mu"] < row["t"]:
            assert row["bias"] < row["mu"]  # aggressive
        elif row["t"] + 1e-9 < row["mu"] < 1:
            assert row["bias"] > row["mu"]  # conservative
    ends = [row for row in rows if row["mu"] in (0, 1)]
    assert len(ends) == 18 and all(row["bias"] == row["mu"] for row in ends)


def test_a_value_known_by_hand(hlodbench):
    rows = read(hlodbench("bias", "--s", "1", "--t", "0.25", "--samples", "11"))
    assert {row["mu"]: round(row["bias"], 3) for row in rows}[0.3] == 0.347
