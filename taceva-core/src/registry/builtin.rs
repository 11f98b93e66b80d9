//! Drivers linked into the program.

use super::{DescriptorError, Factory};

/// A linked-in driver: the function that creates its factory.
///
/// With the feature `inventory`, `submit_builtin!` adds the driver to the list of the program, which `Registry::builtin` reads.
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
    /// Driver whose factory `make` creates.
    pub const fn new(make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>) -> Builtin<D> {
        Builtin { make }
    }

    /// Factory of the driver.
    ///
    /// # Errors
    /// [`DescriptorError`] if the description of the driver contradicts itself.
    pub fn factory(&self) -> Result<Box<dyn Factory<D>>, DescriptorError> {
        (self.make)()
    }
}
