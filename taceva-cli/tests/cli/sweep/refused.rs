//! Invalid files of sweeps are refused at the start, by line.

use super::{small, week};

#[test]
fn an_unknown_key_is_refused_with_its_line_and_the_nearest_key() {
    let bench = week();
    small(&bench, &[("seeds =", "seed =")]);
    bench.refused(
        "sweep which.toml",
        3,
        "which.toml, line 6: `seed`: unknown key, did you mean `seeds`?",
    );
    small(&bench, &[("set = {", "sett = {")]);
    bench.refused(
        "sweep which.toml",
        3,
        "`sett`: unknown key of a model, did you mean `set`?",
    );
    small(&bench, &[("size = [", "sise = [")]);
    bench.refused("sweep which.toml", 3, "did you mean `size`?");
    small(&bench, &[("\"pls\"", "\"plss\"")]);
    bench.refused("sweep which.toml", 3, "did you mean `pls`?");
    assert!(!bench.path("which.sweep").exists());
}

#[test]
fn conditions_seeds_and_splits_that_cannot_be_meant_are_refused_at_the_start() {
    let bench = week();
    small(&bench, &[]);
    for only in ["model==ridge", "model=ridge,seed=1", "seed>1", "(seed=1)"] {
        bench.refused(
            &format!("sweep which.toml --only {only}"),
            2,
            "expected NAME = VALUE or NAME != VALUE",
        );
    }
    small(
        &bench,
        &[("[vary]", "[skip]\nwhere = [\"model == ridge\"]\n[vary]")],
    );
    bench.refused("sweep which.toml", 3, "line 10: `model == ridge`: ");
    for (old, new, message) in [
        (
            "seeds = [1]",
            "seeds = 3",
            "line 6: `seeds = 3`: expected a list such as [1, 2, 3], or a range such as \"1-5\"; for one seed write [3]",
        ),
        (
            "seeds = [1]",
            "seeds = [-1]",
            "line 6: `seeds`: -1: expected whole numbers from 0",
        ),
        (
            "seeds = [1]",
            "seeds = \"9223372036854775807-9223372036854775808\"",
            "to 9223372036854775807",
        ),
        (
            "by-point 50",
            "by-pont 50",
            "line 7: no split is called `by-pont",
        ),
    ] {
        small(&bench, &[(old, new)]);
        bench.refused("sweep which.toml", 3, message);
    }
    assert!(!bench.path("which.sweep").exists());
    small(
        &bench,
        &[(
            "[vary]",
            "[skip]\nwhere = [\"model = pls or model = knn and size = 8x8\"]\n[vary]",
        )],
    );
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("tasks    5, 3 combinations left out"), "{dry}");
}

#[test]
fn what_would_share_one_result_is_refused_by_both_names() {
    let bench = week();
    small(&bench, &[("[\"monday\"]", "[\"monday\", \"./monday\"]")]);
    bench.refused(
        "sweep which.toml",
        3,
        "`monday` and `./monday` are the same recording",
    );
    small(&bench, &[("\"pls\"", "\"ridge\"")]);
    bench.refused("sweep which.toml", 3, "the model ridge is named twice");
    small(&bench, &[("size = [\"8x8\", \"12x12\"]", "seed = [1, 2]")]);
    bench.refused("sweep which.toml", 3, "vary the seed with `seeds`");
}

#[test]
fn settings_of_a_model_that_are_no_table_are_refused_and_not_left_out() {
    let bench = week();
    small(
        &bench,
        &[("set = { neighbours = 3 }", "set = \"neighbours=3\"")],
    );
    bench.refused("sweep which.toml", 3, "`set` of the model knn: expected {");
}
