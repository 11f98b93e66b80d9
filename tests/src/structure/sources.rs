//! The Rust sources of the workspace, each with its package.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use crate::source::{rust_files, without_text};
use crate::{metadata, root};

/// One Rust file of the workspace.
#[derive(Debug)]
pub struct Source {
    /// Name of its package.
    pub package: String,
    /// Path from the root of the workspace, with `/`.
    pub path: String,
    /// Text of the file.
    pub text: String,
    /// Code of the file without comments, strings and test items; empty for files outside the product.
    pub product_code: String,
}

impl Source {
    fn new(package: &str, path: &str, text: String) -> Source {
        let mut source = Source {
            package: package.to_owned(),
            path: path.to_owned(),
            text,
            product_code: String::new(),
        };
        if source.is_product() {
            source.product_code = without_test_items(&without_text(&source.text));
        }
        source
    }

    /// True if the file is part of a program: it lies outside `tests`, `benches`, `examples` and `fuzz`, and is not a `tests.rs`.
    pub fn is_product(&self) -> bool {
        let beside = ["tests", "benches", "examples", "fuzz"];
        !self.path.split('/').any(|part| beside.contains(&part))
            && !self.path.ends_with("/tests.rs")
    }
}

/// Every Rust file of every package, in path order, read once. A file behind a symbolic link counts at its real path.
///
/// # Panics
/// If a file cannot be read, which ends the test.
pub fn sources() -> &'static [Source] {
    static SOURCES: OnceLock<Vec<Source>> = OnceLock::new();
    SOURCES.get_or_init(read_sources)
}

fn read_sources() -> Vec<Source> {
    let root = root();
    let mut packages: Vec<(String, PathBuf)> = metadata()
        .packages
        .iter()
        .map(|package| {
            let folder = package.manifest_path.parent().expect("a folder");
            (package.name.to_string(), folder.as_std_path().to_owned())
        })
        .collect();
    // A package within the folder of another one comes first and keeps its files.
    packages.sort_by_key(|(_, folder)| std::cmp::Reverse(folder.components().count()));
    let mut found: Vec<Source> = Vec::new();
    let mut taken = BTreeSet::new();
    for (package, folder) in packages {
        for file in rust_files(&folder) {
            let is_linked = file
                .ancestors()
                .take_while(|path| *path != folder)
                .any(|path| path.is_symlink());
            if is_linked
                || file.components().any(|part| part.as_os_str() == "target")
                || !taken.insert(file.clone())
            {
                continue;
            }
            let path = file.strip_prefix(&root).expect("below the root");
            found.push(Source::new(
                &package,
                &path.to_string_lossy(),
                fs::read_to_string(&file).expect("readable"),
            ));
        }
    }
    found.sort_by(|one, other| one.path.cmp(&other.path));
    found
}

/// Code without `#[cfg(test)]` items; comments and strings must be removed before.
///
/// ```
/// use taceva_tests::structure::without_test_items;
///
/// let code = "struct A;\n#[cfg(test)]\nfn b() { c(); }\nstruct D;\n";
/// assert_eq!(without_test_items(code), "struct A;\n\nstruct D;\n");
/// ```
pub fn without_test_items(code: &str) -> String {
    let mut kept = String::new();
    let mut rest = code;
    while let Some(start) = rest.find("#[cfg(test)]") {
        kept.push_str(&rest[..start]);
        let item = &rest[start..];
        rest = &item[end_of_item(item)..];
    }
    kept + rest
}

/// Length of the item that `code` begins with, up to its closing brace or semicolon.
fn end_of_item(code: &str) -> usize {
    let mut depth = 0_usize;
    for (at, letter) in code.char_indices() {
        match letter {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 && (letter == '}' || letter == ';') {
            let end = at + 1;
            // A list of imports ends with both.
            return end + usize::from(code[end..].starts_with(';'));
        }
    }
    code.len()
}

#[cfg(test)]
mod tests {
    use super::without_test_items;

    #[test]
    fn an_item_for_tests_ends_with_its_brace_or_semicolon() {
        let code = "#[cfg(test)]\nuse a::{b, c};\nuse d;\n#[cfg(test)]\nmod tests {\n fn e() {}\n}\nstruct F;\n";
        assert_eq!(without_test_items(code), "\nuse d;\n\nstruct F;\n");
    }
}
