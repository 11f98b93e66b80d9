//! Tests that no crate has an import cycle of three or more files, except for listed cycles. Files of a cycle cannot be read one at a time.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use taceva_tests::imports::{circles, graph};
use taceva_tests::metadata;

/// Least number of files in a rejected cycle.
const LEAST: usize = 3;

/// Accepted cycles: package, one of the files, maximum number of files, and the reason.
const KNOWN: &[(&str, &str, usize, &str)] = &[
    (
        "taceva-metrics",
        "evaluate/metric",
        4,
        "a metric names its family, which is made for a plan of metrics",
    ),
    (
        "taceva-host",
        "child/kind",
        6,
        "a kind of device holds both ends of the socket: one end starts the child that serves the other",
    ),
    (
        "taceva-report",
        "figure/pdf/text",
        3,
        "what no font draws is drawn as lines, and lines carry text",
    ),
    (
        "taceva-models",
        "estimators/library",
        14,
        "the module of library models lists the adapters, which implement its trait",
    ),
];

#[test]
fn no_files_import_one_another_in_a_ring_of_three_or_more() {
    let mut unknown = Vec::new();
    let mut met = BTreeSet::new();
    let mut files = 0;
    for package in &metadata().packages {
        let folder = package.manifest_path.parent().expect("a folder");
        let graph = graph(folder.join("src").as_std_path());
        files += graph.len();
        for circle in circles(&graph, LEAST) {
            let known = KNOWN.iter().find(|(of, file, most, _)| {
                *of == package.name.as_str() && circle.contains(*file) && circle.len() <= *most
            });
            met.extend(known.map(|(_, file, _, _)| *file));
            if known.is_none() {
                let edges = circle.iter().map(|from| {
                    let to: Vec<&str> = graph[from]
                        .intersection(&circle)
                        .map(String::as_str)
                        .collect();
                    format!("    {from} -> {}", to.join(", "))
                });
                let edges: Vec<String> = edges.collect();
                unknown.push(format!(
                    "{}, {} files:\n{}",
                    package.name,
                    circle.len(),
                    edges.join("\n")
                ));
            }
        }
    }
    assert!(
        files > 1000,
        "only {files} files were seen: the reader is broken"
    );
    assert!(unknown.is_empty(), "{}", unknown.join("\n"));
    let listed: BTreeSet<&str> = KNOWN.iter().map(|(_, file, _, _)| *file).collect();
    assert_eq!(met, listed, "a circle that is gone is taken off the list");
}

#[test]
fn a_ring_is_found_through_what_others_hand_on_and_a_parent_that_only_hands_on_is_in_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = BTreeMap::from([
        (
            "lib.rs",
            "mod a;\nmod b;\npub use a::deep::Deep;\npub use b::B;\n",
        ),
        (
            "a.rs",
            "mod deep;\npub(crate) use deep::Deep;\nconst SHARED: usize = deep::LENGTH;\n",
        ),
        (
            "a/deep.rs",
            "use crate::{B, c};\n// use crate::nowhere::Else;\npub struct Deep(B);\n",
        ),
        (
            "b.rs",
            "use crate::c::C as Other;\npub struct B(Other);\n#[cfg(test)]\nmod tests { use crate::a::Deep; }\n",
        ),
        (
            "c.rs",
            "pub struct C(Option<Box<crate::a::Deep>>);\nfn name() -> &'static str { \"crate::b::B\" }\n",
        ),
    ]);
    for (name, code) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, code).expect("written");
    }
    let graph = graph(folder.path());
    let to = |from: &str| graph[from].iter().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(to("lib"), Vec::<&str>::new());
    assert_eq!(to("a"), ["a/deep"]);
    assert_eq!(to("a/deep"), ["b", "c"]);
    assert_eq!((to("b"), to("c")), (vec!["c"], vec!["a/deep"]));
    let ring = ["a/deep", "b", "c"].map(str::to_owned);
    assert_eq!(circles(&graph, 3), [BTreeSet::from(ring)]);
    assert_eq!(circles(&graph, 4), Vec::<BTreeSet<String>>::new());
}
