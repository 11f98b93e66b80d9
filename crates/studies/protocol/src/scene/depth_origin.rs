//! Heights from which the depths of a press count.

use serde::Deserialize;

/// Height from which the depths of a press count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DepthOrigin {
    /// Surface of the gel, fitted to the readings before and in contact.
    #[default]
    Surface,
    /// First reading above the threshold, up to a step of the search below the surface and more on a soft gel.
    Contact,
}
