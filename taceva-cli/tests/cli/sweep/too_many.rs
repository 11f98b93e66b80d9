//! Grids of too many tasks, and of none.

use super::{small, week};

#[test]
fn a_grid_of_ten_million_tasks_is_refused_with_the_count() {
    let bench = week();
    small(&bench, &[("[1]", "\"1-1250000\"")]);
    bench.refused(
        "sweep which.toml",
        3,
        "the seeds alone make 1250000 tasks for each model",
    );
    let seeds: Vec<String> = (0..1250).map(|seed| seed.to_string()).collect();
    let sizes: Vec<String> = (1..=2000)
        .map(|size| format!("\"{size}x{size}\""))
        .collect();
    small(
        &bench,
        &[
            ("[1]", &format!("[{}]", seeds.join(","))),
            ("[\"8x8\", \"12x12\"]", &format!("[{}]", sizes.join(","))),
        ],
    );
    bench.refused(
        "sweep which.toml",
        3,
        "a grid of 10000000 tasks (1 datasets × 4 models × 1250 seeds",
    );
}

#[test]
fn an_empty_grid_is_refused_with_what_empties_it() {
    let bench = week();
    small(&bench, &[("seeds = [1]", "seeds = []")]);
    bench.refused(
        "sweep which.toml",
        3,
        "line 6: an empty grid: `seeds` has no entry",
    );
    small(&bench, &[("[\"monday\"]", "\"units/*\"")]);
    bench.refused("sweep which.toml", 3, "`units/*`: no folder matches");
    small(
        &bench,
        &[("[vary]", "[skip]\nwhere = [\"model != none\"]\n[vary]")],
    );
    bench.refused(
        "sweep which.toml",
        3,
        "`[skip]` leaves out all 8 combinations",
    );
    small(
        &bench,
        &[("[vary]", "[skip]\nwhere = [\"modell = ridge\"]\n[vary]")],
    );
    bench.refused(
        "sweep which.toml",
        3,
        "no task has `modell`: did you mean `model`?",
    );
}
