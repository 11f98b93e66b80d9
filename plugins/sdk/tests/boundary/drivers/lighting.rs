//! A lamp that fails to open because of missing permission.

use taceva_core::{
    ArgSpec, Args, Descriptor, DescriptorError, DriverError, ErrorKind, Factory, Facts, Lighting,
    LightingFacts, Rig,
};

use super::{descriptor, error, way};

pub(super) struct LightingMaker(Descriptor);

impl LightingMaker {
    pub(super) fn new() -> Result<LightingMaker, DescriptorError> {
        let facts = LightingFacts::default().with_scenes(vec!["dark".to_owned()]);
        Ok(LightingMaker(descriptor(
            "lamp",
            Facts::Lighting(facts),
            way(),
        )?))
    }

    /// Driver of a lamp with the required argument `port`.
    pub(super) fn on_a_port() -> Result<LightingMaker, DescriptorError> {
        let facts = LightingFacts::default().with_scenes(vec!["dark".to_owned()]);
        let port = ArgSpec::text("port");
        let descriptor = descriptor("street", Facts::Lighting(facts), vec![port])?;
        Ok(LightingMaker(descriptor))
    }
}

impl Factory<dyn Lighting> for LightingMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn Lighting>, DriverError> {
        Err(error(ErrorKind::PermissionDenied).because("not for you"))
    }
}
