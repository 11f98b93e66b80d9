//! Changer of a plugin.

#![expect(
    unsafe_code,
    reason = "a changer is moved through the plugin's functions"
)]

use std::ffi::c_void;
use std::sync::Arc;

use taceva_abi as abi;
use taceva_core::{
    Changer, ChangerFacts, Deadline, DriverError, DriverKind, ErrorKind, Facts, Interrupt,
};

use super::handle::{Opened, Owned, PluginDevice};
use crate::call::{Failure, Taken, take, timeout};

/// Changer of a plugin in this process.
pub(crate) struct PluginChanger {
    handle: Owned,
    bring: Bring,
    holds: Vec<String>,
}

type Bring = unsafe extern "C" fn(
    *mut c_void,
    abi::Text,
    u64,
    abi::TakeText,
    *mut c_void,
    *mut abi::Error,
) -> abi::Status;

const BRINGING: &str = "bring it into place";

impl PluginDevice for PluginChanger {
    const KIND: DriverKind = DriverKind::Changer;
    type Calls = abi::ChangerCalls;
    type Facts = ChangerFacts;

    fn facts(facts: &Facts) -> Option<&ChangerFacts> {
        match facts {
            Facts::Changer(facts) => Some(facts),
            _ => None,
        }
    }

    fn new(
        opened: Opened<abi::ChangerCalls>,
        facts: &ChangerFacts,
    ) -> Result<PluginChanger, DriverError> {
        let Opened { handle, calls } = opened;
        Ok(PluginChanger {
            bring: handle.needs(calls.bring, "bring")?,
            handle,
            holds: facts.holds.clone(),
        })
    }
}

impl Changer for PluginChanger {
    fn holds(&self) -> &[String] {
        &self.holds
    }

    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        let failed = |kind, why| Failure::new(kind, why).of(self.handle.driver(), BRINGING);
        if !self.holds.iter().any(|known| known == name) {
            let why = format!("{name:?}, expected one of `{}`", self.holds.join("`, `"));
            return Err(failed(ErrorKind::InvalidArgument, why));
        }
        let mut taken = Taken::default();
        let context = taken.context();
        self.handle.call(BRINGING, |raw, error| {
            let (name, timeout) = (abi::Text::from(name), timeout(deadline));
            // SAFETY: [owner & open] by `&mut self`, with a text, a context and an error that outlive the call.
            unsafe { (self.bring)(raw, name, timeout, Some(take), context, error) }
        })?;
        let mut there = taken
            .texts()
            .map_err(|failure| failure.of(self.handle.driver(), BRINGING))?;
        match (there.pop(), there.is_empty()) {
            (Some(name), true) if !name.is_empty() => Ok(name),
            _ => {
                let why = "it did not name the item in place, expected one name".to_owned();
                Err(failed(ErrorKind::Abi, why))
            }
        }
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.handle.interrupt()
    }
}
