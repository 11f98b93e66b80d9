"""Of what the processor time of a training step is made: shares of `perf`'s samples by kind of pass.

usage: RUSTFLAGS=-Csymbol-mangling-version=v0 cargo bench -p taceva-network --bench network --no-run --target-dir target/profile
       perf record -o step.data EXECUTABLE 64 1 24 winograd training
       perf report -i step.data --stdio --no-children -g none -F overhead,sym | python3 benches/peers/step_shares.py

EXECUTABLE is that which the first command names. Names of symbols are those of the compiler's newer form, in which what a loop
works on is part of the name. What the program does before the first step, which is mostly to draw weights, is part of the rest.
"""
import re
import sys

KINDS = [
    ("Winograd's: outputs and gradients of inputs", r"winograd::products"),
    ("Winograd's: gradients of weights", r"winograd::(sums|weight_gradient)"),
    ("weights exchanged, to the points and back", r"winograd::weights|weights::Exchange"),
    ("direct: outputs and gradients of inputs", r"direct::correlation"),
    ("direct: gradients of weights", r"direct::weight_gradient"),
    ("normalisation: moments", r"batch_norm::sums"),
    ("normalisation, shortcut and ReLU", r"batch_norm::apply"),
    ("normalisation: gradients", r"batch_norm::backward|GradientSums"),
    ("pooling of the stem", r"max_pool::"),
    ("optimiser", r"optimizer::"),
    ("zeros and copies", r"mem(set|move|cpy)"),
    ("the kernel", r"\[k\]"),
]


def main():
    shares = {kind: 0.0 for kind, _ in KINDS}
    rest = {}
    for line in sys.stdin:
        found = re.match(r"\s*([\d.]+)%\s+(.*\S)", line)
        if not found:
            continue
        share, symbol = float(found[1]), found[2]
        kinds = (kind for kind, pattern in KINDS if re.search(pattern, symbol))
        kind = next(kinds, None)
        if kind is None:
            rest[symbol] = rest.get(symbol, 0.0) + share
        else:
            shares[kind] += share
    if not any(shares.values()):
        sys.exit("no symbol of taceva-network on standard input: give it what `perf report` prints")
    print("| of the processor time | % |")
    print("|---|---|")
    for kind, share in sorted(shares.items(), key=lambda item: -item[1]):
        print(f"| {kind} | {share:.1f} |")
    print(f"| the rest | {sum(rest.values()):.1f} |")
    for symbol, share in sorted(rest.items(), key=lambda item: -item[1])[:4]:
        print(f"  rest: {share:.1f} {symbol}", file=sys.stderr)


main()
