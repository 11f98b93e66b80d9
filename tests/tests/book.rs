//! Tests that the pages of `docs/` form a book: its summary names each page once, and links lead to files.

use std::fs;

use taceva_tests::{metadata, read, root};

/// Targets of the links in `text`, without anchors, outside of code.
fn links(text: &str) -> Vec<&str> {
    let mut is_code = false;
    let mut found = Vec::new();
    for line in text.lines() {
        is_code ^= line.trim_start().starts_with("```");
        if is_code {
            continue;
        }
        let targets = line.split("](").skip(1);
        let targets = targets.filter_map(|rest| rest.split_once(')'));
        found.extend(targets.filter_map(|(target, _)| target.split('#').next()));
    }
    found
}

/// Names of the pages of `docs/` and `docs/decisions/`, without the summary.
fn pages() -> Vec<String> {
    let names = ["", "decisions/"].into_iter().flat_map(|folder| {
        let entries = fs::read_dir(root().join("docs").join(folder)).expect("a folder of pages");
        let names = entries.map(|entry| entry.expect("readable").file_name());
        names.map(move |name| format!("{folder}{}", name.to_string_lossy()))
    });
    names
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .collect()
}

#[test]
fn the_summary_names_every_page_once_and_no_other() {
    let summary = read("docs/SUMMARY.md");
    let mut named = links(&summary);
    named.sort_unstable();
    let mut pages = pages();
    pages.sort_unstable();
    assert!(pages.len() > 20, "{pages:?}");
    assert_eq!(named, pages);
}

#[test]
fn links_of_pages_lead_to_files() {
    let root = root();
    let mut open = Vec::new();
    let pages = pages().into_iter().map(|name| format!("docs/{name}"));
    let others = ["README.md", "CONTRIBUTING.md"].map(str::to_owned);
    for page in pages.chain(others) {
        let folder = root.join(&page);
        let folder = folder.parent().expect("a page is in a folder");
        for target in links(&read(&page)) {
            let is_elsewhere = target.is_empty() || target.starts_with("http");
            if !is_elsewhere && !folder.join(target).exists() {
                open.push(format!("{page}: {target}"));
            }
        }
    }
    assert!(open.is_empty(), "{}", open.join("\n"));
}

#[test]
fn the_citation_states_the_version_of_the_program() {
    let metadata = metadata();
    let mut packages = metadata.packages.iter();
    let program = packages.find(|package| package.name.as_str() == "taceva-cli");
    let version = &program.expect("the program").version;
    let citation = read("CITATION.cff");
    assert!(
        citation.contains(&format!("\nversion: {version}\n")),
        "{version}"
    );
}
