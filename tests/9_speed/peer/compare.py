#!/usr/bin/env python3
"""Times the peer and techniques of strata on the same spheres in turns, on one thread of the driver and on all; prints a table.

Milliseconds are medians of runs; those of strata are of the steps of its transparency stage alone. Each ratio is the median of
the ratios within a run, so that other work on the machine weighs on both sides. First the peer's picture is compared with
sorted_lists to 1e-3 of radiance: .01 % of the pixels may differ, because rounding decides at silhouettes which surface is nearer.
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

PEER = {"peer list": ["--mode", "list"], "peer blend": ["--mode", "blend"]}
OURS = {
    "sorted_lists": [],
    "alpha_blend": [],
    "a_buffer": [],
    "a_buffer of 16 layers": ["--set", "layers=16"],
    "depth_peeling of 8 passes": [],
}


def run(command, threads=None):
    environment = dict(os.environ) if threads is None else dict(os.environ, LP_NUM_THREADS=str(threads))
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def time_peer(args, mode, threads):
    words = [args.peer, args.capture, "--frames", str(args.frames), *PEER[mode]]
    return float(re.match(r"([\d.]+) ms", run(words, threads)).group(1))


def time_ours(args, label, threads):
    technique = "transparency/" + label.split()[0]
    words = [args.strata, "replay", args.capture, "--time", str(args.frames), "--json", "--use", technique, *OURS[label]]
    steps = json.loads(run(words, threads))["frames"][0]["steps"]
    return sum(step["gpu_ms"]["median"] for step in steps if step["scope"].startswith("transparency:"))


def compare_pictures(args, folder):
    theirs = os.path.join(folder, "peer.exr")
    run([args.peer, args.capture, "--frames", "1", "--output", theirs])
    run([args.strata, "replay", args.capture, "--use", "transparency/sorted_lists", "--outputs", "color", "-o", folder])
    ours = next(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(".exr") and name != "peer.exr")
    print(run([args.strata, "diff", ours, theirs, "--limit", "1e-3", "--percent", "0.01"]))


def print_table(times, threads):
    title = f"threads of the driver: {threads or 'all'}"
    print(f"{title:34}{'ms':>10}{'lowest':>10}{'highest':>10}{'of peer list':>14}")
    for label, values in times.items():
        ratio = statistics.median(own / peer for own, peer in zip(values, times["peer list"]))
        print(f"{label:34}{statistics.median(values):10.1f}{min(values):10.1f}{max(values):10.1f}{ratio:14.2f}")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peer", default="build/peer", help="the program of the target `peer`")
    parser.add_argument("--strata", default="build/strata")
    parser.add_argument("--size", default="480x360", help="extent of the frame as WIDTHxHEIGHT")
    parser.add_argument("--repeats", type=int, default=5, help="runs of each program")
    parser.add_argument("--frames", type=int, default=3, help="frames of each run, after one to warm up")
    parser.add_argument("--only", nargs="*", default=list(OURS), choices=list(OURS), help="techniques to run; default all")
    parser.add_argument("--threads", nargs="*", type=int, default=[1, 0], help="threads of llvmpipe; 0: one per core")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        args.capture = os.path.join(folder, "spheres.strata")
        run([args.strata, "record", "spheres_1024", "--size", args.size, "-o", args.capture])
        compare_pictures(args, folder)
        for threads in args.threads:
            times = {label: [] for label in [*PEER, *args.only]}
            for _ in range(args.repeats):
                for label, values in times.items():
                    values.append((time_peer if label in PEER else time_ours)(args, label, threads or None))
            print_table(times, threads)


if __name__ == "__main__":
    main()
