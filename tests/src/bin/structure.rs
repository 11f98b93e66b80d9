//! Prints counts that describe the structure of the workspace.
//!
//! `cargo run -p taceva-tests --bin structure` prints the sums. `… -- --all` also lists each file and parameter.

use std::error::Error;
use std::io::Write as _;

use taceva_tests::structure::{
    COPIES, EXAMPLES, compiled_crates, copies, documentation, files_named_by_participles, knots,
    lines, mentions, sources, tuple_parameters, walks,
};
use taceva_tests::{metadata, read};

fn main() -> Result<(), Box<dyn Error>> {
    let shows_all = std::env::args().any(|argument| argument == "--all");
    let mut out = std::io::stdout().lock();
    let sources = sources();

    let lines = lines(sources);
    let comments = documentation(sources);
    writeln!(
        out,
        "{:<20} {:>8} {:>8} {:>9} {:>8}",
        "package", "product", "all", "comments", "clauses"
    )?;
    for (package, of) in &lines {
        let said = comments.get(package).copied().unwrap_or_default();
        writeln!(
            out,
            "{package:<20} {:>8} {:>8} {:>9} {:>6.1} %",
            of.product,
            of.all,
            said.comments,
            said.percent()
        )?;
    }
    let product: usize = lines.values().map(|of| of.product).sum();
    let all: usize = lines.values().map(|of| of.all).sum();
    writeln!(out, "{:<20} {product:>8} {all:>8}", "sum")?;

    writeln!(out, "\nknots of top-level modules")?;
    for package in &metadata().packages {
        let src = package
            .manifest_path
            .parent()
            .ok_or("a manifest lies in a folder")?
            .join("src");
        for knot in knots(src.as_std_path()) {
            let modules: Vec<&str> = knot.iter().map(String::as_str).collect();
            writeln!(
                out,
                "  {}: {}: {}",
                package.name,
                modules.len(),
                modules.join(", ")
            )?;
        }
    }

    writeln!(out, "\nfiles that name one example")?;
    for example in EXAMPLES {
        let found = mentions(example);
        writeln!(
            out,
            "  {}, {}: {}",
            example.kind,
            example.words[0],
            found.len()
        )?;
        list(&mut out, shows_all, &found)?;
    }

    writeln!(out, "\ncopies")?;
    for concept in COPIES {
        let found = copies(concept, sources);
        writeln!(out, "  {}: {}", concept.concept, found.len())?;
        list(&mut out, shows_all, &found)?;
    }

    let tuples = tuple_parameters(sources);
    writeln!(out, "\ntuple parameters: {}", tuples.len())?;
    list(&mut out, shows_all, &tuples)?;
    let named = files_named_by_participles(sources);
    writeln!(out, "files named by participles: {}", named.len())?;
    list(&mut out, shows_all, &named)?;

    let crates = compiled_crates("taceva-dataset");
    writeln!(out, "crates that read a dataset: {}", crates.len())?;
    let crates: Vec<&String> = crates.iter().collect();
    list(&mut out, shows_all, &crates)?;
    let rules = read("Cargo.toml").matches(".opt-level = ").count();
    writeln!(out, "rules of optimisation by package: {rules}")?;

    writeln!(out, "\nways of one value")?;
    for walk in walks() {
        writeln!(
            out,
            "  {}: {} stops, {} returns",
            walk.name,
            walk.stops(),
            walk.returns()
        )?;
    }
    Ok(())
}

/// Prints one line for each item of `found` if `shows_all` is true.
fn list(
    out: &mut impl std::io::Write,
    shows_all: bool,
    found: &[impl AsRef<str>],
) -> std::io::Result<()> {
    for one in found.iter().filter(|_| shows_all) {
        writeln!(out, "    {}", one.as_ref())?;
    }
    Ok(())
}
