//! One row of a table.

use taceva_core::{GratingKind, Limit, Nanometre, Phase};

use crate::digest::Digest;

/// Where the file of a frame lies within the dataset, and what its bytes must be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameEntry {
    /// Relative to the folder of the dataset, with `/`.
    pub path: String,
    /// Of the bytes of the file.
    pub digest: Digest,
}

/// One row of a [`Table`](super::Table); what is absent is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Its name, once in a table.
    pub sample: String,
    /// The contact location: what repeats share.
    pub point_id: Option<String>,
    /// The sensor unit.
    pub unit_id: Option<String>,
    /// The lighting scene or the like.
    pub scene: Option<String>,
    /// The depth level within the point.
    pub depth_step: Option<u32>,
    /// The number of the repeat.
    pub repeat: Option<u32>,
    /// Load or unload.
    pub phase: Option<Phase>,
    /// The limit of the gel that kept the tip from where it was sent; none in recordings before format 1.2.
    pub limited_by: Option<Limit>,
    /// The part of a declared split it belongs to.
    pub part: Option<String>,
    /// The time in seconds of the recording's clock.
    pub t_s: Option<f64>,
    /// The relief of the grating that is touched.
    pub kind: Option<GratingKind>,
    /// The spacing of that grating.
    pub spacing: Option<Nanometre>,
    /// The mean luma of the full-size frame, in steps of an 8-bit camera.
    pub intensity: Option<f64>,
    /// A value a channel of the table.
    pub truth: Vec<Option<f64>>,
    /// A text an attribute of the table.
    pub attributes: Vec<Option<String>>,
    /// The picture.
    pub frame: Option<FrameEntry>,
}
