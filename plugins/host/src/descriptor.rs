//! Comparison of two descriptions of one driver.

use std::fmt::Debug;

use taceva_core::{ArgSpec, Args, Descriptor, Facts, Presence};

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

fn differ<T: PartialEq + Debug>(name: &str, [manifest, library]: [T; 2]) -> Option<[String; 3]> {
    let shown = |value: T| format!("{value:?}");
    (manifest != library).then(|| [name.to_owned(), shown(manifest), shown(library)])
}

fn facts(manifest: &Facts, library: &Facts) -> Option<[String; 3]> {
    match (manifest, library) {
        (Facts::Sensor(one), Facts::Sensor(other)) => differ("frame", [one.frame, other.frame])
            .or_else(|| differ("rate_hz", [one.rate, other.rate]))
            .or_else(|| differ("gel.opaque", [one.opaque, other.opaque]))
            .or_else(|| differ("gel.markers", [one.markers, other.markers]))
            .or_else(|| {
                let thickness = [one.gel_thickness, other.gel_thickness];
                differ("gel.thickness_mm", thickness)
            })
            .or_else(|| differ("scenes", [&one.scenes, &other.scenes]))
            .or_else(|| differ("footprint", [one.footprint, other.footprint]))
            .or_else(|| differ("limits.Pz_max_mm", [one.depth_max, other.depth_max]))
            .or_else(|| differ("limits.Fz_max_N", [one.force_max, other.force_max]))
            .or_else(|| differ("facts", [one, other])),
        (Facts::Force(one), Facts::Force(other)) => differ("axes", [one.axes, other.axes])
            .or_else(|| differ("rate_hz", [one.rate, other.rate]))
            .or_else(|| differ("limits.Fz_max_N", [one.force_max, other.force_max]))
            .or_else(|| differ("noise_N", [one.noise, other.noise]))
            .or_else(|| differ("resolution_N", [one.resolution, other.resolution]))
            .or_else(|| differ("numbered", [one.numbered, other.numbered]))
            .or_else(|| differ("tare", [one.tare, other.tare]))
            .or_else(|| differ("facts", [one, other])),
        (one, other) => differ("facts", [one, other]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{DescriptorSpec, DriverKey, DriverSource, Hertz, SensorFacts};

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
