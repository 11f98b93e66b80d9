//! The code of a plugin as the host deals with it, whether it is a library or a module: its digest, and the child that runs it.

use taceva_core::{DriverError, DriverKey, ErrorKind};

#[cfg(target_os = "linux")]
use super::Children;
#[cfg(target_os = "linux")]
use crate::child::ChildSpec;
use crate::library::Image;
use crate::manifest::Sha256Digest;
use crate::python::{PythonError, digest};
use crate::search::{Code, Plugin};

const DOING: &str = "load the plugin";

impl PythonError {
    /// The same, as the failure of a driver of the plugin.
    pub(crate) fn of_driver(self, driver: &DriverKey) -> DriverError {
        DriverError::new(self.kind(), driver, DOING).because(self)
    }
}

impl Plugin {
    /// The digest of its code as it lies there: of its library, or of the files of its package.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if it cannot be read, or is no library.
    pub(crate) fn digest(&self, driver: &DriverKey) -> Result<Sha256Digest, DriverError> {
        match &self.code {
            Code::Library(library) => {
                let image = Image::read(&self.folder, library);
                let image = image.map_err(|error| error.of_driver(driver))?;
                Ok(image.digest())
            }
            Code::Python(_) => digest(&self.folder).map_err(|error| error.of_driver(driver)),
        }
    }

    /// A child that runs its code, and the digest of that. A library is copied first, and the child gets the copy.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if it cannot be read, or nothing is there to run it.
    #[cfg(target_os = "linux")]
    pub(crate) fn child(
        &self,
        driver: &DriverKey,
        children: &Children,
    ) -> Result<(ChildSpec, Sha256Digest), DriverError> {
        let Children {
            program,
            quarantine,
        } = children.clone();
        let failed = |error: std::io::Error| {
            DriverError::new(ErrorKind::Internal, driver, DOING).because(error)
        };
        match &self.code {
            Code::Library(library) => {
                let image = Image::read(&self.folder, library);
                let image = image.map_err(|error| error.of_driver(driver))?;
                let spec = ChildSpec::of_plugin(&image, &self.manifest, &self.text, quarantine);
                let mut spec = spec.map_err(failed)?;
                spec.program = program;
                Ok((spec, image.digest()))
            }
            Code::Python(module) => {
                let digest = digest(&self.folder).map_err(|error| error.of_driver(driver))?;
                let interpreter = self.interpreter.as_ref().ok_or(PythonError::NoInterpreter);
                let spec = interpreter.and_then(|interpreter| interpreter.spec(self, module));
                let mut spec = spec.map_err(|error| error.of_driver(driver))?;
                spec.quarantine = quarantine.map(|quarantine| (quarantine, digest));
                Ok((spec, digest))
            }
        }
    }
}
