//! Lighting of a plugin: a separate device, or an ability of a sensor.

#![expect(
    unsafe_code,
    reason = "the light is set through the plugin's functions"
)]

use std::ffi::c_void;
use std::sync::Arc;

use taceva_abi as abi;
use taceva_core::{Deadline, DriverError, DriverKind, ErrorKind, Facts, Lighting, LightingFacts};

use super::handle::{Handle, Opened, Owned, PluginDevice};
use crate::call::{Failure, timeout};

type Set = unsafe extern "C" fn(*mut c_void, abi::Text, u64, *mut abi::Error) -> abi::Status;

/// Lighting function of an open device.
pub(super) struct LightingAbility {
    handle: Arc<Handle>,
    set: Set,
    scenes: Vec<String>,
}

impl LightingAbility {
    /// Creates the ability of the device `handle`. The owner of the device also owns this value and makes no concurrent call.
    pub(super) fn new(handle: Arc<Handle>, set: Set, scenes: Vec<String>) -> LightingAbility {
        LightingAbility {
            handle,
            set,
            scenes,
        }
    }
}

impl Lighting for LightingAbility {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        const DOING: &str = "set the light";
        if !self.scenes.iter().any(|known| known == scene) {
            let known = self.scenes.join("`, `");
            let why = format!("{scene:?}, expected one of `{known}`");
            let refused = Failure::new(ErrorKind::InvalidArgument, why);
            return Err(refused.of(self.handle.driver(), DOING));
        }
        self.handle.call(DOING, |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with a text and an error that outlive the call.
            unsafe { (self.set)(raw, abi::Text::from(scene), timeout(deadline), error) }
        })
    }
}

/// Lighting of a plugin in this process.
pub(crate) struct PluginLighting {
    ability: LightingAbility,
    /// Dropped after the ability, which uses the handle.
    _handle: Owned,
}

impl PluginDevice for PluginLighting {
    const KIND: DriverKind = DriverKind::Lighting;
    type Calls = abi::LightingCalls;
    type Facts = LightingFacts;

    fn facts(facts: &Facts) -> Option<&LightingFacts> {
        match facts {
            Facts::Lighting(facts) => Some(facts),
            _ => None,
        }
    }

    fn new(
        opened: Opened<abi::LightingCalls>,
        facts: &LightingFacts,
    ) -> Result<PluginLighting, DriverError> {
        let Opened { handle, calls } = opened;
        let set = handle.needs(calls.set, "set")?;
        Ok(PluginLighting {
            ability: LightingAbility::new(handle.share(), set, facts.scenes.clone()),
            _handle: handle,
        })
    }
}

impl Lighting for PluginLighting {
    fn scenes(&self) -> &[String] {
        self.ability.scenes()
    }

    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        self.ability.set(scene, deadline)
    }
}
