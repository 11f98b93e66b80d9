//! What a plugin provides: a `[[provides]]` table of its manifest, or the same text as its library writes it.

use std::ops::Range;

use serde::Deserialize;
use taceva_core::{
    ArgSpec, Axes, Axis, Descriptor, DescriptorSpec, DriverKind, DriverSource, Facts, Footprint,
    ForceFacts, FrameInfo, Hertz, LightingFacts, Millimetre, Newton, PixelFormat, Point,
    RobotFacts, SensorFacts, Speed, Workspace,
};
use toml::Spanned;

use super::Refused;
use super::argument::WrittenArgument;
use crate::id::PluginId;
use crate::shown::shown;

/// One driver or estimator of a plugin, as far as it is known before any code of it runs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Provided {
    /// A driver.
    Driver {
        /// Everything that planning needs; its key is the plugin's id, `/`, and the key of the table.
        descriptor: Box<Descriptor>,
        /// Devices that it may open, for listing what is plugged in.
        usb: Vec<UsbId>,
    },
    /// An estimator.
    Estimator(EstimatorInfo),
}

/// An estimator of a plugin.
#[derive(Clone, Debug, PartialEq)]
pub struct EstimatorInfo {
    /// The name by which people choose it: the plugin's id, `/`, and the key of the table.
    pub key: taceva_core::DriverKey,
    /// What it is, in a few words.
    pub title: String,
    /// What can be set.
    pub settings: Vec<ArgSpec>,
}

/// A device on USB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UsbId {
    /// Who makes it.
    pub vendor: u16,
    /// What it is.
    pub product: u16,
}

/// The table as it is written: all keys of all kinds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenProvides {
    kind: Kind,
    pub(super) key: Spanned<String>,
    title: Spanned<String>,
    source: Option<Spanned<Source>>,
    frame: Option<Spanned<WrittenFrame>>,
    rate_hz: Option<Spanned<f64>>,
    gel: Option<Spanned<WrittenGel>>,
    camera: Option<Spanned<WrittenCamera>>,
    field_of_view_mm2: Option<Spanned<f64>>,
    footprint: Option<Spanned<WrittenFootprint>>,
    limits: Option<Spanned<WrittenLimits>>,
    scenes: Option<Spanned<Vec<String>>>,
    workspace: Option<Spanned<WrittenWorkspace>>,
    repeatability_mm: Option<Spanned<f64>>,
    guarded_motion: Option<Spanned<bool>>,
    axes: Option<Spanned<Vec<Spanned<String>>>>,
    tare: Option<Spanned<bool>>,
    #[serde(default)]
    usb: Vec<UsbId>,
    #[serde(default)]
    args: Vec<WrittenArgument>,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Sensor,
    Robot,
    Force,
    Lighting,
    Estimator,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Kind::Sensor => DriverKind::Sensor.name(),
            Kind::Robot => DriverKind::Robot.name(),
            Kind::Force => DriverKind::Force.name(),
            Kind::Lighting => DriverKind::Lighting.name(),
            Kind::Estimator => "estimator",
        }
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Source {
    Real,
    Simulated,
    Recorded,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenFrame {
    width: u32,
    height: u32,
    format: PixelFormat,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenGel {
    opaque: Option<bool>,
    markers: Option<bool>,
    thickness_mm: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCamera {
    width: u32,
    height: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenFootprint {
    shape: Shape,
    radius_mm: Option<f64>,
    half_x_mm: Option<f64>,
    half_y_mm: Option<f64>,
    depth_max_mm: Option<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    Disc,
    Rect,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenLimits {
    #[serde(rename = "Pz_max_mm")]
    depth_mm: Option<f64>,
    #[serde(rename = "Fz_max_N")]
    force_n: Option<f64>,
    speed_max_mm_s: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenWorkspace {
    least_mm: [f64; 3],
    greatest_mm: [f64; 3],
}

impl WrittenProvides {
    /// The table as it is meant, for a plugin called `id`.
    pub(super) fn provided(mut self, id: &PluginId) -> Result<Provided, Refused> {
        if let Some((key, span)) = self.stranger() {
            let problem = format!("`{key}`: no fact of a {}", self.kind.name());
            return Err(Refused { span, problem });
        }
        let key = self.key.get_ref();
        let is_word = !key.contains('/');
        let key = id.driver(key).ok().filter(|_| is_word).ok_or_else(|| {
            let problem = format!(
                "`key`: {:?}, expected a word of lower-case letters, digits, `-`, `_` and `.`",
                shown(self.key.get_ref())
            );
            Refused::at(&self.key, problem)
        })?;
        let title = super::plain_text("title", &self.title)?;
        let arguments = std::mem::take(&mut self.args)
            .into_iter()
            .map(WrittenArgument::spec)
            .collect::<Result<Vec<ArgSpec>, Refused>>()?;
        if self.kind == Kind::Estimator {
            return Ok(Provided::Estimator(EstimatorInfo {
                key,
                title,
                settings: arguments,
            }));
        }
        let source = match self.source.as_ref().map(Spanned::get_ref) {
            Some(Source::Real) => DriverSource::Real,
            Some(Source::Simulated) => DriverSource::Simulated,
            Some(Source::Recorded) => DriverSource::Recorded,
            None => {
                let problem =
                    "the key `source` is missing, expected `real`, `simulated` or `recorded`";
                return Err(Refused::at(&self.key, problem));
            }
        };
        let facts = self.facts()?;
        let descriptor = DescriptorSpec::new(key, title, source, facts)
            .arguments(arguments)
            .check()
            .map_err(|error| Refused::at(&self.key, error.to_string()))?;
        Ok(Provided::Driver {
            descriptor: Box::new(descriptor),
            usb: self.usb,
        })
    }

    /// The first key that says nothing of a device of this kind.
    fn stranger(&self) -> Option<(&'static str, Range<usize>)> {
        use Kind::{Force, Lighting, Robot, Sensor};
        fn span<T>(key: &Option<Spanned<T>>) -> Option<Range<usize>> {
            key.as_ref().map(Spanned::span)
        }
        let devices: &[Kind] = &[Sensor, Robot, Force, Lighting];
        let limits = self.limits.as_ref();
        let limit = |of: fn(&WrittenLimits) -> Option<f64>| {
            limits
                .filter(|limits| of(limits.get_ref()).is_some())
                .map(Spanned::span)
        };
        type Key<'a> = (&'static str, Option<Range<usize>>, &'a [Kind]);
        let table: [Key<'_>; 16] = [
            ("source", span(&self.source), devices),
            ("frame", span(&self.frame), &[Sensor]),
            ("rate_hz", span(&self.rate_hz), &[Sensor, Force]),
            ("gel", span(&self.gel), &[Sensor]),
            ("camera", span(&self.camera), &[Sensor]),
            (
                "field_of_view_mm2",
                span(&self.field_of_view_mm2),
                &[Sensor],
            ),
            ("footprint", span(&self.footprint), &[Sensor]),
            ("scenes", span(&self.scenes), &[Sensor, Lighting]),
            ("workspace", span(&self.workspace), &[Robot]),
            ("repeatability_mm", span(&self.repeatability_mm), &[Robot]),
            ("guarded_motion", span(&self.guarded_motion), &[Robot]),
            ("axes", span(&self.axes), &[Force]),
            ("tare", span(&self.tare), &[Force]),
            (
                "limits.Pz_max_mm",
                limit(|limits| limits.depth_mm),
                &[Sensor],
            ),
            (
                "limits.Fz_max_N",
                limit(|limits| limits.force_n),
                &[Sensor, Force],
            ),
            (
                "limits.speed_max_mm_s",
                limit(|limits| limits.speed_max_mm_s),
                &[Robot],
            ),
        ];
        table
            .into_iter()
            .find(|(_, span, kinds)| span.is_some() && !kinds.contains(&self.kind))
            .and_then(|(key, span, _)| Some((key, span?)))
    }

    fn facts(&self) -> Result<Facts, Refused> {
        match self.kind {
            Kind::Sensor => Ok(Facts::Sensor(Box::new(self.sensor()?))),
            Kind::Robot => Ok(Facts::Robot(self.robot()?)),
            Kind::Force => Ok(Facts::Force(self.force()?)),
            Kind::Lighting => Ok(Facts::Lighting(LightingFacts {
                scenes: value(&self.scenes).unwrap_or_default(),
            })),
            Kind::Estimator => {
                let problem = "an estimator is no device";
                Err(Refused::at(&self.key, problem))
            }
        }
    }

    fn sensor(&self) -> Result<SensorFacts, Refused> {
        let gel = self.gel.as_ref().map(Spanned::get_ref);
        let limits = self.limits.as_ref().map(Spanned::get_ref);
        Ok(SensorFacts {
            frame: self.frame.as_ref().map(|frame| {
                let frame = frame.get_ref();
                FrameInfo {
                    width: frame.width,
                    height: frame.height,
                    format: frame.format,
                }
            }),
            rate: value(&self.rate_hz).map(Hertz),
            opaque: gel.and_then(|gel| gel.opaque),
            markers: gel.and_then(|gel| gel.markers),
            scenes: value(&self.scenes).unwrap_or_default(),
            footprint: self.footprint.as_ref().map(footprint).transpose()?,
            depth_max: limits.and_then(|limits| limits.depth_mm).map(Millimetre),
            force_max: limits.and_then(|limits| limits.force_n).map(Newton),
            camera: self
                .camera
                .as_ref()
                .map(|camera| [camera.get_ref().width, camera.get_ref().height]),
            gel_thickness: gel.and_then(|gel| gel.thickness_mm).map(Millimetre),
            field_of_view_mm2: value(&self.field_of_view_mm2),
        })
    }

    fn robot(&self) -> Result<RobotFacts, Refused> {
        let corner = |[x, y, z]: [f64; 3]| Point {
            x: Millimetre(x),
            y: Millimetre(y),
            z: Millimetre(z),
        };
        let limits = self.limits.as_ref();
        let speed = limits.and_then(|limits| Some((limits, limits.get_ref().speed_max_mm_s?)));
        Ok(RobotFacts {
            workspace: self.workspace.as_ref().map(|workspace| Workspace {
                least: corner(workspace.get_ref().least_mm),
                greatest: corner(workspace.get_ref().greatest_mm),
            }),
            speed_max: speed
                .map(|(limits, speed)| {
                    Speed::try_new(speed)
                        .map_err(|error| Refused::at(limits, format!("`speed_max_mm_s`: {error}")))
                })
                .transpose()?,
            repeatability: value(&self.repeatability_mm).map(Millimetre),
            guarded_motion: value(&self.guarded_motion).unwrap_or(false),
        })
    }

    fn force(&self) -> Result<ForceFacts, Refused> {
        let limits = self.limits.as_ref().map(Spanned::get_ref);
        let axes = match &self.axes {
            Some(axes) => axes.get_ref().iter().try_fold(Axes::NONE, with_axis)?,
            None => Axes::NONE,
        };
        Ok(ForceFacts {
            axes,
            rate: value(&self.rate_hz).map(Hertz),
            force_max: limits.and_then(|limits| limits.force_n).map(Newton),
            tare: value(&self.tare).unwrap_or(false),
        })
    }
}

fn value<T: Clone>(key: &Option<Spanned<T>>) -> Option<T> {
    key.as_ref().map(|key| key.get_ref().clone())
}

fn with_axis(axes: Axes, written: &Spanned<String>) -> Result<Axes, Refused> {
    let name = written.get_ref();
    let axis = Axis::ALL.into_iter().find(|axis| axis.name() == name);
    match axis.filter(|axis| !axes.contains(*axis)) {
        Some(axis) => Ok(axes.with(axis)),
        None => Err(Refused::at(
            written,
            format!(
                "`axes`: {:?}, expected each of `Fx`, `Fy`, `Fz`, `Tx`, `Ty`, `Tz` at most once",
                shown(name)
            ),
        )),
    }
}

fn footprint(written: &Spanned<WrittenFootprint>) -> Result<Footprint, Refused> {
    let WrittenFootprint {
        shape,
        radius_mm,
        half_x_mm,
        half_y_mm,
        depth_max_mm,
    } = *written.get_ref();
    let footprint = match (shape, radius_mm, half_x_mm, half_y_mm) {
        (Shape::Disc, Some(radius), None, None) => Footprint::disc(radius, depth_max_mm),
        (Shape::Rect, None, Some(half_x), Some(half_y)) => {
            Footprint::rectangle(half_x, half_y, depth_max_mm)
        }
        (Shape::Disc, ..) => {
            let problem = "`footprint`: a disc has `radius_mm` and no half sides";
            return Err(Refused::at(written, problem));
        }
        (Shape::Rect, ..) => {
            let problem = "`footprint`: a rect has `half_x_mm` and `half_y_mm` and no radius";
            return Err(Refused::at(written, problem));
        }
    };
    footprint.map_err(|error| Refused::at(written, format!("`footprint`: {error}")))
}
