//! Bench: one sensor unit in a rig, for any number of presses.

mod error;
mod press;

pub use error::PressError;
pub use press::Press;

use std::sync::Arc;

use crate::contact::{Conditioning, Contact, History, Indentation, Solid};
use crate::parameters::{Outline, Parameters};
use crate::provenance::Provenance;
use crate::random::{Purpose, Random};
use crate::rig::{Label, Touch, TransducerModel, search};
use crate::specimen::GratingPose;
use crate::unit::Unit;

/// Sensor unit in a rig, with seeded noise. Results depend only on the arguments, not on order, threads or interruptions.
///
/// ```
/// use taceva_sim::{Bench, Model, Press};
/// let bench = Bench::new(Model::GelSight.parameters(), 0, 1);
/// let press = Press { id: 1, depth_mm: 0.5, ..Press::default() };
/// let contact = bench.press(&press)?;
/// let label = bench.label(&press, &contact);
/// // First touch is detected late: the ball is deeper than the rig reports.
/// assert!(contact.depth_mm > label.position_mm[2]);
/// assert_eq!(bench.provenance().to_string().split(',').next(), Some("source = simulated"));
/// # Ok::<(), taceva_sim::PressError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Bench {
    parameters: Arc<Parameters>,
    unit: Unit,
    seed: u64,
    random: Random,
    solid: Solid,
    conditioning: Conditioning,
    transducer: TransducerModel,
    outline: Outline,
}

impl Bench {
    /// Creates unit number `unit` of a sensor, with noise from `seed`.
    pub fn new(parameters: Parameters, unit: u32, seed: u64) -> Bench {
        let random = Random::new(seed);
        Bench {
            unit: Unit::new(&parameters, unit),
            seed,
            random,
            solid: Solid::new(&parameters),
            conditioning: Conditioning::new(&parameters.material),
            transducer: TransducerModel::new(parameters.transducer, random),
            outline: parameters.outline(),
            parameters: Arc::new(parameters),
        }
    }

    /// Parameters of sensor and rig.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The unit of the sensor.
    pub fn unit(&self) -> &Unit {
        &self.unit
    }

    /// Body of the sensor, for callers that move a ball stepwise.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Random numbers of this run.
    pub fn random(&self) -> Random {
        self.random
    }

    /// Provenance of every product of this bench.
    pub fn provenance(&self) -> Provenance {
        Provenance {
            sensor: self.parameters.name.clone(),
            unit: self.unit.number(),
            seed: self.seed,
            parameters: *self.parameters.digest(),
        }
    }

    /// First contact at the point of `press`, identical for all presses at this point.
    ///
    /// # Errors
    /// [`PressError`] as for [`press`](Bench::press).
    pub fn touch(&self, press: &Press) -> Result<Touch, PressError> {
        press.check(&self.parameters, self.outline)?;
        Ok(self.find(press))
    }

    /// Contact of `press` on a new gel.
    ///
    /// # Errors
    /// [`PressError`] for a number that is not finite, a place outside the probed surface, or a depth out of range.
    pub fn press(&self, press: &Press) -> Result<Contact, PressError> {
        press.check(&self.parameters, self.outline)?;
        Ok(self.indent(press, 1.0))
    }

    /// Contact of `press` on a gel with `history`.
    ///
    /// # Errors
    /// As [`press`](Bench::press).
    pub fn press_after(&self, history: &History, press: &Press) -> Result<Contact, PressError> {
        press.check(&self.parameters, self.outline)?;
        let wear = history.wear(press.point);
        Ok(self.indent(press, self.conditioning.remaining(wear, press.depth_mm)))
    }

    /// Label that the rig records for `press` with `contact`.
    pub fn label(&self, press: &Press, contact: &Contact) -> Label {
        let [point, later] = [
            self.transducer.point_zero_n(press.point),
            self.transducer.press_zero_n(press.id),
        ];
        let zero = std::array::from_fn(|axis| point[axis] + later[axis]);
        let noise = self.random.stream(Purpose::ForceNoise, press.id);
        Label {
            position_mm: [
                press.place_mm[0] + press.shear_mm[0],
                press.place_mm[1] + press.shear_mm[1],
                contact.travel_mm,
            ],
            force_n: self.transducer.read(contact.force_n, zero, noise, 0),
        }
    }

    /// Pose of a board on the gel in a press: turned by up to 23° and shifted by up to 1 mm along each of x and y.
    pub fn grating_pose(&self, press: u64) -> GratingPose {
        let stream = self.random.stream(Purpose::GratingPose, press);
        GratingPose {
            yaw_degree: stream.between(0, -23.0, 23.0),
            offset_mm: [1, 2].map(|index| stream.between(index, -1.0, 1.0)),
        }
    }

    pub(crate) fn conditioning(&self) -> &Conditioning {
        &self.conditioning
    }

    fn find(&self, press: &Press) -> Touch {
        let indentation = Indentation {
            place_mm: press.place_mm,
            depth_mm: 0.0,
            deepest_mm: 0.0,
            shear_mm: [0.0; 2],
            indenter_radius_mm: press.indenter.radius_mm(),
            stiffness: self.unit.stiffness(press.place_mm),
        };
        self.find_at(press.point, &indentation)
    }

    fn find_at(&self, point: u64, indentation: &Indentation) -> Touch {
        let [_, _, zero] = self.transducer.point_zero_n(point);
        let noise = self.random.stream(Purpose::SearchNoise, point);
        search(
            &self.parameters.search,
            self.random.stream(Purpose::SearchPhase, point),
            |step| zero + self.transducer.normal_noise_n(noise, u64::from(step)),
            |depth_mm| {
                self.solid.swift_force_n(&Indentation {
                    depth_mm,
                    ..*indentation
                })
            },
        )
    }

    fn indent(&self, press: &Press, remaining: f64) -> Contact {
        let mut indentation = Indentation {
            place_mm: press.place_mm,
            depth_mm: 0.0,
            deepest_mm: 0.0,
            shear_mm: [0.0; 2],
            indenter_radius_mm: press.indenter.radius_mm(),
            stiffness: self.unit.stiffness(press.place_mm),
        };
        let touch = self.find_at(press.point, &indentation);
        let stream = self.random.stream(Purpose::Positioning, press.id);
        let [x, y, z] =
            [0, 1, 2].map(|axis| self.parameters.robot.positioning_mm * stream.normal(axis));
        let off_mm = touch.late_mm + z;
        indentation.place_mm = [press.place_mm[0] + x, press.place_mm[1] + y];
        indentation.stiffness *= remaining;
        indentation.depth_mm = (press.depth_mm + off_mm).max(0.0);
        indentation.deepest_mm = indentation.depth_mm.max(press.deepest_mm() + off_mm);
        indentation.shear_mm = press.shear_mm;
        let limited = self.limit(&mut indentation);
        let mut contact = self.solid.contact(&indentation);
        contact.limited = limited;
        contact.travel_mm = if limited {
            indentation.depth_mm - off_mm
        } else {
            press.depth_mm
        };
        contact
    }

    /// Reduces the depths of an indentation until the force limit holds. Returns true if the limit stops the press before its depth.
    fn limit(&self, indentation: &mut Indentation) -> bool {
        let limit_n = self.parameters.probing.force_max_n;
        let loading = |depth_mm: f64| Indentation {
            depth_mm,
            deepest_mm: depth_mm,
            ..*indentation
        };
        // Relaxation only lowers a force, so checking the unrelaxed force suffices.
        if self.solid.swift_force_n(&loading(indentation.deepest_mm)) <= limit_n {
            return false;
        }
        let force_n = |depth_mm: f64| self.solid.contact(&loading(depth_mm)).force_n[2];
        if force_n(indentation.deepest_mm) <= limit_n {
            return false;
        }
        let (mut low, mut high) = (0.0, indentation.deepest_mm);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if force_n(middle) <= limit_n {
                low = middle;
            } else {
                high = middle;
            }
        }
        let stopped = indentation.depth_mm > low;
        indentation.deepest_mm = low;
        indentation.depth_mm = indentation.depth_mm.min(low);
        stopped
    }
}

/// Number of bisection steps for a depth; the final interval is far below a nanometre.
const BISECTIONS: u32 = 30;
