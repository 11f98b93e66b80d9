//! Contact solver for a sensor body.

use super::board;
use super::dome_law::DomeLaw;
use super::indentation::Indentation;
use super::layer_law::LayerLaw;
use super::stand::{Answer, Stand, dot};
use super::{Contact, Friction, Relaxation};
use crate::parameters::{Body, Parameters};

/// Sensor body, as input of the contact solver.
#[derive(Clone, Copy, Debug)]
pub struct Solid {
    law: Law,
    friction: f64,
    relaxation: Relaxation,
    speed_mm_per_s: f64,
}

#[derive(Clone, Copy, Debug)]
enum Law {
    Layer(LayerLaw),
    Dome(DomeLaw),
}

/// State of a flat board in a gel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoardStand {
    /// Depth of the board in the gel, mm.
    pub depth_mm: f64,
    /// Normal force.
    pub force_n: f64,
    /// Effective modulus of the gel.
    pub young_modulus_mpa: f64,
}

impl Solid {
    /// Creates the body of a sensor with these parameters, pressed at the speed of its rig.
    pub fn new(parameters: &Parameters) -> Solid {
        Solid {
            law: match parameters.body {
                Body::Layer(layer) => Law::Layer(LayerLaw::new(layer)),
                Body::Dome(dome) => Law::Dome(DomeLaw::new(dome)),
            },
            friction: parameters.surface.friction,
            relaxation: Relaxation::new(
                parameters.material.relaxing_fraction,
                parameters.material.relaxation_time_s,
            ),
            speed_mm_per_s: parameters.robot.speed_mm_per_s,
        }
    }

    /// Height of the lowest point of a ball at first touch of the undeformed body, relative to the apex.
    pub fn touch_height_mm(&self, place_mm: [f64; 2], indenter_radius_mm: f64) -> f64 {
        match &self.law {
            Law::Layer(_) => 0.0,
            Law::Dome(dome) => dome.touch_height_mm(place_mm, indenter_radius_mm),
        }
    }

    /// Force along the sensor's axis without relaxation, as in a search for first contact.
    pub fn swift_force_n(&self, indentation: &Indentation) -> f64 {
        let stand = self.stand(indentation, indentation.depth_mm, indentation.shear_mm);
        let answer = self.answer(&stand, indentation);
        if answer.force_n <= 0.0 {
            return 0.0;
        }
        let (slide_mm, tangent) = unit(stand.slide);
        let shear_n = self.friction(&answer, 1.0).load(slide_mm);
        (answer.force_n * stand.normal[2] - shear_n * tangent[2]) * indentation.stiffness
    }

    /// Contact after `indentation` at the speed of the rig, without a pause before the reading.
    pub fn contact(&self, indentation: &Indentation) -> Contact {
        let stand = self.stand(indentation, indentation.depth_mm, indentation.shear_mm);
        let answer = self.answer(&stand, indentation);
        let relaxed = self.relaxed(indentation, stand.normal_depth_mm);
        self.settle(indentation, &stand, &answer, relaxed)
    }

    /// Contact after `indentation`, with `relaxed` times the unrelaxed force.
    pub fn contact_at(&self, indentation: &Indentation, relaxed: f64) -> Contact {
        let stand = self.stand(indentation, indentation.depth_mm, indentation.shear_mm);
        let answer = self.answer(&stand, indentation);
        self.settle(indentation, &stand, &answer, relaxed)
    }

    /// Normal force of an unrelaxed gel at `depth_mm` with the shear of `indentation`; the input of the relaxation.
    pub fn elastic_force_n(&self, indentation: &Indentation, depth_mm: f64) -> f64 {
        let stand = self.stand(indentation, depth_mm, indentation.shear_mm);
        self.answer(&stand, indentation).force_n * indentation.stiffness
    }

    /// State of a flat board whose holder is `travel_mm` below first touch at the apex, on an unrelaxed gel of nominal stiffness.
    pub fn board(&self, travel_mm: f64) -> BoardStand {
        if travel_mm <= 0.0 {
            return BoardStand::default();
        }
        let law = |depth_mm: f64| match &self.law {
            Law::Layer(layer) => layer.board(depth_mm),
            Law::Dome(dome) => {
                let answer = dome.answer(depth_mm, FLAT_MM);
                (answer.force_n, answer.young_modulus_mpa)
            }
        };
        let depth_mm = board::depth_under_holder_mm(travel_mm, |depth_mm| law(depth_mm).0);
        let (force_n, young_modulus_mpa) = law(depth_mm);
        BoardStand {
            depth_mm,
            force_n,
            young_modulus_mpa,
        }
    }

    /// Relaxation of this body in its initial state.
    pub fn relaxation(&self) -> Relaxation {
        self.relaxation
    }

    fn stand(&self, indentation: &Indentation, depth_mm: f64, shear_mm: [f64; 2]) -> Stand {
        match &self.law {
            Law::Layer(_) => Stand {
                normal_depth_mm: depth_mm,
                normal: [0.0, 0.0, 1.0],
                slide: [shear_mm[0], shear_mm[1], 0.0],
            },
            Law::Dome(dome) => dome.stand(indentation, depth_mm, shear_mm),
        }
    }

    #[inline]
    fn answer(&self, stand: &Stand, indentation: &Indentation) -> Answer {
        if stand.normal_depth_mm <= 0.0 {
            return Answer::default();
        }
        self.answer_at(stand.normal_depth_mm, indentation.indenter_radius_mm)
    }

    #[inline]
    fn answer_at(&self, normal_depth_mm: f64, indenter_radius_mm: f64) -> Answer {
        match &self.law {
            Law::Layer(layer) => layer.answer(normal_depth_mm, indenter_radius_mm),
            Law::Dome(dome) => dome.answer(normal_depth_mm, indenter_radius_mm),
        }
    }

    /// Ratio of relaxed to unrelaxed force after a ramp along the normal to the greatest depth, and back if unloading.
    fn relaxed(&self, indentation: &Indentation, normal_depth_mm: f64) -> f64 {
        let unrelaxed = |depth: f64| {
            self.answer_at(depth, indentation.indenter_radius_mm)
                .force_n
        };
        if self.relaxation.is_elastic() || normal_depth_mm <= 0.0 {
            return 1.0;
        }
        let step_s = |depth_mm: f64| depth_mm / f64::from(RAMP_STEPS) / self.speed_mm_per_s;
        let unloads = indentation.deepest_mm > indentation.depth_mm;
        let turn_mm = if unloads {
            normal_depth_mm * indentation.deepest_mm / indentation.depth_mm
        } else {
            normal_depth_mm
        };
        let mut memory = self.relaxation;
        let decay = memory.decay(step_s(turn_mm));
        for step in 1..=RAMP_STEPS {
            let depth = turn_mm * f64::from(step) / f64::from(RAMP_STEPS);
            memory.step(unrelaxed(depth), decay);
        }
        if unloads {
            let way = turn_mm - normal_depth_mm;
            let decay = memory.decay(step_s(way));
            for step in 1..=RAMP_STEPS {
                let depth = turn_mm - way * f64::from(step) / f64::from(RAMP_STEPS);
                memory.step(unrelaxed(depth), decay);
            }
        }
        memory.ratio()
    }

    fn friction(&self, answer: &Answer, scale: f64) -> Friction {
        Friction {
            limit_n: self.friction * answer.force_n * scale,
            stiffness_n_per_mm: answer.shear_n_per_mm * scale,
        }
    }

    /// Computes friction, directions and forces of a contact.
    fn settle(
        &self,
        indentation: &Indentation,
        stand: &Stand,
        answer: &Answer,
        relaxed: f64,
    ) -> Contact {
        let [dx, dy] = indentation.shear_mm;
        let mut contact = Contact {
            position_mm: [indentation.place_mm[0] + dx, indentation.place_mm[1] + dy],
            depth_mm: indentation.depth_mm,
            normal_depth_mm: stand.normal_depth_mm.max(0.0),
            normal: stand.normal,
            indenter_radius_mm: indentation.indenter_radius_mm,
            ..Contact::default()
        };
        let scale = indentation.stiffness * relaxed;
        if answer.force_n * scale <= 0.0 {
            return contact;
        }
        let friction = self.friction(answer, scale);
        let (slide_mm, tangent) = unit(stand.slide);
        let shear_n = if indentation.deepest_mm > indentation.depth_mm {
            let turned = self.stand(indentation, indentation.deepest_mm, indentation.shear_mm);
            friction.unload(dot(turned.slide, tangent).max(slide_mm), slide_mm)
        } else {
            friction.load(slide_mm)
        };
        contact.tangent = tangent;
        contact.carried_mm = slide_mm.min(friction.sliding_begins_mm());
        contact.slip_mm = slide_mm - contact.carried_mm;
        contact.radius_mm = answer.radius_mm;
        contact.stick_radius_mm = answer.radius_mm * friction.stick_ratio(shear_n);
        contact.young_modulus_mpa = answer.young_modulus_mpa * scale;
        contact.skin_share = answer.skin_share;
        contact.normal_force_n = answer.force_n * scale;
        contact.shear_force_n = shear_n;
        let along =
            |axis: usize| shear_n * tangent[axis] - contact.normal_force_n * stand.normal[axis];
        contact.force_n = [along(0), along(1), -along(2)];
        contact
    }
}

/// Radius from which a ball counts as flat, mm.
const FLAT_MM: f64 = 1e9;

/// Number of steps of a ramp; the force is linear in each.
const RAMP_STEPS: u32 = 12;

/// Length and direction of a vector.
fn unit(vector: [f64; 3]) -> (f64, [f64; 3]) {
    let length = dot(vector, vector).sqrt();
    if length > 0.0 {
        (length, vector.map(|component| component / length))
    } else {
        (0.0, [0.0; 3])
    }
}
