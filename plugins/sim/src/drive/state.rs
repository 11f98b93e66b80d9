//! State of a simulated rig: a moving tip, a gel with history, and a clock.

mod course;
mod travel;

use self::course::Course;
pub(super) use self::travel::{Ended, Motion};

use std::time::Duration;

use taceva_core::{Millimetre, Pose};

use super::place::{Visits, nanometres, point_of};
use super::specimen::Mounted;
use super::ticks::Ticks;
use super::touch::Touch;
use super::visit::{SurfaceBelow, Visit, VisitErrors};
use crate::bench::Bench;
use crate::contact::{BoardStand, Contact, History};
use crate::optics::AmbientLight;
use crate::parameters::{Model, Robot, Transducer};
use crate::random::{Purpose, Random};
use crate::rig::TransducerModel;

/// State of the devices of one rig.
#[derive(Debug)]
pub(super) struct State {
    now: Ticks,
    pub(super) bench: Option<Bench>,
    pub(super) sensor_is_open: bool,
    pub(super) mounted: Mounted,
    pub(super) light: AmbientLight,
    /// Pose that the robot reports.
    sent: Pose,
    /// True position of the lowest point of the tip, mm, z into the gel.
    tip_mm: [f64; 3],
    /// Current motion; `None` while the tip rests.
    course: Option<Course>,
    robot: Robot,
    transducer: Transducer,
    errors: TransducerModel,
    random: Random,
    tare_n: [f64; 3],
    visits: Visits,
    visit: Visit,
    /// Name that replaces the number of the next visits in their random numbers; `None` if visits are counted.
    name: Option<u64>,
    /// Earliest start of the next visit.
    appointment: Ticks,
    history: History,
}

/// Initial position of the tip, above every gel.
pub(super) const HOME_MM: [f64; 3] = [0.0, 0.0, -20.0];
impl State {
    pub(super) fn new() -> State {
        let parameters = Model::GelSight.parameters();
        let random = Random::new(0);
        let mut visits = Visits::default();
        let key = visits.next([HOME_MM[0], HOME_MM[1]]);
        let mut state = State {
            now: Ticks::default(),
            history: History::new(),
            name: None,
            appointment: Ticks::default(),
            bench: None,
            sensor_is_open: false,
            mounted: Mounted::default(),
            light: AmbientLight::Normal,
            sent: pose(HOME_MM),
            tip_mm: HOME_MM,
            course: None,
            robot: parameters.robot,
            transducer: parameters.transducer,
            errors: TransducerModel::new(parameters.transducer, random),
            random,
            tare_n: [0.0; 3],
            visits,
            visit: Visit {
                key,
                ..Visit::default()
            },
        };
        state.visit.errors = state.visit_errors();
        state
    }

    /// Installs a sensor under the tip and removes the previous sensor.
    pub(super) fn install(&mut self, bench: Bench) {
        self.lay(bench);
        self.sensor_is_open = true;
    }

    /// Installs a gel under the tip and removes the previous gel.
    pub(super) fn lay(&mut self, bench: Bench) {
        self.robot = bench.parameters().robot;
        self.transducer = bench.parameters().transducer;
        self.random = bench.random();
        self.errors = TransducerModel::new(self.transducer, self.random);
        self.visit.touch = None;
        self.visit.surface = None;
        self.visit.errors = self.visit_errors();
        self.bench = Some(bench);
    }

    pub(super) fn sent(&self) -> Pose {
        self.sent
    }

    pub(super) fn force_range_n(&self) -> f64 {
        self.transducer.range_n
    }

    /// Key of the visit and number of its next picture.
    pub(super) fn next_picture(&mut self) -> (u64, u32) {
        let number = self.visit.pictures;
        self.visit.pictures = number.wrapping_add(1);
        (self.visit.key.visit, number)
    }

    /// Current time.
    pub(super) fn now(&self) -> Duration {
        self.now.duration()
    }

    /// Advances the clock by `rest` while the tip rests.
    pub(super) fn rest(&mut self, rest: Duration) {
        let rest = Ticks::of(rest);
        self.now = self.now.after(rest);
        self.follow(rest.seconds());
    }

    /// Time to the next frame of a camera that started with the visit.
    pub(super) fn to_next_beat(&self, period: Duration) -> Duration {
        self.now
            .since(self.visit.began)
            .to_next(Ticks::of(period))
            .duration()
    }

    /// Uses `name` instead of a count for coming visits.
    pub(super) fn name_visits(&mut self, name: u64) {
        self.name = Some(name);
    }

    /// Delays the next tare in the air until `at`.
    pub(super) fn schedule(&mut self, at: Duration) {
        self.appointment = Ticks::of(at);
    }

    /// Adds a press made before this rig was set up.
    pub(super) fn remember(&mut self, place_mm: [f64; 2], deepest_mm: f64) {
        self.history.finish(point_of(place_mm), deepest_mm);
    }

    /// Next reading of the transducer, in N, after the tare.
    pub(super) fn read(&mut self) -> [f64; 3] {
        let raw = self.raw_reading();
        std::array::from_fn(|axis| raw[axis] - self.tare_n[axis])
    }

    /// Sets the tare to the mean of `readings` readings. In the air, this begins a new visit if the gel was touched or visits have names.
    pub(super) fn tare(&mut self, readings: u32) {
        let is_over = self.visit.has_touched || self.name.is_some();
        if self.visit.touch.is_none() {
            self.now = self.now.max(self.appointment);
            if is_over {
                self.begin_visit();
            }
        }
        let mut sum = [0.0; 3];
        for _ in 0..readings {
            let reading = self.raw_reading();
            for (sum, reading) in sum.iter_mut().zip(reading) {
                *sum += reading;
            }
        }
        self.tare_n = sum.map(|sum| sum / f64::from(readings));
    }

    /// True contact of a ball; `None` under a board or without a gel.
    pub(super) fn contact(&self) -> Option<Contact> {
        let bench = self.bench.as_ref()?;
        let Mounted::Ball(ball) = self.mounted else {
            return None;
        };
        Some(match &self.visit.touch {
            Some(touch) => touch.contact(bench, ball.radius_mm(), self.tip_mm),
            None => Contact {
                position_mm: [self.tip_mm[0], self.tip_mm[1]],
                indenter_radius_mm: ball.radius_mm(),
                ..Contact::default()
            },
        })
    }

    /// Current state of a board in the gel.
    pub(super) fn board(&self) -> BoardStand {
        match (&self.bench, &self.visit.touch) {
            (Some(bench), Some(touch)) => touch.board(bench, self.tip_mm),
            _ => BoardStand::default(),
        }
    }

    pub(super) fn tip_mm(&self) -> [f64; 3] {
        self.tip_mm
    }

    /// Ends the contact after a change of the specimen.
    pub(super) fn release(&mut self) {
        self.visit.touch = None;
    }

    pub(super) fn is_touching(&self) -> bool {
        self.visit.touch.is_some()
    }

    fn force_n(&self) -> [f64; 3] {
        match self.mounted {
            Mounted::Ball(_) => self.contact().map_or([0.0; 3], |contact| contact.force_n),
            Mounted::Board(_) => [0.0, 0.0, self.board().force_n],
        }
    }

    fn raw_reading(&mut self) -> [f64; 3] {
        let visit = self.visit.key.visit;
        let noise = self.random.stream(Purpose::ForceNoise, visit);
        let zero_n = self.visit.errors.zero_n;
        self.visit.readings += 1;
        self.errors
            .read(self.force_n(), zero_n, noise, self.visit.readings)
    }

    /// Errors of robot and transducer in the current visit.
    fn visit_errors(&self) -> VisitErrors {
        VisitErrors::of(self.visit.key, self.robot, &self.errors, self.random)
    }

    /// Begins a new visit in the air over another place.
    fn arrive(&mut self) {
        let place = coordinates(&self.sent);
        let moved = nanometres([place[0], place[1]]) != self.visit.key.place;
        if moved && self.visit.touch.is_none() {
            self.begin_visit();
        }
    }

    /// Begins a visit in the air. Draws a new position error, so that later results do not depend on the path.
    fn begin_visit(&mut self) {
        let sent = coordinates(&self.sent);
        let mut key = self.visits.next([sent[0], sent[1]]);
        if let Some(name) = self.name {
            key.visit = name;
        }
        self.visit = Visit {
            key,
            began: self.now,
            ..Visit::default()
        };
        self.visit.errors = self.visit_errors();
        let error = self.visit.errors.position_mm;
        self.tip_mm = std::array::from_fn(|axis| sent[axis] + error[axis]);
    }

    /// Updates the contact with the gel, `step_s` seconds after the last step.
    fn follow(&mut self, step_s: f64) {
        let Some(bench) = &self.bench else {
            return;
        };
        let point = self.visit.key.point;
        let mut touch = match self.visit.touch.take() {
            Some(touch) => touch,
            None => {
                let [x, y, z] = self.tip_mm;
                // Above the highest point of the gel, its surface is not computed.
                if z < -bench.unit().height_max_mm() {
                    return;
                }
                let surface = SurfaceBelow::at(bench, self.mounted, [x, y], self.visit.surface);
                self.visit.surface = Some(surface);
                if z <= surface.surface_mm {
                    return;
                }
                Touch::above(bench, [x, y], surface.surface_mm, self.history.wear(point))
            }
        };
        if touch.follow(bench, self.mounted, self.tip_mm, step_s) {
            self.visit.has_touched = true;
            self.visit.touch = Some(touch);
        } else if touch.deepest_mm() > 0.0 {
            self.history.finish(point, touch.deepest_mm());
        }
    }
}

fn pose([x, y, z]: [f64; 3]) -> Pose {
    let mut pose = Pose::default();
    let position = &mut pose.position;
    (position.x, position.y, position.z) = (Millimetre(x), Millimetre(y), Millimetre(z));
    pose
}

fn coordinates(pose: &Pose) -> [f64; 3] {
    let position = &pose.position;
    [position.x.0, position.y.0, position.z.0]
}
