//! Generated datasets for the tests, each with special content.

use std::fmt::Write as _;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageFormat, Rgb, RgbImage};
use taceva_core::{
    Certificate, Channel, Channels, Clock, Coverage, Frame, FrameInfo, Instrument, Limit, Phase,
    PixelFormat, Readings, Sample, SignalInfo, Signals, SilentProgress, Stamp, Traceability, Unit,
};
use taceva_dataset::{
    Dataset, Footprint, PictureSide, Recorder, RecordingFacts, RecordingSpec, SensorFacts,
    SignalsSpec, Source,
};
use taceva_import::{ExportForm, ExportPlan, ExportReport, ImportMap, ImportPlan};

/// Number of samples, larger than a row group of a table.
const SAMPLES: u16 = 1030;

/// Recording with every id, missing labels, a picture without contact, and frames stored as differences.
pub(crate) fn recorded(folder: &Path) -> Dataset {
    let path = folder.join("recorded");
    let mut sensor = SensorFacts::new("gel \"π\"")
        .with_presses_since_gel(1200_u32)
        .with_serial("7")
        .with_opaque(true);
    sensor.leds.green = Some(PictureSide::Top);
    let facts = RecordingFacts::new(Source::Simulated, Clock::Monotonic, sensor)
        .with_traceability(traced())
        .with_footprint(Footprint::rectangle(8.5, 10.0).with_depth_max(2.25));
    let channels = [
        Channel::FX,
        Channel::FZ,
        Channel::named("Tz", Unit::NewtonMillimetre).expect("a name"),
    ];
    let channels = Channels::new(channels).expect("distinct");
    let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, channels)).expect("new");
    let info = FrameInfo {
        width: 16,
        height: 12,
        format: PixelFormat::Rgb8,
    };
    // Incompressible texture with a few changing pixels, so that only differences are small.
    let frame = |seed: u16| {
        let pixels = (0..576_u32).map(|pixel| {
            let [.., texture] = pixel.wrapping_mul(2_654_435_761).to_le_bytes();
            if pixel < 3 {
                seed.to_le_bytes()[0]
            } else {
                texture.wrapping_mul(31) ^ texture >> 3
            }
        });
        Frame::new(info, pixels.collect()).expect("whole")
    };
    for number in 0..SAMPLES {
        let force = Some(f64::from(number) / 7.0).filter(|_| number % 5 != 0);
        let truth = vec![
            force,
            Some(-0.1 * f64::from(number)),
            Some(1e-9 / f64::from(number + 1)),
        ];
        let mut sample = Sample::new(format!("s{number}"))
            .with_point_id(format!("p{}", number / 20))
            .with_truth(Readings::new(truth))
            .with_frame(frame(number / 3));
        sample.stamp = Some(Stamp {
            valid_s: 1.0e3 + f64::from(number) / 30.0,
            received_s: None,
        });
        sample.repeat = Some(u32::from(number / 10 % 2));
        sample.depth_step = (number % 4 != 0).then_some(u32::from(number % 10));
        sample.phase = (number % 3 != 0).then_some(Phase::Unload);
        sample.limited_by = (number % 10 == 9).then_some(Limit::NormalForce);
        sample.zero_u_mm = (number % 5 != 0).then_some(0.004 / f64::from(number));
        sample.scene_id = (number < 500).then(|| "dark, \"room\"".to_owned());
        recorder.append(&sample).expect("recorded");
    }
    recorder.append_reference(&frame(9000)).expect("recorded");
    recorder.close().expect("closed");
    Dataset::open(&path).expect("a dataset")
}

/// Transducer and sensor with certificates, and robot without a certificate.
fn traced() -> Vec<Traceability> {
    let day = |text: &str| text.parse().expect("a day");
    let amount = |text: &str| text.parse().expect("an amount");
    let certificate = |number: &str| {
        let coverage = Coverage::Factor(2.0);
        let mut certificate = Certificate::new(number, "π", day("2026-05-12"), "42", coverage);
        certificate.valid_until = Some(day("2027-05-12"));
        certificate.expanded.insert("Fz".to_owned(), amount("3 mN"));
        let range = [amount("50 mN"), amount("50 N")];
        certificate.range.insert("Fz".to_owned(), range);
        Some(certificate)
    };
    let force = Traceability::new(Instrument::Force);
    let mut force = force.with_driver("ati/netft", Some("42".to_owned()));
    force.certificate = certificate("D-K-1");
    let robot = Traceability::new(Instrument::Robot).with_driver("lab/arm", None);
    let mut sensor = Traceability::new(Instrument::Sensor);
    sensor.certificate = certificate("D-K-2");
    vec![force, robot, sensor]
}

/// Recording of taxels, whose first rows are without contact.
pub(crate) fn skin(folder: &Path) -> Dataset {
    let path = folder.join("skin");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("skin"));
    let info = SignalInfo::new(2, 3, 2, Unit::Microtesla).expect("a grid");
    let signals = SignalsSpec::new(info, ["x", "y"]).expect("named");
    let channels = Channels::new([Channel::FZ]).expect("distinct");
    let spec =
        RecordingSpec::new(facts, channels).with_signals(signals.with_rest([[0, 2], [5, 5]]));
    let mut recorder = Recorder::create(&path, &spec).expect("new");
    for number in 0..40_u8 {
        let values = (0..12_u8)
            .map(|place| (f32::from(place) - 3.3) * 10_f32.powi(i32::from(number % 9) - 5) / 3.0);
        let sample = Sample::new(format!("{number}"))
            .with_truth(Readings::new(vec![Some(f64::from(number) / 3.0)]))
            .with_signals(Signals::new(info, values.collect()).expect("whole"));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(&path).expect("a dataset")
}

const MAP: &str = r#"
map_version = 2
table = "labels.csv"
[frame]
column = "file"
channel_order = "bgr"
reference = "unknown"
[columns]
Fz = { from = "force", unit = "mN" }
[ids]
sample = "name"
part = "part"
kind = "kind"
spacing_mm = "spacing"
[attributes]
image = "kleid"
frames = "kleid"
signals = "操作者"
timestamp = "操作者"
group = "操作者"
row = "kleid"
index = "kleid"
file = "操作者"
path = "kleid"
[time]
clock = "unix"
column = "t"
unit = "ms"
[sensor]
model = "lab"
serial = "unknown"
gel = "g'1"
opaque = "unknown"
"#;

/// Import of BGR and JPEG pictures, with the origin of each row and names in several scripts.
pub(crate) fn imported(folder: &Path) -> Dataset {
    let lab = folder.join("lab");
    fs::create_dir_all(lab.join("bilder")).expect("made");
    let mut table = "file,name,force,part,kind,spacing,kleid,操作者,t\n".to_owned();
    for number in 0..12_u8 {
        let (name, part) = (
            format!("нажатие {number} ✓"),
            ["train", "test"][usize::from(number % 2)],
        );
        let kind = ["line", "dot", ""][usize::from(number % 3)];
        let spacing = if kind.is_empty() { "" } else { "0.35" };
        let force = if number == 4 {
            String::new()
        } else {
            format!("{}.5", u32::from(number) * 100)
        };
        writeln!(table, "bilder/{number}.jpg,{name},{force},{part},{kind},{spacing},\"a, \"\"b\"\"\",山田 {number},{}", 1_700_000_000_000_u64 + u64::from(number))
            .expect("text");
        let picture = RgbImage::from_fn(16, 8, |x, y| {
            let [x, y] = [x, y].map(|side| side.to_le_bytes()[0]);
            Rgb([x * 9 + number, y * 20, 200 - x * 3])
        });
        let path = lab.join(format!("bilder/{number}.jpg"));
        let written = DynamicImage::ImageRgb8(picture).save_with_format(path, ImageFormat::Jpeg);
        written.expect("written");
    }
    fs::write(lab.join("labels.csv"), table).expect("written");
    let map = ImportMap::parse("map.toml".as_ref(), MAP).expect("a map");
    import(&lab, &map, &folder.join("imported"))
}

/// Dataset imported from the folder `source`.
pub(crate) fn import(source: &Path, map: &ImportMap, target: &Path) -> Dataset {
    let plan = ImportPlan::new(source, map).expect("planned");
    plan.run(target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(target).expect("a dataset")
}

/// Exports a dataset to a folder beside it, on several threads.
pub(crate) fn exported(dataset: &Dataset, form: ExportForm) -> (PathBuf, ExportReport) {
    let target = dataset.path().with_extension(form.name());
    let jobs = NonZeroUsize::new(3).expect("three");
    let plan = ExportPlan::new(dataset, form).expect("samples");
    let report = plan.run(&target, jobs, &SilentProgress).expect("exported");
    (target, report)
}
