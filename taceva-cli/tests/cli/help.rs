//! The program without a command, its help, and its manual pages.

use std::fs;

use crate::support::Bench;

#[test]
fn the_program_without_a_command_says_three_ways_in() {
    let said = Bench::new().ok("");
    for line in [
        "taceva init recording",
        "taceva run",
        "taceva init rig",
        "--help",
    ] {
        assert!(said.contains(line), "no `{line}` in\n{said}");
    }
}

#[test]
fn help_of_a_command_ends_with_examples() {
    let said = Bench::new().ok("score --help");
    assert!(
        said.contains("Examples:\n  taceva score --truth truth.csv"),
        "{said}"
    );
    assert!(said.contains("point_id"), "{said}");
}

#[test]
fn help_of_a_command_explains_it_beyond_its_first_line() {
    let bench = Bench::new();
    for (command, expected) in [
        ("import", "`taceva init recording FOLDER` writes it"),
        ("check", "Every finding has a stable code"),
        ("export", "`datasets.load_dataset("),
        ("fit", "a checkpoint is written"),
        ("evaluate", "are scored in five folds (cv:5)"),
        ("plugin allow", "only to resources that its manifest lists"),
    ] {
        let help = bench.ok(&format!("{command} --help"));
        let words: Vec<&str> = help.split_whitespace().collect();
        assert!(words.join(" ").contains(expected), "{command}: {help}");
    }
}

#[test]
fn manual_pages_are_written_for_every_command() {
    let bench = Bench::new();
    let page = bench.ok("man");
    assert!(page.contains(".TH taceva 1"), "{page}");
    bench.ok("man --out pages");
    for name in [
        "taceva",
        "taceva-evaluate",
        "taceva-plugin-new",
        "taceva-init-rig",
    ] {
        let page = fs::read_to_string(bench.path(&format!("pages/{name}.1"))).expect(name);
        assert!(page.contains(".SH SYNOPSIS"), "{page}");
    }
}
