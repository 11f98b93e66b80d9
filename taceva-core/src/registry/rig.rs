//! Resources that the devices of one rig share.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use crate::driver::{DriverError, SimulatedBench};

/// Devices that are opened together, with their shared connections, buses and simulated benches.
///
/// ```
/// use std::sync::{Arc, Mutex};
/// use taceva_core::Rig;
/// let mut rig = Rig::new();
/// let first = rig.share("bench", || Ok(Mutex::new(0.0)))?;
/// let second: Arc<Mutex<f64>> = rig.share("bench", || Ok(Mutex::new(1.0)))?;
/// assert!(Arc::ptr_eq(&first, &second));
/// # Ok::<(), taceva_core::DriverError>(())
/// ```
#[derive(Default)]
pub struct Rig {
    shared: BTreeMap<String, Arc<dyn Any + Send + Sync>>,
    benches: BTreeMap<String, Arc<dyn SimulatedBench>>,
}

impl Rig {
    /// A rig without devices.
    pub fn new() -> Rig {
        Rig::default()
    }

    /// Returns the shared object called `name`. The first request creates the object with `make`.
    ///
    /// The name must identify the resource completely: `tcp 192.168.1.10:502`.
    ///
    /// # Errors
    /// The error of `make`. The rig then stores nothing.
    /// # Panics
    /// If an object of another type has this name, because two drivers use one name.
    pub fn share<T: Any + Send + Sync>(
        &mut self,
        name: &str,
        make: impl FnOnce() -> Result<T, DriverError>,
    ) -> Result<Arc<T>, DriverError> {
        let shared = match self.shared.get(name) {
            Some(shared) => Arc::clone(shared),
            None => {
                let made: Arc<dyn Any + Send + Sync> = Arc::new(make()?);
                self.shared.insert(name.to_owned(), Arc::clone(&made));
                made
            }
        };
        match shared.downcast() {
            Ok(shared) => Ok(shared),
            Err(_) => panic!("two drivers share different types under the name `{name}`"),
        }
    }

    /// Registers a simulated bench. A bench with the same name is replaced.
    ///
    /// The name joins two texts with a space: the driver's key before its last `/`, and its argument `rig`. For example, `sim/robot` with
    /// `rig=bench` gives `sim bench`.
    pub fn offer_bench(&mut self, name: &str, bench: Arc<dyn SimulatedBench>) {
        self.benches.insert(name.to_owned(), bench);
    }

    /// Simulated bench called `name`; `None` if no opened device registered it.
    pub fn bench(&self, name: &str) -> Option<Arc<dyn SimulatedBench>> {
        self.benches.get(name).map(Arc::clone)
    }
}

impl fmt::Debug for Rig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.shared.keys()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use crate::id::DriverKey;

    #[test]
    fn what_could_not_be_made_is_made_by_the_next_who_asks() {
        let mut rig = Rig::new();
        let absent = || {
            let arm = DriverKey::fixed("test/arm");
            Err::<u8, _>(DriverError::new(ErrorKind::NotFound, &arm, "connect"))
        };
        assert!(rig.share("link", absent).is_err());
        assert_eq!(*rig.share("link", || Ok(5_u8)).expect("made"), 5);
        assert_eq!(*rig.share("link", || Ok(6_u8)).expect("kept"), 5);
    }
}
