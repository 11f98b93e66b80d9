//! Knots: top-level modules of a crate that import each other, directly or through others.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::imports::{Graph, circles, graph};

/// Imports between the top-level modules of the crate with sources in `src`.
///
/// # Panics
/// If a file cannot be read, which ends the test.
pub fn module_graph(src: &Path) -> Graph {
    let mut modules: Graph = BTreeMap::new();
    for (file, imported) in graph(src) {
        let from = top(&file);
        let others = imported.iter().map(|other| top(other));
        let others = others.filter(|other| *other != from && *other != "lib" && from != "lib");
        let others: BTreeSet<String> = others.map(str::to_owned).collect();
        modules.entry(from.to_owned()).or_default().extend(others);
    }
    modules
}

/// The knots of two or more top-level modules of the crate.
///
/// # Panics
/// If a file cannot be read, which ends the test.
pub fn knots(src: &Path) -> Vec<BTreeSet<String>> {
    circles(&module_graph(src), 2)
}

/// The top-level module of a file.
fn top(file: &str) -> &str {
    file.split('/').next().unwrap_or(file)
}
