//! A bench with a constant clock.

use std::time::Duration;

use taceva_core::{DriverError, ErrorKind, SimulatedBench, Specimen};

use super::error;

/// Bench whose clock does not advance.
pub(super) struct Table;

impl SimulatedBench for Table {
    fn now(&self) -> Duration {
        Duration::from_nanos(77)
    }
    fn rest(&self, _: Duration) -> Result<(), DriverError> {
        Ok(())
    }
    fn mount(&self, specimen: Specimen) -> Result<(), DriverError> {
        match specimen {
            Specimen::Sphere { .. } => Ok(()),
            grating => Err(error(ErrorKind::InvalidArgument).because(grating.to_string())),
        }
    }
    fn name_press(&self, _: u64) -> Result<(), DriverError> {
        Ok(())
    }
    fn schedule(&self, _: Duration) -> Result<(), DriverError> {
        Ok(())
    }
    fn provenance(&self) -> Option<String> {
        Some("a table".to_owned())
    }
}
