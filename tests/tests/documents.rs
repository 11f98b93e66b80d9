//! Generated numbers in documents equal the output of their commands.

use std::fs;
use std::path::Path;
use std::process::Command;

use taceva_tests::renew::{Document, Kind, Passage, Runner, documents, unexplained_tables};
use taceva_tests::{example, root, taceva};

fn all() -> Vec<Document> {
    documents(&root()).expect("the workspace can be read")
}

fn passages(document: &Document) -> Vec<Passage> {
    Passage::all(&document.text)
        .unwrap_or_else(|(line, error)| panic!("{}:{line}: {error}", document.name))
}

#[test]
fn quick_numbers_of_documents_are_what_their_commands_print() {
    // Example in the `examples` folder, which commands of the README run.
    example("make_recording");
    let programs = taceva();
    let programs = programs.parent().expect("a program is in a folder");
    let (mut compared, mut wrong) = (0, Vec::new());
    for document in all() {
        let runner = Runner::new(&root(), programs).expect("a folder");
        let quick = passages(&document).into_iter();
        for passage in quick.filter(|passage| passage.kind == Kind::Quick) {
            compared += 1;
            let place = format!("{}:{}: {}", document.name, passage.line, passage.command);
            match runner.compare(&passage, &document.text) {
                Ok(None) => {}
                Ok(Some(difference)) => wrong.push(format!("{place}\n  {difference:?}")),
                Err(error) => wrong.push(format!("{place}\n  {error}")),
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{}\n\n`cargo run --release -p taceva-tests --bin renew -- --quick` renews them",
        wrong.join("\n")
    );
    assert!(
        compared > 0,
        "no document has a passage that a command wrote"
    );
}

#[test]
fn an_option_is_no_folder_for_the_drawn_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    let ran = Command::new(example("make_recording"))
        .arg("--help")
        .current_dir(folder.path())
        .output()
        .expect("the example starts");
    assert_eq!(ran.status.code(), Some(2));
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(said.starts_with("usage: make_recording FOLDER"), "{said}");
    let written = fs::read_dir(folder.path()).expect("readable").count();
    assert_eq!(written, 0);
}

#[test]
fn every_table_of_numbers_says_what_wrote_it_or_why_nothing_did() {
    let mut open = Vec::new();
    for document in all() {
        let lines = unexplained_tables(&document.text)
            .unwrap_or_else(|(line, error)| panic!("{}:{line}: {error}", document.name));
        open.extend(
            lines
                .into_iter()
                .map(|line| format!("{}:{line}", document.name)),
        );
    }
    assert!(
        open.is_empty(),
        "tables of numbers without `<!-- from: … -->` around or `<!-- by hand: … -->` before them:\n{}",
        open.join("\n")
    );
}

#[test]
fn pictures_that_documents_show_are_there() {
    for document in all() {
        let folder = document.path.parent().expect("a file is in a folder");
        for shown in document.text.split("](").skip(1) {
            let Some((target, _)) = shown.split_once(')') else {
                continue;
            };
            let is_picture = Path::new(target)
                .extension()
                .is_some_and(|form| form == "png" || form == "svg");
            if is_picture && !target.starts_with("http") {
                assert!(folder.join(target).is_file(), "{}: {target}", document.name);
            }
        }
    }
}
