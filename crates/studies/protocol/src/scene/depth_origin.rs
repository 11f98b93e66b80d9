//! Heights relative to which the depths of a press are measured.

use serde::Deserialize;

/// Height relative to which the depths of a press are measured.
///
/// ```
/// use taceva_protocol::DepthOrigin;
/// assert_eq!(DepthOrigin::default(), DepthOrigin::Contact);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum DepthOrigin {
    /// First reading at which the force exceeds the contact threshold. It is up to one search step below the surface, and more on a soft gel.
    #[default]
    Contact,
    /// Surface of the gel, fitted to the readings before and during contact.
    Surface,
}
