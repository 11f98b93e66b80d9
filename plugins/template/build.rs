//! Lists the sources of the crates for Rust plugins, and the headers and the example for C plugins, so they can be embedded.
//!
//! `vendor/` contains links to these files. `cargo package` replaces the links by their targets, so the published crate is complete. A checkout
//! without symbolic links reads the files from the workspace.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Crates, each with its path relative to this folder in the workspace.
const CRATES: [(&str, &str); 3] = [
    ("taceva-core", "../../taceva-core"),
    ("taceva-abi", "../abi"),
    ("taceva-plugin", "../sdk"),
];

fn main() -> io::Result<()> {
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").ok_or(io::ErrorKind::NotFound)?);
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    let mut sources = String::new();
    for (name, in_workspace) in CRATES {
        let packed = here.join("vendor").join(name);
        let folder = if packed.join("src").is_dir() {
            packed
        } else {
            here.join(in_workspace)
        };
        let mut files = vec![folder.join("README.md")];
        walk(&folder.join("src"), &mut files)?;
        list(name, &folder, files, &mut sources)?;
    }
    fs::write(out.join("sources.rs"), format!("&[\n{sources}]\n"))?;

    let packed = here.join("vendor/include");
    let folder = if packed.is_dir() {
        packed
    } else {
        here.join("../abi/include")
    };
    let (mut files, mut headers) = (Vec::new(), String::new());
    walk(&folder, &mut files)?;
    list("include", &folder, files, &mut headers)?;
    fs::write(out.join("headers.rs"), format!("&[\n{headers}]\n"))?;

    let packed = here.join("vendor/c-example");
    let folder = if packed.join("src").is_dir() {
        packed
    } else {
        here.join("../c-example")
    };
    let (mut files, mut example) = (vec![folder.join("plugin.toml")], String::new());
    walk(&folder.join("src"), &mut files)?;
    list("", &folder, files, &mut example)?;
    fs::write(out.join("example.rs"), format!("&[\n{example}]\n"))
}

/// Writes one line per file: its path in the plugin, below `name` unless it is empty, and its content.
fn list(name: &str, folder: &Path, mut files: Vec<PathBuf>, into: &mut String) -> io::Result<()> {
    files.sort();
    for file in files {
        let below = file.strip_prefix(folder).map_err(io::Error::other)?;
        let below = below.to_str().ok_or(io::ErrorKind::InvalidData)?;
        let place = format!("{name}/{}", below.replace('\\', "/"));
        let place = place.trim_start_matches('/');
        writeln!(into, "    ({place:?}, include_str!({file:?})),").map_err(io::Error::other)?;
    }
    Ok(())
}

/// Lists the files below `folder`. Cargo runs this script again after a file is added.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    println!(
        "cargo::rerun-if-changed={}",
        folder.canonicalize()?.display()
    );
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}
