"""The parts of scripts/report.py: reading and encoding here, the page and its scripts in page/.

cli           options and the order of things
program_table Table 1, from what `hlodbench table` prints
quality       the table of PSNR
environment   where and how each folder was measured
series        counters by frame, for the plots
pictures      pictures as data URIs, differences, worst regions
sweeps        heat-maps of sweeps
page          puts it all into one HTML file
"""
