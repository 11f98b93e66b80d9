//! Conversion of poses between the base frame of a robot and the frame of the sensor.

use taceva_core::{Degree, Millimetre, Point, Pose, Rotation};

use super::{Carried, RigRobot, SignedAxes};

/// Place and rotation of the robot base frame relative to the sensor frame.
///
/// A is the rotation from base to sensor by `axes`, and o the `origin_mm`. p is the reported position, and Q the rotation of the tool since
/// registration.
///
/// - If the robot carries the indenter, the tip is at A·(p − o), rotated by A·Q·Aᵀ.
/// - If it carries the sensor, the tip rests at o in the base frame. It is at A·Qᵀ·(o − p), rotated by A·Qᵀ·Aᵀ.
///
/// # Units
/// mm and degrees.
#[derive(Clone, Copy, Debug)]
pub struct Registration {
    carries: Carried,
    origin_mm: [f64; 3],
    axes: SignedAxes,
    /// Rotation of the tool at registration.
    turned: Rotation,
}

type Matrix = [[f64; 3]; 3];

impl Registration {
    /// Creates the registration of `robot`; `turned` is the rotation of its tool in the base frame at registration.
    pub fn new(robot: &RigRobot, turned: Rotation) -> Registration {
        Registration {
            carries: robot.carries,
            origin_mm: robot.origin_mm.value,
            axes: robot.axes.value,
            turned,
        }
    }

    /// Pose of the tip in the sensor frame for the reported pose `base`.
    pub fn to_sensor(&self, base: &Pose) -> Pose {
        let since = product(&matrix(&base.rotation), &transposed(&matrix(&self.turned)));
        let place = coordinates(&base.position);
        let gone = std::array::from_fn(|axis| place[axis] - self.origin_mm[axis]);
        let (place, turn) = match self.carries {
            Carried::Indenter => (gone, since),
            Carried::Sensor => {
                let back = transposed(&since);
                (applied(&back, gone.map(|length: f64| -length)), back)
            }
        };
        pose(
            self.axes.to_sensor(place),
            &self.turn_to_sensor(&turn),
            &Rotation::default(),
        )
    }

    /// Pose in the base frame to which the robot must move for the pose `tip` in the sensor frame.
    pub fn to_base(&self, tip: &Pose) -> Pose {
        let turn = self.turn_to_base(&matrix(&tip.rotation));
        let place = self.axes.to_device(coordinates(&tip.position));
        let (gone, since) = match self.carries {
            Carried::Indenter => (place, turn),
            Carried::Sensor => {
                let since = transposed(&turn);
                (applied(&since, place).map(|length| -length), since)
            }
        };
        let there = std::array::from_fn(|axis| self.origin_mm[axis] + gone[axis]);
        let turned = product(&since, &matrix(&self.turned));
        pose(there, &turned, &self.turned)
    }

    fn turn_to_sensor(&self, base: &Matrix) -> Matrix {
        // A·M·Aᵀ: applies A to the columns of M, then to the rows of the product.
        let rows = transposed(&columns(base).map(|column| self.axes.to_sensor(column)));
        rows.map(|row| self.axes.to_sensor(row))
    }

    fn turn_to_base(&self, sensor: &Matrix) -> Matrix {
        let rows = transposed(&columns(sensor).map(|column| self.axes.to_device(column)));
        rows.map(|row| self.axes.to_device(row))
    }
}

fn coordinates(point: &Point) -> [f64; 3] {
    [point.x.0, point.y.0, point.z.0]
}

/// Pose at `place` with the rotation `turn`. Of all equivalent angles, those nearest to `near` are chosen.
fn pose([x, y, z]: [f64; 3], turn: &Matrix, near: &Rotation) -> Pose {
    let [x, y, z] = [x, y, z].map(Millimetre);
    Pose {
        position: Point { x, y, z },
        rotation: rotation(turn, near),
    }
    .on_grid()
}

/// Rotation matrix Rz·Ry·Rx: rotations about x, then y, then z, each a fixed axis.
fn matrix(rotation: &Rotation) -> Matrix {
    let [x, y, z] = [rotation.x, rotation.y, rotation.z].map(|angle| angle.0.to_radians());
    let ((sx, cx), (sy, cy), (sz, cz)) = (x.sin_cos(), y.sin_cos(), z.sin_cos());
    [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]
}

/// Rotation angles of the matrix `turn`, each nearest to that of `near`. At y = ±90°, x and z share an axis, so x is copied from `near`.
fn rotation(turn: &Matrix, near: &Rotation) -> Rotation {
    let level = turn[0][0].hypot(turn[1][0]);
    let y = (-turn[2][0]).atan2(level).to_degrees();
    let (x, z) = match level > 1e-9 {
        true => (
            turn[2][1].atan2(turn[2][2]).to_degrees(),
            turn[1][0].atan2(turn[0][0]).to_degrees(),
        ),
        false => {
            let about = (-turn[0][1]).atan2(turn[1][1]).to_degrees();
            let side = (-turn[2][0]).signum();
            (near.x.0, about + side * near.x.0)
        }
    };
    let nearest =
        |angle: f64, near: Degree| Degree(angle - 360.0 * ((angle - near.0) / 360.0).round());
    Rotation {
        x: nearest(x, near.x),
        y: nearest(y, near.y),
        z: nearest(z, near.z),
    }
}

fn product(one: &Matrix, other: &Matrix) -> Matrix {
    let columns = columns(other);
    one.map(|row| std::array::from_fn(|column| dot(&row, &columns[column])))
}

fn applied(turn: &Matrix, vector: [f64; 3]) -> [f64; 3] {
    turn.map(|row| dot(&row, &vector))
}

fn dot(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

fn transposed(matrix: &Matrix) -> Matrix {
    std::array::from_fn(|row| std::array::from_fn(|column| matrix[column][row]))
}

fn columns(matrix: &Matrix) -> Matrix {
    transposed(matrix)
}

#[cfg(test)]
mod tests;
