//! Specimens, units and light scenes of a rig, as the opened devices report them.

use taceva_protocol::RigFile;

use crate::error::AcquireError;
use crate::presses::FileOpener;

/// Names of the items in an open changer, or of the scenes of a lighting device. Created by [`check_rig`](super::check_rig).
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[non_exhaustive]
pub struct Stock {
    /// Key in the table `[changers]`: `specimen`, `unit` or `light`.
    pub key: &'static str,
    /// Names of the items or light scenes.
    pub holds: Vec<String>,
}

/// Result of opening a changer or lighting.
pub(super) struct TriedStock {
    pub(super) key: &'static str,
    /// Names of the items; `None` if the rig file names no such device. The error is the failure to open the device.
    pub(super) holds: Result<Option<Vec<String>>, AcquireError>,
}

/// Opens the changers of `rig` and its lighting, one after another. Nothing moves.
pub(super) fn take_stock(rig: &RigFile, opener: &FileOpener<'_>) -> [TriedStock; 3] {
    let changers = &rig.changers;
    let tried = |key, holds| TriedStock { key, holds };
    [
        tried("specimen", opener.held(changers.specimen.as_ref())),
        tried("unit", opener.held(changers.unit.as_ref())),
        tried("light", opener.scenes(changers.light.as_ref())),
    ]
}
