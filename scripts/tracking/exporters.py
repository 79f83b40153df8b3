"""A night in the formats of other tools. Each value is of the revision tested, never the baseline's.

Shapes, as published:
google-benchmark       docs/user_guide.md and tools/gbench/report.py of google/benchmark: what
                       compare.py reads
bencher                https://bencher.dev/docs/reference/bencher-metric-format/
github-action-benchmark  README of benchmark-action/github-action-benchmark, "customSmallerIsBetter"
"""

import statistics

from .measure import CPU

# Exact values for which less is better, if anything is.
COUNTS = {"dn": "nodes", "rarn": "nodes", "d": "nodes", "queries": "queries",
          "triangles": "triangles"}


def _samples(night):
    """The samples by cell, of the cells that have some."""
    return (night.get("timing") or {}).get("cells") or {}


def _times(night):
    """(cell, [ms])."""
    return [(cell, samples["new"]) for cell, samples in _samples(night).items()]


def _counts(night):
    """(cell, counter, value)."""
    return [(cell, counter, values[counter]) for cell, values in night["exact"].items()
            for counter in COUNTS if counter in values]


def export_google_benchmark(night):
    """JSON with a benchmark for each repetition, so that compare.py has its U test. Cells without
    times are left out: the format is one of times. cpu_time is that of the traversing thread, and
    the frame time where it is not known."""
    machine, context = night["machine"], night["context"]
    rows = []
    for family, (cell, samples) in enumerate(_samples(night).items()):
        values = samples["new"]
        processor = samples["stages"]["new"].get(CPU) or []
        processor = processor if len(processor) == len(values) else values
        for index, (value, cpu) in enumerate(zip(values, processor)):
            rows.append({
                "name": cell, "family_index": family, "per_family_instance_index": 0,
                "run_name": cell, "run_type": "iteration", "repetitions": len(values),
                "repetition_index": index, "threads": 1, "iterations": 1, "real_time": value,
                "cpu_time": cpu, "time_unit": "ms"})
    return {
        "context": {
            "date": night["time_utc"].replace("Z", "+00:00"), "host_name": machine["key"],
            "executable": "hlodbench", "num_cpus": machine["cpu_cores"], "mhz_per_cpu": 0,
            "cpu_scaling_enabled": False, "caches": [],
            "load_avg": context.get("load_average") or [],
            "library_build_type": "release" if machine["build_type"] == "Release" else "debug",
            "revision": night["revision"]},
        "benchmarks": rows}


def export_bencher(night):
    """Benchmarks by name, measures of each, a value with bounds."""
    result = {}
    for cell, values in _times(night):
        result.setdefault(cell, {})["frame-time"] = {
            "value": statistics.median(values), "lower_value": min(values),
            "upper_value": max(values)}
    for cell, counter, value in _counts(night):
        result.setdefault(cell, {})[counter] = {"value": value}
    return result


def export_github_action_benchmark(night):
    """A list of values for which less is better."""
    rows = []
    for cell, values in _times(night):
        rows.append({"name": f"{cell} frame time", "unit": "ms", "value": statistics.median(values),
                     "range": f"± {(max(values) - min(values)) / 2:.4g}",
                     "extra": f"median of {len(values)} repetitions\n{night['machine']['key']}"})
    for cell, counter, value in _counts(night):
        rows.append({"name": f"{cell} {counter}", "unit": COUNTS[counter], "value": value,
                     "extra": "exact"})
    return rows


EXPORTERS = {"google-benchmark": export_google_benchmark, "bencher": export_bencher,
             "github-action-benchmark": export_github_action_benchmark}
