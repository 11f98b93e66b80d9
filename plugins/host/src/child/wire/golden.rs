//! Golden bytes of every message at the current wire version. A build that writes other bytes needs a new version number.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::time::Duration;

use taceva_core::{
    ArgSpec, ArgValue, Axes, Channel, Channels, Deadline, DescriptorSpec, DriverKey, DriverKind,
    DriverSource, ErrorKind, Facts, Fault, FeatureShape, ForceFacts, Found, FrameInfo, Guard,
    GuardedStop, Nanometre, Newton, PixelFormat, Pose, Specimen, Speed, Stamp, Wrench,
};

use super::{
    Answer, BenchAnswer, BenchCall, Call, Failure, Greeting, Hello, ModelAnswer, ModelCall,
    ModelEvent, ModelOrder, ModelWord, OpenedDevice, Order, OrderAnswer, SetShape, Urgent, Wire,
    decode,
};
use crate::child::sandbox::{Confinement, Isolation};
use crate::offer::Offer;
use crate::wire_version::WIRE;

/// An enum of messages with the tag bytes of its variants.
pub(in crate::child) trait Listed {
    const NAME: &'static str;
    const TAGS: &'static [u8];
}

/// Path of the file with the golden bytes.
fn golden() -> String {
    format!("{}/tests/wire/{WIRE}.txt", env!("CARGO_MANIFEST_DIR"))
}

/// Writes one line per message. `messages` must contain every variant.
fn list<T: Listed + Wire>(messages: &[T], into: &mut String) {
    let mut tags = BTreeSet::new();
    for message in messages {
        let mut bytes = Vec::new();
        message.write(&mut bytes);
        assert!(decode::<T>(&bytes).is_ok(), "{} {bytes:?}", T::NAME);
        tags.insert(bytes[0]);
        line(T::NAME, &bytes, into);
    }
    let known: BTreeSet<u8> = T::TAGS.iter().copied().collect();
    assert_eq!(tags, known, "a kind of {} has no example here", T::NAME);
}

fn line(name: &str, bytes: &[u8], into: &mut String) {
    write!(into, "{name} ").expect("writing to a string does not fail");
    for byte in bytes {
        write!(into, "{byte:02x}").expect("writing to a string does not fail");
    }
    into.push('\n');
}

fn failure() -> Failure {
    Failure {
        kind: ErrorKind::Timeout,
        doing: "capture".to_owned(),
        cause: Some("no frame".to_owned()),
        fault: Some(Fault::EmergencyStop),
    }
}

const KEY: DriverKey = DriverKey::fixed("org.example.eye/eye");
const SOON: Deadline = Deadline::after(Duration::from_millis(40));
const SHAPE: FeatureShape = FeatureShape {
    height: 2,
    width: 3,
    depth: 1,
};

fn channels() -> Channels {
    Channels::new([Channel::FZ, Channel::PX]).expect("two")
}

fn stamp() -> Stamp {
    Stamp {
        valid_s: 1.5,
        received_s: Some(1.625),
    }
}

fn of_the_child(into: &mut String) {
    let confinement = Confinement {
        needs: vec!["serial:/dev/ttyUSB*".parse().expect("a need")],
        readable: vec!["/opt/venv".into()],
        seals: false,
        ..Confinement::default()
    };
    let hello = Hello {
        wire: WIRE,
        parent: 4711,
        confinement,
        is_heard: true,
        loads: true,
    };
    let mut bytes = Vec::new();
    hello.write(&mut bytes);
    line("Hello", &bytes, into);
    let isolation = Isolation {
        landlock: Some(7),
        system_calls: Some(102),
        user: Some(65_534),
        memory: 4 << 30,
        needs: vec!["usb".parse().expect("a need")],
        takes_code: true,
    };
    let greetings = [
        Greeting::Ready { isolation },
        Greeting::Refused { failure: failure() },
    ];
    list(&greetings, into);
}

fn orders(into: &mut String) {
    let args = vec![
        ("file".to_owned(), ArgValue::Text("a;b".to_owned())),
        ("index".to_owned(), ArgValue::Whole(-3)),
        ("gain".to_owned(), ArgValue::Number(0.5)),
        ("fast".to_owned(), ArgValue::Flag(true)),
    ];
    let set = SetShape {
        samples: 40,
        shape: SHAPE,
        channels: channels(),
        has_groups: true,
    };
    let made = [
        ModelOrder::Fit {
            estimator: KEY,
            settings: args.clone(),
            training: set.clone(),
            validation: Some(set),
        },
        ModelOrder::Load {
            estimator: KEY,
            channels: channels(),
            shape: SHAPE,
            length: 1_000,
        },
    ];
    list(&made, into);
    let order = made[1].clone();
    let kind = DriverKind::Sensor;
    let orders = [
        Order::Open {
            kind,
            driver: KEY,
            args: args.clone(),
        },
        Order::Describe { driver: KEY, args },
        Order::Discover { driver: KEY },
        Order::Bench {
            name: "bench".to_owned(),
        },
        Order::Shutdown {},
        Order::Model { order },
        Order::Offer {},
    ];
    list(&orders, into);
    let facts = ForceFacts::default().with_axes(Axes::NORMAL);
    let spec = DescriptorSpec::new(KEY, "an eye", DriverSource::Real, Facts::Force(facts));
    let spec = spec.arguments([ArgSpec::path("file").help("where it lies")]);
    let offer = Offer {
        id: "org.example.eye".to_owned(),
        version: "1.0.0".to_owned(),
        needs: vec!["usb".to_owned()],
        provides: vec!["kind = \"force\"\n".to_owned()],
    };
    let answers = [
        OrderAnswer::Opened {
            device: devices()[0].clone(),
        },
        OrderAnswer::Described {
            descriptor: spec.check().expect("sound"),
        },
        OrderAnswer::Found {
            found: vec![Found::new(KEY, "an eye".to_owned()).with_arguments("index=1".to_owned())],
        },
        OrderAnswer::Bench { is_there: true },
        OrderAnswer::Failed { failure: failure() },
        OrderAnswer::Making {},
        OrderAnswer::Offered { offer },
    ];
    list(&answers, into);
}

fn devices() -> [OpenedDevice; 5] {
    let frame = FrameInfo {
        width: 640,
        height: 480,
        format: PixelFormat::Rgb8,
    };
    let names = || vec!["dark".to_owned(), "room".to_owned()];
    [
        OpenedDevice::Sensor {
            frame,
            interrupts: true,
            scenes: Some(names()),
        },
        OpenedDevice::Robot {
            guarded: true,
            expires: false,
        },
        OpenedDevice::Force {
            axes: Axes::SIX,
            interrupts: true,
            tare: false,
        },
        OpenedDevice::Lighting { scenes: names() },
        OpenedDevice::Changer {
            holds: names(),
            interrupts: true,
        },
    ]
}

fn calls(into: &mut String) {
    list(&devices(), into);
    let (target, deadline) = (Pose::default(), SOON);
    let speed = Speed::try_new(2.5).expect("above 0");
    let guard = Guard::at(Newton(1.5));
    let name = "dark".to_owned();
    let calls = [
        Call::Start { deadline },
        Call::Stop {},
        Call::Attach {},
        Call::Capture { deadline },
        Call::Light {
            scene: name.clone(),
            deadline,
        },
        Call::Pose { deadline },
        Call::MoveTo {
            target,
            speed,
            deadline,
        },
        Call::MoveGuarded {
            target,
            speed,
            guard,
            deadline,
        },
        Call::ClearHalt { deadline },
        Call::Read { deadline },
        Call::Zero { deadline },
        Call::Close {},
        Call::Bring {
            name: name.clone(),
            deadline,
        },
        Call::MoveExpiring {
            target,
            speed,
            deadline,
        },
    ];
    list(&calls, into);
    let answers = [
        Answer::Done {},
        Answer::Stamped { stamp: stamp() },
        Answer::At {
            pose: target,
            stamp: stamp(),
        },
        Answer::Load {
            wrench: Wrench::default(),
            stamp: stamp(),
            sequence: Some(12),
            lost: Some(3),
        },
        Answer::Stopped {
            stop: GuardedStop::Arrived { stamp: stamp() },
        },
        Answer::Failed { failure: failure() },
        Answer::InPlace { name },
        Answer::Framed {
            stamp: stamp(),
            sequence: Some(12),
        },
    ];
    list(&answers, into);
    list(&[Urgent::Interrupt {}, Urgent::Halt {}], into);
}

fn models_and_benches(into: &mut String) {
    let events = [
        ModelEvent::Begins {
            stage: "fit".to_owned(),
            steps: Some(10),
        },
        ModelEvent::Advances { steps: 2 },
        ModelEvent::Ends {},
        ModelEvent::Made {},
        ModelEvent::Failed { failure: failure() },
    ];
    list(&events, into);
    list(&[ModelWord::Cancel {}], into);
    let calls = [
        ModelCall::Predict { samples: 40 },
        ModelCall::Save {},
        ModelCall::Fetch {},
        ModelCall::Close {},
    ];
    list(&calls, into);
    let answers = [
        ModelAnswer::Done {},
        ModelAnswer::Saved { length: 1_000 },
        ModelAnswer::Failed { failure: failure() },
    ];
    list(&answers, into);
    let rest = Duration::from_millis(5);
    let radius = Nanometre(2_000_000);
    let calls = [
        BenchCall::Now {},
        BenchCall::Rest { rest },
        BenchCall::Mount {
            specimen: Specimen::Sphere { radius },
        },
        BenchCall::NamePress { name: 7 },
        BenchCall::Schedule { at: rest },
        BenchCall::Provenance {},
    ];
    list(&calls, into);
    let answers = [
        BenchAnswer::Done {},
        BenchAnswer::Now { now: rest },
        BenchAnswer::Provenance {
            text: Some("gel".to_owned()),
        },
        BenchAnswer::Failed { failure: failure() },
    ];
    list(&answers, into);
}

#[test]
fn a_message_of_other_bytes_needs_another_number_of_the_wire() {
    let mut now = String::new();
    of_the_child(&mut now);
    orders(&mut now);
    calls(&mut now);
    models_and_benches(&mut now);
    let written = std::fs::read_to_string(golden()).unwrap_or_default();
    let written: Vec<&str> = written.lines().collect();
    let now: Vec<&str> = now.lines().collect();
    let place = (0..now.len().max(written.len())).find(|at| now.get(*at) != written.get(*at));
    assert!(
        place.is_none(),
        "line {} of {} differs: give `WIRE` the next number, and write the file anew:\n{}",
        place.unwrap_or(0) + 1,
        golden(),
        now.join("\n")
    );
}
