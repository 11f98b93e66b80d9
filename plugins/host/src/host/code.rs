//! Code of a plugin, library or Python module: its digest, and the child that runs it.

use taceva_core::{DriverError, DriverKey};

use crate::library::Image;
use crate::manifest::Sha256Digest;
use crate::python::{PythonError, digest};
use crate::search::{Code, Plugin};

#[cfg(target_os = "linux")]
use {super::Children, crate::child::ChildSpec, taceva_core::ErrorKind};

const DOING: &str = "load the plugin";

/// Code of a plugin: the copied library, or the digest of a Python package.
pub(crate) enum ReadCode {
    Library(Image),
    Package(Sha256Digest),
}

impl ReadCode {
    pub(crate) fn digest(&self) -> Sha256Digest {
        match self {
            ReadCode::Library(image) => image.digest(),
            ReadCode::Package(digest) => *digest,
        }
    }
}

impl PythonError {
    /// Converts the failure into an error of a driver of the plugin.
    fn of_driver(self, driver: &DriverKey) -> DriverError {
        DriverError::new(self.kind(), driver, DOING).because(self)
    }
}

impl Plugin {
    /// Reads the plugin's code.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if the code cannot be read or is not a library.
    pub(crate) fn read(&self, driver: &DriverKey) -> Result<ReadCode, DriverError> {
        match &self.code {
            Code::Library(library) => {
                let image = Image::read(&self.folder, library);
                let image = image.map_err(|error| error.of_driver(driver))?;
                Ok(ReadCode::Library(image))
            }
            Code::Python(_) => {
                let digest = digest(&self.folder).map_err(|error| error.of_driver(driver))?;
                Ok(ReadCode::Package(digest))
            }
        }
    }

    /// Specifies a child that runs `code`. The child is unconfined if `is_trusted`.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if no interpreter can run the code, or the user of a confined child may not read the code.
    #[cfg(target_os = "linux")]
    pub(crate) fn child(
        &self,
        code: &ReadCode,
        driver: &DriverKey,
        children: &Children,
        is_trusted: bool,
    ) -> Result<ChildSpec, DriverError> {
        let Children {
            program,
            quarantine,
        } = children.clone();
        let mut spec = match (code, self.module()) {
            (ReadCode::Library(image), _) => {
                let spec = ChildSpec::of_plugin(image, &self.manifest, &self.text, None);
                let mut spec = spec.map_err(|error| {
                    DriverError::new(ErrorKind::Internal, driver, DOING).because(error)
                })?;
                spec.program = program;
                spec
            }
            (ReadCode::Package(_), Some(module)) => {
                let interpreter = self
                    .interpreter
                    .as_ref()
                    .ok_or_else(|| self.no_interpreter());
                let spec =
                    interpreter.and_then(|interpreter| interpreter.spec(self, module, is_trusted));
                spec.map_err(|error| error.of_driver(driver))?
            }
            (ReadCode::Package(_), None) => {
                return Err(self.no_interpreter().of_driver(driver));
            }
        };
        spec.confinement.is_trusted = is_trusted;
        spec.quarantine = quarantine.map(|quarantine| (quarantine, code.digest()));
        Ok(spec)
    }
}
