//! Imports between the source files of a crate. Each `use` declaration and path is followed to the file that declares the name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::source::{rust_files, without_tests, without_text};

/// Path of a module within the crate, as words; empty for the root.
type Module = Vec<String>;

/// Files of one crate, with the imports of each. A file is named by the path of its module, such as `stats/holm`; the root is `lib`.
pub type Graph = BTreeMap<String, BTreeSet<String>>;

/// Imports of a file, and the rest of its code.
struct Source {
    /// Imported names, each with its path, and true if it is re-exported.
    imports: Vec<(String, Vec<String>, bool)>,
    /// The code without its `use` declarations.
    body: String,
}

/// Imports between the files below `src`. Unit tests are excluded. Imports between a module and its parent are also excluded: names that the parent
/// only re-exports, and names that a child takes from its parent.
///
/// # Panics
/// If a file cannot be read, which ends the test.
pub fn graph(src: &Path) -> Graph {
    let mut sources = BTreeMap::new();
    for file in rust_files(src) {
        let relative = file.strip_prefix(src).expect("below it").with_extension("");
        let words = relative.iter().map(|word| word.to_string_lossy());
        let mut module: Module = words.map(|word| word.into_owned()).collect();
        let last = module.last().map(String::as_str);
        if last == Some("tests") || module.first().is_some_and(|first| first == "bin") {
            continue;
        }
        if matches!(last, Some("lib" | "main" | "mod")) {
            module.pop();
        }
        let code = fs::read_to_string(&file).expect("readable");
        sources.insert(module, Source::read(&without_text(without_tests(&code))));
    }
    let found = sources.iter().map(|(module, source)| {
        let others = imported(&sources, module, source);
        (name(module), others.iter().map(name).collect())
    });
    found.collect()
}

fn name(module: &Module) -> String {
    match module.is_empty() {
        true => "lib".to_owned(),
        false => module.join("/"),
    }
}

/// The other files from which `module` imports.
fn imported(
    sources: &BTreeMap<Module, Source>,
    module: &Module,
    source: &Source,
) -> BTreeSet<Module> {
    let words = words(&source.body);
    let mut found = BTreeSet::new();
    for (name, path, is_public) in &source.imports {
        // A name that is re-exported and used counts as an import.
        if *is_public && !words.contains(name.as_str()) {
            continue;
        }
        found.extend(declared_in(sources, module, path, 0));
    }
    for path in paths(&source.body) {
        found.extend(declared_in(sources, module, &path, 0));
    }
    let parent = &module[..module.len().saturating_sub(1)];
    // Code without its own file, such as a nested module, belongs to no file.
    found.retain(|other| other != module && other != parent && sources.contains_key(other));
    found
}

/// Maximum number of re-exports that are followed for one name.
const HANDED_ON: usize = 8;

/// File with the declaration to which `path` refers in `module`; `None` for other crates.
fn declared_in(
    sources: &BTreeMap<Module, Source>,
    module: &Module,
    path: &[String],
    depth: usize,
) -> Option<Module> {
    let child = |of: &Module, word: &str| {
        let mut longer = of.clone();
        longer.push(word.to_owned());
        sources.contains_key(&longer).then_some(longer)
    };
    let mut rest = path;
    let mut at = match rest.first()?.as_str() {
        "crate" => Module::new(),
        "self" => module.clone(),
        "super" => module[..module.len().checked_sub(1)?].to_vec(),
        word => child(module, word)?,
    };
    rest = &rest[1..];
    while rest.first().is_some_and(|word| word == "super") {
        at.pop();
        rest = &rest[1..];
    }
    while let Some(deeper) = rest.first().and_then(|word| child(&at, word)) {
        at = deeper;
        rest = &rest[1..];
    }
    let handed_on = rest.first().filter(|_| at != *module && depth < HANDED_ON);
    let imports = sources.get(&at).map(|source| source.imports.iter());
    let further = handed_on.and_then(|name| {
        let mut of_that_name = imports?.filter(|(known, _, _)| known == name);
        of_that_name.find_map(|(_, path, _)| declared_in(sources, &at, path, depth + 1))
    });
    Some(further.unwrap_or(at))
}

impl Source {
    /// Parses `code`, which has no comments and strings.
    fn read(code: &str) -> Source {
        let (mut imports, mut body) = (Vec::new(), String::new());
        for statement in code.split_inclusive(';') {
            let start = statement.rfind("use ").filter(|&start| {
                let before = statement[..start].trim_end();
                let is_word = before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
                start == 0 || !is_word || before.ends_with("pub")
            });
            let Some(start) = start else {
                body.push_str(statement);
                continue;
            };
            let before = statement[..start].trim_end();
            let is_public = before.ends_with("pub")
                || before
                    .rsplit_once("pub(")
                    .is_some_and(|(_, inside)| inside.ends_with(')') && !inside.contains('\n'));
            body.push_str(&statement[..start]);
            let tree: String = statement[start + 4..]
                .trim_end_matches(';')
                .replace(" as ", "@")
                .split_whitespace()
                .collect();
            for path in expanded(&tree) {
                let (path, renamed) = path.split_once('@').unwrap_or((&path, ""));
                let mut words: Vec<String> = path.split("::").map(str::to_owned).collect();
                if words.len() > 1
                    && words
                        .last()
                        .is_some_and(|last| last == "self" || last == "*")
                {
                    words.pop();
                }
                let own = words.last().cloned().unwrap_or_default();
                let name = if renamed.is_empty() {
                    own
                } else {
                    renamed.to_owned()
                };
                imports.push((name, words, is_public));
            }
        }
        Source { imports, body }
    }
}

/// Full paths that `tree` imports. `tree` is the part of a `use` declaration after `use`, without spaces.
fn expanded(tree: &str) -> Vec<String> {
    let Some(open) = tree.find('{') else {
        return vec![tree.to_owned()];
    };
    let (before, inside) = (&tree[..open], &tree[open + 1..tree.len() - 1]);
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for letter in inside.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        match (letter, parts.last_mut()) {
            (',', _) if depth == 0 => parts.push(String::new()),
            (letter, Some(last)) => last.push(letter),
            (_, None) => {}
        }
    }
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    let all = parts.flat_map(|part| expanded(&part));
    all.map(|rest| format!("{before}{rest}")).collect()
}

fn is_letter(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

fn words(body: &str) -> BTreeSet<&str> {
    body.split(|letter: char| !is_letter(letter)).collect()
}

/// Every path of at least two words in `body`.
fn paths(body: &str) -> BTreeSet<Vec<String>> {
    let candidates = body.split(|letter: char| !(is_letter(letter) || letter == ':'));
    let paths = candidates.filter(|path| path.contains("::") && !path.starts_with(':'));
    let words = paths.map(|path| path.split("::").map(str::to_owned).collect());
    words.filter(|path: &Vec<String>| path.len() > 1).collect()
}

/// Groups of at least `least` files in which every file imports every other, directly or through others.
pub fn circles(graph: &Graph, least: usize) -> Vec<BTreeSet<String>> {
    let reached: BTreeMap<&str, BTreeSet<&str>> = graph
        .keys()
        .map(|from| (from.as_str(), reached(graph, from)))
        .collect();
    let mut found = BTreeSet::new();
    for (from, there) in &reached {
        let back = there.iter().filter(|to| reached[**to].contains(from));
        let circle: BTreeSet<String> = back.map(|file| (*file).to_owned()).collect();
        if circle.len() >= least {
            found.insert(circle);
        }
    }
    found.into_iter().collect()
}

/// Files that `from` imports, directly or through others.
fn reached<'a>(graph: &'a Graph, from: &str) -> BTreeSet<&'a str> {
    let (mut seen, mut left) = (BTreeSet::new(), vec![from]);
    while let Some(file) = left.pop() {
        for next in graph.get(file).into_iter().flatten() {
            if seen.insert(next.as_str()) {
                left.push(next);
            }
        }
    }
    seen
}
