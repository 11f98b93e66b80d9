//! Drivers linked into the program.

use super::{DescriptorError, Factory};

/// A driver linked into the program, stored as the function that creates its factory.
///
/// With the feature `inventory`, the macro `submit_builtin!` registers the driver, and `Registry::builtin` returns all registered drivers.
///
/// ```
/// use taceva_core::{
///     Args, Builtin, Descriptor, DescriptorSpec, DriverError, DriverKey, DriverSource, ErrorKind, Factory, Facts, Lighting,
///     LightingFacts, Rig,
/// };
///
/// struct Lamp(Descriptor);
///
/// impl Factory<dyn Lighting> for Lamp {
///     fn descriptor(&self) -> &Descriptor {
///         &self.0
///     }
///     fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn Lighting>, DriverError> {
///         Err(DriverError::new(ErrorKind::NotFound, self.0.key(), "switch it on"))
///     }
/// }
///
/// let lamp: Builtin<dyn Lighting> = Builtin::new(|| {
///     let mut facts = LightingFacts::default();
///     facts.scenes = vec!["normal".to_owned()];
///     let facts = Facts::Lighting(facts);
///     let spec = DescriptorSpec::new(DriverKey::fixed("room/lamp"), "a lamp", DriverSource::Real, facts);
///     Ok(Box::new(Lamp(spec.check()?)))
/// });
/// assert_eq!(lamp.factory()?.descriptor().title(), "a lamp");
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
pub struct Builtin<D: ?Sized + 'static> {
    make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>,
}

impl<D: ?Sized + 'static> Builtin<D> {
    /// Driver whose factory is created by `make`.
    pub const fn new(make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>) -> Builtin<D> {
        Builtin { make }
    }

    /// Creates the factory of the driver.
    ///
    /// # Errors
    /// [`DescriptorError`] if entries in the description of the driver contradict each other.
    pub fn factory(&self) -> Result<Box<dyn Factory<D>>, DescriptorError> {
        (self.make)()
    }
}
