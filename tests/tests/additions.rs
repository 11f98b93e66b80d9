//! Tests that `CONTRIBUTING.md` lists, under "Adding…", only existing files, and every file that mentions an example of the addition.

use taceva_tests::structure::{EXAMPLES, mentions};
use taceva_tests::{read, root};

/// Placeholders in the listed paths, each for a name.
const PLACEHOLDERS: [&str; 3] = ["NAME", "MAKER", "DEVICE"];

/// Section of `CONTRIBUTING.md` about one kind of addition, with the names of an example.
struct Section {
    heading: &'static str,
    kind: &'static str,
    /// Names of the example, in the order of [`PLACEHOLDERS`].
    names: [&'static str; 3],
}

const SECTIONS: [Section; 5] = [
    Section {
        heading: "A layout (preset)",
        kind: "preset",
        names: ["ycb-slide", "", ""],
    },
    Section {
        heading: "A metric",
        kind: "metric",
        names: ["signal_to_repeatability", "", ""],
    },
    Section {
        heading: "A driver",
        kind: "driver",
        names: ["netft", "ati", "netft"],
    },
    Section {
        heading: "A model",
        kind: "model",
        names: ["elastic_net", "", ""],
    },
    Section {
        heading: "A check",
        kind: "check",
        names: ["stuck_taxel", "", ""],
    },
];

/// Paths in the section with the given heading, or in all sections of "Adding…".
fn paths(heading: Option<&str>) -> Vec<String> {
    let text = read("CONTRIBUTING.md");
    let (_, adding) = text.split_once("\n## Adding…\n").expect("the part exists");
    let adding = adding.split("\n## ").next().unwrap_or_default();
    let sections = adding.split("\n### ").skip(1);
    let sections =
        sections.filter(|section| heading.is_none_or(|of| section.lines().next() == Some(of)));
    let quoted = sections.flat_map(|section| section.split('`').skip(1).step_by(2));
    quoted
        .filter(|text| text.contains('/') && !text.contains(' '))
        .flat_map(alternatives)
        .collect()
}

/// Paths that `a/{b,c}.rs` abbreviates.
fn alternatives(path: &str) -> Vec<String> {
    let Some((before, rest)) = path.split_once('{') else {
        return vec![path.to_owned()];
    };
    let (inside, after) = rest.split_once('}').expect("a closed brace");
    let each = inside.split(',');
    each.map(|one| format!("{before}{one}{after}")).collect()
}

#[test]
fn every_file_of_an_addition_exists() {
    let paths = paths(None);
    assert!(paths.len() > 40, "{paths:?}");
    for path in paths {
        let name = PLACEHOLDERS.iter().filter_map(|word| path.find(word)).min();
        let known = match name {
            Some(at) => path[..at].rsplit_once('/').map_or("", |(folder, _)| folder),
            None => path.as_str(),
        };
        assert!(root().join(known).exists(), "CONTRIBUTING.md: `{path}`");
    }
}

#[test]
fn every_file_that_names_an_example_is_in_its_list() {
    for section in SECTIONS {
        let listed = paths(Some(section.heading)).into_iter().map(|path| {
            let names = PLACEHOLDERS.iter().zip(section.names);
            names.fold(path, |path, (word, name)| path.replace(word, name))
        });
        let listed: Vec<String> = listed.collect();
        assert!(!listed.is_empty(), "no list below `{}`", section.heading);
        let mut examples = EXAMPLES.iter();
        let example = examples.find(|example| example.kind == section.kind);
        for file in mentions(example.expect("an example of the kind")) {
            let is_listed = |path: &String| {
                *path == file || (path.ends_with('/') && file.starts_with(path.as_str()))
            };
            assert!(
                listed.iter().any(is_listed),
                "{}: CONTRIBUTING.md lacks `{file}`",
                section.kind
            );
        }
    }
}
