//! Drivers that are linked into the program.

use super::{DescriptorError, Factory};

/// A driver that is linked in: how to make its factory.
///
/// With the feature `inventory`, `submit_builtin!` puts it on the list of the program, which `Registry::builtin` reads.
pub struct Builtin<D: ?Sized + 'static> {
    make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>,
}

impl<D: ?Sized + 'static> Builtin<D> {
    /// A driver whose factory `make` makes.
    pub const fn new(make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>) -> Builtin<D> {
        Builtin { make }
    }

    /// Its factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the driver contradicts itself.
    pub fn factory(&self) -> Result<Box<dyn Factory<D>>, DescriptorError> {
        (self.make)()
    }
}
