//! An interpreter, and what it says of its environment.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::error::PythonError;
use super::run::output;

/// What asks it.
const ASK: &str = include_str!("ask.py");
/// How what it says begins; whatever was printed before is not its.
const BEGIN: &str = "# taceva environment\n";
/// The file of the package that becomes the process of a plugin.
const CHILD: &str = "plugin_child.py";
/// What says of the machine how many processors it has, which libraries of numbers read.
const OF_PROCESSORS: [&str; 2] = ["/proc/cpuinfo", "/sys/devices/system/cpu"];

/// An interpreter of Python in whose environment `taceva` is installed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interpreter {
    program: PathBuf,
    version: String,
    package: PathBuf,
    readable: Vec<PathBuf>,
    lying: Vec<Lying>,
}

/// A plugin that lies in an environment, found by its entry point.
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
    /// The interpreter at `program`, asked what lies in its environment. Nothing of a plugin runs, but what the environment itself runs
    /// when an interpreter starts does.
    ///
    /// # Errors
    /// [`PythonError`] if it cannot be started, says nothing, or `taceva` is not installed in its environment.
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
                "its package `taceva` is older than plugins in Python",
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

    /// Its file, as it is started.
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// The version of Python, such as `3.12.4`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// What a process of it reads: its environment, what that was made from, and the package `taceva`.
    pub(crate) fn reads(&self) -> Vec<PathBuf> {
        let processors = OF_PROCESSORS.map(PathBuf::from);
        self.readable.iter().cloned().chain(processors).collect()
    }

    /// What the user of a process must be able to read.
    pub(crate) fn must_read(&self) -> impl Iterator<Item = &Path> {
        self.readable.iter().map(PathBuf::as_path)
    }

    /// What it is given to become the process of a plugin.
    pub(crate) fn child(&self) -> PathBuf {
        self.package.join(CHILD)
    }

    /// The plugins that lie in its environment.
    pub(crate) fn lying(&self) -> &[Lying] {
        &self.lying
    }
}
