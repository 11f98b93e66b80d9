//! Changer whose driver is a Python object.

use std::sync::Arc;

use pyo3::prelude::*;
use taceva_core::{Changer, Deadline, Descriptor, DriverError, ErrorKind, Facts, Interrupt};

use super::objects::Object;
use crate::errors::value_error;

const BRING: &str = "bring it into place";

/// Changer that calls `bring(name, deadline)` of a Python object.
pub(super) struct PythonChanger {
    object: Object,
    holds: Vec<String>,
}

impl PythonChanger {
    pub(super) fn new(
        object: Object,
        descriptor: &Descriptor,
    ) -> Result<PythonChanger, DriverError> {
        let holds = match descriptor.facts() {
            Facts::Changer(facts) => facts.holds.clone(),
            _ => Vec::new(),
        };
        Ok(PythonChanger { object, holds })
    }
}

impl Changer for PythonChanger {
    fn holds(&self) -> &[String] {
        &self.holds
    }

    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        if !self.holds.iter().any(|held| held == name) {
            let why = format!("{name:?}, expected one of {:?}", self.holds);
            let refused = DriverError::new(ErrorKind::InvalidArgument, self.object.key(), BRING);
            return Err(refused.because(why));
        }
        self.object.call(BRING, deadline, |object, deadline| {
            let said = object.call_method1("bring", (name, deadline))?;
            if said.is_none() {
                return Ok(name.to_owned());
            }
            let class = said.get_type().name()?;
            said.extract().map_err(|_| {
                value_error(format_args!(
                    "bring returned a {class}, expected the name of the specimen or unit in place, or None if the changer cannot tell"
                ))
            })
        })
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.object.interrupt_handle()
    }
}
