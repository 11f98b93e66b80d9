//! Search for plugins in Python environments, through their interpreters.

use std::path::{Path, PathBuf};

use taceva_core::shown;

use super::{MANIFEST, Place, Reason, Searching};
use crate::python::{Interpreter, Lying, PythonError};

/// File that makes a folder a package.
const PACKAGE: &str = "__init__.py";

impl Searching {
    /// Queries the interpreter at `program` and checks the plugins in its environment.
    pub(super) fn environment(&mut self, program: &Path) {
        let interpreter = match self.asked(program) {
            Ok(interpreter) => interpreter,
            Err(error) => {
                // The rejection already names the interpreter.
                let own = format!("{}: ", shown(program));
                let said = error.to_string();
                let why = said.strip_prefix(&own).unwrap_or(&said);
                let reason = Reason::Python(why.to_owned());
                let rejection = reason.of(program, Place::Python);
                self.rejected_interpreters.push(rejection.to_string());
                self.rejections.push(rejection);
                return;
            }
        };
        self.interpreters.push(interpreter.clone());
        for lying in interpreter.lying() {
            self.entry_point(&interpreter, lying);
        }
    }

    fn asked(&mut self, program: &Path) -> Result<Interpreter, PythonError> {
        let start = |source| PythonError::Start {
            program: program.to_owned(),
            source,
        };
        if !program.is_absolute() {
            let relative = "a relative path, expected one that begins with `/`";
            return Err(start(std::io::Error::other(relative)));
        }
        let real = std::fs::canonicalize(program).map_err(start)?;
        if let Some(path) = self.writable.by_all(&real).map_err(start)? {
            return Err(PythonError::WorldWritable {
                program: program.to_owned(),
                path,
            });
        }
        Interpreter::ask(program)
    }

    fn entry_point(&mut self, interpreter: &Interpreter, lying: &Lying) {
        let plain = crate::text::shown;
        let (id, module) = (plain(&lying.id), plain(&lying.module));
        let refused = |why: String| {
            Reason::Python(format!(
                "the entry point `{id}` of the group `taceva.plugins` names `{module}`: {why}"
            ))
        };
        let Some(folder) = &lying.folder else {
            let why = plain(lying.fault.as_deref().unwrap_or("the module is missing"));
            let rejection = refused(why).of(interpreter.program(), Place::Python);
            self.rejections.push(rejection);
            return;
        };
        let manifest = folder.join(MANIFEST);
        if !manifest.exists() {
            let why = format!(
                "it contains no {MANIFEST}; write it with `python -m taceva.plugin manifest {module} --write`, and add it to the package files of the project"
            );
            self.rejections.push(refused(why).of(folder, Place::Python));
            return;
        }
        let found = self.manifest(Place::Python, &manifest, Some(interpreter));
        if let Some(found) = found.filter(|found| *found != lying.id) {
            let why = format!("the id in its manifest is `{found}`");
            self.forget(&found, folder);
            self.rejections
                .push(refused(why).of(&manifest, Place::Python));
        }
    }

    /// Removes the plugin `id` that was found in `folder`.
    fn forget(&mut self, id: &str, folder: &Path) {
        let real = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        for (known, alike) in &mut self.found {
            if known.as_str() == id {
                alike.retain(|plugin| plugin.folder != real);
            }
        }
        self.found.retain(|_, alike| !alike.is_empty());
    }

    /// Checks that `folder` is the package `name`.
    pub(super) fn package(&mut self, folder: &Path, name: &str) -> Result<(), Reason> {
        if folder.file_name().is_none_or(|last| last != name) {
            return Err(Reason::Python(format!(
                "`python = \"{name}\"`: the manifest of a module must be in its package, expected a folder called `{name}`"
            )));
        }
        let init: PathBuf = folder.join(PACKAGE);
        if !init.is_file() {
            return Err(Reason::Python(format!(
                "`python = \"{name}\"`: not a package, expected {PACKAGE} beside the manifest"
            )));
        }
        match self.writable.by_all(&init).map_err(Reason::Unreadable)? {
            Some(path) => Err(Reason::WorldWritable { path }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
