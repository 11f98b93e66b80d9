//! Facts about a sensor that samples do not contain.

use taceva_core::{Footprint, Outline, SkipReason};

/// Facts about a sensor that samples do not contain. Undeclared facts are `None`.
///
/// ```
/// use taceva_metrics::{Footprint, SensorFacts};
/// let facts = SensorFacts::default().with_footprint(Footprint::disc(12.5, Some(1.0))?).with_opaque(true);
/// assert_eq!((facts.opaque, facts.frame_size), (Some(true), None));
/// # Ok::<(), taceva_metrics::FootprintError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SensorFacts {
    /// Sensing surface, and its greatest indentation.
    pub footprint: Option<Footprint>,
    /// True if the gel blocks ambient light.
    pub opaque: Option<bool>,
    /// Name of the lighting scene with which other scenes are compared.
    pub reference_scene: String,
    /// Width and height of the sensor's pictures, pixels.
    pub frame_size: Option<[u32; 2]>,
}

impl SensorFacts {
    /// Name of the reference scene by default.
    pub const REFERENCE_SCENE: &'static str = "normal";

    /// The same facts with another [`footprint`](SensorFacts::footprint).
    #[must_use]
    pub fn with_footprint(self, footprint: impl Into<Option<Footprint>>) -> SensorFacts {
        SensorFacts {
            footprint: footprint.into(),
            ..self
        }
    }

    /// The same facts with another [`opaque`](SensorFacts::opaque).
    #[must_use]
    pub fn with_opaque(self, opaque: impl Into<Option<bool>>) -> SensorFacts {
        SensorFacts {
            opaque: opaque.into(),
            ..self
        }
    }

    /// The same facts with another [`reference_scene`](SensorFacts::reference_scene).
    #[must_use]
    pub fn with_reference_scene(self, reference_scene: impl Into<String>) -> SensorFacts {
        SensorFacts {
            reference_scene: reference_scene.into(),
            ..self
        }
    }

    /// The same facts with another [`frame_size`](SensorFacts::frame_size).
    #[must_use]
    pub fn with_frame_size(self, frame_size: impl Into<Option<[u32; 2]>>) -> SensorFacts {
        SensorFacts {
            frame_size: frame_size.into(),
            ..self
        }
    }
}

impl Default for SensorFacts {
    /// Facts without any declaration. The reference scene is [`REFERENCE_SCENE`](SensorFacts::REFERENCE_SCENE).
    fn default() -> SensorFacts {
        SensorFacts {
            footprint: None,
            opaque: None,
            reference_scene: SensorFacts::REFERENCE_SCENE.to_owned(),
            frame_size: None,
        }
    }
}

/// Fact about the sensor that a metric requires.
///
/// ```
/// use taceva_metrics::{Fact, catalogue};
/// let uniformity = catalogue::find("uniformity").ok_or("a metric")?;
/// assert!(uniformity.facts.contains(&Fact::Footprint));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Fact {
    /// Outline of the sensing surface.
    Footprint,
    /// Greatest indentation of the sensing surface.
    DepthMax,
    /// Gel that is not declared opaque.
    NotOpaque,
    /// Size of the sensor's pictures.
    FrameSize,
}

impl Fact {
    /// Reason to skip a metric that requires this fact; `None` if `facts` satisfy the requirement.
    pub(crate) fn obstacle(self, facts: &SensorFacts) -> Option<SkipReason> {
        let footprint = facts.footprint.as_ref();
        let (there, name) = match self {
            Fact::Footprint => (footprint.is_some(), "footprint"),
            Fact::DepthMax => (
                footprint.is_some_and(|footprint| footprint.depth_max().is_some()),
                "depth_max_mm",
            ),
            Fact::FrameSize => (facts.frame_size.is_some(), "frame_size"),
            Fact::NotOpaque => {
                return (facts.opaque == Some(true)).then_some(SkipReason::GelIsOpaque);
            }
        };
        (!there).then_some(SkipReason::FactAbsent(name))
    }
}

/// Formats `footprint` for the parameters of a state, with lengths in whole nanometres.
pub(crate) fn written(footprint: &Footprint) -> String {
    let outline = match footprint.outline() {
        Outline::Disc { radius } => format!("disc {}", radius.0),
        Outline::Rectangle { half_x, half_y } => format!("rectangle {} {}", half_x.0, half_y.0),
        other => format!("{other:?}"),
    };
    match footprint.depth_max() {
        Some(depth) => format!("{outline} depth {}", depth.0),
        None => outline,
    }
}
