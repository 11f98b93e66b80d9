//! What the crates that others build on owe each of their public types: an example that runs, and room to grow.

use std::fs;

use taceva_tests::root;
use taceva_tests::source::{rust_files, without_tests};

/// The crates whose interface is a promise, by folder.
const PROMISED: [&str; 5] = [
    "taceva-core",
    "taceva-dataset",
    "taceva-metrics",
    "plugins/abi",
    "plugins/sdk",
];

/// Files whose structs of public fields are still made by literals; one whose structs are not is taken off the list.
const LITERALS: [&str; 2] = [
    "taceva-core/src/driver/guarded_motion.rs",
    "taceva-core/src/registry/facts.rs",
];

/// What says in the doc of a struct of public fields that it is complete.
const CLOSED: &str = "gets no further field";

/// A public type as its source declares it.
#[derive(Debug, PartialEq)]
struct PublicType {
    name: String,
    has_example: bool,
    has_public_fields: bool,
    can_grow: bool,
}

/// The types that `code` declares at its outermost level.
fn public_types(code: &str) -> Vec<PublicType> {
    let lines: Vec<&str> = without_tests(code).lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let kinds = ["struct ", "enum ", "union ", "trait ", "type "];
        let declared = line
            .strip_prefix("pub ")
            .and_then(|rest| kinds.iter().find_map(|kind| rest.strip_prefix(kind)));
        let Some(declared) = declared else { continue };
        let name = declared.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
        let start = lines[..at].iter().rposition(|line| line.is_empty());
        let above = &lines[start.map_or(0, |blank| blank + 1)..at];
        let is_struct = line.starts_with("pub struct ");
        let body = lines[at + 1..]
            .iter()
            .take_while(|line| !line.starts_with('}'));
        found.push(PublicType {
            name: name.into_iter().next().unwrap_or_default().to_owned(),
            has_example: above.iter().any(|line| line.starts_with("/// ```")),
            has_public_fields: is_struct
                && line.ends_with('{')
                && body.into_iter().any(|line| line.starts_with("    pub ")),
            can_grow: above
                .iter()
                .any(|line| *line == "#[non_exhaustive]" || line.contains(CLOSED)),
        });
    }
    found
}

/// The files of the promised crates with the types of each, paths from the root of the workspace.
fn all_types() -> Vec<(String, Vec<PublicType>)> {
    let mut found = Vec::new();
    for folder in PROMISED {
        for file in rust_files(&root().join(folder).join("src")) {
            let code = fs::read_to_string(&file).expect("readable");
            let path = file.strip_prefix(root()).expect("below the root");
            found.push((path.display().to_string(), public_types(&code)));
        }
    }
    assert!(found.len() > 200, "{}: the reader is broken", found.len());
    found
}

/// The types to which something is owed, each behind the path of its file.
fn owed(is_owed: impl Fn(&str, &PublicType) -> bool) -> Vec<String> {
    let mut owed = Vec::new();
    for (path, types) in all_types() {
        let lacking = types.iter().filter(|declared| is_owed(&path, declared));
        owed.extend(lacking.map(|declared| format!("{path}: {}", declared.name)));
    }
    owed
}

#[test]
fn every_public_type_has_an_example() {
    let owed = owed(|_, declared| !declared.has_example);
    assert!(owed.is_empty(), "no example:\n{}", owed.join("\n"));
}

#[test]
fn every_struct_of_public_fields_can_grow_or_says_that_it_is_complete() {
    // Structs of the C boundary grow at their end, and say their size.
    let owed = owed(|path, declared| {
        declared.has_public_fields && !declared.can_grow && !path.starts_with("plugins/abi/")
    });
    let (known, unknown): (Vec<_>, Vec<_>) = owed
        .into_iter()
        .partition(|one| LITERALS.iter().any(|place| one.starts_with(place)));
    assert!(
        unknown.is_empty(),
        "neither #[non_exhaustive] nor \"{CLOSED}\":\n{}",
        unknown.join("\n")
    );
    let is_met = |place: &&str| known.iter().any(|one| one.starts_with(place));
    let met: Vec<&str> = LITERALS.into_iter().filter(is_met).collect();
    assert_eq!(met, LITERALS, "no longer owed: off the list");
}

#[test]
fn the_reader_sees_what_a_type_has_and_what_it_lacks() {
    let code = "/// A.\n///\n/// ```\n/// let a = A;\n/// ```\n#[derive(Debug)]\n#[non_exhaustive]\npub struct A {\n    pub b: u8,\n}\n\n/// C.\npub struct C<T> {\n    /// It.\n    pub d: T,\n}\n\n/// E.\npub(crate) struct E;\n#[cfg(test)]\nmod tests {\n}\n";
    let expected = [("A", true, true), ("C", false, false)].map(|(name, has, can)| PublicType {
        name: name.to_owned(),
        has_example: has,
        has_public_fields: true,
        can_grow: can,
    });
    assert_eq!(public_types(code), expected);
}
