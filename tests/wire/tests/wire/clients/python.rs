//! Python interpreter with the public clients of devices.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use taceva_needs::{Need, skip};

/// Interpreter with the clients, as `.ci/install` installs it.
const INSTALLED: &str = "../../target/clients/bin/python";

/// Path of a Python interpreter that has `module`: the one named by `TACEVA_PYTHON`, installed by `.ci/install`, or on the path. Without any, records
/// a skip.
pub(crate) fn with(module: &str) -> Option<PathBuf> {
    let named = std::env::var_os("TACEVA_PYTHON").map(PathBuf::from);
    let installed = Path::new(env!("CARGO_MANIFEST_DIR")).join(INSTALLED);
    let found = match named {
        Some(named) => named,
        None if installed.exists() => installed,
        None => PathBuf::from("python3"),
    };
    let import = Command::new(&found)
        .args(["-c", &format!("import {module}")])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    if import.is_ok_and(|status| status.success()) {
        return Some(found);
    }
    let reason = format!("{} has no module `{module}`", found.display());
    skip(Need::PublicClients, reason);
    None
}

/// Output lines of `script` that begin with `= `, without this prefix; other lines of the client are ignored.
pub(crate) fn run(python: &Path, script: &str, arguments: &[String]) -> Vec<String> {
    let output = Command::new(python)
        .args(["-c", script])
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("the interpreter that was just tried");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}\n{errors}");
    let ours = said.lines().filter_map(|line| line.strip_prefix("= "));
    ours.map(str::to_owned).collect()
}
