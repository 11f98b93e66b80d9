//! Poses in Python: six numbers in mm and degrees.

use pyo3::prelude::*;
use taceva_core::{Degree, Millimetre, Point, Pose, Rotation, Stamp};

use super::sensor::stamp;
use crate::errors::value_error;

/// `pose` as `taceva.plugin.Pose`.
pub(super) fn python_pose<'py>(py: Python<'py>, pose: &Pose) -> PyResult<Bound<'py, PyAny>> {
    let Pose {
        position: Point { x, y, z },
        rotation,
    } = pose;
    let numbers = (x.0, y.0, z.0, rotation.x.0, rotation.y.0, rotation.z.0);
    py.import("taceva.plugin")?.getattr("Pose")?.call1(numbers)
}

/// Parses a pose that the Python function `method` returned: three numbers are a position, six a position and an orientation of the tip.
pub(super) fn pose_of(said: &Bound<'_, PyAny>, method: &str) -> PyResult<Pose> {
    let numbers: Vec<f64> = said.extract().unwrap_or_default();
    let (place, turn) = match numbers.as_slice() {
        [place @ .., rx, ry, rz] if place.len() == 3 => (place, [*rx, *ry, *rz]),
        place if place.len() == 3 => (place, [0.0; 3]),
        _ => {
            return Err(value_error(format_args!(
                "{method} returned a pose that is not 3 or 6 numbers, expected taceva.plugin.Pose(x, y, z, rx, ry, rz), in mm and degrees"
            )));
        }
    };
    let [x, y, z] = [0, 1, 2].map(|at| Millimetre(place[at]));
    let [rx, ry, rz] = turn.map(Degree);
    Ok(Pose {
        position: Point { x, y, z },
        rotation: Rotation {
            x: rx,
            y: ry,
            z: rz,
        },
    })
}

/// Parses a pose with its time, which the Python function `method` returned.
pub(super) fn placed(said: &Bound<'_, PyAny>, method: &str) -> PyResult<(Pose, Stamp)> {
    let parts: Result<(Bound<'_, PyAny>, Bound<'_, PyAny>), _> = said.extract();
    let Ok((pose, time)) = parts else {
        let class = said.get_type().name()?;
        return Err(value_error(format_args!(
            "{method} returned a {class}, expected (taceva.plugin.Pose(x, y, z), time)"
        )));
    };
    Ok((pose_of(&pose, method)?, stamp(&time, method)?))
}
