"""The parts of scripts/sweep.

cli          options, and the order of things
description  the YAML file: reads and checks it, and gives the cells' parameters
program      what the program is (its hash) and which options it knows
inputs       the contents of scenes and sessions, as hashes
plan         cells with their identities, and the hierarchies they need: OUT/plan.json
runner       starts Snakemake on it, shows progress, passes signals on
Snakefile    which job needs which, and what may run beside what
job          one job of it: a hierarchy or a cell
cell         a result folder that appears when it is complete, or not at all
table        OUT/sweep.csv: a row for each cell and strategy
"""
