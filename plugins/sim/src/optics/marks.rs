//! Marks of wear on the surface of a gel: scratches, a tear and dust. They move with the surface.

use std::f64::consts::TAU;

use super::band::Band;
use super::disc::{Disc, DiscSpec};
use super::raster::Raster;
use crate::parameters::GelWear;
use crate::random::{Purpose, Random, Stream};
use taceva_core::whole_size;

/// Fraction of half the field of view in which marks lie.
const INSIDE: f64 = 0.8;
/// Absorbed light at the centre of a mark; below 0 for a bright mark. By kind: scratch, tear, dust.
const DARKNESS: [f64; 3] = [-0.6, 0.8, 0.6];
/// Radius of a scratch, in widths of the field; the next constant is the radius of a speck of dust.
const SCRATCH: f64 = 0.003;
const SPECK: f64 = 0.01;
/// Scale of the edges of marks, in widths of the field.
const EDGE: f64 = 0.002;

/// Marks of one unit. Scratches are rows of small discs.
#[derive(Clone, Debug, Default)]
pub(super) struct Marks {
    /// Places on the untouched gel, mm.
    pub(super) places_mm: Vec<[f64; 2]>,
    /// Index of the disc at each place.
    kinds: Vec<usize>,
    discs: Vec<Disc>,
}

impl Marks {
    /// Marks of `unit` on a field of `field_mm`. A length of 1 mm at the middle is `per_mm` in the unit of `raster`.
    pub(super) fn new(
        wear: Option<&GelWear>,
        field_mm: [f64; 2],
        unit: u32,
        raster: &Raster,
        per_mm: f64,
    ) -> Marks {
        let Some(wear) = wear else {
            return Marks::default();
        };
        let stream = Random::new(u64::from(unit)).stream(Purpose::Wear, 0);
        let width = field_mm[0];
        let radii = [SCRATCH * width, wear.tear_radius_mm, SPECK * width];
        let mut marks = Marks {
            discs: std::iter::zip(radii, DARKNESS)
                .map(|(radius, darkness)| {
                    let spec = DiscSpec {
                        radius: radius * per_mm,
                        darkness,
                        edge: EDGE * width * per_mm,
                    };
                    Disc::new(spec, raster)
                })
                .collect(),
            ..Marks::default()
        };
        let place = |number: u64| {
            [0, 1].map(|axis: usize| {
                let half = 0.5 * INSIDE * field_mm[axis];
                stream.between(8 * number + axis as u64, -half, half)
            })
        };
        for number in 0..whole_size(wear.scratches) as u64 {
            marks.scratch(place(number), number, width, &stream);
        }
        if wear.tear_radius_mm > 0.0 {
            marks.push(place(FIRST_TEAR), 1);
        }
        for number in 0..whole_size(wear.dust) as u64 {
            marks.push(place(FIRST_SPECK + number), 2);
        }
        marks
    }

    /// Darkens or brightens the pixels of `band` at `seen`, the present places in the unit of `raster`.
    #[inline(always)]
    pub(super) fn stamp(&self, seen: &[[f32; 2]], raster: &Raster, band: &mut Band<'_>) {
        for ([x, y], kind) in seen.iter().zip(&self.kinds) {
            self.discs[*kind].stamp(raster, *x, *y, band);
        }
    }

    fn scratch(&mut self, from: [f64; 2], number: u64, width: f64, stream: &Stream) {
        let length = width * stream.between(8 * number + 2, 0.05, 0.25);
        let angle = stream.between(8 * number + 3, 0.0, TAU);
        let step = SCRATCH * width;
        let along = [libm::cos(angle), libm::sin(angle)];
        for disc in 0..=whole_size(length / step) {
            let away = disc as f64 * step;
            self.push([0, 1].map(|axis: usize| from[axis] + away * along[axis]), 0);
        }
    }

    fn push(&mut self, place_mm: [f64; 2], kind: usize) {
        self.places_mm.push(place_mm);
        self.kinds.push(kind);
    }
}

/// First random number for the place of a tear, above the numbers of scratches; the next constant is the first number for dust.
const FIRST_TEAR: u64 = 1_000;
const FIRST_SPECK: u64 = 2_000;
