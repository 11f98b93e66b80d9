//! Comparison of two descriptions of one driver.

use std::fmt::Display;

use taceva_core::{ArgSpec, Args, Descriptor, Facts, Footprint, Outline, Presence};

/// True if `args` set an argument of `descriptor` that may change its facts.
pub(crate) fn changes_facts(descriptor: &Descriptor, args: &Args) -> bool {
    let mut arguments = descriptor.arguments().iter();
    arguments.any(|argument| argument.changes_facts && argument.is_set_by(args))
}

/// Same as [`difference`], for a library's description with `args`. Facts are not compared if `args` may change them.
pub(crate) fn difference_with(
    manifest: &Descriptor,
    library: &Descriptor,
    args: &Args,
) -> Option<[String; 3]> {
    let keys = [manifest, library].map(Descriptor::key);
    let kinds = [manifest, library].map(Descriptor::kind);
    let rest = || match changes_facts(manifest, args) {
        true => differ("source", [manifest, library].map(Descriptor::source))
            .or_else(|| arguments([manifest, library].map(Descriptor::arguments))),
        false => difference(manifest, library),
    };
    differ("key", keys)
        .or_else(|| differ("kind", kinds))
        .or_else(rest)
}

/// First difference between `manifest` and `library`: name of the item, and both values. Titles and help texts are not compared.
pub(crate) fn difference(manifest: &Descriptor, library: &Descriptor) -> Option<[String; 3]> {
    let source = [manifest, library].map(Descriptor::source);
    differ("source", source)
        .or_else(|| facts(manifest.facts(), library.facts()))
        .or_else(|| arguments([manifest, library].map(Descriptor::arguments)))
}

/// First difference between two lists of arguments, apart from help texts.
pub(crate) fn arguments([manifest, library]: [&[ArgSpec]; 2]) -> Option<[String; 3]> {
    let keys = |specs: &[ArgSpec]| {
        let keys: Vec<String> = specs.iter().map(|spec| format!("`{}`", spec.key)).collect();
        match keys.is_empty() {
            true => "none".to_owned(),
            false => keys.join(", "),
        }
    };
    let [promised, said] = [manifest, library].map(keys);
    if promised != said {
        return Some(["arguments".to_owned(), promised, said]);
    }
    manifest.iter().zip(library).find_map(|(promised, said)| {
        let is_alike = *promised == said.clone().help(&promised.help);
        let name = format!("argument `{}`", promised.key);
        (!is_alike).then(|| [name, declared(promised), declared(said)])
    })
}

/// Declaration of an argument in words, without its help.
fn declared(spec: &ArgSpec) -> String {
    let presence = match &spec.presence {
        Presence::Required => "required".to_owned(),
        Presence::Optional => "optional".to_owned(),
        Presence::Default(value) => format!("`{value}` by default"),
    };
    let changes = if spec.changes_facts {
        ", changes facts"
    } else {
        ""
    };
    format!("{}, {presence}{changes}", spec.expected())
}

fn differ<T: PartialEq + Display>(name: &str, [manifest, library]: [T; 2]) -> Option<[String; 3]> {
    (manifest != library).then(|| [name.to_owned(), manifest.to_string(), library.to_string()])
}

fn facts(manifest: &Facts, library: &Facts) -> Option<[String; 3]> {
    if manifest == library {
        return None;
    }
    let [promised, said] = [manifest, library].map(stated);
    let mut pairs = promised.into_iter().zip(said);
    let first = pairs.find(|(promised, said)| promised != said);
    // Facts of later versions have no row.
    let [promised, said] = first.map_or_else(
        || ["facts", "other facts"].map(|words| Fact::new(words, words.to_owned())),
        |(promised, said)| [promised, said],
    );
    Some([promised.key.to_owned(), promised.words, said.words])
}

/// Fact of a device: its key in a manifest, and its value in words.
#[derive(Clone, PartialEq)]
struct Fact {
    key: &'static str,
    words: String,
}

impl Fact {
    fn new(key: &'static str, words: String) -> Fact {
        Fact { key, words }
    }

    fn of<T: Display>(key: &'static str, value: Option<T>) -> Fact {
        let words = value.map_or_else(|| "nothing".to_owned(), |value| value.to_string());
        Fact::new(key, words)
    }

    fn list(key: &'static str, values: &[String]) -> Fact {
        Fact::of(key, (!values.is_empty()).then(|| values.join(", ")))
    }
}

/// All facts of a device, in the order of a manifest.
fn stated(facts: &Facts) -> Vec<Fact> {
    let kind = Fact::new("kind", facts.kind().to_string());
    let facts = match facts {
        Facts::Sensor(facts) => vec![
            Fact::of("frame", facts.frame),
            Fact::of("rate_hz", facts.rate),
            Fact::of("gel.opaque", facts.opaque),
            Fact::of("gel.markers", facts.markers),
            Fact::of("gel.thickness_mm", facts.gel_thickness),
            Fact::list("scenes", &facts.scenes),
            Fact::of("footprint", facts.footprint.map(outlined)),
            Fact::of("limits.Pz_max_mm", facts.depth_max),
            Fact::of("limits.Fz_max_N", facts.force_max),
            Fact::of(
                "camera",
                facts
                    .camera
                    .map(|[width, height]| format!("{width}×{height}")),
            ),
            Fact::of("field_of_view_mm2", facts.field_of_view_mm2),
            Fact::of("latency_ms", facts.latency_ms),
        ],
        Facts::Robot(facts) => vec![
            Fact::of("workspace", facts.workspace),
            Fact::of("limits.speed_max_mm_s", facts.speed_max),
            Fact::of("repeatability_mm", facts.repeatability),
            Fact::of("pose_noise_mm", facts.pose_noise),
            Fact::of("deceleration_mm_s2", facts.deceleration_mm_s2),
            Fact::of("stop_ms", facts.stop_ms),
            Fact::of("latency_ms", facts.latency_ms),
            Fact::new("guarded_motion", facts.guarded_motion.to_string()),
        ],
        Facts::Force(facts) => vec![
            Fact::new("axes", facts.axes.to_string()),
            Fact::of("rate_hz", facts.rate),
            Fact::of("limits.Fz_max_N", facts.force_max),
            Fact::of("noise_N", facts.noise),
            Fact::of("resolution_N", facts.resolution),
            Fact::of("latency_ms", facts.latency_ms),
            Fact::new("numbered", facts.numbered.to_string()),
            Fact::new("tare", facts.tare.to_string()),
        ],
        Facts::Lighting(facts) => vec![Fact::list("scenes", &facts.scenes)],
        Facts::Changer(facts) => vec![Fact::list("holds", &facts.holds)],
        _ => Vec::new(),
    };
    [vec![kind], facts].concat()
}

fn outlined(footprint: Footprint) -> String {
    let outline = match footprint.outline() {
        Outline::Disc { radius } => format!("a disc with a radius of {radius}"),
        Outline::Rectangle { half_x, half_y } => {
            format!("a rectangle with half sides of {half_x} and {half_y}")
        }
        _ => "another outline".to_owned(),
    };
    match footprint.depth_max() {
        Some(depth) => format!("{outline}, indented by at most {depth}"),
        None => outline,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{
        DescriptorSpec, DriverKey, DriverSource, FrameInfo, Hertz, LightingFacts, PixelFormat,
        RobotFacts, SensorFacts, Workspace,
    };

    fn sensor(rate_hz: f64, title: &str) -> Descriptor {
        let facts = SensorFacts::default().with_rate(Hertz(rate_hz));
        let spec = DescriptorSpec::new(
            DriverKey::fixed("org.example/eye"),
            title,
            DriverSource::Real,
            Facts::Sensor(Box::new(facts)),
        );
        spec.check().expect("consistent")
    }

    #[test]
    fn facts_may_differ_where_an_argument_is_set_that_changes_them_and_nothing_else_may() {
        let with = |rate_hz: f64, source: DriverSource| {
            let facts = SensorFacts::default().with_rate(Hertz(rate_hz));
            let key = DriverKey::fixed("org.example/eye");
            let facts = Facts::Sensor(Box::new(facts));
            let speed = ArgSpec::whole("speed", 1, 9).optional().changes_facts();
            let name = ArgSpec::text("name").optional();
            let spec = DescriptorSpec::new(key, "eye", source, facts);
            spec.arguments([speed, name]).check().expect("consistent")
        };
        let (manifest, other) = (
            with(30.0, DriverSource::Real),
            with(60.0, DriverSource::Real),
        );
        let difference = |library: &Descriptor, arguments: &str| {
            let args = manifest.args(arguments).expect("declared");
            difference_with(&manifest, library, &args).map(|[what, ..]| what)
        };
        assert_eq!(difference(&other, "speed=2"), None);
        assert_eq!(difference(&other, "name=a").as_deref(), Some("rate_hz"));
        assert_eq!(difference(&other, "").as_deref(), Some("rate_hz"));
        let simulated = with(60.0, DriverSource::Simulated);
        let found = difference(&simulated, "speed=2");
        assert_eq!(found.as_deref(), Some("source"));
    }

    #[test]
    fn other_arguments_are_named_in_words_and_other_helps_are_no_difference() {
        let strength = || ArgSpec::number("strength", 0.0, 9.0).help("of the penalty");
        let quantile = ArgSpec::number("quantile", 0.0, 1.0).help("of the labels");
        let found = |one: &[ArgSpec], other: &[ArgSpec]| arguments([one, other]);
        let said = |words: [&str; 3]| Some(words.map(str::to_owned));
        assert_eq!(
            found(&[strength()], &[quantile]),
            said(["arguments", "`strength`", "`quantile`"])
        );
        assert_eq!(
            found(&[], &[strength()]),
            said(["arguments", "none", "`strength`"])
        );
        assert_eq!(
            found(&[strength()], &[strength().unit("mm").optional()]),
            said([
                "argument `strength`",
                "a number from 0 to 9, required",
                "a number from 0 to 9 mm, optional"
            ])
        );
        assert_eq!(found(&[strength()], &[strength().help("other")]), None);
    }

    #[test]
    fn facts_that_differ_are_stated_in_words_and_not_as_code() {
        let frame = FrameInfo {
            width: 320,
            height: 240,
            format: PixelFormat::Gray8,
        };
        let sensor = |frame: Option<FrameInfo>| {
            Facts::Sensor(Box::new(SensorFacts::default().with_frame(frame)))
        };
        let still = Facts::Robot(RobotFacts::default());
        let workspace = Workspace {
            least: Default::default(),
            greatest: Default::default(),
        };
        let moving = Facts::Robot(RobotFacts::default().with_workspace(workspace));
        let dark = LightingFacts::default().with_scenes(vec!["dark".to_owned()]);
        for (manifest, library, expected) in [
            (
                sensor(Some(frame)),
                sensor(None),
                ["frame", "320×240 gray8", "nothing"],
            ),
            (
                moving,
                still.clone(),
                ["workspace", "from (0, 0, 0) mm to (0, 0, 0) mm", "nothing"],
            ),
            (still, Facts::Lighting(dark), ["kind", "robot", "lighting"]),
        ] {
            let found = facts(&manifest, &library);
            assert_eq!(found, Some(expected.map(str::to_owned)));
            assert_eq!(facts(&manifest, &manifest), None);
        }
    }

    #[test]
    fn the_first_difference_is_named_with_what_either_says() {
        assert_eq!(difference(&sensor(30.0, "eye"), &sensor(30.0, "I")), None);
        let [what, promised, said] =
            difference(&sensor(30.0, "eye"), &sensor(60.0, "eye")).expect("rate");
        assert_eq!(what, "rate_hz");
        assert!(
            promised.contains("30") && said.contains("60"),
            "{promised} {said}"
        );
    }
}
