//! Child process of a Python plugin.

use std::path::Path;

use rustix::process::geteuid;

use crate::child::{ChildSpec, ModuleToImport, NOBODY};
use crate::manifest::PythonModule;
use crate::python::{Interpreter, PythonError, arguments, closed_by};
use crate::search::Plugin;

impl Interpreter {
    /// Specifies a child that runs this interpreter with the confinement of `module` of `plugin`. A trusted child runs as the user of the host, so
    /// its access to the files is not checked.
    pub(crate) fn spec(
        &self,
        plugin: &Plugin,
        module: &PythonModule,
        is_trusted: bool,
    ) -> Result<ChildSpec, PythonError> {
        let start = |source| PythonError::Start {
            program: self.program().to_owned(),
            source,
        };
        // The files are checked before the start, because the error of a failed start is less specific.
        std::fs::metadata(self.program()).map_err(start)?;
        std::fs::metadata(self.child()).map_err(|source| PythonError::File {
            path: self.child(),
            source,
        })?;
        if !is_trusted {
            self.refuse_closed(&plugin.folder)?;
        }
        let import = ModuleToImport {
            folder: plugin.folder.clone(),
            name: module.name.clone(),
            preload: module.preload.clone(),
        };
        let spec = ChildSpec::of_module(import, plugin.id().as_str(), &plugin.text);
        let mut spec = spec.map_err(start)?;
        self.confine(&mut spec, module);
        spec.confinement.readable.push(plugin.folder.clone());
        Ok(spec)
    }

    /// Makes `spec` start this interpreter, confined as the plugin `module` needs.
    pub(crate) fn confine(&self, spec: &mut ChildSpec, module: &PythonModule) {
        spec.program = Some(self.program().to_owned());
        spec.arguments = arguments(&self.child());
        spec.confinement.readable = self.reads();
        spec.confinement.memory = module.profile.memory();
        spec.confinement.seals = module.profile.seals();
    }

    /// Fails if the user `nobody` cannot read a required file. A child of root runs as this user.
    pub(crate) fn refuse_closed(&self, package: &Path) -> Result<(), PythonError> {
        if !geteuid().is_root() {
            return Ok(());
        }
        for path in self.must_read().chain([package]) {
            if let Some(closed) = closed_by(path) {
                return Err(PythonError::Closed {
                    path: path.to_owned(),
                    closed,
                    user: NOBODY,
                });
            }
        }
        Ok(())
    }
}
