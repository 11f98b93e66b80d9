//! The registry finds linked-in drivers without a manual list.

use taceva_core::{
    Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey,
    DriverSource, ErrorKind, Factory, Facts, ForceFacts, ForceTransducer, Lighting, LightingFacts,
    Registry, Rig, Robot, Sensor, Stamp, Wrench, submit_builtin,
};

struct Idle(Descriptor);

impl Idle {
    fn force() -> Result<Box<dyn Factory<dyn ForceTransducer>>, DescriptorError> {
        let spec = DescriptorSpec::new(
            DriverKey::fixed("test/idle"),
            "a transducer that nothing touches",
            DriverSource::Simulated,
            Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL)),
        );
        Ok(Box::new(Idle(spec.check()?)))
    }

    fn unlit() -> Result<Box<dyn Factory<dyn Lighting>>, DescriptorError> {
        let spec = DescriptorSpec::new(
            DriverKey::fixed("test/unlit"),
            "a lighting device without scenes, expected at least one",
            DriverSource::Simulated,
            Facts::Lighting(LightingFacts::default()),
        );
        Ok(Box::new(Idle(spec.check()?)))
    }
}

submit_builtin!(dyn ForceTransducer, Idle::force);
submit_builtin!(dyn Lighting, Idle::unlit);

impl Factory<dyn ForceTransducer> for Idle {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        Ok(Box::new(Untouched))
    }
}

impl Factory<dyn Lighting> for Idle {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn Lighting>, DriverError> {
        Err(DriverError::new(
            ErrorKind::Unsupported,
            self.0.key(),
            "be lit",
        ))
    }
}

struct Untouched;

impl ForceTransducer for Untouched {
    fn axes(&self) -> Axes {
        Axes::NORMAL
    }
    fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let stamp = Stamp {
            valid_s: 0.0,
            received_s: None,
        };
        Ok((Wrench::default(), stamp))
    }
}

#[test]
fn a_submitted_driver_is_found_by_its_kind_and_opens() {
    let registry = Registry::<dyn ForceTransducer>::builtin().expect("no contradiction");
    assert_eq!(registry.len(), 1);
    let factory = registry.get("test/idle").expect("submitted above");
    let mut device = factory
        .open(&Args::default(), &mut Rig::new())
        .expect("opens");
    let (wrench, _) = device.read(Deadline::PASSED).expect("reads");
    assert_eq!((wrench, device.axes()), (Wrench::default(), Axes::NORMAL));
}

#[test]
fn kinds_without_a_driver_have_an_empty_registry() {
    assert!(Registry::<dyn Sensor>::builtin().expect("none").is_empty());
    assert!(Registry::<dyn Robot>::builtin().expect("none").is_empty());
}

#[test]
fn a_linked_driver_that_contradicts_itself_is_an_error_and_not_silence() {
    let error = Registry::<dyn Lighting>::builtin().expect_err("no scenes");
    assert_eq!(
        error.to_string(),
        "the driver `test/unlit` contradicts itself: a lighting device without scenes, expected at least one"
    );
}
