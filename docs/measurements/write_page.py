#!/usr/bin/env python3
"""Writes the page of a device, as Markdown on standard output, from what strata measured there.

    docs/measurements/write_page.py RESULTS... [--reference RESULTS] [--strata build/strata] >docs/measurements/DEVICE.md

RESULTS are folders of outputs, or .tar.gz files of them: JSON by `strata ... --json` in files named for what was run:
    devices.json              strata --list-gpus
    model-STAGE-SCENE-at-N.txt   strata report --stage STAGE --defaults --samples N --repeats 1
    hard-cases.txt            strata report --hard-cases
    repeat-NAME.err           standard error of strata replay --repeats 20
    i/SCENE/*.exr             strata replay -o
    bench-device.txt, bench-TECHNIQUE.txt, steps-SCENE-at-N.txt (replay --time), time-SCENE.txt (report), counted-TECHNIQUE.txt and
    uncounted-TECHNIQUE.txt (replay --time with the built-in shaders, and with shaders without their counters)
The reference's (another device's) models, hard cases and pictures stand beside the device's. What is missing is left out."""
import argparse
import glob
import json
import os
import subprocess
import sys
import tarfile
import tempfile


class Results:
    """The files of one or more runs on one device; a later run's replace an earlier one's."""

    def __init__(self, sources, scratch):
        self.files = {}
        for number, source in enumerate(sources):
            folder = source
            if not os.path.isdir(source):
                folder = os.path.join(scratch, f"{len(os.listdir(scratch))}-{number}")
                with tarfile.open(source) as archive:
                    archive.extractall(folder, filter="data") if hasattr(tarfile, "data_filter") else archive.extractall(folder)
            for root, _, names in os.walk(folder):
                for name in names:
                    path = os.path.join(root, name)
                    inside = os.path.relpath(path, folder)
                    self.files[inside.removeprefix("r/")] = path

    def names(self, start, end):
        return sorted(n for n in self.files if n.startswith(start) and n.endswith(end) and "/" not in n)

    def json(self, name):
        try:
            with open(self.files[name], encoding="utf-8") as file:
                return json.load(file)
        except (KeyError, ValueError):
            return None

    def text(self, name):
        with open(self.files[name], encoding="utf-8", errors="replace") as file:
            return file.read()


def short(value):
    if value is None:
        return ""
    if value == 0:
        return "0"
    size = abs(value)
    return f"{value:.1e}" if size < 1e-3 or size >= 1e5 else f"{value:.0f}" if size >= 100 else f"{value:.3g}"


def spread(s, digits=3):
    return "" if not s else f"{s['median']:.{digits}f} ± {s['mad']:.{digits}f}"


def table(heads, rows):
    if not rows:
        return ["none", ""]
    cell = lambda text: str(text).replace("|", "\\|")
    return ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)] + \
        ["| " + " | ".join(cell(c) for c in row) + " |" for row in rows] + [""]


def label(row):
    return row["technique"] + (" " + row["settings"] if row["settings"] else "")


def device_lines(results):
    found = results.json("devices.json")
    gpus = found["gpus"] if found else []
    real = next((g for g in gpus if g["kind"] != "cpu"), gpus[0] if gpus else None)
    if not real:
        return ["# A device without a name", ""]
    return [f"# {real['name']}", "", f"Driver {real['driver']} {real['driver_version']}. Written by `docs/measurements/write_page.py`.", ""]


def model_lines(results, reference):
    over, worst_of, count = [], {}, 0
    for name in results.names("model-", ".txt"):
        report = results.json(name)
        if not report:
            over.append((name, "no JSON", "", "", "", ""))
            continue
        theirs = reference.json(name) if reference else None
        known = {label(r): r.get("implementation_error") for r in theirs["rows"]} if theirs else {}
        for row in report["rows"]:
            error = row.get("implementation_error")
            if not error:
                continue
            count += 1
            stage = report["stage"]
            share = error["rmse"] / error["tolerance"]["rmse"] if error["tolerance"]["rmse"] else 0
            worst_of[stage] = max(worst_of.get(stage, 0), share)
            if error.get("doubt"):
                beside = known.get(label(row)) or {}
                over.append((f"{report['capture_name'].split('-')[0]}, {report['samples']}", label(row), short(error["rmse"]),
                             short(error["tolerance"]["rmse"]), short(beside.get("rmse")), short(error["worst"]),
                             short(error["tolerance"].get("worst")), short(beside.get("worst"))))
    if not count:
        return []
    lines = ["## Techniques against their models", "",
             f"{count} rows, 64 x 36, {count - len(over)} within tolerance. Largest share of its tolerance by stage: " +
             ", ".join(f"{stage} {100 * share:.0f} %" for stage, share in sorted(worst_of.items())) + ".", "",
             "Beyond tolerance; the last of each three is the reference device:", ""]
    return lines + table(["frame, samples", "technique", "rmse", "tolerated", "reference", "worst", "tolerated", "reference"], over)


def hard_lines(results, reference):
    ours, theirs = results.json("hard-cases.txt"), reference.json("hard-cases.txt") if reference else None
    if not ours or not theirs:
        return []
    rows = []
    for a, b in zip(ours["rows"], theirs["rows"]):
        for c, d in zip(a["cases"], b["cases"]):
            if c["verdict"] != d["verdict"]:
                rows.append((label(a), c["case"], c["verdict"], short(c.get("error")), d["verdict"], short(d.get("error"))))
    return ["## Hard cases with another verdict than on the reference", ""] + \
        table(["technique", "case", "here", "error", "reference", "error"], rows)


def repeat_lines(results):
    rows = [(n.removeprefix("repeat-").removesuffix(".err"), " ".join(results.text(n).split())) for n in results.names("repeat-", ".err")]
    return (["## Twenty repeats", ""] + table(["frame", "strata replay --repeats 20 says"], rows)) if rows else []


def same_lines(results, strata):
    """Techniques of which the picture is promised to be the same to the bit."""
    groups = {}
    for name, path in sorted(results.files.items()):
        parts = name.split("/")
        if parts[0] == "same" and name.endswith(".exr"):
            groups.setdefault(parts[1], []).append(("/".join(parts[2:-1]), path))
    rows = []
    for scene, pictures in groups.items():
        for technique, path in pictures[1:]:
            done = subprocess.run([strata, "diff", pictures[0][1], path, "--json"], capture_output=True, text=True)
            images = [i for f in json.loads(done.stdout)["frames"] for a in f["passes"] for i in a["images"]] if done.returncode < 2 else []
            verdict = "same to the bit" if images and all(i["identical"] for i in images) else "differs"
            rows.append((scene, technique, pictures[0][0], verdict))
    return (["## Pictures that are promised to be the same", ""] + table(["frame", "technique", "against", ""], rows)) if rows else []


def picture_lines(results, reference, strata):
    rows = []
    for name, path in sorted(results.files.items()):
        if not name.startswith("i/") or not name.endswith(".exr") or not reference or name not in reference.files:
            continue
        done = subprocess.run([strata, "diff", reference.files[name], path, "--json"], capture_output=True, text=True)
        if done.returncode > 1:
            rows.append((name, "cannot be compared", "", "", ""))
            continue
        images = {i["image"]: i for f in json.loads(done.stdout)["frames"] for a in f["passes"] for i in a["images"]}
        display = images.get("display", {})
        color = images.get("color", {})
        error = lambda image, key: short(image["error"][key]) if "error" in image else "0"
        rows.append((name.split("/")[1], error(color, "relative_rmse"), error(display, "rmse"), error(display, "worst"),
                     short(display.get("flip", {}).get("mean"))))
    if not rows:
        return []
    order = sorted(rows, key=lambda r: -float(r[2] or 0) if r[2][:1].isdigit() else 0)
    return ["## Pictures against the reference device", "", f"{len(rows)} frames, 64 x 36, defaults; the twelve that differ most:", ""] + \
        table(["frame", "color, relative rmse", "display rmse", "worst", "FLIP"], order[:12])


def limit_lines(results):
    bench = results.json("bench-device.txt")
    if not bench:
        return []
    limits = bench["limits"]
    lines = ["## What the device can do", "",
             f"Copy {limits['bytes_per_second']['median'] * 1e-9:.0f} ± {limits['bytes_per_second']['mad'] * 1e-9:.0f} GB/s "
             f"({limits['copied_bytes'] >> 20} MiB moved), multiply-adds in compute shaders "
             f"{limits['operations_per_second']['median'] * 1e-12:.1f} ± {limits['operations_per_second']['mad'] * 1e-12:.1f} T operations/s.", "",
             f"The ten hottest steps of {bench['scene']}, {bench['extent'][0]} x {bench['extent'][1]} ({bench['frame_ms']:.1f} ms):", ""]
    return lines + table(["step", "ms", "% of copying", "% of multiply-adds"],
                         [(s["name"], spread(s["ms"]), short(100 * s["share_of_bytes"]),
                           short(100 * s["share_of_operations"]) if "share_of_operations" in s else "") for s in bench["steps"]])


def step_lines(results):
    rows, stages = [], []
    for name in results.names("steps-", ".txt"):
        frame = (results.json(name) or {"frames": [None]})["frames"][0]
        if not frame:
            continue
        rows.append((name, frame))
        stages += [s for s in frame["stage_ms"] if s not in stages]
    lines = [(n.removeprefix("steps-").removesuffix(".txt").replace("-at-", ", "), spread(f["frame_ms"], 2),
              *[f"{f['stage_ms'][s]['median']:.2f}" if s in f["stage_ms"] else "" for s in stages]) for n, f in rows]
    return (["## Milliseconds by stage, 1920 x 1080", ""] + table(["frame, samples", "frame", *stages], lines)) if lines else []


def counter_lines(results):
    rows = []
    for name in results.names("counted-", ".txt"):
        technique = name.removeprefix("counted-").removesuffix(".txt")
        counted, plain = results.json(name), results.json("un" + name)
        if not counted or not plain:
            continue
        a, b = (r["frames"][0]["stage_ms"]["transparency"] for r in (counted, plain))
        rows.append((technique, spread(a), spread(b), f"{a['median'] / b['median']:.3f}"))
    return (["## What counting costs, smoke_grenade 1920 x 1080", ""] +
            table(["technique", "ms", "without counters", "ratio"], rows)) if rows else []


def ratio_lines(results):
    rows = []
    for name in results.names("bench-", ".txt"):
        bench = results.json(name)
        if not bench or bench["schema"] != "strata.bench":
            continue
        for r in bench["rows"]:
            measured = spread(r["ratio"]) if "ratio" in r else "not measured: " + r["not_measured"]
            rows.append((r["technique"], r["name"], measured, short(r.get("published", {}).get("ratio")),
                         short(r["of"]["ms"]["median"]) if "of" in r else "", short(r["against"]["ms"]["median"]) if "against" in r else ""))
    return (["## Ratios of times (strata bench)", ""] +
            table(["technique", "ratio", "measured", "published", "ms", "against ms"], rows)) if rows else []


def report_lines(results):
    lines = []
    for name in results.names("time-", ".txt"):
        report = results.json(name)
        if not report:
            continue
        rows = []
        for row in report["rows"]:
            if "not_supported" in row:
                continue
            errors = {e["metric"]: e["value"] for e in row.get("touched_error", row["technique_error"])}
            rows.append((label(row), short(errors.get("relative rmse")), spread(row["stage_ms"]), spread(row.get("time"), 2),
                         f"{row['bytes_per_pixel']:.0f}", "beyond tolerance" if row["implementation_error"].get("doubt") else ""))
        lines += [f"## {report['stage']} of {report['capture_name'].split('-')[0]}, {report['extent'][0]} x {report['extent'][1]}", "",
                  f"Time in units of {report['time_unit']}'s, {report['repeats']} runs. Truth: {report['truths'][0]['is']}.", ""]
        lines += table(["technique", "relative rmse touched", "ms", "time", "bytes per pixel", "model"], rows)
    return lines


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("results", nargs="+")
    options.add_argument("--reference", action="append", default=[])
    options.add_argument("--strata", default="build/strata")
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        results = Results(given.results, scratch)
        reference = Results(given.reference, scratch) if given.reference else None
        if not any(n.endswith((".txt", ".json")) for n in results.files):
            sys.exit("no results in " + ", ".join(given.results))
        lines = device_lines(results) + model_lines(results, reference) + hard_lines(results, reference) + \
            same_lines(results, given.strata) + repeat_lines(results) + picture_lines(results, reference, given.strata) + \
            limit_lines(results) + step_lines(results) + counter_lines(results) + ratio_lines(results) + report_lines(results)
    print("\n".join(lines).rstrip())


main()
