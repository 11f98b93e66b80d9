//! What is known about a device before anybody connects to it.

use crate::driver::{Axes, DriverKind, Speed};
use crate::footprint::Footprint;
use crate::frame::FrameInfo;
use crate::geometry::Point;
use crate::quantity::{Hertz, Millimetre, Newton};

/// The facts of a device of each kind; an absent one is not known, never assumed.
///
/// ```
/// use taceva_core::{DriverKind, Facts, RobotFacts};
/// assert_eq!(Facts::Robot(RobotFacts::default()).kind(), DriverKind::Robot);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Facts {
    /// Of a sensor.
    Sensor(Box<SensorFacts>),
    /// Of a robot.
    Robot(RobotFacts),
    /// Of a force transducer.
    Force(ForceFacts),
    /// Of a lighting.
    Lighting(LightingFacts),
}

impl Facts {
    /// The kind they are facts of.
    pub fn kind(&self) -> DriverKind {
        match self {
            Facts::Sensor(_) => DriverKind::Sensor,
            Facts::Robot(_) => DriverKind::Robot,
            Facts::Force(_) => DriverKind::Force,
            Facts::Lighting(_) => DriverKind::Lighting,
        }
    }
}

/// What is known about a sensor.
///
/// ```
/// use taceva_core::{Footprint, Millimetre, SensorFacts};
/// let mut facts = SensorFacts::default();
/// facts.footprint = Some(Footprint::disc(17.0, Some(3.5))?);
/// assert_eq!(facts.depth_limit(), Some(Millimetre(3.5)));
/// # Ok::<(), taceva_core::FootprintError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SensorFacts {
    /// Size and format of the frames it gives; `None` where only its arguments or a recording decide.
    pub frame: Option<FrameInfo>,
    /// Frames a second.
    pub rate: Option<Hertz>,
    /// Whether the gel keeps the light of the room from the camera.
    pub opaque: Option<bool>,
    /// Whether markers in the gel show how it shears.
    pub markers: Option<bool>,
    /// The scenes of the light around it that it can set itself; an opaque gel has none.
    pub scenes: Vec<String>,
    /// Where it senses, and how deep it may be pressed.
    pub footprint: Option<Footprint>,
    /// How deep it may be pressed; never deeper than the footprint says.
    pub depth_max: Option<Millimetre>,
    /// How hard it may be pressed.
    pub force_max: Option<Newton>,
    /// Pixels along x and y of its camera, before anything is scaled.
    pub camera: Option<[u32; 2]>,
    /// How thick the gel is.
    pub gel_thickness: Option<Millimetre>,
    /// The area that the camera sees, in mm².
    pub field_of_view_mm2: Option<f64>,
    /// How long after it was true a frame is stamped, in ms; whoever conducts a run takes it off the stamps. 0 where stamps are true.
    pub latency_ms: Option<f64>,
}

impl SensorFacts {
    /// How deep it may be pressed, by the limit or, without one, by the footprint.
    pub fn depth_limit(&self) -> Option<Millimetre> {
        let footprint = self.footprint.and_then(|footprint| footprint.depth_max());
        self.depth_max
            .or(footprint.map(|depth| Millimetre(depth.to_millimetres())))
    }
}

/// What is known about a robot.
///
/// ```
/// use taceva_core::{RobotFacts, Speed};
/// let mut facts = RobotFacts::default();
/// facts.speed_max = Some(Speed::try_new(100.0)?);
/// assert_eq!((facts.workspace, facts.guarded_motion), (None, false));
/// # Ok::<(), taceva_core::SpeedError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RobotFacts {
    /// Where its tip may be.
    pub workspace: Option<Workspace>,
    /// How fast it may move.
    pub speed_max: Option<Speed>,
    /// How well it comes back to a pose: one standard deviation an axis.
    pub repeatability: Option<Millimetre>,
    /// How far a pose that it reports scatters about where it was sent: one standard deviation an axis. Where it is not known, a real robot
    /// is taken to report as well as it comes back, and a simulated one to report where it was sent.
    pub pose_noise: Option<Millimetre>,
    /// How fast it slows down when it is halted, in mm/s².
    pub deceleration_mm_s2: Option<f64>,
    /// How long it moves on after a halt has reached it, in ms.
    pub stop_ms: Option<f64>,
    /// How long after it was true a pose is stamped, in ms; whoever conducts a run takes it off the stamps. 0 where stamps are true.
    pub latency_ms: Option<f64>,
    /// Whether it can stop by itself at a force.
    pub guarded_motion: bool,
}

/// The box in which a tip may be, its faces included, in the sensor's frame.
///
/// ```
/// use taceva_core::{Millimetre, Point, Workspace};
/// let corner = |side: f64| Point { x: Millimetre(side), y: Millimetre(side), z: Millimetre(side) };
/// let workspace = Workspace { least: corner(-10.0), greatest: corner(10.0) };
/// assert!(workspace.contains(&corner(10.0)) && !workspace.contains(&corner(10.5)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Workspace {
    /// The corner of the least coordinates.
    pub least: Point,
    /// The corner of the greatest coordinates.
    pub greatest: Point,
}

impl Workspace {
    /// Whether `point` lies in it.
    pub fn contains(&self, point: &Point) -> bool {
        self.sides(point)
            .iter()
            .all(|(least, value, greatest)| least <= value && value <= greatest)
    }

    fn sides(&self, point: &Point) -> [(f64, f64, f64); 3] {
        [
            (self.least.x.0, point.x.0, self.greatest.x.0),
            (self.least.y.0, point.y.0, self.greatest.y.0),
            (self.least.z.0, point.z.0, self.greatest.z.0),
        ]
    }
}

/// What is known about a force transducer.
///
/// ```
/// use taceva_core::{Axes, ForceFacts, Hertz};
/// let mut facts = ForceFacts::default();
/// (facts.axes, facts.rate) = (Axes::SIX, Some(Hertz(1000.0)));
/// assert_eq!(facts.force_max, None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ForceFacts {
    /// Which components it measures.
    pub axes: Axes,
    /// Readings a second.
    pub rate: Option<Hertz>,
    /// The greatest magnitude of each force it can measure.
    pub force_max: Option<Newton>,
    /// How far readings of a load that rests scatter: one standard deviation a component.
    pub noise: Option<Newton>,
    /// The step between two neighbouring readings of a force. Equal readings betray a signal that froze only where it is below the noise.
    pub resolution: Option<Newton>,
    /// How long after it was true a reading is stamped, in ms; whoever conducts a run takes it off the stamps. 0 where stamps are true.
    pub latency_ms: Option<f64>,
    /// Whether it numbers its readings, see [`ForceTransducer::sequence`](crate::ForceTransducer::sequence).
    pub numbered: bool,
    /// Whether it can call the present load zero.
    pub tare: bool,
}

impl ForceFacts {
    /// Whether two readings of a live transducer are hardly ever equal to the last bit: its step, if one is stated, is below its noise.
    ///
    /// ```
    /// use taceva_core::{ForceFacts, Newton};
    /// let mut scale = ForceFacts::default();
    /// assert!(scale.seldom_repeats());
    /// scale.resolution = Some(Newton(0.01));
    /// assert!(!scale.seldom_repeats());
    /// ```
    pub fn seldom_repeats(&self) -> bool {
        self.resolution
            .is_none_or(|step| self.noise.is_some_and(|noise| step.0 < noise.0))
    }
}

/// What is known about a lighting.
///
/// ```
/// use taceva_core::LightingFacts;
/// let mut facts = LightingFacts::default();
/// facts.scenes = vec!["normal".to_owned(), "dark".to_owned()];
/// assert_eq!(facts.scenes[0], "normal");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightingFacts {
    /// The names of its scenes, the one of the calibration first.
    pub scenes: Vec<String>,
}
