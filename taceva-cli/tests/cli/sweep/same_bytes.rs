//! The table, its digest and the page have the same bytes for every engine and every order of tasks.

use std::fs;
use std::process::Stdio;

use super::store::{WHOLE, small_bytes, whole};
use super::{count, small, text, week};
use crate::support::list::carry_out;
use crate::support::sweeps::{TASKS, bytes};

#[test]
fn one_worker_two_workers_and_two_sweeps_at_once_give_the_same_bytes_and_each_task_is_made_once() {
    let bench = whole();
    let out = &WHOLE.1;
    assert!(
        out.contains(&format!("{TASKS} scored, 0 failed, 0 missing")),
        "{out}"
    );
    let reference = bytes(&bench, "one");
    let printed = out
        .lines()
        .find_map(|line| line.strip_prefix("digest   "))
        .expect(out);
    let digest = taceva_dataset::Digest::of(&reference[0]).to_string();
    assert_eq!(printed, digest);
    bench.ok("sweep which.toml --out two --jobs 2 -q");
    assert_eq!(bytes(&bench, "two"), reference);
    // Some of the tasks first: a table of the existing results; then the rest in another order.
    let part = bench.ok("sweep which.toml --out parts --jobs 2 -q --only seed=2");
    assert!(part.contains("16 scored, 0 failed, 32 missing"), "{part}");
    let both: Vec<_> = (0..2)
        .map(|_| {
            let mut command = bench.command("sweep which.toml --out parts --jobs 1 -q");
            command.stdout(Stdio::null()).spawn().expect("it starts")
        })
        .collect();
    for mut one in both {
        assert!(one.wait().expect("it ends").success());
    }
    bench.ok("sweep which.toml --out parts -q");
    assert_eq!(bytes(&bench, "parts"), reference);
    for entry in fs::read_dir(bench.path("parts/logs")).expect("logs") {
        let log = fs::read_to_string(entry.expect("readable").path()).expect("text");
        assert_eq!(log.matches("\nscored").count(), 1, "{log}");
    }
    assert_eq!(count(&bench.path("parts/claims")), 0);
    // Each frame once for each of the two sizes, for all trainings.
    assert_eq!(count(&bench.path("one/cache/2/features")), 4);
    assert_eq!(text(&bench, "one/times.csv").lines().count(), TASKS + 1);
}

#[test]
fn a_collector_that_is_started_early_makes_a_table_of_what_is_there_and_says_what_is_missing() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q --only model=baseline");
    let ran = bench.run("sweep collect which.toml");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.out.contains("2 scored, 0 failed, 6 missing"),
        "{}",
        ran.out
    );
    assert_eq!(
        text(&bench, "which.sweep/table.csv")
            .matches(",missing,")
            .count(),
        6
    );
    bench.ok("sweep which.toml -q");
    assert_eq!(bytes(&bench, "which.sweep"), small_bytes());
}

#[test]
fn the_lines_of_a_list_carried_out_by_any_program_that_starts_commands_give_the_same_bytes() {
    let bench = week();
    small(&bench, &[]);
    let lines = bench.ok("sweep which.toml -q --on list");
    let (collect, tasks) = lines
        .trim_end()
        .rsplit_once('\n')
        .map(|(tasks, last)| (last, tasks))
        .expect("lines");
    assert_eq!(tasks.lines().count(), 8);
    // Two at once, in reverse order.
    let reversed: Vec<&str> = tasks.lines().rev().collect();
    bench.write("tasks.txt", &reversed.join("\n"));
    let script = format!("xargs -P 2 -I LINE sh -c LINE < tasks.txt && {collect}");
    carry_out(&bench, &script);
    assert_eq!(bytes(&bench, "which.sweep"), small_bytes());
}
