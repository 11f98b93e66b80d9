//! Drivers and estimators of a plugin, from a `[[provides]]` table of its manifest or the same text from its library.

use std::ops::Range;

use taceva_core::{ArgSpec, Descriptor, DescriptorSpec, DriverSource};
use toml::Spanned;

use super::Refused;
use super::argument::WrittenArgument;
use super::provides_table::{Kind, Source, WrittenLimits, WrittenProvides};
use super::usb_id::UsbId;
use crate::id::PluginId;
use crate::text::shown;

/// Driver or estimator of a plugin, as described before its code runs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Provided {
    /// A driver.
    Driver {
        /// Description of the driver, for planning. Its key is the plugin's id, `/`, and the key of the table.
        descriptor: Box<Descriptor>,
        /// USB ids of its devices, for listing devices that are plugged in.
        usb: Vec<UsbId>,
    },
    /// An estimator.
    Estimator(EstimatorInfo),
}

/// Description of a plugin's estimator.
#[derive(Clone, Debug, PartialEq)]
pub struct EstimatorInfo {
    /// Key by which users choose the estimator: the plugin's id, `/`, and the key of the table.
    pub key: taceva_core::DriverKey,
    /// Short title.
    pub title: String,
    /// Declared settings.
    pub settings: Vec<ArgSpec>,
}

impl WrittenProvides {
    /// Checks the table and converts it, for the plugin `id`.
    pub(super) fn provided(mut self, id: &PluginId) -> Result<Provided, Refused> {
        if let Some((key, span)) = self.stranger() {
            let problem = format!("`{key}`: not a fact of a {}", self.kind.name());
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

    /// First key in the table that does not apply to this kind of device; `None` if all apply.
    fn stranger(&self) -> Option<(&'static str, Range<usize>)> {
        use Kind::{Changer, Force, Lighting, Robot, Sensor};
        fn span<T>(key: &Option<Spanned<T>>) -> Option<Range<usize>> {
            key.as_ref().map(Spanned::span)
        }
        let devices: &[Kind] = &[Sensor, Robot, Force, Lighting, Changer];
        let limits = self.limits.as_ref();
        let limit = |of: fn(&WrittenLimits) -> Option<f64>| {
            limits
                .filter(|limits| of(limits.get_ref()).is_some())
                .map(Spanned::span)
        };
        type Key<'a> = (&'static str, Option<Range<usize>>, &'a [Kind]);
        let table: [Key<'_>; 24] = [
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
            ("holds", span(&self.holds), &[Changer]),
            ("workspace", span(&self.workspace), &[Robot]),
            ("repeatability_mm", span(&self.repeatability_mm), &[Robot]),
            ("pose_noise_mm", span(&self.pose_noise_mm), &[Robot]),
            (
                "deceleration_mm_s2",
                span(&self.deceleration_mm_s2),
                &[Robot],
            ),
            ("stop_ms", span(&self.stop_ms), &[Robot]),
            (
                "latency_ms",
                span(&self.latency_ms),
                &[Sensor, Robot, Force],
            ),
            ("noise_N", span(&self.noise_n), &[Force]),
            ("resolution_N", span(&self.resolution_n), &[Force]),
            ("guarded_motion", span(&self.guarded_motion), &[Robot]),
            ("axes", span(&self.axes), &[Force]),
            ("tare", span(&self.tare), &[Force]),
            ("numbered", span(&self.numbered), &[Force]),
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
}
