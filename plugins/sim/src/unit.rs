//! One sensor unit: its differences from other units, and the differences between its places.
//!
//! A unit depends on the name of the sensor and the number of the unit, not on the seed of a run. Every run therefore uses the same gel. Unit 0 has
//! the nominal modulus and sag.

use std::f64::consts::TAU;

use taceva_core::random::fnv_1a;

use crate::parameters::{Body, Parameters, Surface};
use crate::random::{Purpose, Random, Stream};

/// One unit of a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    number: u32,
    modulus_ratio: f64,
    stiffness: Waves,
    stiffness_sd: f64,
    relief: Option<Relief>,
    surface: Surface,
    /// Shift of the gel in its housing.
    shift_mm: [f64; 2],
}

/// Surface of a flat gel, without load.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Relief {
    sag_ratio: f64,
    gap: Waves,
    gap_mm: f64,
    blisters: [Blister; BLISTERS],
}

/// Blister: a place where the gel has detached from its plate.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Blister {
    centre_mm: [f64; 2],
    radius_mm: f64,
    height_mm: f64,
}

/// Number of blisters. The second may have height 0.
const BLISTERS: usize = 2;
/// Distances along x and y at which parameters state the sag, mm.
const SAG_STATED_MM: [f64; 2] = [7.0, 9.0];
/// Bound of the rounding error of sums of a few lengths.
const ROUNDING_MM: f64 = 1e-9;
/// Start of the edge softening, as a fraction of the distance from the axis to the edge of the gel; the next constant is the margin of the gel beyond
/// the picture.
const EDGE_BEGINS: f64 = 0.75;
const EDGE_MARGIN_MM: f64 = 1.5;

impl Unit {
    /// Unit `number` of a sensor.
    pub fn new(parameters: &Parameters, number: u32) -> Unit {
        let name = fnv_1a(parameters.name.as_bytes());
        let random = Random::new(u64::from(number));
        let stiffness = random.stream(Purpose::Stiffness, name);
        let variation = parameters.variation;
        let differs = |index| {
            if number == 0 {
                0.0
            } else {
                stiffness.normal(index)
            }
        };
        let relief = match parameters.body {
            Body::Layer(_) => Some(Relief::new(parameters, random, name, differs(101))),
            Body::Dome(_) => None,
        };
        Unit {
            number,
            modulus_ratio: (1.0 + variation.modulus * differs(100)).max(0.1),
            stiffness: Waves::new(stiffness, 0, STIFFNESS_WAVES),
            stiffness_sd: variation.stiffness,
            relief,
            surface: parameters.surface,
            shift_mm: parameters.shift_mm(),
        }
    }

    /// Number of the unit.
    pub fn number(&self) -> u32 {
        self.number
    }

    /// Stiffness at a place relative to the nominal stiffness, above 0.
    pub fn stiffness(&self, place_mm: [f64; 2]) -> f64 {
        let place_mm = self.on_gel(place_mm);
        let smooth = 1.0 + self.stiffness_sd * self.stiffness.at(place_mm);
        self.modulus_ratio * smooth.max(0.1) * self.edge(place_mm)
    }

    /// Height of the surface at a place above the ideal surface; negative if it sags.
    pub fn height_mm(&self, place_mm: [f64; 2]) -> f64 {
        let place_mm = self.on_gel(place_mm);
        let Some(relief) = &self.relief else {
            return 0.0;
        };
        let [sag_x, sag_y] = [self.surface.sag_x_mm, self.surface.sag_y_mm];
        let x = place_mm[0] / SAG_STATED_MM[0];
        let y = place_mm[1] / SAG_STATED_MM[1];
        let sag = relief.sag_ratio * (sag_x * x * x + sag_y * y * y);
        let blisters: f64 = relief.blisters.iter().map(|one| one.at(place_mm)).sum();
        relief.gap_mm * relief.gap.at(place_mm) + blisters - sag
    }

    /// Upper bound of [`height_mm`](Unit::height_mm) over the whole surface.
    pub fn height_max_mm(&self) -> f64 {
        let Some(relief) = &self.relief else {
            return ROUNDING_MM;
        };
        if self.surface.sag_x_mm.min(self.surface.sag_y_mm) < 0.0 {
            return f64::INFINITY;
        }
        let blisters = relief.blisters.iter().map(|one| one.height_mm.max(0.0));
        relief.gap_mm.abs() * Waves::GREATEST + blisters.sum::<f64>() + ROUNDING_MM
    }

    /// Converts a place of the rig to a place on the gel, which may be shifted in its housing.
    fn on_gel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x - self.shift_mm[0], y - self.shift_mm[1]]
    }

    /// Factor of the stiffness near the edge: 1 inside, lower towards the free edge.
    fn edge(&self, place_mm: [f64; 2]) -> f64 {
        let reach = |length: f64| 0.5 * length + EDGE_MARGIN_MM;
        let x = place_mm[0].abs() / reach(self.surface.width_mm);
        let y = place_mm[1].abs() / reach(self.surface.height_mm);
        let beyond = ((x.max(y) - EDGE_BEGINS) / (1.0 - EDGE_BEGINS)).clamp(0.0, 1.0);
        1.0 - self.surface.edge_softening * beyond * beyond
    }
}

impl Relief {
    fn new(parameters: &Parameters, random: Random, name: u64, differs: f64) -> Relief {
        let stream = random.stream(Purpose::Surface, name);
        let [half_x, half_y] = [
            0.5 * parameters.surface.width_mm,
            0.5 * parameters.surface.height_mm,
        ];
        let second = stream.uniform(200) < 0.5;
        let blisters = std::array::from_fn(|number| {
            let draw = |index: u64| stream.uniform(210 + 10 * number as u64 + index);
            let exists = number == 0 || second;
            Blister {
                centre_mm: [
                    (2.0 * draw(0) - 1.0) * half_x,
                    (2.0 * draw(1) - 1.0) * half_y,
                ],
                radius_mm: 0.8 + 0.8 * draw(2),
                height_mm: if exists {
                    parameters.variation.blister_mm * (0.4 + 0.6 * draw(3))
                } else {
                    0.0
                },
            }
        });
        Relief {
            sag_ratio: (1.0 + parameters.variation.sag * differs).max(0.0),
            gap: Waves::new(stream, 0, GAP_WAVES),
            gap_mm: parameters.variation.gap_mm,
            blisters,
        }
    }
}

impl Blister {
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let [dx, dy] = [x - self.centre_mm[0], y - self.centre_mm[1]];
        let squared = (dx * dx + dy * dy) / (self.radius_mm * self.radius_mm);
        self.height_mm * libm::exp(-0.5 * squared)
    }
}

/// A smooth random field of mean 0 and variance 1: plane waves of random direction, length and phase.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Waves {
    waves: [[f64; 3]; WAVES],
}

const WAVES: usize = 8;
/// Maximum wave number of the stiffness along each axis, radians per millimetre; the next constant is that of the gap.
const STIFFNESS_WAVES: f64 = 0.5;
const GAP_WAVES: f64 = 1.0;

impl Waves {
    /// Upper bound of the field, at which the cosine of each of the [`WAVES`] waves is 1.
    const GREATEST: f64 = 0.5 * WAVES as f64;

    fn new(stream: Stream, first: u64, wave_number_max: f64) -> Waves {
        let waves = std::array::from_fn(|wave| {
            let index = first + 3 * wave as u64;
            [
                stream.between(index, -wave_number_max, wave_number_max),
                stream.between(index + 1, -wave_number_max, wave_number_max),
                TAU * stream.uniform(index + 2),
            ]
        });
        Waves { waves }
    }

    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let cosines = self
            .waves
            .iter()
            .map(|[along_x, along_y, phase]| libm::cos(along_x * x + along_y * y + phase));
        // The sum of eight cosines has variance 4.
        0.5 * cosines.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Model;

    #[test]
    fn the_field_of_stiffness_has_the_declared_spread_over_many_units() {
        let parameters = Model::GelSight.parameters();
        let n = 400;
        let squares: f64 = (1..=n)
            .map(|number| {
                Unit::new(&parameters, number)
                    .stiffness
                    .at([1.0, -2.0])
                    .powi(2)
            })
            .sum();
        // The squared sum of eight cosines, averaged over 400 units, is accurate to about 7 %.
        assert!((squares / f64::from(n) - 1.0).abs() < 0.2, "{squares}");
    }

    #[test]
    fn a_unit_is_the_same_gel_whatever_the_run_and_another_number_is_another_gel() {
        let parameters = Model::MagicTac.parameters();
        let place = [2.0, 3.0];
        let heights: Vec<u64> = [0, 0, 1]
            .map(|number| Unit::new(&parameters, number).height_mm(place).to_bits())
            .into();
        assert_eq!(heights[0], heights[1]);
        assert_ne!(heights[0], heights[2]);
    }

    #[test]
    fn no_place_of_any_unit_is_higher_than_its_greatest_height_and_some_come_near_it() {
        let mut nearest: f64 = 0.0;
        for number in 0..40 {
            let unit = Unit::new(&Model::GelSight.parameters(), number);
            let most = unit.height_max_mm();
            for (x, y) in (-30..=30).flat_map(|x| (-40..=40).map(move |y| (x, y))) {
                let height = unit.height_mm([0.25 * f64::from(x), 0.25 * f64::from(y)]);
                assert!(height <= most, "unit {number}: {height} > {most}");
                nearest = nearest.max(height / most);
            }
        }
        assert!(nearest > 0.5, "{nearest}");
    }

    #[test]
    fn the_gel_is_softer_at_its_free_edge_and_nowhere_else() {
        let unit = Unit::new(&Model::GelSight.parameters(), 0);
        assert!((unit.edge([3.0, 4.0]) - 1.0).abs() < 1e-15);
        assert!(unit.edge([8.0, 0.0]) < 0.95);
    }
}
