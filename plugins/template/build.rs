//! Lists the sources of the crates that a plugin in Rust is built from, so that they can be embedded.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The crates, and where they lie from here.
const CRATES: [(&str, &str); 3] = [
    ("taceva-core", "../../taceva-core"),
    ("taceva-abi", "../abi"),
    ("taceva-plugin", "../sdk"),
];

fn main() -> io::Result<()> {
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").ok_or(io::ErrorKind::NotFound)?);
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    let mut list = String::from("&[\n");
    for (name, folder) in CRATES {
        let folder = here.join(folder).canonicalize()?;
        let mut files = vec![folder.join("README.md")];
        walk(&folder.join("src"), &mut files)?;
        files.sort();
        for file in files {
            let below = file.strip_prefix(&folder).map_err(io::Error::other)?;
            let below = below
                .to_str()
                .ok_or(io::ErrorKind::InvalidData)?
                .replace('\\', "/");
            let place = format!("{name}/{below}");
            writeln!(list, "    ({place:?}, include_str!({file:?})),").map_err(io::Error::other)?;
        }
    }
    list.push_str("]\n");
    fs::write(out.join("sources.rs"), list)
}

/// The files below `folder`; cargo runs this again when one is added.
#[expect(clippy::print_stdout, reason = "so a build script speaks to cargo")]
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    println!("cargo::rerun-if-changed={}", folder.display());
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
