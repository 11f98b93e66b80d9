//! Heights from which the depths of a press count.

use serde::Deserialize;

/// Height from which the depths of a press count.
///
/// ```
/// use taceva_protocol::DepthOrigin;
/// assert_eq!(DepthOrigin::default(), DepthOrigin::Contact);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum DepthOrigin {
    /// First reading above the threshold, up to a step of the search below the surface and more on a soft gel.
    #[default]
    Contact,
    /// Surface of the gel, fitted to the readings before and in contact.
    Surface,
}
