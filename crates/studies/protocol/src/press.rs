//! A press: its place, specimen and depths. Its id is computed from its content.

use taceva_core::{Footprint, Nanometre, Phase, Specimen};

use crate::content_id::{ContentId, Hasher};
use crate::scene::WearLoad;

/// A press, which consists of an approach, waypoints in contact, and a retreat.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Press {
    /// Unit of the sensor model.
    pub unit: String,
    /// Light scene; `None` if the light cannot be set.
    pub light: Option<String>,
    /// Specimen that presses the gel.
    pub specimen: Specimen,
    /// Place of the press along x and y of the sensor frame.
    pub place: [Nanometre; 2],
    /// Rotation of the specimen about z, in thousandths of a degree.
    pub turn_millidegrees: i32,
    /// Number of the repetition of this press; `None` unless presses are repeated.
    pub repeat: Option<u32>,
    /// Motion at this place.
    pub motion: Motion,
}

/// Motion at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Frames above the gel without contact.
    Rest {
        /// Number of frames.
        frames: u32,
    },
    /// First contact only, to measure the surface height.
    Touch,
    /// First contact, followed by these waypoints in order.
    Indent(Vec<Waypoint>),
    /// First contact, followed by a load that wears the gel. The load gives no sample.
    Load(LoadCycle),
}

/// One cycle of a load that wears the gel.
///
/// ```
/// use taceva_core::Nanometre;
/// use taceva_protocol::{LoadCycle, WearLoad};
///
/// let cycle = LoadCycle { load: WearLoad::Shear, force: 500_000, travel: Nanometre(250_000) };
/// assert_eq!(cycle.force_n(), 0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoadCycle {
    /// Kind of load.
    pub load: WearLoad,
    /// Normal force at which the descent ends, in µN.
    pub force: u32,
    /// Sideways travel along x.
    pub travel: Nanometre,
}

impl LoadCycle {
    /// Normal force at which the descent ends, in N.
    pub fn force_n(&self) -> f64 {
        f64::from(self.force) / 1e6
    }

    /// Offsets that the loaded tip visits in order, relative to the place of the press.
    pub(crate) fn offsets(&self) -> Vec<[Nanometre; 2]> {
        let to = |x: i64| [Nanometre(x), Nanometre(0)];
        match self.load {
            WearLoad::Compression => Vec::new(),
            WearLoad::Shear => vec![to(self.travel.0), to(-self.travel.0), to(0)],
            WearLoad::Abrasion => vec![to(self.travel.0)],
        }
    }
}

/// Position at which the tip rests for a sample, relative to the place of the press and its depth zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Waypoint {
    /// Depth below the depth zero of the press.
    pub depth: Nanometre,
    /// Offset along x and y from the place of the press.
    pub shear: [Nanometre; 2],
    /// Loading or unloading branch of the press.
    pub phase: Phase,
}

impl Press {
    /// Digest of the press. Equal presses have equal ids.
    pub fn id(&self) -> ContentId {
        let hasher = Hasher::new("taceva.press/1")
            .text(&self.unit)
            .text(self.light.as_deref().unwrap_or_default());
        let hasher = match self.specimen {
            Specimen::Sphere { radius } => hasher.text("sphere").whole(radius.0),
            Specimen::Grating { kind, spacing } => hasher.text(kind.name()).whole(spacing.0),
        };
        let hasher = hasher
            .whole(self.place[0].0)
            .whole(self.place[1].0)
            .whole(i64::from(self.turn_millidegrees))
            .whole(self.repeat.map_or(-1, i64::from));
        match &self.motion {
            Motion::Rest { frames } => hasher.text("rest").whole(i64::from(*frames)),
            Motion::Touch => hasher.text("touch"),
            Motion::Indent(waypoints) => {
                let start = hasher.text("indent").count(waypoints.len());
                waypoints.iter().fold(start, |hasher, waypoint| {
                    hasher
                        .whole(waypoint.depth.0)
                        .whole(waypoint.shear[0].0)
                        .whole(waypoint.shear[1].0)
                        .text(waypoint.phase.name())
                })
            }
            Motion::Load(cycle) => hasher
                .text("load")
                .text(cycle.load.name())
                .whole(i64::from(cycle.force))
                .whole(cycle.travel.0),
        }
        .finish()
    }

    /// Id of the contact point that all samples of the press share: the board of a grating, otherwise the place in mm.
    pub fn point_id(&self) -> String {
        match self.specimen {
            Specimen::Grating { kind, spacing } => format!("{kind} {}", spacing.to_millimetres()),
            Specimen::Sphere { .. } => {
                let [x, y] = self.place.map(Nanometre::to_millimetres);
                format!("{x},{y}")
            }
        }
    }

    /// Mirrors each shear that would leave `footprint` along x, y or both. Removes the shear if every mirrored shear leaves the footprint.
    pub(crate) fn turn_shear_inwards(&mut self, footprint: &Footprint) {
        let [x, y] = self.place;
        let Motion::Indent(waypoints) = &mut self.motion else {
            return;
        };
        for waypoint in waypoints {
            let [along_x, along_y] = waypoint.shear.map(|side| side.0);
            let turned = [
                [along_x, along_y],
                [-along_x, along_y],
                [along_x, -along_y],
                [-along_x, -along_y],
            ];
            let is_inside = |[along_x, along_y]: &[i64; 2]| {
                footprint.contains(Nanometre(x.0 + along_x), Nanometre(y.0 + along_y))
            };
            let inside = turned.into_iter().find(is_inside);
            waypoint.shear = inside.unwrap_or_default().map(Nanometre);
        }
    }

    /// Greatest shear of the press's waypoints, in mm.
    pub fn greatest_shear_mm(&self) -> f64 {
        let shears = self.waypoints().iter().map(|waypoint| waypoint.shear);
        let lengths = shears.map(|[x, y]| x.to_millimetres().hypot(y.to_millimetres()));
        lengths.fold(0.0, f64::max)
    }

    /// Number of samples, unless a limit ends the press early.
    pub fn samples(&self) -> usize {
        match &self.motion {
            Motion::Rest { frames } => usize::try_from(*frames).unwrap_or(usize::MAX),
            Motion::Touch => 1,
            Motion::Indent(waypoints) => waypoints.len(),
            Motion::Load(_) => 0,
        }
    }

    /// Waypoints of the press; empty unless the press indents.
    pub fn waypoints(&self) -> &[Waypoint] {
        match &self.motion {
            Motion::Indent(waypoints) => waypoints,
            Motion::Rest { .. } | Motion::Touch | Motion::Load(_) => &[],
        }
    }

    /// Load cycle of the press; `None` for a measured press.
    pub fn load(&self) -> Option<&LoadCycle> {
        match &self.motion {
            Motion::Load(cycle) => Some(cycle),
            Motion::Rest { .. } | Motion::Touch | Motion::Indent(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press() -> Press {
        Press {
            unit: "1".into(),
            light: None,
            specimen: Specimen::Sphere {
                radius: Nanometre(2_000_000),
            },
            place: [Nanometre(1_500_000), Nanometre(-250_000)],
            turn_millidegrees: 0,
            repeat: None,
            motion: Motion::Indent(vec![Waypoint {
                depth: Nanometre(100_000),
                shear: [Nanometre(0); 2],
                phase: Phase::Load,
            }]),
        }
    }

    #[test]
    fn the_name_of_a_press_is_fixed_for_ever() {
        assert_eq!(press().id().to_string(), "37530e391b5de9f73b17380ea6b3a6c8");
        assert_eq!(press().point_id(), "1.5,-0.25");
    }

    #[test]
    fn a_shear_that_would_leave_the_footprint_turns_inwards_and_others_stay() {
        let disc = Footprint::disc(2.0, None).expect("a disc");
        let sheared = |x_nm: i64, shear: [i64; 2]| {
            let mut press = press();
            press.place = [Nanometre(x_nm), Nanometre(0)];
            if let Motion::Indent(waypoints) = &mut press.motion {
                waypoints[0].shear = shear.map(Nanometre);
            }
            press.turn_shear_inwards(&disc);
            press.waypoints()[0].shear.map(|side| side.0)
        };
        assert_eq!(sheared(0, [750_000, 0]), [750_000, 0]);
        assert_eq!(sheared(1_500_000, [750_000, 0]), [-750_000, 0]);
        // Longer than the disc is wide.
        assert_eq!(sheared(1_500_000, [5_000_000, 0]), [0, 0]);
    }

    fn load(load: WearLoad, force: u32) -> Motion {
        Motion::Load(LoadCycle {
            load,
            force,
            travel: Nanometre(1),
        })
    }

    #[test]
    fn whatever_is_changed_changes_the_name() {
        let changes: [fn(&mut Press); 11] = [
            |press| press.unit = "2".into(),
            |press| press.light = Some("S1".into()),
            |press| {
                press.specimen = Specimen::Sphere {
                    radius: Nanometre(1),
                };
            },
            |press| press.place[1] = Nanometre(0),
            |press| press.turn_millidegrees = 1,
            |press| press.repeat = Some(0),
            |press| press.motion = Motion::Touch,
            |press| press.motion = Motion::Rest { frames: 1 },
            |press| press.motion = load(WearLoad::Shear, 1),
            |press| press.motion = load(WearLoad::Shear, 2),
            |press| press.motion = load(WearLoad::Abrasion, 1),
        ];
        let mut ids: Vec<ContentId> = changes
            .iter()
            .map(|change| {
                let mut changed = press();
                change(&mut changed);
                changed.id()
            })
            .chain([press().id()])
            .collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), changes.len() + 1);
    }
}
