//! Writes the description of a driver as TOML, for the table `[[provides]]` of a manifest.

mod toml;

use std::fmt::{self, Write as _};

use taceva_core::{
    ArgKind, ArgSpec, ArgValue, Descriptor, EstimatorFactory, Facts, Footprint, ForceFacts,
    Outline, Point, Presence, RobotFacts, SensorFacts,
};

use self::toml::{Number, Text, written};

/// TOML text that describes a driver in `[[provides]]` of a manifest. The arguments are in `[[args]]`, not in `[[provides.args]]`.
///
/// The text contains only the last part of the driver's key: the plugin `org.example.digit` provides `org.example.digit/finger` as `finger`.
///
/// ```
/// use taceva_core::{Axes, DescriptorSpec, DriverKey, DriverSource, Facts, ForceFacts};
/// let facts = ForceFacts::default().with_axes(Axes::NORMAL).with_tare(true);
/// let key = DriverKey::fixed("org.example.scale/scale");
/// let spec = DescriptorSpec::new(key, "a kitchen scale", DriverSource::Real, Facts::Force(facts));
/// assert_eq!(
///     taceva_plugin::provides_table(&spec.check()?),
///     "kind = \"force\"\nkey = \"scale\"\ntitle = \"a kitchen scale\"\nsource = \"real\"\naxes = [\"Fz\"]\ntare = true\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn provides_table(descriptor: &Descriptor) -> String {
    let mut table = Table::new(
        descriptor.kind().name(),
        descriptor.key().as_str(),
        descriptor.title(),
    );
    table.line("source", &Text(descriptor.source().name()));
    match descriptor.facts() {
        Facts::Sensor(facts) => table.sensor(facts),
        Facts::Robot(facts) => table.robot(facts),
        Facts::Force(facts) => table.force(facts),
        Facts::Lighting(facts) => table.scenes(&facts.scenes),
        Facts::Changer(facts) if facts.holds.is_empty() => {}
        Facts::Changer(facts) => table.texts("holds", facts.holds.iter().map(String::as_str)),
        // For a kind that this crate does not know, only the name is written. The host then rejects the table.
        _ => {}
    }
    table.arguments(descriptor.arguments());
    table.text
}

/// Same as [`provides_table`], for an estimator.
///
/// ```
/// # use taceva_core::{DriverKey, ModelError, Saved, SavedRegressor};
/// # use taceva_plugin::{EstimatorFactory, FitRequest};
/// struct Mean(DriverKey);
/// impl EstimatorFactory for Mean {
///     fn key(&self) -> &DriverKey { &self.0 }
///     fn title(&self) -> &str { "the mean of the labels" }
/// #   fn fit(&self, _: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> { unreachable!("nothing is fitted") }
/// #   fn load(&self, _: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> { unreachable!("nothing is loaded") }
///     // `fit` and `load` besides.
/// }
/// let table = taceva_plugin::estimator_table(&Mean(DriverKey::fixed("org.example.mean/mean")));
/// assert_eq!(table, "kind = \"estimator\"\nkey = \"mean\"\ntitle = \"the mean of the labels\"\n");
/// ```
pub fn estimator_table(estimator: &dyn EstimatorFactory) -> String {
    let mut table = Table::new("estimator", estimator.key().as_str(), estimator.title());
    table.arguments(estimator.settings());
    table.text
}

struct Table {
    text: String,
}

impl Table {
    fn new(kind: &str, key: &str, title: &str) -> Table {
        let mut table = Table {
            text: String::new(),
        };
        let word = key.rsplit('/').next().unwrap_or(key);
        table.line("kind", &Text(kind));
        table.line("key", &Text(word));
        table.line("title", &Text(title));
        table
    }

    fn line(&mut self, key: &str, value: &dyn fmt::Display) {
        writeln!(self.text, "{key} = {value}").expect("writing to a string does not fail");
    }

    fn number(&mut self, key: &str, value: Option<f64>) {
        if let Some(value) = value {
            self.line(key, &Number(value));
        }
    }

    /// Writes `fields` as an inline table, without fields whose value is `None`. Writes nothing if all values are `None`.
    fn inline(&mut self, key: &str, fields: &[(&str, Option<String>)]) {
        let known: Vec<String> = fields
            .iter()
            .filter_map(|(name, value)| Some(format!("{name} = {}", value.as_ref()?)))
            .collect();
        if !known.is_empty() {
            self.line(key, &format_args!("{{ {} }}", known.join(", ")));
        }
    }

    fn sensor(&mut self, facts: &SensorFacts) {
        if let Some(frame) = facts.frame {
            let fields = [
                ("width", Some(frame.width.to_string())),
                ("height", Some(frame.height.to_string())),
                ("format", Some(Text(frame.format.name()).to_string())),
            ];
            self.inline("frame", &fields);
        }
        self.number("rate_hz", facts.rate.map(|rate| rate.0));
        let gel = [
            ("opaque", facts.opaque.map(|opaque| opaque.to_string())),
            ("markers", facts.markers.map(|markers| markers.to_string())),
            (
                "thickness_mm",
                facts.gel_thickness.map(|height| written(height.0)),
            ),
        ];
        self.inline("gel", &gel);
        if let Some([width, height]) = facts.camera {
            let fields = [
                ("width", Some(width.to_string())),
                ("height", Some(height.to_string())),
            ];
            self.inline("camera", &fields);
        }
        self.number("field_of_view_mm2", facts.field_of_view_mm2);
        self.number("latency_ms", facts.latency_ms);
        if let Some(footprint) = facts.footprint {
            self.footprint(footprint);
        }
        let limits = [
            ("Pz_max_mm", facts.depth_max.map(|depth| written(depth.0))),
            ("Fz_max_N", facts.force_max.map(|force| written(force.0))),
        ];
        self.inline("limits", &limits);
        self.scenes(&facts.scenes);
    }

    fn footprint(&mut self, footprint: Footprint) {
        let (shape, [radius, half_x, half_y]) = match footprint.outline() {
            Outline::Disc { radius } => ("disc", [Some(radius), None, None]),
            Outline::Rectangle { half_x, half_y } => ("rect", [None, Some(half_x), Some(half_y)]),
            // Skipped like a kind that this crate does not know.
            _ => return,
        };
        let length = |length: Option<taceva_core::Nanometre>| {
            length.map(|length| written(length.to_millimetres()))
        };
        let fields = [
            ("shape", Some(Text(shape).to_string())),
            ("radius_mm", length(radius)),
            ("half_x_mm", length(half_x)),
            ("half_y_mm", length(half_y)),
            ("depth_max_mm", length(footprint.depth_max())),
        ];
        self.inline("footprint", &fields);
    }

    fn robot(&mut self, facts: &RobotFacts) {
        if let Some(workspace) = facts.workspace {
            let corner = |Point { x, y, z }: Point| {
                let [x, y, z] = [x, y, z].map(|side| written(side.0));
                Some(format!("[{x}, {y}, {z}]"))
            };
            let fields = [
                ("least_mm", corner(workspace.least)),
                ("greatest_mm", corner(workspace.greatest)),
            ];
            self.inline("workspace", &fields);
        }
        let speed = facts.speed_max.map(|speed| written(speed.mm_per_s()));
        self.inline("limits", &[("speed_max_mm_s", speed)]);
        self.number(
            "repeatability_mm",
            facts.repeatability.map(|spread| spread.0),
        );
        self.number("pose_noise_mm", facts.pose_noise.map(|noise| noise.0));
        self.number("deceleration_mm_s2", facts.deceleration_mm_s2);
        self.number("stop_ms", facts.stop_ms);
        self.number("latency_ms", facts.latency_ms);
        self.line("guarded_motion", &facts.guarded_motion);
    }

    fn force(&mut self, facts: &ForceFacts) {
        self.texts("axes", facts.axes.iter().map(taceva_core::Axis::name));
        self.number("rate_hz", facts.rate.map(|rate| rate.0));
        let force = facts.force_max.map(|force| written(force.0));
        self.inline("limits", &[("Fz_max_N", force)]);
        self.number("noise_N", facts.noise.map(|noise| noise.0));
        self.number("resolution_N", facts.resolution.map(|step| step.0));
        self.number("latency_ms", facts.latency_ms);
        if facts.numbered {
            self.line("numbered", &true);
        }
        self.line("tare", &facts.tare);
    }

    fn scenes(&mut self, scenes: &[String]) {
        if !scenes.is_empty() {
            self.texts("scenes", scenes.iter().map(String::as_str));
        }
    }

    fn texts<'a>(&mut self, key: &str, texts: impl Iterator<Item = &'a str>) {
        let texts: Vec<String> = texts.map(|text| Text(text).to_string()).collect();
        self.line(key, &format_args!("[{}]", texts.join(", ")));
    }

    fn arguments(&mut self, arguments: &[ArgSpec]) {
        for argument in arguments {
            self.text.push_str("\n[[args]]\n");
            self.argument(argument);
        }
    }

    fn argument(&mut self, argument: &ArgSpec) {
        self.line("key", &Text(&argument.key));
        let open = f64::NEG_INFINITY..=f64::INFINITY;
        match &argument.kind {
            ArgKind::Text => self.line("type", &Text("text")),
            ArgKind::Path => self.line("type", &Text("path")),
            ArgKind::Flag => self.line("type", &Text("flag")),
            ArgKind::Choice { of } => {
                self.line("type", &Text("choice"));
                self.texts("choices", of.iter().map(String::as_str));
            }
            ArgKind::Whole { least, most } => {
                self.line("type", &Text("whole"));
                if (*least, *most) != (i64::MIN, i64::MAX) {
                    self.line("range", &format_args!("[{least}, {most}]"));
                }
            }
            ArgKind::Number { least, most } => {
                self.line("type", &Text("number"));
                if *least > *open.start() || *most < *open.end() {
                    self.line(
                        "range",
                        &format_args!("[{}, {}]", Number(*least), Number(*most)),
                    );
                }
            }
            // Skipped like a kind of driver that this crate does not know.
            _ => {}
        }
        if let Some(unit) = &argument.unit {
            self.line("unit", &Text(unit));
        }
        match &argument.presence {
            Presence::Required => {}
            Presence::Optional => self.line("optional", &true),
            Presence::Default(ArgValue::Whole(value)) => self.line("default", value),
            Presence::Default(ArgValue::Number(value)) => self.line("default", &Number(*value)),
            Presence::Default(ArgValue::Flag(value)) => self.line("default", value),
            // Text, or a value that is written as text.
            Presence::Default(value) => self.line("default", &Text(&value.to_string())),
        }
        if !argument.help.is_empty() {
            self.line("help", &Text(&argument.help));
        }
        if argument.changes_facts {
            self.line("changes_facts", &true);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_argument_of_each_type_is_written_with_all_it_says() {
        let settings = [
            ArgSpec::whole("seed", 0, i64::MAX)
                .default(ArgValue::Whole(0))
                .help("of the noise"),
            ArgSpec::number("exposure", 0.1, 33.0)
                .unit("ms")
                .default(ArgValue::Number(8.0)),
            ArgSpec::choice("pace", ["virtual", "real"]),
            ArgSpec::path("table").optional(),
        ];
        let expected = r#"
[[args]]
key = "seed"
type = "whole"
range = [0, 9223372036854775807]
default = 0
help = "of the noise"

[[args]]
key = "exposure"
type = "number"
range = [0.1, 33.0]
unit = "ms"
default = 8.0

[[args]]
key = "pace"
type = "choice"
choices = ["virtual", "real"]

[[args]]
key = "table"
type = "path"
optional = true
"#;
        let mut table = Table {
            text: String::new(),
        };
        table.arguments(&settings);
        assert_eq!(table.text, expected);
    }
}
