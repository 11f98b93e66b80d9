//! Why there is no picture.

use taceva_core::FrameInfo;
use thiserror::Error;

use super::ambient::AmbientLight;

/// Why a camera cannot be made, or cannot take a picture.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OpticsError {
    /// A frame that the sensor cannot give.
    #[error(
        "a frame of {width}×{height}: expected 1×1 up to the sensor's {native_width}×{native_height}"
    )]
    Size {
        /// Pixels a row asked for.
        width: u32,
        /// Rows asked for.
        height: u32,
        /// Pixels a row at full size.
        native_width: u32,
        /// Rows at full size.
        native_height: u32,
    },
    /// A buffer for another frame than the camera gives.
    #[error("a buffer for {found}: this camera gives {expected}")]
    Frame {
        /// What the buffer is for.
        found: FrameInfo,
        /// What the camera gives.
        expected: FrameInfo,
    },
    /// Light from outside on a gel that lets none in.
    #[error("lighting scene {scene}: the gel is opaque, only `normal` reaches the camera")]
    Opaque {
        /// The scene asked for.
        scene: AmbientLight,
    },
    /// A number outside what can be pictured.
    #[error("{quantity} = {value}: expected {expected}")]
    Value {
        /// The quantity, as its field is called.
        quantity: &'static str,
        /// What it was.
        value: f64,
        /// What would be accepted.
        expected: &'static str,
    },
}
