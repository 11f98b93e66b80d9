//! Conversion of a `[[provides]]` table to device facts.

use taceva_core::{
    Axes, Axis, ChangerFacts, Facts, Footprint, ForceFacts, FrameInfo, Hertz, LightingFacts,
    Millimetre, Newton, Point, RobotFacts, SensorFacts, Speed, Workspace,
};
use toml::Spanned;

use super::Refused;
use super::provides_table::{Kind, Shape, WrittenFootprint, WrittenProvides};
use crate::text::shown;

impl WrittenProvides {
    /// Facts of the device, by its kind.
    pub(super) fn facts(&self) -> Result<Facts, Refused> {
        match self.kind {
            Kind::Sensor => Ok(Facts::Sensor(Box::new(self.sensor()?))),
            Kind::Robot => Ok(Facts::Robot(self.robot()?)),
            Kind::Force => Ok(Facts::Force(self.force()?)),
            Kind::Lighting => Ok(Facts::Lighting(
                LightingFacts::default().with_scenes(value(&self.scenes).unwrap_or_default()),
            )),
            Kind::Changer => Ok(Facts::Changer(
                ChangerFacts::default().with_holds(value(&self.holds).unwrap_or_default()),
            )),
            Kind::Estimator => {
                let problem = "an estimator has no facts of a device";
                Err(Refused::at(&self.key, problem))
            }
        }
    }

    fn sensor(&self) -> Result<SensorFacts, Refused> {
        let gel = self.gel.as_ref().map(Spanned::get_ref);
        let limits = self.limits.as_ref().map(Spanned::get_ref);
        Ok(SensorFacts::default()
            .with_frame(self.frame.as_ref().map(|frame| {
                let frame = frame.get_ref();
                FrameInfo {
                    width: frame.width,
                    height: frame.height,
                    format: frame.format,
                }
            }))
            .with_rate(value(&self.rate_hz).map(Hertz))
            .with_opaque(gel.and_then(|gel| gel.opaque))
            .with_markers(gel.and_then(|gel| gel.markers))
            .with_scenes(value(&self.scenes).unwrap_or_default())
            .with_footprint(self.footprint.as_ref().map(footprint).transpose()?)
            .with_depth_max(limits.and_then(|limits| limits.depth_mm).map(Millimetre))
            .with_force_max(limits.and_then(|limits| limits.force_n).map(Newton))
            .with_camera(
                self.camera
                    .as_ref()
                    .map(|camera| [camera.get_ref().width, camera.get_ref().height]),
            )
            .with_gel_thickness(gel.and_then(|gel| gel.thickness_mm).map(Millimetre))
            .with_field_of_view_mm2(value(&self.field_of_view_mm2))
            .with_latency_ms(value(&self.latency_ms)))
    }

    fn robot(&self) -> Result<RobotFacts, Refused> {
        let corner = |[x, y, z]: [f64; 3]| Point {
            x: Millimetre(x),
            y: Millimetre(y),
            z: Millimetre(z),
        };
        let limits = self.limits.as_ref();
        let speed = limits.and_then(|limits| Some((limits, limits.get_ref().speed_max_mm_s?)));
        Ok(RobotFacts::default()
            .with_workspace(self.workspace.as_ref().map(|workspace| Workspace {
                least: corner(workspace.get_ref().least_mm),
                greatest: corner(workspace.get_ref().greatest_mm),
            }))
            .with_speed_max(
                speed
                    .map(|(limits, speed)| {
                        Speed::try_new(speed).map_err(|error| {
                            Refused::at(limits, format!("`speed_max_mm_s`: {error}"))
                        })
                    })
                    .transpose()?,
            )
            .with_repeatability(value(&self.repeatability_mm).map(Millimetre))
            .with_pose_noise(value(&self.pose_noise_mm).map(Millimetre))
            .with_deceleration_mm_s2(value(&self.deceleration_mm_s2))
            .with_stop_ms(value(&self.stop_ms))
            .with_latency_ms(value(&self.latency_ms))
            .with_guarded_motion(value(&self.guarded_motion).unwrap_or(false)))
    }

    fn force(&self) -> Result<ForceFacts, Refused> {
        let limits = self.limits.as_ref().map(Spanned::get_ref);
        let axes = match &self.axes {
            Some(axes) => axes.get_ref().iter().try_fold(Axes::NONE, with_axis)?,
            None => Axes::NONE,
        };
        Ok(ForceFacts::default()
            .with_axes(axes)
            .with_rate(value(&self.rate_hz).map(Hertz))
            .with_force_max(limits.and_then(|limits| limits.force_n).map(Newton))
            .with_noise(value(&self.noise_n).map(Newton))
            .with_resolution(value(&self.resolution_n).map(Newton))
            .with_latency_ms(value(&self.latency_ms))
            .with_numbered(value(&self.numbered).unwrap_or(false))
            .with_tare(value(&self.tare).unwrap_or(false)))
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
            let problem = "`footprint`: a disc has only `radius_mm`";
            return Err(Refused::at(written, problem));
        }
        (Shape::Rect, ..) => {
            let problem = "`footprint`: a rect has only `half_x_mm` and `half_y_mm`";
            return Err(Refused::at(written, problem));
        }
    };
    footprint.map_err(|error| Refused::at(written, format!("`footprint`: {error}")))
}
