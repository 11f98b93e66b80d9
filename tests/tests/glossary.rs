//! The glossary of CONTRIBUTING.md defines each term once, and replaced words are not used as identifiers.

use std::collections::BTreeSet;
use std::fs;

use taceva_tests::source::{rust_files, without_text};
use taceva_tests::{metadata, read};

/// Replaced words, each with its replacement. No crate uses these words.
const REPLACED: &[(&str, &str)] = &[
    ("contender", "what it is, such as a kernel"),
    ("contenders", "what they are, such as kernels"),
    ("deal", "assign"),
    ("dealer", "assign"),
    ("deals", "assign"),
    ("dealt", "assigned"),
    ("hands", "what it is, such as BenchClock"),
    ("station", "waypoint"),
    ("stations", "waypoints"),
    ("supplies", "resolve"),
    ("supply", "resolve"),
    ("tallies", "sum"),
    ("tally", "count, sum"),
    ("teller", "classifier"),
    ("told", "predicted, given, distinguished"),
];

/// Replaced words, each with its replacement and the crates that may still use it.
const REPLACED_BUT_IN: &[(&str, &str, &[&str])] = &[
    // `draft`: a first map for a folder of a laboratory.
    ("draft", "collect", &["taceva-cli", "taceva-import"]),
    // `ground`: the basis of a comparison.
    ("ground", "samples, group", &["taceva-report"]),
    // `judge`: the checker of a simulated run, or of published numbers.
    (
        "judge",
        "check, set",
        &["taceva-report", "taceva-simulation"],
    ),
    // `printed`: output of a child process or of a program.
    (
        "printed",
        "formatted",
        &[
            "taceva-conformance",
            "taceva-drivers",
            "taceva-host",
            "taceva-report",
            "taceva-tests",
        ],
    ),
    // `tell`: a message to a log.
    (
        "tell",
        "predict, print",
        &["taceva-conformance", "taceva-host"],
    ),
];

/// Replaced words, each with its replacement and the crates that no longer use it. A device may be silent; other things have a more precise name.
const REPLACED_IN: &[(&str, &str, &[&str])] = &[(
    "silent",
    "what it is, such as SilentProgress",
    &[
        "taceva-cli",
        "taceva-core",
        "taceva-dataset",
        "taceva-import",
        "taceva-metrics",
        "taceva-models",
        "taceva-report",
        "taceva-study",
        "taceva-acquire",
        "taceva-check",
        "taceva-evaluate",
    ],
)];

/// Identifiers that contain a replaced word and are allowed, because they are precise.
const KEPT: [&str; 1] = ["SilentProgress"];

/// The terms of the glossary, in lower case, each with its definition.
fn terms() -> Vec<(String, String)> {
    let contributing = read("CONTRIBUTING.md");
    let (_, after) = contributing
        .split_once("## Glossary\n")
        .expect("CONTRIBUTING.md has a glossary");
    let section = after.split("\n## ").next().expect("a section");
    let entries = section.lines().filter_map(|line| line.strip_prefix("- **"));
    entries
        .map(|entry| {
            let (term, definition) = entry
                .split_once("**: ")
                .unwrap_or_else(|| panic!("expected `- **term**: definition` in: {entry}"));
            (term.to_lowercase(), definition.to_owned())
        })
        .collect()
}

#[test]
fn every_term_is_defined_once_and_in_one_line() {
    let terms = terms();
    assert!(terms.len() > 20, "{terms:?}");
    let names: BTreeSet<&str> = terms.iter().map(|(term, _)| term.as_str()).collect();
    let sorted: Vec<&str> = terms.iter().map(|(term, _)| term.as_str()).collect();
    assert_eq!(
        names.into_iter().collect::<Vec<_>>(),
        sorted,
        "in order, each once"
    );
    for (term, definition) in &terms {
        let is_sentence = definition.ends_with('.') && definition.len() > 20;
        assert!(is_sentence, "{term}: {definition}");
    }
}

#[test]
fn no_replaced_word_is_a_term() {
    for (term, _) in terms() {
        let some = REPLACED_BUT_IN.iter().chain(REPLACED_IN);
        let some = some.map(|(word, ..)| *word);
        let mut all = REPLACED.iter().map(|(word, _)| *word).chain(some);
        let found = all.find(|word| *word == term);
        assert_eq!(found, None);
    }
}

#[test]
fn replaced_words_do_not_come_back_as_identifiers() {
    let mut found = Vec::new();
    for package in &metadata().packages {
        let folder = package.manifest_path.parent().expect("a folder");
        let src = folder.join("src").into_std_path_buf();
        let name = package.name.as_str();
        let instead_of = |word: &str| {
            let everywhere = REPLACED.iter().find(|(old, _)| *old == word);
            let but_here = REPLACED_BUT_IN
                .iter()
                .find(|(old, _, but_in)| *old == word && !but_in.contains(&name));
            let here = REPLACED_IN
                .iter()
                .find(|(old, _, of)| *old == word && of.contains(&name));
            let some = but_here.or(here).map(|(_, instead, _)| *instead);
            everywhere.map(|(_, instead)| *instead).or(some)
        };
        for file in rust_files(&src) {
            let text = fs::read_to_string(&file).expect("readable");
            for identifier in identifiers(&without_text(&text)) {
                if KEPT.contains(&identifier.as_str()) {
                    continue;
                }
                for word in words_of(&identifier) {
                    if let Some(instead) = instead_of(&word) {
                        found.push(format!("{}: `{identifier}`: {instead}", file.display()));
                    }
                }
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn identifiers_are_read_without_comments_and_strings() {
    let code = "/// told\nfn is_told(a: ToldOnce) { let b = 'x'; let c: &'a str = \"deal \\\" dealt\"; r#\"tally\"#; }";
    let found = identifiers(&without_text(code));
    let expected = ["ToldOnce", "a", "b", "c", "fn", "is_told", "let", "str"];
    assert_eq!(found.into_iter().collect::<Vec<_>>(), expected);
    assert_eq!(words_of("is_told"), ["is", "told"]);
    assert_eq!(words_of("ToldOnce"), ["told", "once"]);
    assert_eq!(words_of("MAX_TOLD"), ["max", "told"]);
}

fn identifiers(code: &str) -> BTreeSet<String> {
    let words = code.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
    let named = words.filter(|word| word.starts_with(|letter: char| letter.is_alphabetic()));
    named.map(str::to_owned).collect()
}

/// Splits an identifier into words in lower case: `is_told`, `IsTold` and `IS_TOLD` give `is` and `told`.
fn words_of(identifier: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_lower = false;
    for letter in identifier.chars() {
        if letter == '_' || (letter.is_uppercase() && was_lower) {
            words.push(String::new());
        }
        was_lower = letter.is_lowercase();
        if letter != '_' {
            let last = words.last_mut().expect("there is one");
            last.extend(letter.to_lowercase());
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[test]
fn a_crate_that_keeps_a_word_still_has_it() {
    for (word, _, crates) in REPLACED_BUT_IN {
        for name in *crates {
            let metadata = metadata();
            let of_that_name = |package: &&cargo_metadata::Package| package.name.as_str() == *name;
            let package = metadata.packages.iter().find(of_that_name);
            let folder = package.unwrap_or_else(|| panic!("{name} is not a crate"));
            let src = folder.manifest_path.parent().expect("a folder").join("src");
            let has = rust_files(src.as_std_path()).iter().any(|file| {
                let code = without_text(&fs::read_to_string(file).expect("readable"));
                let all = identifiers(&code);
                all.iter()
                    .any(|identifier| words_of(identifier).iter().any(|own| own == word))
            });
            assert!(has, "{name} no longer has `{word}`: off the list");
        }
    }
}
