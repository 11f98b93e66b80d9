//! Checks of a descriptor, and its facts.

use super::*;
use crate::driver::Axes;
use crate::footprint::Footprint;
use crate::frame::{FrameInfo, PixelFormat};
use crate::geometry::Point;
use crate::quantity::{Hertz, Millimetre, Newton};
use crate::registry::{LightingFacts, Workspace};

const KEY: DriverKey = DriverKey::fixed("test/device");

fn check(source: DriverSource, facts: Facts) -> Result<Descriptor, String> {
    DescriptorSpec::new(KEY, "a device", source, facts)
        .check()
        .map_err(|error| error.to_string())
}

fn sensor(facts: SensorFacts) -> Result<Descriptor, String> {
    check(DriverSource::Simulated, Facts::Sensor(Box::new(facts)))
}

#[test]
fn facts_that_contradict_each_other_are_refused_when_built() {
    let opaque = SensorFacts::default()
        .with_opaque(true)
        .with_scenes(vec!["S1".to_owned()]);
    assert_eq!(
        sensor(opaque).expect_err("opaque"),
        "the driver `test/device` contradicts itself: the gel is opaque, but the light around it can be set to `S1`"
    );
    let deep = SensorFacts::default()
        .with_footprint(Footprint::disc(17.0, Some(3.5)).expect("lengths"))
        .with_depth_max(Millimetre(4.0));
    assert_eq!(
        sensor(deep).expect_err("deep"),
        "the driver `test/device` contradicts itself: the depth limit of 4 mm exceeds the depth of the footprint, 3.5 mm"
    );
    let recorded = check(DriverSource::Recorded, Facts::Robot(RobotFacts::default()));
    assert!(recorded.expect_err("a film").contains("a recorded robot"));
}

#[test]
fn facts_that_no_device_has_are_refused_when_built() {
    let frame = |width| {
        Some(FrameInfo {
            width,
            height: 2,
            format: PixelFormat::Gray8,
        })
    };
    let impossible = [
        SensorFacts::default().with_frame(frame(0)),
        SensorFacts::default().with_rate(Hertz(0.0)),
        SensorFacts::default().with_rate(Hertz(f64::NAN)),
        SensorFacts::default().with_force_max(Newton(-1.0)),
        SensorFacts::default().with_camera([640, 0]),
        SensorFacts::default().with_scenes(vec!["a".into(), "a".into()]),
    ];
    for facts in impossible {
        assert!(sensor(facts.clone()).is_err(), "{facts:?}");
    }
    let corner = |side| Point {
        x: Millimetre(side),
        ..Point::default()
    };
    let inside_out = RobotFacts::default().with_workspace(Workspace {
        least: corner(1.0),
        greatest: corner(-1.0),
    });
    assert!(check(DriverSource::Real, Facts::Robot(inside_out)).is_err());
    assert!(check(DriverSource::Real, Facts::Force(ForceFacts::default())).is_err());
    assert!(
        check(
            DriverSource::Real,
            Facts::Lighting(LightingFacts::default())
        )
        .is_err()
    );
    let good = ForceFacts::default().with_axes(Axes::NORMAL);
    assert!(check(DriverSource::Real, Facts::Force(good)).is_ok());
}

#[test]
fn an_argument_declared_twice_is_refused() {
    let facts = Facts::Sensor(Box::default());
    let error = DescriptorSpec::new(KEY, "a device", DriverSource::Real, facts)
        .arguments([ArgSpec::flag("a"), ArgSpec::text("a")])
        .check()
        .expect_err("twice");
    assert_eq!(
        error.to_string(),
        "the driver `test/device` contradicts itself: argument `a` is declared twice"
    );
}

#[test]
fn the_depth_limit_is_that_of_the_footprint_unless_it_is_tighter() {
    let footprint = Footprint::disc(17.0, Some(3.5)).expect("lengths");
    let mut facts = SensorFacts::default().with_footprint(footprint);
    assert_eq!(facts.depth_limit(), Some(Millimetre(3.5)));
    facts.depth_max = Some(Millimetre(3.0));
    assert_eq!(facts.depth_limit(), Some(Millimetre(3.0)));
}
