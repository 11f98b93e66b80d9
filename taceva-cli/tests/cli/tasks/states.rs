//! States of tasks as files, and their merge.

use super::slip;
use crate::support::Bench;

/// Task of the tables of [`slip`], with its classes.
const TASK: &str = "--task slip=event:positive=slip:names=no_slip|slip --cluster stroke";

/// Writes rows `from` to `to` of the tables of [`slip`] as `truth-NAME.csv` and `pred-NAME.csv`.
fn part(bench: &Bench, name: &str, from: usize, to: usize) {
    for table in ["truth", "pred"] {
        let text = std::fs::read_to_string(bench.path(&format!("{table}.csv"))).expect("written");
        let (head, rows) = text.split_once('\n').expect("a head");
        let rows: Vec<&str> = rows.lines().collect();
        let rows = rows[from..to].join("\n");
        bench.write(&format!("{table}-{name}.csv"), &format!("{head}\n{rows}\n"));
    }
}

/// Scores the part `name`, and writes its state.
fn score(bench: &Bench, name: &str, options: &str) {
    bench.ok(&format!(
        "score --truth truth-{name}.csv --pred pred-{name}.csv {options} --state-out {name}.state --force -q"
    ));
}

/// Test folder with three states, each of two strokes.
fn three() -> Bench {
    let bench = Bench::new();
    slip(&bench);
    for (at, name) in ["1", "2", "3"].into_iter().enumerate() {
        part(&bench, name, 20 * at, 20 * (at + 1));
        score(&bench, name, TASK);
    }
    bench
}

#[test]
fn states_of_parts_merge_to_the_scores_of_one_run_in_any_order() {
    let bench = three();
    let whole = bench.json(&format!("score --truth truth.csv --pred pred.csv {TASK}"));
    for order in ["1.state 2.state 3.state", "3.state 1.state 2.state"] {
        let merged = bench.json(&format!("merge {order}"));
        crate::schema::check("tasks", &merged);
        assert_eq!(merged["tasks"], whole["tasks"], "{order}");
        assert_eq!(merged["paired"], whole["paired"]);
        assert_eq!(
            merged["tables"].as_object().map(serde_json::Map::len),
            Some(6)
        );
    }
    bench.ok("merge 3.state 2.state --state-out both.state -q");
    let merged = bench.json("merge both.state 1.state");
    assert_eq!(merged["tasks"], whole["tasks"]);
}

#[test]
fn a_state_of_one_run_has_the_scores_of_the_run() {
    let bench = Bench::new();
    slip(&bench);
    let rules = "--threshold slip=0.4 --debounce slip=3 --state-out s.state";
    let scored = bench.json(&format!(
        "score --truth truth.csv --pred pred.csv {TASK} {rules}"
    ));
    assert_eq!(bench.json("merge s.state"), scored);
}

#[test]
fn states_of_other_definitions_are_refused_with_both_definitions() {
    let bench = three();
    let cases = [
        (
            format!("{TASK} --threshold slip=0.4"),
            "states of different rule do not merge: none and threshold 0.4 strict",
        ),
        (
            format!("{TASK} --debounce slip=3"),
            "states of different rule do not merge: none and debounce 3",
        ),
        (
            TASK.replace("no_slip|slip", "slip|no_slip"),
            "states of different names do not merge: no_slip, slip and slip, no_slip",
        ),
        (
            TASK.replace("--cluster stroke", "--cluster id"),
            "states of different cluster column do not merge: stroke and id",
        ),
        (
            TASK.replace("event", "outcome"),
            "states of different kind do not merge: event and outcome",
        ),
    ];
    for (options, message) in cases {
        score(&bench, "2", &options);
        bench.refused("merge 1.state 2.state", 3, message);
    }
}

#[test]
fn rows_that_would_count_twice_are_refused() {
    let bench = three();
    bench.refused("merge 1.state 2.state 1.state", 3, "would count twice");
}

#[test]
fn a_sequence_that_is_divided_between_two_states_is_refused_by_name() {
    let bench = Bench::new();
    slip(&bench);
    for (name, from) in [("a", 0), ("b", 5)] {
        part(&bench, name, from, from + 5);
        score(&bench, name, TASK);
    }
    bench.refused(
        "merge a.state b.state",
        3,
        "cluster \"s0\" has rows in both states",
    );
}

#[test]
fn states_of_tasks_and_of_channels_are_refused_together() {
    let bench = three();
    bench.write("f.csv", "id,point_id,Fz\n1,a,0.5\n2,b,0.25\n");
    bench.write("g.csv", "id,Fz\n1,0.5\n2,0.5\n");
    bench.ok("score --truth f.csv --pred g.csv --units Fz=N --state-out channels.state -q");
    bench.refused(
        "merge 1.state channels.state",
        3,
        "its schema is `taceva.state/1.0`",
    );
    bench.refused(
        "merge 1.state --table main",
        2,
        "--table is for scores of channels",
    );
}

#[test]
fn a_state_that_was_edited_is_refused() {
    let bench = three();
    let text = std::fs::read_to_string(bench.path("1.state")).expect("written");
    bench.write(
        "1.state",
        &text.replacen("\"unlabelled\":0", "\"unlabelled\":1", 1),
    );
    let ran = bench.run("merge 1.state -q");
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("1.state"), "{}", ran.err);
}

/// Writes the tables of [`slip`] with one label removed. Returns the arguments that score them with a threshold and a debounce.
fn with_rules(bench: &Bench) -> String {
    slip(bench);
    let truth = std::fs::read_to_string(bench.path("truth.csv")).expect("written");
    bench.write("truth.csv", &truth.replacen(",no_slip\n", ",\n", 1));
    let rules = "--threshold slip=0.4 --debounce slip=2";
    format!(
        "score --truth truth.csv --pred pred.csv --task slip=event:positive=slip --cluster stroke {rules}"
    )
}

#[test]
fn any_number_of_shards_merges_to_the_bytes_of_one_pass() {
    let bench = Bench::new();
    let score = with_rules(&bench);
    let whole = bench.ok(&format!("{score} --state-out whole.state --format json -q"));
    let bytes = |name: &str| std::fs::read(bench.path(name)).expect(name);
    // Six strokes, so some of nine shards have no row.
    for shards in [1, 2, 3, 9] {
        let mut states = Vec::new();
        for number in 1..=shards {
            let state = format!("{number}.state");
            bench.ok(&format!(
                "{score} --shard {number}/{shards} --state-out {state} --force -q"
            ));
            states.insert(0, state);
        }
        let states = states.join(" ");
        let merged = bench.ok(&format!(
            "merge {states} --state-out joined.state --force --format json -q"
        ));
        assert_eq!(merged, whole, "{shards}");
        assert_eq!(bytes("joined.state"), bytes("whole.state"), "{shards}");
    }
    bench.refused("merge 1.state 2.state 1.state", 3, "shard 1 of 9 is also");
    bench.refused("merge 1.state whole.state", 3, "has whole tables");
    let part = bench.json("merge 1.state 3.state");
    assert!(
        part.to_string().contains("only rows of shard 1, 3 of 9"),
        "{part:#}"
    );
    bench.ok(&format!("{score} --shard 2/8 --state-out other.state -q"));
    bench.refused("merge 1.state other.state", 3, "the same number of shards");
}

#[test]
fn a_sweep_of_shards_of_tasks_ends_in_the_bytes_of_one_pass() {
    let bench = Bench::new();
    let whole = bench.ok(&format!("{} --format json -q", with_rules(&bench)));
    let sweep = |shards: u32| {
        format!(
            "sweep_version = 1\n[score]\ntruth = \"truth.csv\"\npred = \"pred.csv\"\nshards = {shards}\ntask = \"slip=event:positive=slip\"\ncluster = \"stroke\"\nthreshold = {{ slip = 0.4 }}\ndebounce = {{ slip = 2 }}\n"
        )
    };
    for shards in [1, 4] {
        bench.write("which.toml", &sweep(shards));
        let out = bench.ok("sweep which.toml --jobs 2 -q");
        assert!(out.contains(&format!("{shards} scored, 0 failed")), "{out}");
        let scores = std::fs::read_to_string(bench.path("which.sweep/score.json"));
        assert_eq!(scores.expect("scores"), whole, "{shards}");
    }
    bench.refused("sweep show which.toml", 2, "score.json");
    let metrics = format!("metrics = [\"mae\"]\n{}", sweep(2));
    bench.write("which.toml", &metrics);
    bench.refused("sweep which.toml", 3, "`metrics` applies to channels only");
    let without_task = sweep(2).replace("task = \"slip=event:positive=slip\"\n", "");
    bench.write("which.toml", &without_task);
    bench.refused("sweep which.toml", 3, "`cluster` is for tasks: write `task");
    bench.write("which.toml", &sweep(2).replace("event", "evnt"));
    bench.refused("sweep which.toml", 3, "did you mean event?");
}
