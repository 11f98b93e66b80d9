//! The code of a plugin as the host deals with it, whether it is a library or a module: its digest, and the child that runs it.

use taceva_core::{DriverError, DriverKey};

use crate::library::Image;
use crate::manifest::Sha256Digest;
use crate::python::{PythonError, digest};
use crate::search::{Code, Plugin};

#[cfg(target_os = "linux")]
use {super::Children, crate::child::ChildSpec, taceva_core::ErrorKind};

const DOING: &str = "load the plugin";

/// The code of a plugin as it was read: a library was copied, a package is only known by its digest.
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
    /// The same, as the failure of a driver of the plugin.
    fn of_driver(self, driver: &DriverKey) -> DriverError {
        DriverError::new(self.kind(), driver, DOING).because(self)
    }
}

impl Plugin {
    /// Its code as it lies there.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if it cannot be read, or is no library.
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

    /// A child that runs its `code`.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if nothing is there to run it.
    #[cfg(target_os = "linux")]
    pub(crate) fn child(
        &self,
        code: &ReadCode,
        driver: &DriverKey,
        children: &Children,
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
                let interpreter = self.interpreter.as_ref().ok_or(PythonError::NoInterpreter);
                let spec = interpreter.and_then(|interpreter| interpreter.spec(self, module));
                spec.map_err(|error| error.of_driver(driver))?
            }
            (ReadCode::Package(_), None) => {
                return Err(PythonError::NoInterpreter.of_driver(driver));
            }
        };
        spec.quarantine = quarantine.map(|quarantine| (quarantine, code.digest()));
        Ok(spec)
    }
}
