//! A device on USB as a manifest names it.

use serde::Deserialize;

/// A device on USB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UsbId {
    /// Who makes it.
    pub vendor: u16,
    /// What it is.
    pub product: u16,
}
