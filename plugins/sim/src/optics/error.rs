//! Errors of the camera.

use taceva_core::FrameInfo;
use thiserror::Error;

use super::ambient::AmbientLight;

/// Reasons why a camera cannot be created or cannot render a picture.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OpticsError {
    /// The size of the frame is out of range.
    #[error(
        "a frame of {width}×{height}: expected 1×1 up to the sensor's {native_width}×{native_height}"
    )]
    Size {
        /// Requested width, pixels.
        width: u32,
        /// Requested height, pixels.
        height: u32,
        /// Width of the full-size frame, pixels.
        native_width: u32,
        /// Height of the full-size frame, pixels.
        native_height: u32,
    },
    /// The buffer does not match the frames of the camera.
    #[error("the buffer is for {found}, but this camera gives {expected}")]
    Frame {
        /// Frame of the buffer.
        found: FrameInfo,
        /// Frame of the camera.
        expected: FrameInfo,
    },
    /// The gel is opaque to the requested scene of light.
    #[error("lighting scene {scene}: the gel is opaque, only `normal` reaches the camera")]
    Opaque {
        /// Requested scene.
        scene: AmbientLight,
    },
    /// A value is out of range.
    #[error("{quantity} = {value}: expected {expected}")]
    Value {
        /// Name of the quantity's field.
        quantity: &'static str,
        /// Value found.
        value: f64,
        /// Accepted values.
        expected: &'static str,
    },
}
