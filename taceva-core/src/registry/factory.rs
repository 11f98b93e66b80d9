//! Factories, which open devices.

use super::{Descriptor, DescriptorError, Found, Rig};
use crate::args::Args;
use crate::driver::DriverError;

/// A driver that opens devices of type `D`, such as `dyn Sensor`.
///
/// ```
/// use taceva_core::{
///     Args, Descriptor, DescriptorSpec, DriverError, DriverKey, DriverSource, ErrorKind, Factory, Facts, Lighting, LightingFacts,
///     Registry, Rig,
/// };
///
/// /// A lamp that is not connected.
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
/// let mut facts = LightingFacts::default();
/// facts.scenes = vec!["normal".to_owned()];
/// let key = DriverKey::fixed("room/lamp");
/// let spec = DescriptorSpec::new(key, "a lamp", DriverSource::Real, Facts::Lighting(facts));
/// let mut lamps = Registry::<dyn Lighting>::empty();
/// lamps.add(Box::new(Lamp(spec.check()?)))?;
/// let opened = lamps.get("room/lamp")?.open(&Args::default(), &mut Rig::new());
/// let error = opened.map(|_| ()).unwrap_err();
/// assert_eq!(error.to_string(), "room/lamp: cannot switch it on: not found");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Factory<D: ?Sized>: Send + Sync {
    /// Description of the unopened device, valid for any arguments.
    fn descriptor(&self) -> &Descriptor;

    /// Description of the unopened device with these arguments, which may set facts such as the size of the frames.
    ///
    /// # Errors
    /// [`DescriptorError`] if the arguments contradict each other or the device.
    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let _ = args;
        Ok(self.descriptor().clone())
    }

    /// Opens the device. Nothing moves, and no light changes unless an argument sets it.
    ///
    /// The [`descriptor`](Factory::descriptor) declares `args`. Devices of one `rig` may share resources.
    ///
    /// # Errors
    /// [`DriverError`] of kind `NotFound`, `PermissionDenied`, `Busy`, `InvalidArgument`, `Protocol`, `Timeout` or `Unsupported`.
    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<D>, DriverError>;

    /// Devices that are connected now. The search opens no device. A driver that cannot search returns an empty list.
    ///
    /// # Errors
    /// [`DriverError`] if the search fails.
    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        Ok(Vec::new())
    }

    /// Digest of the driver's library, `sha256:` and 64 hexadecimal digits; `None` if the driver is linked into the program. Caches reuse only
    /// results of the same build.
    ///
    /// # Errors
    /// [`DriverError`] if the library cannot be read.
    fn build(&self) -> Result<Option<String>, DriverError> {
        Ok(None)
    }
}
