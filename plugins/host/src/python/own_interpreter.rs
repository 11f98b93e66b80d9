//! Interpreter in which this program runs.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Options for isolated mode: no user modules, no `site` import, no bytecode files, unbuffered output.
const ALONE: [&str; 4] = ["-I", "-S", "-B", "-u"];

/// Arguments for an interpreter that runs `child`.
pub(crate) fn arguments(child: &Path) -> Vec<OsString> {
    let alone = ALONE.into_iter().map(OsString::from);
    alone.chain([child.as_os_str().to_owned()]).collect()
}

/// The interpreter, and its script for plugin processes.
static OWN: OnceLock<(PathBuf, PathBuf)> = OnceLock::new();

/// Declares that this program runs in `interpreter`, whose package `taceva` is at `package`. Plugin processes, including processes of libraries, use
/// that interpreter from now on.
pub fn run_within(interpreter: PathBuf, package: PathBuf) {
    // A process has one interpreter, so further calls have no effect.
    let _ = OWN.set((interpreter, package.join("plugin_child.py")));
}

/// The interpreter in which this program runs, and its script for plugin processes; `None` outside Python.
pub(crate) fn own() -> Option<&'static (PathBuf, PathBuf)> {
    OWN.get()
}

/// Interpreter in which this program runs, or interpreter next to its executable in a virtual environment; `None` if there is neither.
pub fn beside_this_program() -> Option<PathBuf> {
    if let Some((interpreter, _)) = own() {
        return Some(interpreter.clone());
    }
    let program = std::env::current_exe().ok()?;
    let folder = program.parent()?;
    let is_environment = folder.parent()?.join("pyvenv.cfg").is_file();
    let interpreter = folder.join("python");
    (is_environment && interpreter.exists()).then_some(interpreter)
}
