//! The interpreter that this program itself belongs to.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Alone, without its user's modules, before its environment is looked at, writing no compiled files, printing at once.
const ALONE: [&str; 4] = ["-I", "-S", "-B", "-u"];

/// What an interpreter is given to run `child`.
pub(crate) fn arguments(child: &Path) -> Vec<OsString> {
    let alone = ALONE.into_iter().map(OsString::from);
    alone.chain([child.as_os_str().to_owned()]).collect()
}

/// An interpreter, and the file that it runs to become the process of a plugin.
static OWN: OnceLock<(PathBuf, PathBuf)> = OnceLock::new();

/// Says that this program runs within `interpreter`, in whose environment the package `taceva` lies at `package`: the processes of plugins
/// are that interpreter again from now on, those of libraries too.
pub fn run_within(interpreter: PathBuf, package: PathBuf) {
    // A process is one interpreter, however often it says so.
    let _ = OWN.set((interpreter, package.join("plugin_child.py")));
}

/// The interpreter that this program runs within, and what it is given to become the process of a plugin.
pub(crate) fn own() -> Option<&'static (PathBuf, PathBuf)> {
    OWN.get()
}

/// The interpreter of the environment that this program lies in, if it lies in one: that it runs within, or that beside its own file.
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
