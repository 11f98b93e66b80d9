//! Lamps around a simulated sensor.

use taceva_core::{
    Args, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey,
    DriverSource, ErrorKind, Factory, Facts, Lighting, LightingFacts, Rig,
};

use super::error::{failed, rig_argument, rig_name};
use super::rig::SimulatedRig;
use crate::optics::AmbientLight;

const KEY: DriverKey = DriverKey::fixed("sim/lighting");

/// Opens simulated lamps.
#[derive(Debug)]
pub struct LightingFactory {
    descriptor: Descriptor,
}

impl LightingFactory {
    /// Creates the factory of `sim/lighting`.
    ///
    /// # Errors
    /// [`DescriptorError`] if its description contradicts itself.
    pub fn new() -> Result<LightingFactory, DescriptorError> {
        let facts = LightingFacts::default().with_scenes(scenes());
        let spec = DescriptorSpec::new(
            KEY,
            "simulated lamps",
            DriverSource::Simulated,
            Facts::Lighting(facts),
        );
        Ok(LightingFactory {
            descriptor: spec.arguments([rig_argument()]).check()?,
        })
    }
}

impl Factory<dyn Lighting> for LightingFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<dyn Lighting>, DriverError> {
        Ok(Box::new(Lamps::new(
            SimulatedRig::of(rig, rig_name(args)),
            KEY,
        )))
    }
}

taceva_core::submit_builtin!(dyn Lighting, || Ok(Box::new(LightingFactory::new()?)));

/// Lamps of a rig. The lamps do not affect an opaque gel.
pub(super) struct Lamps {
    rig: SimulatedRig,
    driver: DriverKey,
    scenes: Vec<String>,
}

impl Lamps {
    pub(super) fn new(rig: SimulatedRig, driver: DriverKey) -> Lamps {
        Lamps {
            rig,
            driver,
            scenes: scenes(),
        }
    }
}

impl Lighting for Lamps {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
        let light = AmbientLight::from_name(scene).ok_or_else(|| {
            let known = self.scenes.join("`, `");
            let why = format!("{scene:?}: expected one of `{known}`");
            failed(
                ErrorKind::InvalidArgument,
                &self.driver,
                "set the light",
                why,
            )
        })?;
        self.rig.state().light = light;
        Ok(())
    }
}

/// Names of the light scenes. The calibration scene is the first.
pub(super) fn scenes() -> Vec<String> {
    AmbientLight::ALL
        .map(|light| light.name().to_owned())
        .into()
}
