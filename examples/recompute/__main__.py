"""Every number of a run, computed again from the files in its folder.

    python3 examples/recompute RUN

RUN is the folder of `taceva run`. Nothing of TacEva is imported: the rules are those of docs/run-files.md, and numpy and pyarrow are all that is needed.
The exit code is 1 if a number differs by more than 1e-12 of its magnitude, if a number in `results.json` has no rule, or if a score of the plan is absent.
"""

import collections
import json
import sys
from pathlib import Path

import accuracy
import capture
import force
import light
import limits
import places
import repeats
from intervals import Undefined, attempt
from standings import OF_TRUTH, standing
from study import channels, studies

METRICS = {name: of for module in (accuracy, capture, force, light, limits, places, repeats) for name, of in module.METRICS.items()}
TOLERANCE = 1e-12
# Metrics whose scores are not one of each channel.
OTHER_SCORES = {"mae_euclid", "sr", "crosstalk", "inter_sensor", "intrinsic", "noise_equivalent_force", "zero_error", "detection_limit"}
OTHER_SCORES |= {"sensitivity", "uniformity", "hysteresis"}
# Small differences of terms near 1, which the program computes in binary64: held against 1, not against themselves.
CANCELLING = ("crosstalk", "matrix")
# Texts that follow from the numbers.
TEXTS = {"method", "standing", "flags"}
SHOWN = 20


def bounded_share(study, metric, label, given):
    """Greatest share of clipped predictions of a channel, among the rows that the metric reads."""
    rows = study.rows(metric)
    names = [name for name in given.get("of") or channels(label) if name in study.bounded]
    return max(float((study.bounded[name][rows] != study.free[name][rows]).mean()) for name in names)


def parameters(study):
    """Constants of the definitions and settings of the scene, by metric."""
    settings = study.settings
    of_bins = {"n_min": settings["n_min"], "ddof": places.DDOF}
    surface = of_bins | {"bins": settings["bins"], "gate": settings["gate_N"]}
    return {
        "smape": {"eps": accuracy.EPS},
        "smape_gated": {"eps": accuracy.EPS, "gate": accuracy.GATE},
        "sr": {"tolerance_mm": settings["tolerance_mm"]},
        "sensitivity": surface,
        "uniformity": surface,
        "r_spatial": of_bins | {"bins": places.STEPS, "window": settings["smoothing"]},
        "repeatability": {"limit_factor": repeats.LIMIT},
        "noise_equivalent_force": {"gate": force.GATE},
        "zero_error": {"gate": force.GATE},
        "detection_limit": {"gate": force.GATE, "light": force.LIGHT},
        "bias_level": {"n_min": limits.LEAST_OF_LEVEL, "width": limits.LEVEL},
        "tolerance": {"tolerance": limits.WITHIN},
        "agreement": {"share": limits.SHARE},
        "tolerance_interval": {"confidence": limits.CONFIDENCE, "share": limits.SHARE},
    }


def absent(study):
    """Scores that the plan asks for, and that are neither in the file nor skipped there."""
    given, skipped = study.results["metrics"], {of["what"] for of in study.results["skipped"]}
    for metric, names in study.planned.items():
        if metric not in given and f"metric:{metric}" not in skipped:
            yield metric
        elif metric in given and metric not in OTHER_SCORES:
            yield from (f"{metric}.{name}" for name in names if name not in given[metric])


def recomputed(study):
    """The parts of a study with numbers, in the form of `results.json`."""
    given, constants = study.results["metrics"], parameters(study)
    found = {}
    for metric, labels in given.items():
        found[metric] = {}
        for label, node in labels.items():
            of = attempt(METRICS[metric], study, metric, label, node) if metric in METRICS else {}
            of = {} if isinstance(of, Undefined) else of
            if metric in METRICS and metric not in OF_TRUTH | {"sr"}:
                of["bounded_share"] = bounded_share(study, metric, label, node)
            found[metric][label] = of | ({"parameters": constants[metric]} if metric in constants else {})
    skills = {label: of for label, of in found.get("skill", {}).items()}
    for metric, labels in found.items():
        for label, of in labels.items():
            if metric in METRICS and (said := standing(metric, label, given[metric][label], of, skills)):
                of["standing"] = said
    return {"metrics": found, "provenance": study.provenance()}


class Comparison:
    def __init__(self):
        self.counts, self.texts = collections.Counter(), 0
        self.lines = []

    def add(self, kind, path, line):
        self.counts[kind] += 1
        self.lines.append(f"{kind}: {'.'.join(map(str, path))}: {line}")

    def compare(self, given, found, path=()):
        """Compare a part of the file with the recomputed part, `None` if there is no such part."""
        if path and path[-1] in TEXTS and (given is not None or found is not None):
            self.texts += given == found
            if given != found:
                self.add("differing", path, f"{given!r} in the file, recomputed {found!r}")
        elif isinstance(given, dict) or isinstance(found, dict):
            given, found = ({} if not isinstance(part, dict) else part for part in (given, found))
            for key in given | found:
                self.compare(given.get(key), found.get(key), (*path, key))
        elif isinstance(given, list) or isinstance(found, list):
            given, found = (part if isinstance(part, list) else [] for part in (given, found))
            for at in range(max(len(given), len(found))):
                of = (part[at] if at < len(part) else None for part in (given, found))
                self.compare(*of, (*path, at))
        elif is_number(given) or is_number(found):
            self.compare_numbers(given, found, path)

    def compare_numbers(self, given, found, path):
        if not is_number(found):
            self.add("not recomputed", path, f"{given!r}")
        elif not is_number(given):
            self.add("differing", path, f"no number in the file, recomputed {found!r}")
        elif given == found:
            self.counts["equal"] += 1
        elif abs(given - found) <= TOLERANCE * max(abs(given), abs(found)):
            self.counts["within"] += 1
        elif set(CANCELLING) <= set(path) and abs(given - found) <= TOLERANCE:
            self.counts["cancelling"] += 1
        else:
            self.add("differing", path, f"{given!r} in the file, recomputed {found!r}")


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def leaves(part):
    """Numbers of a part of the file."""
    if isinstance(part, dict):
        part = list(part.values())
    if isinstance(part, list):
        for inner in part:
            yield from leaves(inner)
    elif is_number(part):
        yield part


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 2
    run = Path(sys.argv[1])
    results, plans = (json.loads((run / name).read_text()) for name in ("results.json", "plans.json"))
    comparison = Comparison()
    # Sections beside the studies have no rule here, so their numbers count as not recomputed.
    comparison.compare({key: part for key, part in results.items() if key != "studies"}, {})
    try:
        for at, study in enumerate(studies(run, results, plans)):
            print(f"{study.results['subject']['sensor']}: {len(study.ids)} samples", file=sys.stderr)
            comparison.compare(results["studies"][at], recomputed(study), ("studies", at))
            for score in absent(study):
                comparison.add("absent", ("studies", at, "metrics"), f"no {score}, although plans.json asks for it")
    except AssertionError as error:
        # The files of the run contradict each other.
        print(error)
        return 1
    counts = comparison.counts
    total = sum(1 for _ in leaves(results))
    print(f"numbers        {total} in {run / 'results.json'}")
    print(f"equal          {counts['equal']} to the last bit")
    print(f"within         {counts['within']} within {TOLERANCE:g} of the value")
    print(f"cancelling     {counts['cancelling']} within {TOLERANCE:g} of 1 ({' '.join(CANCELLING)})")
    print(f"not recomputed {counts['not recomputed']}")
    print(f"differing      {counts['differing']}")
    print(f"absent         {counts['absent']}")
    print(f"texts          {comparison.texts} equal ({', '.join(sorted(TEXTS))})")
    for line in comparison.lines[:SHOWN]:
        print(line)
    if len(comparison.lines) > SHOWN:
        print(f"and {len(comparison.lines) - SHOWN} more")
    return 1 if comparison.lines else 0


if __name__ == "__main__":
    sys.exit(main())
