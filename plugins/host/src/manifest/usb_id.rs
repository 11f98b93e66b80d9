//! A device on USB as a manifest names it.

use serde::Deserialize;

/// A device on USB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UsbId {
    /// The number of its vendor, of 16 bits.
    pub vendor: u16,
    /// The number of the product, of 16 bits.
    pub product: u16,
}
