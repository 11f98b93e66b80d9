//! A lighting of a child.

use taceva_core::{Deadline, DriverError, Lighting};

use super::link::Link;
use crate::child::wire::Call;

pub(super) struct LightingProxy {
    link: Link,
    scenes: Vec<String>,
}

impl LightingProxy {
    pub(super) fn new(link: Link, scenes: Vec<String>) -> LightingProxy {
        LightingProxy { link, scenes }
    }
}

impl Lighting for LightingProxy {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        set_light(&mut self.link, scene, deadline)
    }
}

/// Asks the device, which may be a sensor too, to set a scene.
pub(super) fn set_light(
    link: &mut Link,
    scene: &str,
    deadline: Deadline,
) -> Result<(), DriverError> {
    let scene = scene.to_owned();
    link.done(&Call::Light { scene, deadline }, "set the light", deadline)
}
