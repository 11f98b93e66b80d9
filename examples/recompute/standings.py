"""Standing of each score in verdicts, from the recomputed numbers (docs/decisions/verdicts.md)."""

from study import channels

# From best to worst; a score has the worst of its standings.
WORDS = (
    None,
    "skill unknown",
    "bounded",
    "neighbours in training",
    "low stimulus",
    "not above its noise floor",
    "not above the constant",
    "skill not known: no interval",
    "no skill",
)
ROUNDING, MOST_BOUNDED = 1e-9, 0.05
# Metrics that read no prediction.
OF_TRUTH = {"sensitivity", "uniformity", "hysteresis", "inter_sensor", "intrinsic"}
# The variant that decides, and its value by chance.
BESIDE_CHANCE = {"r_spatial": ("excess", 0.0), "uniformity": ("debiased", 1.0)}


def above(node, threshold):
    """Standing of a score whose interval must lie above a threshold."""
    low = node["ci95"][0] - threshold if "ci95" in node else None
    value = node["value"] - threshold if "value" in node else None
    if low is None and value is not None and value <= ROUNDING:
        low = value
    if low is None:
        return "skill not known: no interval"
    return None if low > ROUNDING else "no skill"


def standing(metric, label, given, node, skills):
    """Standing of a score; `skills` has the recomputed skill of each channel."""
    if metric == "sr":
        return above(node, node["of_constant"]["value"])
    found = [None]
    if metric not in OF_TRUTH:
        names = given.get("of") or channels(label)
        found += [above(skills[name], 0.0) if name in skills else "skill unknown" for name in names]
    if node.get("bounded_share", 0.0) > MOST_BOUNDED:
        found.append("bounded")
    found += [flag for flag in node.get("flags", []) if flag in WORDS]
    if metric == "tolerance" and "of_constant" in node:
        beside = above(node, node["of_constant"]["value"])
        found.append("not above the constant" if beside == "no skill" else beside)
    if metric in BESIDE_CHANCE and "value" in node:
        variant, chance = BESIDE_CHANCE[metric]
        low, high = node[variant].get("ci95", (chance, chance))
        found.append(None if low > chance or high < chance else "not above its noise floor")
    return max(found, key=WORDS.index)
