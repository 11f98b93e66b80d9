//! Radial functions of one layer at one depth, for every contact radius.

use std::sync::{Arc, Mutex, PoisonError};

use super::index::{NODES, Radial, node};
use super::load::Load;
use super::profile::Profile;
use super::quadrature::{Layer, Values};
use super::radial::Quantity;
use crate::number::narrow;

/// Number of rows of a table, one for each contact radius: three per octave, from 0.1 mm to 5 mm.
const ROWS: usize = 18;
const SMALLEST_RADIUS_MM: f64 = 0.1;
/// Step between nodes with a computed integral. A cubic interpolates between them.
const STRIDE: usize = 4;
/// Number of shared tables that are kept, 0.4 MB each: more than twice as many as the gels of this crate need.
const SHARED: usize = 10;

/// Radial functions of a bonded incompressible layer at one depth below its surface.
///
/// Construction evaluates some hundred thousand Bessel functions in a tenth of a second. Construct the tables once per sensor.
#[derive(Clone, Debug)]
pub struct Tables {
    thickness_mm: f64,
    depth_mm: f64,
    radii_mm: [f64; ROWS],
    rows: Vec<[Radial; Quantity::ALL.len()]>,
}

impl Tables {
    /// Computes the tables of a layer `thickness_mm` thick at `depth_mm` below its surface; 0 is the surface itself.
    pub fn new(thickness_mm: f64, depth_mm: f64) -> Tables {
        let radii_mm = std::array::from_fn(|row| {
            let octaves = row as f64 / 3.0;
            SMALLEST_RADIUS_MM * libm::exp2(octaves)
        });
        let rows = radii_mm
            .iter()
            .map(|radius_mm| {
                fill(&Layer {
                    thickness: thickness_mm / radius_mm,
                    depth: depth_mm / radius_mm,
                })
            })
            .collect();
        Tables {
            thickness_mm,
            depth_mm,
            radii_mm,
            rows,
        }
    }

    /// Same as [`new`](Tables::new), but keeps the latest tables for other cameras of this process, whose gels have the same few layers.
    pub(crate) fn shared(thickness_mm: f64, depth_mm: f64) -> Arc<Tables> {
        static KEPT: Mutex<Vec<Arc<Tables>>> = Mutex::new(Vec::new());
        let kept = || KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        let key = |thickness_mm: f64, depth_mm: f64| (thickness_mm.to_bits(), depth_mm.to_bits());
        let wanted = key(thickness_mm, depth_mm);
        let found = |kept: &[Arc<Tables>]| {
            let is_wanted =
                |tables: &&Arc<Tables>| key(tables.thickness_mm, tables.depth_mm) == wanted;
            kept.iter().find(is_wanted).cloned()
        };
        if let Some(tables) = found(&kept()) {
            return tables;
        }
        // Other cameras do not wait for these tables. If two cameras compute the same tables, the first tables are kept.
        let tables = Arc::new(Tables::new(thickness_mm, depth_mm));
        let mut kept = kept();
        if let Some(earlier) = found(&kept) {
            return earlier;
        }
        if kept.len() == SHARED {
            kept.remove(0);
        }
        kept.push(Arc::clone(&tables));
        tables
    }

    /// Depth below the surface, in mm.
    pub fn depth_mm(&self) -> f64 {
        self.depth_mm
    }

    /// Computes the row of `load` into `profile`, without allocation.
    ///
    /// On the surface, the gel follows the ball exactly inside the contact. Outside, the sink is scaled to match at the rim. The factor differs from
    /// 1 by less than 1 % for a ball of 2 mm.
    pub fn profile(&self, load: &Load, profile: &mut Profile) {
        profile.clear();
        if load.normal_force_n <= 0.0 || load.contact_radius_mm <= 0.0 {
            return;
        }
        let radius = load.contact_radius_mm;
        profile.set_radius(radius);
        let (row, fraction) = self.row(radius);
        for quantity in Quantity::ALL {
            let force = if quantity.is_of_shear() {
                load.shear_n()
            } else {
                load.normal_force_n
            };
            let scale =
                force / (load.young_modulus_mpa * radius.powi(i32::from(quantity.radius_power())));
            let [below, above] = [(1.0 - fraction) * scale, fraction * scale].map(narrow);
            let [low, high] = [row, row + 1].map(|row| &self.rows[row][quantity as usize]);
            for ((value, low), high) in profile.table_mut(quantity).iter_mut().zip(low).zip(high) {
                *value = below * low + above * high;
            }
        }
        if self.depth_mm <= 0.0 {
            profile.follow_ball(load);
        }
    }

    /// Index of the row for a radius of at most `radius_mm`, and position between this row and the next, 0 to 1.
    fn row(&self, radius_mm: f64) -> (usize, f64) {
        let above = self.radii_mm.partition_point(|row| *row <= radius_mm);
        let row = above.clamp(1, ROWS - 1) - 1;
        let [low, high] = [self.radii_mm[row], self.radii_mm[row + 1]];
        (row, ((radius_mm - low) / (high - low)).clamp(0.0, 1.0))
    }
}

/// All radial functions of `layer`: the integral at each fourth node, cubics between them, plus the closed form.
fn fill(layer: &Layer) -> [Radial; Quantity::ALL.len()] {
    let radius = |position: usize| (node(position) - 1.0).sqrt();
    let coarse: Vec<(f64, Values)> = (0..NODES)
        .step_by(STRIDE)
        .map(|position| (node(position), layer.integral(radius(position))))
        .collect();
    let mut tables = [[0.0; NODES]; Quantity::ALL.len()];
    // The last node stays zero, because the field ends there.
    for position in 0..NODES - 1 {
        let smooth = interpolate(&coarse, position / STRIDE, node(position));
        let closed = layer.closed_form(radius(position));
        for (quantity, table) in tables.iter_mut().enumerate() {
            table[position] = narrow(smooth[quantity] + closed[quantity]);
        }
    }
    tables
}

/// Lagrange's cubic through the four points around the cell `cell`.
fn interpolate(points: &[(f64, Values)], cell: usize, at: f64) -> Values {
    let first = cell.saturating_sub(1).min(points.len() - 4);
    let four = &points[first..first + 4];
    let mut sum = Values::default();
    for (i, (abscissa, values)) in four.iter().enumerate() {
        let others = four.iter().enumerate().filter(|(j, _)| *j != i);
        let weight: f64 = others
            .map(|(_, (other, _))| (at - other) / (abscissa - other))
            .product();
        for (sum, value) in sum.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_over_layers_of_one_thickness_share_their_tables() {
        // The four compute the tables at the same time, if none is ahead of the others.
        let four = std::thread::scope(|scope| {
            let cameras = [(); 4].map(|()| scope.spawn(|| Tables::shared(4.0, 0.0)));
            cameras.map(|camera| camera.join().expect("tables"))
        });
        assert!(four.iter().all(|other| Arc::ptr_eq(&four[0], other)));
        let deeper = Tables::shared(4.0, 1.0);
        assert_eq!((deeper.thickness_mm, deeper.depth_mm), (4.0, 1.0));
        assert_eq!(four[0].rows, Tables::new(4.0, 0.0).rows);
    }
}
