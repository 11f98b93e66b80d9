//! Table `[program]`: a plugin that is a Python module instead of a library.

use std::fmt;

use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::Refused;
use crate::text::shown;

/// Maximum number of preloaded modules.
const PRELOAD_MAX: usize = 64;

/// Python module of a plugin, and its process settings.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PythonModule {
    /// Name of the package that contains the manifest, as in `import`.
    pub name: String,
    /// Wire version for which the module was written.
    pub wire: u32,
    /// Modules to import before the plugin. Their native code cannot be loaded later, when no code may be mapped.
    pub preload: Vec<String>,
    /// Confinement profile of the process.
    pub profile: Profile,
}

/// Confinement profile of an interpreter's process, in addition to the confinement of every plugin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// Code may be mapped only during import; 4 GiB of address space.
    #[default]
    Interpreter,
    /// Code may be mapped at any time; 64 GiB of address space.
    InterpreterOpen,
}

impl Profile {
    /// Name of the profile in manifests.
    pub const fn name(self) -> &'static str {
        match self {
            Profile::Interpreter => "interpreter",
            Profile::InterpreterOpen => "interpreter-open",
        }
    }

    /// Limit of address space, bytes.
    pub(crate) const fn memory(self) -> u64 {
        match self {
            Profile::Interpreter => 4 << 30,
            Profile::InterpreterOpen => 64 << 30,
        }
    }

    /// True if no code may be mapped after the import.
    pub(crate) const fn seals(self) -> bool {
        matches!(self, Profile::Interpreter)
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Content of the table `[program]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenProgram {
    python: Spanned<String>,
    wire: Spanned<u32>,
    #[serde(default)]
    preload: Vec<Spanned<String>>,
    #[serde(default)]
    profile: Profile,
}

impl WrittenProgram {
    /// Checks the table and converts it.
    pub(super) fn module(&self) -> Result<PythonModule, Refused> {
        let name = self.python.get_ref();
        if !is_word(name) {
            let problem = format!(
                "`python`: {:?}, expected the name of a top-level package without dots, because finding a submodule would import its package",
                shown(name)
            );
            return Err(Refused::at(&self.python, problem));
        }
        if self.preload.len() > PRELOAD_MAX {
            let last = &self.preload[PRELOAD_MAX];
            let problem = format!("`preload`: more than {PRELOAD_MAX} modules");
            return Err(Refused::at(last, problem));
        }
        for module in &self.preload {
            if !module.get_ref().split('.').all(is_word) {
                let problem = format!(
                    "`preload`: {:?}, expected the name of a module such as `cv2` or `scipy.linalg`",
                    shown(module.get_ref())
                );
                return Err(Refused::at(module, problem));
            }
        }
        Ok(PythonModule {
            name: name.clone(),
            wire: *self.wire.get_ref(),
            preload: self
                .preload
                .iter()
                .map(|module| module.get_ref().clone())
                .collect(),
            profile: self.profile,
        })
    }
}

/// True for an ASCII identifier of at most 100 characters.
pub(crate) fn is_word(name: &str) -> bool {
    let mut letters = name.bytes();
    let begins = |first: u8| first.is_ascii_alphabetic() || first == b'_';
    name.len() <= 100
        && letters.next().is_some_and(begins)
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == b'_')
}

#[cfg(test)]
mod tests {
    use super::super::Manifest;
    use super::*;

    const HEAD: &str = "manifest_version = 1\nid = \"org.example.eye\"\nname = \"eye\"\nversion = \"1.0.0\"\nlicense = \"MIT\"\n";
    const FORCE: &str = "[[provides]]\nkind = \"force\"\nkey = \"scale\"\ntitle = \"scale\"\nsource = \"real\"\naxes = [\"Fz\"]\n";

    fn parsed(program: &str) -> Result<Manifest, String> {
        Manifest::parse(&format!("{HEAD}{program}\n{FORCE}")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_module_of_python_is_named_with_its_wire_and_what_it_is_kept_from() {
        let manifest = parsed("[program]\npython = \"lab_eye\"\nwire = 1\n").expect("sound");
        let module = manifest.module().expect("a module");
        assert_eq!((module.name.as_str(), module.wire), ("lab_eye", 1));
        assert_eq!(module.profile, Profile::Interpreter);
        assert!(manifest.platforms().next().is_none());
        let program = "[program]\npython = \"lab_eye\"\nwire = 2\nprofile = \"interpreter-open\"\npreload = [\"torch\", \"scipy.linalg\"]\n";
        let module = parsed(program)
            .expect("sound")
            .module()
            .expect("a module")
            .clone();
        assert_eq!((module.wire, module.profile), (2, Profile::InterpreterOpen));
        assert_eq!(module.preload, ["torch", "scipy.linalg"]);
    }

    #[test]
    fn a_program_that_cannot_be_meant_is_refused_with_its_line_and_what_is_expected() {
        for (program, said) in [
            ("", "a plugin in Python has `program` instead"),
            (
                "[program]\npython = \"lab.eye\"\nwire = 1\n",
                "line 7, column 10: `python`: \"lab.eye\", expected the name of a top-level package",
            ),
            (
                "[program]\npython = \"../eye\"\nwire = 1\n",
                "expected the name of a top-level package",
            ),
            (
                "[program]\npython = \"lab_eye\"\n",
                "the key `wire` is missing",
            ),
            (
                "[program]\npython = \"lab_eye\"\nwire = 1\npreload = [\"a b\"]\n",
                "`preload`: \"a b\", expected the name of a module",
            ),
            (
                "[program]\npython = \"lab_eye\"\nwire = 1\nprofil = \"interpreter\"\n",
                "did you mean `profile`?",
            ),
            (
                "[program]\npython = \"lab_eye\"\nwire = 1\nprofile = \"none\"\n",
                "unknown variant `none`",
            ),
            (
                "library.linux-x86_64 = { path = \"libx.so\" }\nabi = { major = 1, minor = 0 }\n[program]\npython = \"lab_eye\"\nwire = 1\n",
                "a library or a program",
            ),
            (
                "library.linux-x86_64 = { path = \"libx.so\" }\n",
                "the key `abi` is missing",
            ),
        ] {
            let error = parsed(program).expect_err(program);
            assert!(error.contains(said), "{program}: {error}");
        }
    }
}
