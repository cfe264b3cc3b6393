#!/usr/bin/env python3
"""Compares the run time of hagen.Filter.segment() with the C++ filter on the same scan.

usage: python_speed.py [RECORDING [PRESET]]     default: a simulated scan of a VLP-16
Both start from coordinates and find the beams; timed alternately. Prints medians.
"""
import statistics
import sys
import time

import hagen

ROUNDS, RUNS = 40, 25


def main(recording=None, preset="vlp16"):
    scan = next(hagen.open(recording) if recording else hagen.simulate("orchard"))
    xyz = scan.xyz
    segmenter = hagen.Filter(preset)
    python, alone = [], []
    for _ in range(ROUNDS):
        for _ in range(RUNS):
            start = time.perf_counter()
            segmenter.segment(xyz).labels
            python.append(time.perf_counter() - start)
        alone += hagen._hagen._times_without_python(segmenter, xyz, RUNS)
    of_python, of_alone = statistics.median(python), statistics.median(alone)
    print(
        f"{len(xyz)} returns, medians of {ROUNDS * RUNS}: C++ {1e3 * of_alone:.3f} ms, "
        f"Python {1e3 * of_python:.3f} ms ({100 * (of_python / of_alone - 1):+.1f} %)"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
