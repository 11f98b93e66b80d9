//! Requirements on the public types of crates that other projects use: a documented example, and room for new fields or variants.

use std::fs;

use taceva_tests::root;
use taceva_tests::source::{rust_files, without_tests};

/// Folders of the crates with a stable interface.
const PROMISED: [&str; 6] = [
    "taceva-core",
    "crates/recordings/dataset",
    "crates/recordings/import",
    "taceva-metrics",
    "plugins/abi",
    "plugins/sdk",
];

/// Words in the doc comment of a struct with public fields that will get no further field. Their sentence gives the reason.
const COMPLETE_STRUCT: &str = "gets no further field";
/// Words in the doc comment of an enum that will get no further variant.
const COMPLETE_ENUM: &str = "gets no further variant";

/// A public type as declared in its source.
#[derive(Debug, PartialEq)]
struct PublicType {
    name: String,
    is_struct: bool,
    has_example: bool,
    /// True if other crates name its fields or variants, so that a new one would break them.
    is_open: bool,
    /// True if it is `#[non_exhaustive]` or documented as complete.
    is_decided: bool,
}

/// Types that `code` declares at its outermost level.
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
        if above.contains(&"#[doc(hidden)]") {
            // Shared between our crates, without a stability promise.
            continue;
        }
        let body = lines[at + 1..]
            .iter()
            .take_while(|line| !line.starts_with('}'));
        let (is_open, complete) = if line.starts_with("pub enum ") {
            (true, COMPLETE_ENUM)
        } else if line.starts_with("pub struct ") && line.ends_with('{') {
            let mut fields = body.filter(|line| line.starts_with("    pub "));
            (fields.next().is_some(), COMPLETE_STRUCT)
        } else {
            (line.contains("(pub "), COMPLETE_STRUCT)
        };
        found.push(PublicType {
            name: name.into_iter().next().unwrap_or_default().to_owned(),
            is_struct: line.starts_with("pub struct "),
            has_example: above.iter().any(|line| line.starts_with("/// ```")),
            is_open,
            is_decided: above
                .iter()
                .any(|line| *line == "#[non_exhaustive]" || line.contains(complete)),
        });
    }
    found
}

/// Files of the crates in [`PROMISED`], by path from the workspace root, with the types of each.
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

/// Types for which `is_owed` returns true, each after the path of its file.
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
fn every_enum_and_every_struct_of_public_fields_can_grow_or_says_why_it_need_not() {
    // Structs of the C boundary grow at their end and state their size. Values of its kinds are constants; others are rejected.
    let owed = owed(|path, declared| {
        let is_struct_of_boundary = path.starts_with("plugins/abi/") && declared.is_struct;
        declared.is_open && !declared.is_decided && !is_struct_of_boundary
    });
    assert!(
        owed.is_empty(),
        "neither #[non_exhaustive] nor \"{COMPLETE_STRUCT}\" or \"{COMPLETE_ENUM}\" in its doc:\n{}",
        owed.join("\n")
    );
}

#[test]
fn the_reader_sees_what_a_type_has_and_what_it_lacks() {
    let code = "/// A.\n///\n/// ```\n/// let a = A;\n/// ```\n#[derive(Debug)]\n#[non_exhaustive]\npub struct A {\n    pub b: u8,\n}\n\n\
        /// C.\npub struct C<T> {\n    /// It.\n    pub d: T,\n}\n\n/// E.\npub(crate) struct E;\n\n/// F.\npub struct F(pub u8);\n\n\
        /// G.\npub struct G(u8);\n\n/// H gets no further variant: there are two.\npub enum H {\n    I,\n    J,\n}\n\n\
        /// K gets no further field.\npub enum K {\n    L,\n}\n#[cfg(test)]\nmod tests {\n}\n";
    let expected = [
        ("A", true, true, true),
        ("C", false, true, false),
        ("F", false, true, false),
        ("G", false, false, false),
        ("H", false, true, true),
        ("K", false, true, false),
    ];
    let expected = expected.map(|(name, has_example, is_open, is_decided)| PublicType {
        name: name.to_owned(),
        is_struct: !["H", "K"].contains(&name),
        has_example,
        is_open,
        is_decided,
    });
    assert_eq!(public_types(code), expected);
}
