//! Features from the displacements of markers, interpolated to the cells of a grid.

use taceva_core::{Frame, single};

use super::lattice::closest;
use super::local::{Moved, displacement};
use super::spots::distance;
use super::tracker::MarkerTracker;
use crate::features::FeatureError;
use crate::features::cell_features::CellFeatures;
use crate::features::spec::FeatureSpec;

/// Maximum number of markers from which the displacement of a cell is interpolated. They are the nearest markers.
const SPEAKERS: usize = 12;
/// Number of nearest markers over which a cell's share of unseen markers is computed.
const NEAREST: usize = 4;
/// Largest distance from a cell's centre to the nearest marker, in marker spacings. The values of more distant cells are 0.
const REACH: f64 = 1.5;

/// Three values per cell. The first two are the gel's displacement at the cell's centre, to the right and down, in marker spacings. The third is the
/// share of the four nearest markers that are not visible.
///
/// Displacements are interpolated linearly between markers. Cells without a marker nearby contain zeros. Shear displaces markers, and pressure
/// spreads them. Changes of light, and details smaller than the spacing of markers, are not seen.
#[derive(Debug)]
pub(crate) struct MarkerField {
    tracker: MarkerTracker,
    cells: Vec<Cell>,
}

/// Centre of a cell, and the markers from which its displacement is interpolated. The list of markers is empty if the nearest is too far.
#[derive(Debug)]
struct Cell {
    middle_px: [f64; 2],
    speakers: Vec<usize>,
}

impl MarkerField {
    pub(crate) fn new(spec: &FeatureSpec, reference: &Frame) -> Result<MarkerField, FeatureError> {
        let tracker = MarkerTracker::new(reference)?;
        let info = reference.info();
        let places: Vec<[f64; 2]> = tracker
            .markers()
            .iter()
            .map(|marker| marker.place_px)
            .collect();
        let middle = |cell: u32, cells: u32, pixels: u32| {
            f64::from(pixels) / f64::from(cells) * (f64::from(cell) + 0.5) - 0.5
        };
        let reach = REACH * tracker.spacing_px();
        let mut cells = Vec::new();
        for row in 0..spec.height {
            for column in 0..spec.width {
                let middle_px = [
                    middle(column, spec.width, info.width),
                    middle(row, spec.height, info.height),
                ];
                let mut speakers = closest(middle_px, &places, SPEAKERS);
                if distance(middle_px, places[speakers[0]]) > reach {
                    speakers.clear();
                }
                cells.push(Cell {
                    middle_px,
                    speakers,
                });
            }
        }
        Ok(MarkerField { tracker, cells })
    }
}

impl CellFeatures for MarkerField {
    fn depth(&self) -> usize {
        3
    }

    fn write(&self, frame: &Frame, into: &mut [f32]) {
        let tracked = self.tracker.follow(frame);
        let markers = self.tracker.markers();
        let spacing_px = self.tracker.spacing_px();
        for (cell, place) in self.cells.iter().zip(into.chunks_exact_mut(3)) {
            let known = cell.speakers.iter().filter(|own| tracked[**own].is_seen);
            let known: Vec<Moved> = known
                .map(|own| (markers[*own].place_px, tracked[*own].displacement_px))
                .collect();
            let nearest = &cell.speakers[..cell.speakers.len().min(NEAREST)];
            let unseen = nearest.iter().filter(|own| !tracked[**own].is_seen).count();
            let measured = || {
                // All markers are unseen: takes the displacement interpolated from markers further away.
                let own = cell.speakers.first()?;
                Some(tracked[*own].displacement_px)
            };
            let moved = displacement(cell.middle_px, spacing_px, &known).or_else(measured);
            let [right, down] = moved.unwrap_or([0.0; 2]);
            place[0] = single(right / spacing_px);
            place[1] = single(down / spacing_px);
            place[2] = single(unseen as f64 / nearest.len().max(1) as f64);
        }
    }
}
