//! Limits on numbers that describe the structure of crates. `cargo run -p taceva-tests --bin structure -- --all` prints the numbers.

use taceva_tests::metadata;
use taceva_tests::structure::{
    COPIES, EXAMPLES, copies, documentation, files_named_by_participles, knots, lines, mentions,
    sources, tuple_parameters, walks,
};

/// Maximum number of lines of product code, and of all lines in `.rs` files. A commit that adds lines raises these limits and states it.
const MOST_LINES: (usize, usize) = (270_200, 522_900);

/// Maximum number of lines of one file, with its comments and tests.
const MOST_LINES_OF_A_FILE: usize = 400;

/// Maximum number of tuple parameters of functions.
const MOST_TUPLES: usize = 4;

/// Maximum number of files that are named by participles.
const MOST_PARTICIPLES: usize = 4;

/// Maximum number of functions that one value passes through in the program, and of its returns to a file that it had left.
const MOST_STOPS: (usize, usize) = (12, 3);

/// Greatest share of a package's doc comments that begin with a clause, in per cent.
const MOST_CLAUSES: f64 = 4.0;

/// Accepted groups of top-level modules that import each other, by package, each with its number of modules.
const KNOTS: &[(&str, usize)] = &[];

#[test]
fn no_top_level_modules_import_each_other_in_a_knot() {
    let mut found = Vec::new();
    for package in &metadata().packages {
        let src = package
            .manifest_path
            .parent()
            .expect("a folder")
            .join("src");
        for knot in knots(src.as_std_path()) {
            let is_known = KNOTS.contains(&(package.name.as_str(), knot.len()));
            if !is_known {
                found.push(format!("{}: {knot:?}", package.name));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn lines_do_not_grow() {
    let sources = sources();
    let lines = lines(sources);
    let product: usize = lines.values().map(|of| of.product).sum();
    let all: usize = lines.values().map(|of| of.all).sum();
    assert!(product > 100_000, "{product} lines: the reader is broken");
    assert!(
        product <= MOST_LINES.0 && all <= MOST_LINES.1,
        "{product} lines of product code, {all} in all"
    );
}

#[test]
fn a_file_is_short_enough_for_one_concept() {
    let mut long = Vec::new();
    for source in sources() {
        let lines = source.text.lines().count();
        if lines > MOST_LINES_OF_A_FILE {
            long.push(format!("{}: {lines} lines", source.path));
        }
    }
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn no_function_takes_a_tuple_in_the_place_of_a_type() {
    let found = tuple_parameters(sources());
    assert!(
        found.len() <= MOST_TUPLES,
        "{}:\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn files_are_named_by_nouns() {
    let sources = sources();
    let found = files_named_by_participles(sources);
    assert!(
        found.len() <= MOST_PARTICIPLES,
        "{}:\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn doc_comments_name_the_thing() {
    let sources = sources();
    for (package, of) in documentation(sources) {
        assert!(
            of.percent() <= MOST_CLAUSES,
            "{package}: {:.1} % of {} doc comments begin with a clause",
            of.percent(),
            of.comments
        );
    }
}

#[test]
fn one_concept_is_written_once() {
    let sources = sources();
    for concept in COPIES {
        let found = copies(concept, sources);
        assert!(
            found.len() <= concept.most,
            "{}: {}",
            concept.concept,
            found.join(", ")
        );
    }
}

#[test]
fn few_files_name_one_metric_model_check_preset_driver_or_kind() {
    for example in EXAMPLES {
        let found = mentions(example);
        assert!(!found.is_empty(), "{}: the example is gone", example.kind);
        assert!(
            found.len() <= example.most,
            "{}: {} files:\n{}",
            example.kind,
            found.len(),
            found.join("\n")
        );
    }
}

#[test]
fn the_way_of_one_value_is_short_and_as_the_architecture_states_it() {
    for walk in walks() {
        assert_eq!(walk.mistakes(), Vec::<String>::new(), "{}", walk.name);
        assert!(
            walk.stops() <= MOST_STOPS.0 && walk.returns() <= MOST_STOPS.1,
            "{}: {} stops, {} returns",
            walk.name,
            walk.stops(),
            walk.returns()
        );
    }
}
