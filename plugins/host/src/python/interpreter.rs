//! Python interpreter and the contents of its environment.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::error::PythonError;
use super::run::output;

/// Script that queries the interpreter.
const ASK: &str = include_str!("ask.py");
/// First line of the answer. Output before this line is ignored.
const BEGIN: &str = "# taceva environment\n";
/// File of the package `taceva` that runs a plugin's process.
const CHILD: &str = "plugin_child.py";
/// System files that list the processors, for numeric libraries.
const OF_PROCESSORS: [&str; 2] = ["/proc/cpuinfo", "/sys/devices/system/cpu"];

/// Python interpreter whose environment has the package `taceva`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interpreter {
    program: PathBuf,
    version: String,
    package: PathBuf,
    readable: Vec<PathBuf>,
    lying: Vec<Lying>,
}

/// Plugin in an environment, found through its entry point.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Lying {
    pub(crate) id: String,
    pub(crate) module: String,
    pub(crate) folder: Option<PathBuf>,
    pub(crate) fault: Option<String>,
}

#[derive(Deserialize)]
struct Said {
    version: String,
    readable: Vec<PathBuf>,
    package: Option<PathBuf>,
    #[serde(default)]
    plugins: Vec<Lying>,
}

impl Interpreter {
    /// Queries the environment of the interpreter at `program`. Runs the startup code of the environment, but no code of plugins.
    ///
    /// # Errors
    /// [`PythonError`] if the interpreter cannot be started, does not answer, or has no package `taceva`.
    pub fn ask(program: &Path) -> Result<Interpreter, PythonError> {
        let silent = |problem: String| PythonError::Silent {
            program: program.to_owned(),
            problem,
        };
        let printed = output(program, &["-I", "-c", ASK])?;
        let Some((_, said)) = printed.split_once(BEGIN) else {
            return Err(silent(format!(
                "it printed `{}`",
                crate::text::shown(&printed)
            )));
        };
        let said: Said =
            toml::from_str(said).map_err(|error| silent(error.message().to_owned()))?;
        let lacks = |problem| PythonError::NoPackage {
            program: program.to_owned(),
            problem,
        };
        let package = said
            .package
            .ok_or_else(|| lacks("the package `taceva` is not installed in its environment"))?;
        if !package.join(CHILD).is_file() {
            return Err(lacks(
                "its package `taceva` is too old for plugins in Python",
            ));
        }
        let mut readable = said.readable;
        readable.push(package.clone());
        readable.sort();
        readable.dedup();
        Ok(Interpreter {
            program: program.to_owned(),
            version: said.version,
            package,
            readable,
            lying: said.plugins,
        })
    }

    /// Path that starts the interpreter.
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// Python version, such as `3.12.4`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Files that a plugin's process reads: the environment, its base installation, the package `taceva`, and lists of processors.
    pub(crate) fn reads(&self) -> Vec<PathBuf> {
        let processors = OF_PROCESSORS.map(PathBuf::from);
        self.readable.iter().cloned().chain(processors).collect()
    }

    /// Files that the user of a plugin's process must be able to read.
    pub(crate) fn must_read(&self) -> impl Iterator<Item = &Path> {
        self.readable.iter().map(PathBuf::as_path)
    }

    /// Script that the interpreter runs as a plugin's process.
    pub(crate) fn child(&self) -> PathBuf {
        self.package.join(CHILD)
    }

    /// Plugins in the environment.
    pub(crate) fn lying(&self) -> &[Lying] {
        &self.lying
    }
}
