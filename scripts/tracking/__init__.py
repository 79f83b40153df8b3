"""The parts of scripts/nightly.sh.

cli          options and exit codes
matrix       scenes and strategies: the cells
build        the program of this checkout and of a baseline revision
program      hlodbench as it is run: the exact tier, replays for times
measure      pairs of replays that take turns, and the ratios of their times
lock         one night at a time on a machine
load         what other programs use meanwhile
night        the order of things in a night
calibration  a fixed workload that tells how fast the processor is tonight
exact        exact values of a result folder, and what differs between two nights
timing_tier  what is measured, judged, and measured again
timing       ratios and times to verdicts: the U test, the least change
statistics   the U test, medians and intervals
machine      the key of a machine: only like is compared with like
history      the folder of files that are only ever added
migrate      earlier versions of them, and renamed counters
shapes       what readers rely on in them
accept       who took a change for good, and why
output       the files of a night beside the history
summary      a night as Markdown
exporters    a night for other tools
change_points  where a series of nights changes its level
bisect       which commit to try next, and on whose side one is
bisection    the order of things when the commit of a change is looked for
bisect_programs  programs of commits, in worktrees
bisect_report  what is found of them, as Markdown and JSON
commit_line  the commits from a good one to a bad one
commits      subjects of commits
trend        the page of the history, of trend_nights and trend_series; its parts are in page/
simulate     how often the rule errs, from real pairs
"""
