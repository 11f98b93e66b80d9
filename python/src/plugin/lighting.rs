//! A Python lighting device.

use pyo3::prelude::*;
use taceva_core::{Deadline, Descriptor, DriverError, ErrorKind, Facts, Lighting};

use super::objects::Object;

const SET: &str = "set the light";

/// Lighting device that is a Python object with `set(scene, deadline)`.
pub(super) struct PythonLighting {
    object: Object,
    scenes: Vec<String>,
}

impl PythonLighting {
    pub(super) fn new(
        object: Object,
        descriptor: &Descriptor,
    ) -> Result<PythonLighting, DriverError> {
        let scenes = match descriptor.facts() {
            Facts::Lighting(facts) => facts.scenes.clone(),
            _ => Vec::new(),
        };
        Ok(PythonLighting { object, scenes })
    }
}

impl Lighting for PythonLighting {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        if !self.scenes.iter().any(|known| known == scene) {
            let why = format!("{scene:?}, expected one of {:?}", self.scenes);
            let key = self.object.key();
            return Err(DriverError::new(ErrorKind::InvalidArgument, key, SET).because(why));
        }
        self.object.call(SET, deadline, |object, deadline| {
            object.call_method1("set", (scene, deadline)).map(drop)
        })
    }
}
