//! The glossary of CONTRIBUTING.md defines each term once, and words that were replaced do not come back as identifiers.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use taceva_tests::{metadata, read};

/// Words that were replaced in all crates, each with the term in its place. A word is entered once it is gone from every `src`.
const REPLACED: &[(&str, &str)] = &[
    ("deals", "assign"),
    ("dealer", "assign"),
    ("teller", "classifier"),
    ("tallies", "sum"),
    ("hands", "what it is, such as BenchClock"),
];

/// The same for crates in which more words are gone already.
const REPLACED_IN: &[(&str, &[(&str, &str)])] = &[("taceva-cli", TABLE), ("taceva-report", TABLE)];

/// Words of the crates of reports and of the program.
const TABLE: &[(&str, &str)] = &[
    ("deal", "assign"),
    ("dealt", "assigned"),
    ("told", "predicted, given"),
    ("tell", "predict, print"),
    ("tally", "count, summary"),
    ("contender", "what it is, such as a kernel"),
    ("contenders", "what they are, such as kernels"),
    ("printed", "formatted"),
    ("station", "waypoint"),
    ("silent", "what it is, such as SilentProgress"),
];

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
        let all = REPLACED.iter().chain(TABLE);
        let found = all.map(|(word, _)| *word).find(|word| *word == term);
        assert_eq!(found, None);
    }
}

#[test]
fn replaced_words_do_not_come_back_as_identifiers() {
    let mut found = Vec::new();
    for package in &metadata().packages {
        let folder = package.manifest_path.parent().expect("a folder");
        let src = folder.join("src").into_std_path_buf();
        let own = REPLACED_IN
            .iter()
            .find(|(name, _)| *name == package.name.as_str());
        let own = own.map_or(&[][..], |(_, words)| words);
        for file in sources(&src) {
            let text = fs::read_to_string(&file).expect("readable");
            for identifier in identifiers(&without_text(&text)) {
                for word in words_of(&identifier) {
                    let replaced = REPLACED.iter().chain(own).find(|(old, _)| *old == word);
                    if let Some((_, instead)) = replaced {
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

/// Every Rust file below `folder`.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
    found
}

/// Code without comments, strings and letters in quotation marks.
fn without_text(code: &str) -> String {
    let mut left = String::new();
    let mut rest = code;
    while let Some(letter) = rest.chars().next() {
        let skipped = length_of_text(rest, left.chars().last());
        if skipped > 0 {
            left.push(' ');
            rest = &rest[skipped..];
        } else {
            left.push(letter);
            rest = &rest[letter.len_utf8()..];
        }
    }
    left
}

/// How many bytes of comment, string or letter `code` begins with, after the letter `before`.
fn length_of_text(code: &str, before: Option<char>) -> usize {
    if code.starts_with("//") {
        return code.find('\n').unwrap_or(code.len());
    }
    if code.starts_with("/*") {
        return code.find("*/").map_or(code.len(), |end| end + 2);
    }
    let is_in_word = before.is_some_and(|letter| letter.is_alphanumeric() || letter == '_');
    let hashes = code
        .strip_prefix('r')
        .map(|after| after.len() - after.trim_start_matches('#').len());
    if let Some(hashes) = hashes.filter(|_| !is_in_word)
        && code[1 + hashes..].starts_with('"')
    {
        let end = format!("\"{}", "#".repeat(hashes));
        let start = hashes + 2;
        return code[start..]
            .find(&end)
            .map_or(code.len(), |at| start + at + end.len());
    }
    match code.chars().next() {
        Some('"') => end_of_quote(code, '"').unwrap_or(code.len()),
        // A lifetime has no second quotation mark so near.
        Some('\'') => end_of_quote(code, '\'')
            .filter(|end| code[..*end].chars().count() == 3 || code.starts_with("'\\"))
            .unwrap_or(0),
        _ => 0,
    }
}

/// Where the text ends that begins with `mark`.
fn end_of_quote(code: &str, mark: char) -> Option<usize> {
    let mut is_escaped = false;
    for (at, letter) in code.char_indices().skip(1) {
        match letter {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if letter == mark => return Some(at + letter.len_utf8()),
            _ => {}
        }
    }
    None
}

fn identifiers(code: &str) -> BTreeSet<String> {
    let words = code.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
    let named = words.filter(|word| word.starts_with(|letter: char| letter.is_alphabetic()));
    named.map(str::to_owned).collect()
}

/// `is_told`, `IsTold` and `IS_TOLD` as words in lower case.
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
