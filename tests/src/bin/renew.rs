//! Renews every generated passage of the documents, or prints the outdated ones.
//!
//! ```text
//! cargo run --release -p taceva-tests --bin renew -- [--check] [--quick] [--no-times] [FILE …]
//! ```

#![expect(clippy::print_stdout, reason = "a program says what it does")]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use anyhow::{Context as _, bail, ensure};
use taceva_tests::renew::{Document, Kind, Passage, Runner, documents};
use taceva_tests::root;

/// Command line arguments.
#[derive(Default)]
struct Asked {
    is_check: bool,
    is_quick: bool,
    without_times: bool,
    files: Vec<String>,
}

fn main() -> anyhow::Result<ExitCode> {
    let mut asked = Asked::default();
    for word in env::args().skip(1) {
        match word.as_str() {
            "--check" => asked.is_check = true,
            "--quick" => asked.is_quick = true,
            "--no-times" => asked.without_times = true,
            other if other.starts_with('-') => {
                bail!("`{other}`: expected --check, --quick, --no-times or the name of a document")
            }
            file => asked.files.push(file.to_owned()),
        }
    }
    let root = root();
    let mut documents = documents(&root)?;
    if !asked.files.is_empty() {
        for file in &asked.files {
            ensure!(
                documents.iter().any(|document| document.name == *file),
                "{file}: no document of the workspace has that name"
            );
        }
        documents.retain(|document| asked.files.contains(&document.name));
    }
    let programs = build(&root)?;
    let mut is_true = true;
    for document in &mut documents {
        let runner = Runner::new(&root, &programs)?;
        is_true &= renew(document, &runner, &asked)?;
    }
    Ok(match is_true {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    })
}

/// Builds the program `taceva` with the build profile of this program. Returns the folder of the programs.
fn build(root: &Path) -> anyhow::Result<PathBuf> {
    let own = env::current_exe()?;
    let folder = own.parent().context("a program is in a folder")?;
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut build = Command::new(cargo);
    build.args([
        "build",
        "--quiet",
        "--package",
        "taceva-cli",
        "--bin",
        "taceva",
    ]);
    build.args(["--example", "make_recording", "--manifest-path"]);
    build.arg(root.join("Cargo.toml"));
    if folder.ends_with("release") {
        build.arg("--release");
    }
    if let Some(target) = folder.parent() {
        build.arg("--target-dir").arg(target);
    }
    ensure!(build.status()?.success(), "taceva does not build");
    Ok(folder.to_owned())
}

/// Renews or checks one document; true if every checked passage is up to date.
fn renew(document: &mut Document, runner: &Runner, asked: &Asked) -> anyhow::Result<bool> {
    let read = |text: &str| {
        Passage::all(text)
            .map_err(|(line, error)| anyhow::anyhow!("{}:{line}: {error}", document.name))
    };
    let count = read(&document.text)?.len();
    let mut is_true = true;
    for number in 0..count {
        // Earlier passages may have shifted later ones.
        let passage = read(&document.text)?.swap_remove(number);
        let place = format!("{}:{}", document.name, passage.line);
        if let Some(reason) = left_out(passage.kind, asked) {
            println!("left     {place}  {reason}");
            continue;
        }
        let begun = Instant::now();
        let printed = match runner.run(&passage.command) {
            Ok(printed) => printed,
            Err(error) => {
                println!("failed   {place}  {} {error}", first_line(&passage.command));
                is_true = false;
                continue;
            }
        };
        let took = begun.elapsed().as_secs_f64();
        let fresh = passage.renewed(&document.text, &printed);
        if fresh == passage.content(&document.text) {
            println!("true     {place}  {took:.1} s");
        } else if asked.is_check {
            println!("differs  {place}  {}", first_line(&passage.command));
            is_true = false;
        } else {
            document.text.replace_range(passage.range.clone(), &fresh);
            fs::write(&document.path, &document.text)?;
            println!("renewed  {place}  {took:.1} s");
        }
    }
    Ok(is_true)
}

/// Reason why a passage of `kind` is skipped; `None` if it is not skipped.
fn left_out(kind: Kind, asked: &Asked) -> Option<&'static str> {
    match kind {
        Kind::Quick => None,
        _ if asked.is_quick => Some("takes too long for a test"),
        Kind::Times if asked.is_check => Some("its output contains times"),
        Kind::Times if asked.without_times => {
            Some("its output contains times, which were excluded")
        }
        Kind::Data if env::var_os("TACEVA_DATA").is_none() => {
            Some("TACEVA_DATA names no recordings")
        }
        Kind::Slow | Kind::Data | Kind::Times => None,
    }
}

fn first_line(command: &str) -> &str {
    command.lines().next().unwrap_or_default()
}
