//! The built-in driver `camera/v4l2`.

use std::fs;
use std::path::Path;

use super::kernel::FourCc;
use taceva_core::{
    ArgSpec, ArgValue, Args, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, Factory, Facts, Found, FrameInfo, Hertz, PixelFormat, Rig, Sensor, SensorFacts,
    submit_builtin,
};

use super::KEY;
use super::camera::{LocalCamera, V4l2Options};
use super::fixed::Fixed;
use super::leds::Leds;
use crate::arguments::optional_number;
use crate::camera::crop::Crop;
use crate::camera::preset::Preset;
use crate::name_order;
use crate::present::access_of;
use crate::text::shown;

submit_builtin!(dyn Sensor, || Ok(Box::new(V4l2Factory::new()?)));

/// Opens local cameras (Linux), such as the cameras in DIGIT and GelSight Mini: `camera/v4l2:device=/dev/video0;preset=digit`.
///
/// # The physical contract
/// - Opening sets size, pixel format and rate. A camera that does not support them is rejected, with the list of supported formats. For JPEG, opening
///   captures one image.
/// - Exposure, gain, white balance and focus are **fixed**. Automatic control is switched off at open and at every start; requested values are set
///   and read back; others stay unchanged. The values read back are stored with a recording. A camera that keeps automatic control on is rejected, or
///   flagged with `automatic=keep`.
/// - A frame is the newest image received, with the kernel's time stamp on the monotonic clock. Missed images are counted from gaps in the image
///   numbers. A damaged, short or wrongly sized image is an error of that frame. An unplugged camera is `Disconnected`; `start` reopens it.
/// - A camera serves one program. A second program gets an error that the camera is in use.
/// - With `preset=digit`, `led` sets the LEDs of the sensor at open and at every start. The LEDs are read back, and stored with a recording. LEDs
///   that do not keep the value are an error. Without `led` the LEDs stay unchanged and are read back.
///
/// # Verification
/// The test `kernel` of `taceva-wire` runs the kernel's emulated camera `vivid` in a virtual machine. The test compares YUYV pixels with the colour
/// bars of `vivid`. The driver suite, gain, a second program and unplugging are tested too. `vivid` gives only uncompressed pixels and, of the fixed
/// controls, only gain and automatic gain. The test checks that `vivid` rejects `pixels=mjpeg`, `exposure_ms`, `white_balance_k` and `focus`.
/// **Not verified without the device**: JPEG through this interface (decoded as in `camera/mjpeg`), exposure, white balance and focus, the presets,
/// and the latency.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::camera::v4l2::V4l2Factory;
/// let factory = V4l2Factory::new()?;
/// let args = factory.descriptor().args("device=/dev/video0;preset=digit;exposure_ms=15").expect("good");
/// let described = factory.describe(&args)?;
/// assert_eq!(described.sensor().and_then(|facts| facts.camera), Some([640, 480]));
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct V4l2Factory {
    descriptor: Descriptor,
}

/// Default width and height of an image, pixels.
const USUAL: [u32; 2] = [640, 480];
/// Maximum width or height of an image, pixels, as for image files.
const SIDE_MAX: i64 = 16_384;

impl V4l2Factory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the built-in descriptor is inconsistent. Tests exclude this case.
    pub fn new() -> Result<V4l2Factory, DescriptorError> {
        let side = |key: &str, help: &str| {
            ArgSpec::whole(key, 2, SIDE_MAX)
                .optional()
                .help(help)
                .changes_facts()
        };
        let arguments = [
            ArgSpec::path("device")
                .help("device file, such as /dev/video0 or a file below /dev/v4l/by-id"),
            Preset::argument(&KEY),
            side(
                "width",
                "width of its pictures, pixels; default: 640, or that of the preset",
            ),
            side(
                "height",
                "height of its pictures, pixels; default: 480, or that of the preset",
            ),
            ArgSpec::choice("pixels", ["any", "yuyv", "mjpeg"])
                .optional()
                .help("pixel format; any prefers YUYV to MJPEG")
                .changes_facts(),
            ArgSpec::number("rate", 0.1, 10_000.0)
                .unit("Hz")
                .optional()
                .help("frames per second; default: unchanged, or that of the preset")
                .changes_facts(),
        ];
        let facts = Facts::Sensor(Box::default());
        let spec = DescriptorSpec::new(KEY, "a camera of this machine", DriverSource::Real, facts);
        let spec = spec
            .arguments(arguments)
            .arguments(Fixed::arguments())
            .arguments([Leds::argument()]);
        Ok(V4l2Factory {
            descriptor: spec.check()?,
        })
    }
}

impl Factory<dyn Sensor> for V4l2Factory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        spec.facts = Facts::Sensor(Box::new(options(args).facts()));
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        Ok(Box::new(LocalCamera::open(options(args))?))
    }

    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        Ok(cameras_in(Path::new("/")))
    }
}

impl V4l2Options {
    /// Facts about the sensor that are known before the camera is opened.
    fn facts(&self) -> SensorFacts {
        let sent = FrameInfo {
            width: self.width,
            height: self.height,
            format: PixelFormat::Rgb8,
        };
        let mut facts = SensorFacts::default();
        // Only the first JPEG file shows whether the camera is gray.
        facts.frame = (self.pixels == [FourCc::YUYV]).then(|| self.crop.of(sent));
        facts.camera = Some([self.width, self.height]);
        facts.rate = self.rate_hz.map(Hertz);
        facts
    }
}

fn options(args: &Args) -> V4l2Options {
    let text = |key| args.get(key).and_then(ArgValue::as_text);
    let preset = text("preset").and_then(|name| Preset::named(&KEY, name));
    let side = |key, of_preset: Option<u32>, usual| {
        let given = args.get(key).and_then(|value| match value {
            ArgValue::Whole(number) => u32::try_from(*number).ok(),
            _ => None,
        });
        given.or(of_preset).unwrap_or(usual)
    };
    let [width, height] = USUAL;
    let width = side("width", preset.map(|preset| preset.width), width);
    let height = side("height", preset.map(|preset| preset.height), height);
    let of_preset = preset.and_then(|preset| preset.pixels.as_deref());
    let pixels = match text("pixels").or(of_preset) {
        Some("yuyv") => vec![FourCc::YUYV],
        Some("mjpeg") => vec![FourCc::MJPG],
        _ => vec![FourCc::YUYV, FourCc::MJPG],
    };
    V4l2Options {
        device: args.text("device").to_owned(),
        width,
        height,
        pixels,
        rate_hz: optional_number(args, "rate").or(preset.map(|preset| preset.rate_hz)),
        crop: preset.map_or(Crop::NONE, |preset| preset.crop(width, height)),
        fixed: Fixed::of(args),
        leds: Leds::of(args, preset),
    }
}

/// Cameras that the system with root folder `root` lists, sorted by the names of their device files.
fn cameras_in(root: &Path) -> Vec<Found> {
    let class = root.join("sys/class/video4linux");
    let entries = fs::read_dir(&class).into_iter().flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.starts_with("video"))
        .collect();
    names.sort_by(|one, other| name_order::compare(one, other));
    let read = |name: &str, file: &str| {
        let text = fs::read_to_string(class.join(name).join(file)).unwrap_or_default();
        text.trim().to_owned()
    };
    // Further device files of a camera give no images.
    let first = names.iter().filter(|name| read(name, "index") == "0");
    let found = first.map(|name| {
        let path = format!("/dev/{name}");
        let card = read(name, "name");
        let preset = Preset::of(&KEY).find(|preset| {
            let begins = preset.card.as_ref();
            begins.is_some_and(|begins| card.starts_with(begins.as_str()))
        });
        let stable = stable_name(root, name).unwrap_or_else(|| path.clone());
        let arguments = match preset {
            Some(preset) => format!("device={stable};preset={}", preset.name),
            None => format!("device={stable}"),
        };
        let title = match card.is_empty() {
            true => path.clone(),
            false => shown(&card),
        };
        Found::new(KEY, title)
            .with_arguments(arguments)
            .with_access(access_of(&root.join(&path[1..]), "video"))
    });
    found.collect()
}

/// Device path of the camera `name` that remains valid after replugging; `None` if the system provides none.
fn stable_name(root: &Path, name: &str) -> Option<String> {
    let folder = root.join("dev/v4l/by-id");
    let mut links: Vec<_> = fs::read_dir(&folder).ok()?.flatten().collect();
    links.sort_by_key(fs::DirEntry::file_name);
    let leads_there = |link: &fs::DirEntry| {
        let target = fs::read_link(link.path()).ok();
        target.is_some_and(|target| target.file_name().is_some_and(|file| file == name))
    };
    let link = links.into_iter().find(leads_there)?;
    let link = link.file_name().into_string().ok()?;
    // A `;` would end the argument.
    (!link.contains(';')).then(|| format!("/dev/v4l/by-id/{link}"))
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn cameras_are_listed_by_their_lasting_names_with_what_is_known_of_them() {
        let root = tempfile::tempdir().expect("a folder");
        let camera = |name: &str, index: &str, card: &str| {
            let folder = root.path().join("sys/class/video4linux").join(name);
            fs::create_dir_all(&folder).expect("a folder");
            fs::write(folder.join("index"), index).expect("a file");
            fs::write(folder.join("name"), format!("{card}\n")).expect("a file");
        };
        camera("video10", "0", "Webcam");
        camera("video2", "0", "DIGIT: DIGIT");
        camera("video3", "1", "DIGIT: DIGIT");
        let links = root.path().join("dev/v4l/by-id");
        fs::create_dir_all(&links).expect("a folder");
        symlink("../../video2", links.join("usb-DIGIT_D20042-video-index0")).expect("a link");
        let found = cameras_in(root.path());
        let listed: Vec<(&str, &str)> = found
            .iter()
            .map(|found| (found.title.as_str(), found.arguments.as_str()))
            .collect();
        assert_eq!(
            listed,
            [
                (
                    "DIGIT: DIGIT",
                    "device=/dev/v4l/by-id/usb-DIGIT_D20042-video-index0;preset=digit"
                ),
                ("Webcam", "device=/dev/video10"),
            ]
        );
        assert_eq!(cameras_in(&root.path().join("nothing")), []);
    }

    #[test]
    fn what_is_given_counts_before_the_preset() {
        let factory = V4l2Factory::new().expect("a factory");
        let of = |arguments: &str| options(&factory.descriptor().args(arguments).expect("good"));
        let mini = of("device=/dev/video0;preset=gelsight-mini");
        assert_eq!(
            (mini.width, mini.height, mini.rate_hz),
            (3280, 2464, Some(25.0))
        );
        assert_eq!(mini.pixels, [FourCc::MJPG]);
        assert_eq!(
            mini.crop,
            Crop {
                left: 492,
                top: 369
            }
        );
        let small = of("device=/dev/video0;preset=digit;width=320;height=240;rate=60");
        assert_eq!(
            (small.width, small.height, small.rate_hz),
            (320, 240, Some(60.0))
        );
        let plain = of("device=/dev/video0;pixels=yuyv");
        let frame = plain.facts().frame.expect("known");
        assert_eq!((frame.width, frame.height, plain.rate_hz), (640, 480, None));
        let refused = factory
            .descriptor()
            .args("device=/dev/video0;preset=gelsight-r15");
        assert!(refused.is_err(), "a preset of another driver");
    }
}
